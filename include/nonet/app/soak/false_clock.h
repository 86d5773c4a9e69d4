// A wall clock that jumps, for single processes: nobody else's clock is touched.
#pragma once

#include <string>
#include <vector>

#include <sys/types.h>

namespace nonet::app {

/// Processes that are started with variables() read a wall clock that is off by as much as jump() said last.
/// Clocks that only count on stay true, as when somebody sets the machine's clock. Done by libfaketime.
class FalseClock {
 public:
  /// `file` says by how much. Throws std::runtime_error without libfaketime.
  explicit FalseClock(std::string file);

  /// What the environment of a process needs, each NAME=value.
  std::vector<std::string> variables() const;
  /// Off by so many seconds from now on. The processes see it within kTillSeen.
  void jump(long seconds) const;
  static constexpr double kTillSeen = 1.0;  // s

  /// What the library leaves behind of a process that was killed.
  static void clean(pid_t pid);

 private:
  std::string library_;
  std::string file_;
};

}  // namespace nonet::app
