// Walk reports as table, JSON and SVG.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "nonet/lab/reports/walk_report.h"

#include "lab/common/plot.h"

namespace nonet::lab {

namespace {

constexpr std::size_t kForward = 0;
constexpr std::size_t kLeft = kWalkDirections / 4;
constexpr std::size_t kBack = kWalkDirections / 2;
constexpr std::size_t kRight = 3 * kWalkDirections / 4;

Estimate mean(const Estimate& a, const Estimate& b) {
  return {0.5 * (a.mean + b.mean), 0.5 * std::hypot(a.ci95, b.ci95)};
}
Estimate degrees(const Estimate& radians) {
  return {toDegrees(radians.mean), toDegrees(radians.ci95)};
}
nlohmann::ordered_json toJson(const Estimate& e) {
  const auto rounded = [](double value) { return std::round(value * 1e4) / 1e4; };
  return {{"mean", rounded(e.mean)}, {"ci95", rounded(e.ci95)}};
}
std::string text(const Estimate& e) {
  return fmt::format("{:7.3f} +- {:<5}", e.mean, errorText(e.ci95));
}

constexpr double kCenter = 300.0;  // of the polar plot
constexpr double kRadius = 220.0;
constexpr double kRing = 0.2;  // m/s from one ring to the next
constexpr const char* kSteady = "#2060c0";
constexpr const char* kFromStand = "#d07010";

// Forward is up, left is left.
std::string spokesAndRings(int rings) {
  std::string svg;
  for (int ring = 1; ring <= rings; ++ring) {
    const double r = kRadius * ring / rings;
    svg += fmt::format(
        "<circle cx='{0}' cy='{0}' r='{1:.1f}' fill='none' stroke='#ccc'/><text x='{2:.1f}' y='{3:.1f}' "
        "fill='#777'>{4:.1f}</text>\n",
        kCenter, r, kCenter + 3 + r * std::sin(0.2), kCenter - r * std::cos(0.2) - 2, kRing * ring);
  }
  constexpr std::array<const char*, 4> kNames = {"forward", "left", "backward", "right"};
  for (int i = 0; i < 8; ++i) {
    const double angle = kPi * i / 4;
    const double x = -std::sin(angle);
    const double y = -std::cos(angle);
    svg += fmt::format("<line x1='{0}' y1='{0}' x2='{1:.1f}' y2='{2:.1f}' stroke='#ddd'/>\n", kCenter,
                       kCenter + kRadius * x, kCenter + kRadius * y);
    svg += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>{}</text>\n",
                       kCenter + (kRadius + 26) * x, kCenter + (kRadius + 14) * y + 4,
                       i % 2 == 0 ? kNames.at(static_cast<std::size_t>(i) / 2)
                                  : fmt::format("{} deg", i < 4 ? 45 * i : 45 * i - 360));
  }
  // An arrow that the robot looks along.
  return svg +
         fmt::format("<path d='M {0} {1} l -6 12 l 12 0 z' fill='#444'/>\n", kCenter, kCenter - kRadius - 6);
}

std::string speedCurve(const std::array<Estimate, kWalkDirections>& speeds, double scale, const char* color) {
  std::string svg = fmt::format("<polygon fill='none' stroke='{}' stroke-width='2' points='", color);
  for (int d = 0; d < kWalkDirections; ++d) {
    const double angle = 2.0 * kPi * d / kWalkDirections;
    const double r = scale * std::max(0.0, speeds[static_cast<std::size_t>(d)].mean);
    svg += fmt::format("{:.1f},{:.1f} ", kCenter - r * std::sin(angle), kCenter - r * std::cos(angle));
  }
  return svg + "'/>\n";
}

// What a walk does, cycle by cycle.
struct WalkCourse {
  std::vector<double> time;                     // s
  std::array<std::vector<double>, 2> desired;   // centre of mass from the stance foot, x and y, m
  std::array<std::vector<double>, 2> measured;  // the same
  std::array<std::vector<double>, 2> ahead;     // soles from the torso, left and right, m
  std::array<std::vector<double>, 2> height;
  std::vector<double> pitch;  // deg
  std::vector<double> roll;

  void add(const RobotTrial& trial) {
    const motion::WalkTrace& trace = trial.motion().walk().engine().trace();
    time.push_back(static_cast<double>(time.size()) * kCycleTime);
    for (std::size_t i = 0; i < 2; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      desired[i].push_back(trace.p_SComDesired[axis]);
      measured[i].push_back(trace.p_SComMeasured[axis]);
      ahead[i].push_back(trace.feet[i].translation().x());
      height[i].push_back(trace.feet[i].translation().z());
    }
    pitch.push_back(toDegrees(trial.belief().body.pitch));
    roll.push_back(toDegrees(trial.belief().body.roll));
  }
};

struct Line {
  const char* name;
  const std::vector<double>& values;
};
Plot timePlot(const std::string& title, const std::string& unit, const std::vector<double>& time,
              const Line& one, const Line& other) {
  Plot plot;
  plot.title = title;
  plot.xLabel = "time, s";
  plot.yLabel = unit;
  plot.curves = {{one.name, kSteady, time, one.values, false},
                 {other.name, "#c03020", time, other.values, false}};
  return plot;
}

}  // namespace

std::string walkReportTable(const WalkReport& report) {
  std::string out;
  const auto line = [&](const std::string& name, const Estimate& e, const char* unit) {
    out += fmt::format("{:<34}{} {}\n", name, text(e), unit);
  };
  line("forward, ten seconds from a stand", report.forwardTenSeconds, "m/s");
  line("forward, steady", report.steady[kForward], "m/s");
  line("backward, steady", report.steady[kBack], "m/s");
  line("sideways, steady", mean(report.steady[kLeft], report.steady[kRight]), "m/s");
  line("turning on the spot", degrees(report.turn), "deg/s");
  line("odometry error (share of way)", report.odometryError, "");
  out += fmt::format("{:<34}{} in {} walks\n\n", "falls", report.falls, report.trials);
  if (report.course.courses > 0) {
    const CourseSummary& c = report.course;
    out += fmt::format("{:<34}{} in {} courses, reward {:.2f}, stops drift {:.2f} m\n", "falls on the course",
                       c.falls, c.courses, c.reward, c.stopDrift);
    out += fmt::format("{:<34}{} in {} courses\n", "falls while sets change at random", c.changeFalls,
                       c.courses);
    out += fmt::format("{:<34}{:7.1f} s, every target reached\n\n", "time for a course", c.time);
  }
  out += "direction     steady m/s         first 3 s m/s      falls\n";
  for (int d = 0; d < kWalkDirections; ++d) {
    const auto at = static_cast<std::size_t>(d);
    out += fmt::format("{:6.1f} deg {} {}  {}\n", 360.0 * d / kWalkDirections, text(report.steady[at]),
                       text(report.fromStand[at]), report.fallsByDirection[at]);
  }
  return out;
}

std::string walkReportJson(const WalkReport& report) {
  nlohmann::ordered_json json;
  json["forward_10s_mps"] = toJson(report.forwardTenSeconds);
  json["forward_mps"] = toJson(report.steady[kForward]);
  json["backward_mps"] = toJson(report.steady[kBack]);
  json["sideways_mps"] = toJson(mean(report.steady[kLeft], report.steady[kRight]));
  json["turn_degps"] = toJson(degrees(report.turn));
  json["odometry_error"] = toJson(report.odometryError);
  json["falls"] = report.falls;
  json["trials"] = report.trials;
  if (report.course.courses > 0) {
    const CourseSummary& c = report.course;
    json["course"] = {{"courses", c.courses},         {"falls", c.falls},
                      {"reward", c.reward},           {"distance_m", c.distance},
                      {"stop_drift_m", c.stopDrift},  {"time_s", c.time},
                      {"change_falls", c.changeFalls}};
  }
  for (int d = 0; d < kWalkDirections; ++d) {
    const auto at = static_cast<std::size_t>(d);
    json["directions"].push_back({{"deg", 360.0 * d / kWalkDirections},
                                  {"steady_mps", toJson(report.steady[at])},
                                  {"first_3s_mps", toJson(report.fromStand[at])},
                                  {"falls", report.fallsByDirection[at]}});
  }
  return json.dump(2) + "\n";
}

std::string walkReportSvg(const WalkReport& report) {
  double fastest = 0.1;
  for (const Estimate& e : report.steady) fastest = std::max(fastest, e.mean);
  for (const Estimate& e : report.fromStand) fastest = std::max(fastest, e.mean);
  const double rings = std::ceil(fastest / kRing);
  const double scale = kRadius / (kRing * rings);
  std::string svg = fmt::format(
      "<text x='14' y='24' font-size='15' font-weight='bold'>robot type {}: walking speed by direction, "
      "m/s</text>\n",
      report.robotType);
  svg += spokesAndRings(static_cast<int>(rings)) + speedCurve(report.fromStand, scale, kFromStand) +
         speedCurve(report.steady, scale, kSteady);
  svg += drawLegend({{"steady", kSteady, false}, {"first 3 s from a stand", kFromStand, false}}, 14.0, 44.0);
  svg += fmt::format(
      "<text x='14' y='592'>forward {:.2f} m/s steady, {:.2f} over ten seconds from a stand; turning {:.0f} "
      "deg/s; {} falls in {} walks</text>\n",
      report.steady[kForward].mean, report.forwardTenSeconds.mean, toDegrees(report.turn.mean), report.falls,
      report.trials);
  return svgPicture(600.0, 604.0, svg);
}

std::string walkTraceSvg(const TrialSettings& setup, const Pose2& velocity, double seconds) {
  RobotTrial trial(setup);
  trial.settle(Pose2());
  const motion::WalkVelocity request{velocity};
  trial.run(request, 3.0);
  WalkCourse walk;
  for (int i = 0; i < static_cast<int>(seconds / kCycleTime); ++i) {
    trial.step(request);
    walk.add(trial);
  }
  const std::array<Plot, 5> plots = {
      timePlot("centre of mass ahead of the stance foot", "m", walk.time, {"desired", walk.desired[0]},
               {"measured", walk.measured[0]}),
      timePlot("centre of mass left of the stance foot", "m", walk.time, {"desired", walk.desired[1]},
               {"measured", walk.measured[1]}),
      timePlot("soles ahead of the torso", "m", walk.time, {"left", walk.ahead[0]}, {"right", walk.ahead[1]}),
      timePlot("soles above the torso", "m", walk.time, {"left", walk.height[0]}, {"right", walk.height[1]}),
      timePlot("torso's tilt", "deg", walk.time, {"pitch, forward", walk.pitch},
               {"roll, to the right", walk.roll})};
  std::string svg = fmt::format(
      "<text x='14' y='22' font-size='15' font-weight='bold'>robot type {}: {:.1f} s of walking, 3 s after "
      "the begin</text>\n<text x='560' y='22'>asked for {:.1f} m/s ahead, {:.1f} m/s to the left, {:.0f} "
      "deg/s</text>\n",
      setup.robotType, seconds, velocity.translation.x(), velocity.translation.y(),
      toDegrees(velocity.rotation));
  double top = 34.0;
  for (const Plot& plot : plots) {
    svg += drawPlot(plot, {kPlotMargin.left, top + kPlotMargin.top, 800.0, 120.0});
    top += 120.0 + kPlotMargin.top + kPlotMargin.bottom;
  }
  return svgPicture(kPlotMargin.left + 800.0 + kPlotMargin.right, top + 6.0, svg);
}

}  // namespace nonet::lab
