// Walk reports as table, JSON and SVG.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "nonet/lab/reports/walk_report.h"

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
  return fmt::format("{:7.3f} +- {:.3f}", e.mean, e.ci95);
}

// One curve of a time plot.
struct Curve {
  std::string name;
  std::string color;
  std::vector<double> values;
};

// A box with curves over the same times, scaled to its own range.
std::string panel(const std::string& title, const std::vector<Curve>& curves, double top, double cycleTime) {
  constexpr double kLeftEdge = 60.0;
  constexpr double kWidth = 800.0;
  constexpr double kHeight = 140.0;
  double low = 1e9;
  double high = -1e9;
  std::size_t count = 2;
  for (const Curve& curve : curves) {
    for (const double value : curve.values) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
    count = std::max(count, curve.values.size());
  }
  const double range = std::max(high - low, 1e-6);
  std::string svg = fmt::format(
      "<rect x='{}' y='{}' width='{}' height='{}' fill='none' stroke='#999'/>\n<text x='{}' "
      "y='{}'>{}</text>\n"
      "<text x='2' y='{}'>{:.3f}</text>\n<text x='2' y='{}'>{:.3f}</text>\n"
      "<text x='{}' y='{}'>{:.2f} s</text>\n",
      kLeftEdge, top, kWidth, kHeight, kLeftEdge, top - 5, title, top + 10, high, top + kHeight, low,
      kLeftEdge + kWidth - 40, top + kHeight + 14, static_cast<double>(count) * cycleTime);
  double label = kLeftEdge + 300;
  for (const Curve& curve : curves) {
    svg += fmt::format("<text x='{}' y='{}' fill='{}'>{}</text>\n<polyline fill='none' stroke='{}' points='",
                       label, top - 5, curve.color, curve.name, curve.color);
    label += 130;
    for (std::size_t i = 0; i < curve.values.size(); ++i) {
      const double x = kLeftEdge + kWidth * static_cast<double>(i) / static_cast<double>(count - 1);
      const double y = top + kHeight * (high - curve.values[i]) / range;
      svg += fmt::format("{:.1f},{:.1f} ", x, y);
    }
    svg += "'/>\n";
  }
  return svg;
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
  constexpr double kCenter = 260.0;
  double fastest = 0.1;
  for (const Estimate& e : report.steady) fastest = std::max(fastest, e.mean);
  const double rings = std::ceil(fastest / 0.2);
  const double scale = 220.0 / (0.2 * rings);
  std::string svg =
      "<svg xmlns='http://www.w3.org/2000/svg' width='520' height='540' font-family='sans-serif' "
      "font-size='12'>\n"
      "<rect width='520' height='540' fill='white'/>\n";
  for (int ring = 1; ring <= static_cast<int>(rings); ++ring) {
    svg += fmt::format(
        "<circle cx='{0}' cy='{0}' r='{1:.1f}' fill='none' stroke='#ccc'/>\n<text x='{2}' y='{3:.1f}' "
        "fill='#888'>{4:.1f} m/s</text>\n",
        kCenter, 0.2 * ring * scale, kCenter + 3, kCenter - 0.2 * ring * scale - 2, 0.2 * ring);
  }
  const auto curve = [&](const std::array<Estimate, kWalkDirections>& speeds, const char* color) {
    svg += fmt::format("<polygon fill='none' stroke='{}' stroke-width='2' points='", color);
    for (int d = 0; d < kWalkDirections; ++d) {
      const double angle = 2.0 * kPi * d / kWalkDirections;
      const double r = scale * std::max(0.0, speeds[static_cast<std::size_t>(d)].mean);
      // Forward is up, left is left.
      svg += fmt::format("{:.1f},{:.1f} ", kCenter - r * std::sin(angle), kCenter - r * std::cos(angle));
    }
    svg += "'/>\n";
  };
  curve(report.fromStand, "#e08020");
  curve(report.steady, "#2060c0");
  svg += fmt::format(
      "<text x='10' y='525' fill='#2060c0'>steady</text><text x='80' y='525' fill='#e08020'>first 3 s"
      "</text><text x='180' y='525'>turning {:.0f} deg/s, {} falls in {} walks</text>\n</svg>\n",
      toDegrees(report.turn.mean), report.falls, report.trials);
  return svg;
}

std::string walkTraceSvg(const TrialSetup& setup, const Pose2& velocity, double seconds) {
  RobotTrial trial(setup);
  trial.settle(Pose2());
  const motion::WalkVelocity request{velocity};
  trial.run(request, 3.0);
  Curve comX{"desired", "#2060c0", {}};
  Curve comXMeasured{"measured", "#c03020", {}};
  Curve comY = comX;
  Curve comYMeasured = comXMeasured;
  Curve leftX{"left", "#2060c0", {}};
  Curve rightX{"right", "#c03020", {}};
  Curve leftZ = leftX;
  Curve rightZ = rightX;
  Curve pitch{"pitch", "#2060c0", {}};
  Curve roll{"roll", "#c03020", {}};
  const int cycles = static_cast<int>(seconds / kCycleTime);
  for (int i = 0; i < cycles; ++i) {
    trial.step(request);
    const motion::WalkTrace& trace = trial.motion().walk().engine().trace();
    comX.values.push_back(trace.p_SComDesired.x());
    comXMeasured.values.push_back(trace.p_SComMeasured.x());
    comY.values.push_back(trace.p_SComDesired.y());
    comYMeasured.values.push_back(trace.p_SComMeasured.y());
    leftX.values.push_back(trace.feet[0].translation().x());
    rightX.values.push_back(trace.feet[1].translation().x());
    leftZ.values.push_back(trace.feet[0].translation().z());
    rightZ.values.push_back(trace.feet[1].translation().z());
    pitch.values.push_back(toDegrees(trial.belief().body.pitch));
    roll.values.push_back(toDegrees(trial.belief().body.roll));
  }
  std::string svg =
      "<svg xmlns='http://www.w3.org/2000/svg' width='880' height='920' font-family='sans-serif' "
      "font-size='11'>\n"
      "<rect width='880' height='920' fill='white'/>\n";
  svg += panel("centre of mass ahead of the stance foot, m", {comX, comXMeasured}, 30, kCycleTime);
  svg += panel("centre of mass left of the stance foot, m", {comY, comYMeasured}, 210, kCycleTime);
  svg += panel("soles ahead of the torso, m", {leftX, rightX}, 390, kCycleTime);
  svg += panel("soles above the torso, m", {leftZ, rightZ}, 570, kCycleTime);
  svg += panel("torso tilt, degrees", {pitch, roll}, 750, kCycleTime);
  return svg + "</svg>\n";
}

}  // namespace nonet::lab
