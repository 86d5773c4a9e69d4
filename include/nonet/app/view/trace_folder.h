// Decision traces (nonet match --trace, nonet replay --trace) for the viewer: which robot's lie where.
#pragma once

#include <cstddef>
#include <map>
#include <string>

namespace nonet::app {

class TraceFolder {
 public:
  /// Looks into every file of the folder. Throws std::runtime_error if there is no trace in it.
  explicit TraceFolder(const std::string& folder);

  std::size_t size() const { return files_.size(); }
  /// The trace of the robot in this slot of the track as a JSON array, one cycle per 0.1 s; "[]" if there is
  /// none. `problem`, if given, gets one sentence with the file's name if that is torn or damaged.
  std::string cycles(std::size_t slot, std::string* problem = nullptr) const;

 private:
  std::map<std::size_t, std::string> files_;  // by slot
};

}  // namespace nonet::app
