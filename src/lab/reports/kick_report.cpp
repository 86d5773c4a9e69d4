#include "nonet/lab/reports/kick_report.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "nonet/lab/common/statistics.h"
#include "nonet/math/angle.h"
#include "nonet/math/random.h"
#include "nonet/motion/kick_catalogue.h"

#include "lab/common/parallel.h"

namespace nonet::lab {

namespace {

KickFigure figureOf(const std::vector<double>& sample) {
  if (sample.empty()) return {};
  return {mean(sample), quantile(sample, 0.5), quantile(sample, 0.1)};
}

/// Where a ball was highest.
struct Apex {
  double height = 0.0;  // m
  double at = 0.0;      // m from where it lay
};
Apex apexOf(const Kick& kick) {
  Apex apex;
  for (const Vector3& p : kick.path)
    if (p.z() > apex.height) apex = {p.z(), p.head<2>().norm()};
  return apex;
}

double deviation(const std::vector<double>& sample) {
  if (sample.size() < 2) return 0.0;
  return standardError(sample) * std::sqrt(static_cast<double>(sample.size()));
}

KickMeasures statisticsOf(const std::string& name, const motion::KickHead& head, std::vector<Kick> kicks,
                          double asked) {
  KickMeasures s;
  s.name = name;
  s.trials = static_cast<int>(kicks.size());
  if (head.isChip()) s.clears = 0.0;
  const auto share = 1.0 / static_cast<double>(s.trials);
  std::vector<double> distances;
  std::vector<double> reached;
  std::vector<double> heights;
  std::vector<double> apexes;
  std::vector<double> apexPlaces;
  std::vector<double> directions;
  std::vector<double> times;
  for (const Kick& kick : kicks) {
    s.falls += kick.fell ? share : 0.0;
    s.misses += kick.missed() ? share : 0.0;
    s.selfCollisions += kick.selfCollided ? share : 0.0;
    if (s.clears) *s.clears += kick.clears(head) ? share : 0.0;
    s.under2m += kick.tooShort() ? share : 0.0;
    distances.push_back(kick.forward);
    reached.push_back(kick.forward / asked);
    heights.push_back(kick.height);
    if (kick.missed()) continue;
    const Apex apex = apexOf(kick);
    apexes.push_back(apex.height);
    apexPlaces.push_back(apex.at);
    directions.push_back(std::abs(kick.direction()));
    times.push_back(kick.time);
    s.withinTen += std::abs(kick.direction()) < toRadians(10.0) ? share : 0.0;
  }
  s.distance = figureOf(distances);
  s.reached = figureOf(reached);
  s.height = figureOf(heights);
  s.apex = figureOf(apexes);
  s.apexAt = figureOf(apexPlaces);
  s.apexSpread = deviation(apexes);
  s.directionError = figureOf(directions);
  s.time = figureOf(times);
  s.kicks = std::move(kicks);
  return s;
}

nlohmann::ordered_json jsonOf(const KickFigure& figure, double unit = 1.0) {
  return {{"mean", unit * figure.mean}, {"median", unit * figure.median}, {"p10", unit * figure.p10}};
}

}  // namespace

std::vector<std::string> kickNames(const agent::AgentSettings& agent) {
  const auto library = motion::sharedSkillLibrary(agent.skillFolder, agent.parameters.motion.skills);
  const motion::KickCatalogue catalogue(*library, agent.robotType);
  std::vector<std::string> names;
  for (const motion::KickOption& option : catalogue.options()) {
    if (option.foot == model::Side::Left) names.emplace_back(option.name);
  }
  return names;
}

std::vector<KickMeasures> measureKicks(const KickReportSettings& settings) {
  const std::vector<std::string> known = kickNames(settings.agent);
  std::vector<std::string> names = {settings.kick};
  if (settings.kick == "all") {
    names = known;
  }
  std::vector<KickMeasures> report;
  const Random seeds(settings.seed);
  for (const std::string& name : names) {
    const motion::KickHead head = name == "any" ? motion::KickHead{} : kickHead(settings.agent, name);
    std::vector<Kick> kicks(static_cast<std::size_t>(settings.trials));
    const int threads = settings.server ? 1 : settings.threads;
    inParallel(settings.trials, threads, settings.progress, name, [&](int i) {
      KickScene scene;
      scene.kick = name == "any" ? "" : name;
      scene.start = settings.start;
      scene.rolling = settings.rolling;
      scene.pushed = settings.pushed;
      scene.passed = settings.passed;
      scene.distance = settings.distance;
      scene.stops = settings.stops || head.scales;
      scene.bearing = kickBearing(i);
      const std::uint64_t seed = seeds.fork(static_cast<std::uint64_t>(i)).next();
      kicks[static_cast<std::size_t>(i)] = settings.server
                                               ? kickOnServer(settings.agent, *settings.server, scene, seed)
                                               : kickOnce(settings.agent, sim::Settings{}, scene, seed);
    });
    report.push_back(statisticsOf(name, head, std::move(kicks), settings.distance));
  }
  return report;
}

std::string kickReportTable(const std::vector<KickMeasures>& report) {
  std::string out =
      fmt::format("{:<20} {:>7} {:>6} {:>6} {:>6} {:>9} | {:>6} {:>7} {:>6} {:>8} | {:>8} {:>6} {:>7}\n",
                  "kick", "trials", "falls", "fouls", "misses", "under 2 m", "mean m", "median", "p10",
                  "of asked", "off deg", "time s", "high m");
  for (const KickMeasures& s : report) {
    out += fmt::format(
        "{:<20} {:>7} {:>5.1f}% {:>5.1f}% {:>5.1f}% {:>8.1f}% | {:>6.2f} {:>7.2f} {:>6.2f} {:>7.0f}% | "
        "{:>8.1f} "
        "{:>6.2f} "
        "{:>7.2f}\n",
        s.name, s.trials, 100.0 * s.falls, 100.0 * s.selfCollisions, 100.0 * s.misses, 100.0 * s.under2m,
        s.distance.mean, s.distance.median, s.distance.p10, 100.0 * s.reached.median,
        toDegrees(s.directionError.mean), s.time.mean, s.height.mean);
  }
  for (const KickMeasures& s : report)
    if (s.clears)
      out += fmt::format("{:<20} {:.1f}% high enough a metre on, and down soon enough\n", s.name,
                         100.0 * *s.clears);
  out += "fouls: the referee froze limbs that collided with the robot's own\n";
  out += "\nwhat the heads should say of the balls' flights:\n";
  for (const KickMeasures& s : report)
    out += fmt::format("{:<20} flies {:.2f}m at {:.1f}m within {:.2f}m\n", s.name, s.apex.median,
                       s.apexAt.median, s.apexSpread);
  return out;
}

std::string kickReportJson(const std::vector<KickMeasures>& report, const KickReportSettings& settings) {
  nlohmann::ordered_json json;
  for (const KickMeasures& s : report) {
    json[s.name] = {{"type", settings.agent.robotType},
                    {"trials", s.trials},
                    {"asked_m", settings.distance},
                    {"distance_m", jsonOf(s.distance)},
                    {"of_asked", jsonOf(s.reached)},
                    {"height_1m_m", jsonOf(s.height)},
                    {"apex_m", jsonOf(s.apex)},
                    {"apex_at_m", jsonOf(s.apexAt)},
                    {"apex_spread_m", s.apexSpread},
                    {"direction_error_deg", jsonOf(s.directionError, toDegrees(1.0))},
                    {"time_s", jsonOf(s.time)},
                    {"under_2m", s.under2m},
                    {"within_10_deg", s.withinTen},
                    {"misses", s.misses},
                    {"falls", s.falls},
                    {"self_collisions", s.selfCollisions}};
    if (s.clears) json[s.name]["clears"] = *s.clears;
  }
  return json.dump(2) + "\n";
}

}  // namespace nonet::lab
