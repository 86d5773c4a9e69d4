#include "nonet/lab/reports/kick_report.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "nonet/lab/common/statistics.h"

#include "lab/common/parallel.h"

namespace nonet::lab {

namespace {

using model::Side;

KickStatistics statisticsOf(const std::vector<Kick>& kicks) {
  KickStatistics s;
  s.kicks = static_cast<int>(kicks.size());
  const auto count = static_cast<double>(s.kicks);
  std::vector<double> distances;
  int hits = 0;
  int straight = 0;
  for (const Kick& kick : kicks) {
    s.falls += kick.fell ? 1 : 0;
    s.misses += kick.missed() ? 1 : 0;
    distances.push_back(kick.forward);
    s.duration += kick.duration / count;
    if (kick.missed()) continue;
    ++hits;
    s.directionError += std::abs(kick.direction());
    straight += std::abs(kick.direction()) < toRadians(10.0) ? 1 : 0;
  }
  if (hits > 0) s.directionError /= hits;
  s.withinTen = straight / count;
  const Estimate distance = estimate(distances);
  s.distance = distance.mean;
  s.ci95 = distance.ci95;
  return s;
}

}  // namespace

KickReport measureKicks(const KickReportSettings& settings) {
  const Random seeds(settings.seed);
  std::array<std::vector<Kick>, 2> kicks;
  for (std::vector<Kick>& side : kicks) side.resize(static_cast<std::size_t>(settings.kicks));
  inParallel(2 * settings.kicks, settings.threads, [&](int i) {
    const auto side = static_cast<std::size_t>(i % 2);
    kicks[side][static_cast<std::size_t>(i / 2)] =
        kickOnce(settings.setup, static_cast<Side>(side), settings.from,
                 seeds.fork(static_cast<std::uint64_t>(i)).next());
  });
  return {statisticsOf(kicks[0]), statisticsOf(kicks[1])};
}

std::string kickReportTable(const KickReport& report) {
  std::string out = "foot   kicks  falls  misses  distance m           off deg  within 10 deg  time s\n";
  for (const Side side : {Side::Left, Side::Right}) {
    const KickStatistics& s = report[static_cast<std::size_t>(side)];
    out += fmt::format("{:<5} {:6} {:6} {:7} {:11.2f} +- {:4.2f} {:9.1f} {:13.0f}% {:7.2f}\n",
                       side == Side::Left ? "left" : "right", s.kicks, s.falls, s.misses, s.distance, s.ci95,
                       toDegrees(s.directionError), 100.0 * s.withinTen, s.duration);
  }
  return out;
}

std::string kickReportJson(const KickReport& report) {
  nlohmann::ordered_json json;
  for (const Side side : {Side::Left, Side::Right}) {
    const KickStatistics& s = report[static_cast<std::size_t>(side)];
    json[side == Side::Left ? "left" : "right"] = {{"kicks", s.kicks},
                                                   {"falls", s.falls},
                                                   {"misses", s.misses},
                                                   {"distance_m", {{"mean", s.distance}, {"ci95", s.ci95}}},
                                                   {"direction_error_deg", toDegrees(s.directionError)},
                                                   {"within_10_deg", s.withinTen},
                                                   {"duration_s", s.duration}};
  }
  return json.dump(2) + "\n";
}

}  // namespace nonet::lab
