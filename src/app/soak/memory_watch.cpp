#include "nonet/app/soak/memory_watch.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

namespace nonet::app {

double residentMemory(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/status");
  constexpr std::string_view kKey = "VmRSS:";
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(kKey)) return std::stod(line.substr(kKey.size())) / 1024.0;
  }
  return 0.0;
}

std::vector<pid_t> childrenOf(pid_t parent) {
  std::vector<pid_t> found;
  std::error_code gone;
  for (const auto& task :
       std::filesystem::directory_iterator("/proc/" + std::to_string(parent) + "/task", gone)) {
    std::ifstream children(task.path() / "children");
    for (pid_t child = 0; children >> child;) found.push_back(child);
  }
  return found;
}

void MemoryWatch::look(double time, pid_t pid) {
  const double megabytes = residentMemory(pid);
  if (megabytes > 0.0) samples_[pid].push_back({time, megabytes});
}

MemoryGrowth MemoryWatch::growth() const {
  MemoryGrowth growth;
  for (const auto& [pid, samples] : samples_) {
    const double begin = samples.front().time;
    growth.megabytes = std::max(growth.megabytes, samples.back().megabytes);
    const double watched = samples.back().time - begin;
    if (watched < kShortestWatch) continue;
    std::vector<double> times;
    std::vector<double> sizes;
    for (const Sample& sample : samples) {
      if (sample.time < begin + 0.5 * watched) continue;
      times.push_back(sample.time / 3600.0);
      sizes.push_back(sample.megabytes);
    }
    growth.perHour = std::max(growth.perHour.value_or(slopeOf(times, sizes)), slopeOf(times, sizes));
  }
  return growth;
}

double slopeOf(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() < 3) return 0.0;
  const auto count = static_cast<double>(x.size());
  double meanX = 0.0;
  double meanY = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    meanX += x[i] / count;
    meanY += y[i] / count;
  }
  double square = 0.0;
  double product = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    square += (x[i] - meanX) * (x[i] - meanX);
    product += (x[i] - meanX) * (y[i] - meanY);
  }
  return square > 0.0 ? product / square : 0.0;
}

}  // namespace nonet::app
