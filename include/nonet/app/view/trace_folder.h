// Decision traces (nonet match --trace, nonet replay --trace) for the viewer: which robot's lie where.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace nonet::app {

class TraceFolder {
 public:
  /// Looks into every file of the folder. Throws std::runtime_error if there is no trace in it.
  explicit TraceFolder(const std::string& folder);

  std::size_t size() const { return files_.size(); }
  /// The trace of this player as a JSON array, one cycle per 0.1 s; "[]" if there is none. `problem`, if
  /// given, gets one sentence with the file's name if that is torn or damaged.
  std::string cycles(const std::string& team, int unum, std::string* problem = nullptr) const;

 private:
  using Player = std::pair<std::string, int>;  // team and number: teams may change sides
  static std::optional<Player> playerOf(const std::string& path);

  std::map<Player, std::string> files_;
};

}  // namespace nonet::app
