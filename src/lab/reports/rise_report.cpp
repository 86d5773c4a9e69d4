#include "nonet/lab/reports/rise_report.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "nonet/math/random.h"

#include "lab/common/parallel.h"

namespace nonet::lab {

namespace {

constexpr int kMostThrows = 60;  // until one ends in a fall
constexpr std::array<const char*, kFallKindCount> kNames{"front", "back", "side"};

}  // namespace

RiseReport measureRising(const RiseReportSettings& settings) {
  const int count = static_cast<int>(kFallKindCount) * settings.falls;
  std::vector<Rise> rises(static_cast<std::size_t>(count));
  const Random seeds(settings.seed);
  inParallel(count, settings.threads, settings.progress, "falls", [&](int i) {
    const auto kind = static_cast<FallKind>(i / settings.falls);
    Rise& rise = rises[static_cast<std::size_t>(i)];
    // Some throws are caught or end otherwise than wanted: thrown again.
    Random own = seeds.fork(static_cast<std::uint64_t>(i));
    for (int k = 0; k < kMostThrows && !rise.fell; ++k) rise = fallAndRise(settings.setup, kind, own.next());
  });
  RiseReport report;
  for (std::size_t kind = 0; kind < kFallKindCount; ++kind) {
    RiseStatistics& statistics = report.kinds[kind];
    std::vector<double> times;
    for (int i = 0; i < settings.falls; ++i) {
      const Rise& rise = rises[kind * static_cast<std::size_t>(settings.falls) + static_cast<std::size_t>(i)];
      if (!rise.fell) continue;
      ++statistics.falls;
      if (rise.collided > 0.0) ++statistics.selfCollisions;
      if (!rise.stands) continue;
      ++statistics.risen;
      if (rise.attempts == 1) ++statistics.firstTry;
      times.push_back(rise.time);
    }
    std::sort(times.begin(), times.end());
    if (times.empty()) continue;
    statistics.median = 0.5 * (times[(times.size() - 1) / 2] + times[times.size() / 2]);
    statistics.slowest = times.back();
  }
  return report;
}

std::string riseReportTable(const RiseReport& report) {
  std::string out = "fall    falls  first try  risen  fouls  median s  slowest s\n";
  for (std::size_t kind = 0; kind < kFallKindCount; ++kind) {
    const RiseStatistics& s = report.kinds[kind];
    out += fmt::format("{:<6} {:6} {:10} {:6} {:6} {:9.2f} {:10.2f}\n", kNames[kind], s.falls, s.firstTry,
                       s.risen, s.selfCollisions, s.median, s.slowest);
  }
  return out +
         "fouls: limbs of the robot collided, for which the referee would have frozen them for a second\n";
}

std::string riseReportJson(const RiseReport& report) {
  nlohmann::ordered_json json;
  for (std::size_t kind = 0; kind < kFallKindCount; ++kind) {
    const RiseStatistics& s = report.kinds[kind];
    json[kNames[kind]] = {{"falls", s.falls},     {"first_try", s.firstTry},
                          {"risen", s.risen},     {"self_collisions", s.selfCollisions},
                          {"median_s", s.median}, {"slowest_s", s.slowest}};
  }
  return json.dump(2) + "\n";
}

}  // namespace nonet::lab
