// How much memory processes hold over time.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include <sys/types.h>

namespace nonet::app {

/// Resident memory of a process, MB; 0 if there is none.
double residentMemory(pid_t pid);

/// The processes that `parent` has started and that are still there.
std::vector<pid_t> childrenOf(pid_t parent);

struct MemoryGrowth {
  double megabytes = 0.0;  // at the last look, the largest of all processes
  std::optional<double>
      perHour;  // MB, least squares over the later half: the fastest of all processes. Absent for
                // less than kShortestWatch, which tells only how pages are touched for the first time
};
inline constexpr double kShortestWatch = 120.0;  // s

/// Memory of a few processes, looked at now and then. What a program takes at its start is no growth.
class MemoryWatch {
 public:
  /// `time` in s, growing.
  void look(double time, pid_t pid);
  MemoryGrowth growth() const;

 private:
  struct Sample {
    double time = 0.0;
    double megabytes = 0.0;
  };
  std::map<pid_t, std::vector<Sample>> samples_;
};

/// Slope of the least-squares line through (x, y), 0 for fewer than three points.
double slopeOf(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace nonet::app
