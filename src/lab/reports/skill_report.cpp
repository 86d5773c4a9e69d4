#include "nonet/lab/reports/skill_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "nonet/math/angle.h"
#include "nonet/motion/skill_language.h"

#include "lab/common/plot.h"

namespace nonet::lab {

namespace {

using model::JointId;

constexpr int kColumns = 3;
constexpr double kPanelWidth = 370.0;
constexpr double kPanelHeight = 210.0;
constexpr double kAfter = 0.3;  // s of the held posture that the joints' panels show
constexpr const char* kTold = "#8ab4e8";
constexpr const char* kDone = "#b04a00";
constexpr const char* kLimit = "#c03020";
constexpr const char* kMark = "#888";

double topOf(int row) {
  return kPictureHead + kPanelHeight * row;
}

/// Degrees as the skill's text has them.
double written(JointId joint, double angle) {
  return (motion::countsBackwards(joint) ? -1.0 : 1.0) * toDegrees(angle);
}

std::string_view resultName(SkillTrial::Result result) {
  switch (result) {
    case SkillTrial::Result::Finished:
      return "finished";
    case SkillTrial::Result::Failed:
      return "failed";
    case SkillTrial::Result::Running:
      return "running";
  }
  return "";
}

std::string title(const SkillTrialSettings& settings) {
  return fmt::format("skill {}{}, robot type {}", settings.skill, settings.mirrored ? " (mirrored)" : "",
                     settings.agent.robotType);
}

/// The largest difference between target and angle at the end, and of which joint.
std::pair<JointId, double> worstAtEnd(const SkillTrial& trial) {
  std::pair<JointId, double> worst{JointId::Head1, 0.0};
  for (const JointId joint : trial.moved()) {
    const std::size_t i = model::index(joint);
    const double error = std::abs(trial.cycles.back().target[i] - trial.cycles.back().angle[i]);
    if (error > worst.second) worst = {joint, error};
  }
  return worst;
}

nlohmann::ordered_json toJson(const SkillKick& kick) {
  nlohmann::ordered_json json = {{"ball_from_torso_m", {kick.p_RPlace.x(), kick.p_RPlace.y()}},
                                 {"made_for_walk", kick.fromWalk},
                                 {"contact", kick.contact}};
  if (!kick.contact) return json;
  json["contact_s"] = kick.time;
  json["ball_speed_mps"] = kick.speed;
  json["distance_m"] = kick.distance;
  json["height_m"] = kick.height;
  json["direction_deg"] = toDegrees(kick.direction);
  json["intended_direction_deg"] = toDegrees(kick.intended);
  return json;
}

nlohmann::ordered_json jointsJson(const SkillTrial& trial) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const JointId joint : trial.moved()) {
    const std::size_t i = model::index(joint);
    json[motion::jointWord(joint)] = {{"target_end_deg", written(joint, trial.cycles.back().target[i])},
                                      {"angle_end_deg", written(joint, trial.cycles.back().angle[i])}};
  }
  return json;
}

std::vector<PlotLine> marksOf(const SkillTrial& trial) {
  std::vector<PlotLine> marks;
  for (const SkillMark& mark : trial.marks) marks.push_back({mark.time, fmt::format("{}", mark.line), kMark});
  if (trial.result != SkillTrial::Result::Running) marks.push_back({trial.duration, "end", kMark});
  return marks;
}

/// A column of the trial over time.
template <class Value>
PlotCurve curveOf(const SkillTrial& trial, const char* color, double until, Value value) {
  PlotCurve curve{"", color, {}, {}, false};
  for (const SkillCycle& cycle : trial.cycles) {
    if (cycle.time > until) break;
    curve.x.push_back(cycle.time);
    curve.y.push_back(value(cycle));
  }
  return curve;
}

Plot jointPlot(const SkillTrial& trial, const SkillTrialSettings& settings, JointId joint) {
  const std::size_t i = model::index(joint);
  const model::JointSpec& spec = model::robotModel(settings.agent.robotType).joint(joint);
  const auto [low, high] = std::minmax({written(joint, spec.low), written(joint, spec.high)});
  Plot plot;
  plot.title = fmt::format("{} ({:.0f} to {:.0f} deg)", motion::jointWord(joint), low, high);
  plot.xLabel = "time, s";
  plot.yLabel = "angle, deg";
  const double until = trial.duration + kAfter;
  plot.curves = {
      curveOf(trial, kTold, until, [&](const SkillCycle& c) { return written(joint, c.target[i]); }),
      curveOf(trial, kDone, until, [&](const SkillCycle& c) { return written(joint, c.angle[i]); })};
  plot.curves.front().width = 4.0;  // shows on both sides of the other
  plot.marks = marksOf(trial);
  plot.limits = {{low, "limit", kLimit}, {high, "limit", kLimit}};
  return plot;
}

// A measure that cannot be negative, over the whole trial.
template <class Value>
Plot measurePlot(const SkillTrial& trial, const char* title, const char* yLabel, const Value& value) {
  Plot plot;
  plot.title = title;
  plot.xLabel = "time, s";
  plot.yLabel = yLabel;
  plot.curves = {curveOf(trial, kDone, trial.cycles.back().time, value)};
  plot.marks = marksOf(trial);
  plot.low = 0.0;
  return plot;
}

Plot torsoPlot(const SkillTrial& trial) {
  return measurePlot(trial, "torso above the ground", "height, m",
                     [](const SkillCycle& c) { return c.torsoHeight; });
}

Plot ballPlot(const SkillTrial& trial) {
  return measurePlot(trial, "ball", "speed, m/s", [](const SkillCycle& c) { return c.ballSpeed; });
}

}  // namespace

std::string skillReportText(const SkillTrial& trial, const SkillTrialSettings& settings) {
  const SkillCycle& end = trial.cycles.back();
  std::string text =
      fmt::format("{}: {} after {:.2f} s, watched for {:.2f} s\n", title(settings), resultName(trial.result),
                  trial.duration, static_cast<double>(trial.cycles.size()) * kCycleTime);
  text += fmt::format("  robot    {}; at the end torso {:.3f} m high, tilted {:.0f} deg\n",
                      trial.fell ? "fell" : "did not fall", end.torsoHeight, toDegrees(end.tilt));
  const auto [joint, error] = worstAtEnd(trial);
  text += fmt::format("  joints   {} moved; at the end the farthest off is {} by {:.1f} deg\n",
                      trial.moved().size(), motion::jointWord(joint), toDegrees(error));
  for (const motion::SkillPlayer::Stretch& stretch : trial.stretches)
    text +=
        fmt::format("  curve    of line {} takes {:.2f} s instead of {:.2f} s: its joints are no faster\n",
                    stretch.line, stretch.taken, stretch.wanted);
  if (!trial.kick) return text;
  const SkillKick& kick = *trial.kick;
  text += fmt::format("  ball     {:.3f} m ahead and {:.3f} m to the left of the torso: ", kick.p_RPlace.x(),
                      kick.p_RPlace.y());
  if (kick.contact) {
    text += fmt::format(
        "touched after {:.2f} s, {:.1f} m/s, {:.2f} m far,\n           direction {:+.1f} deg (left is "
        "positive; meant: {:+.1f}), centre up to {:.2f} m high\n",
        kick.time, kick.speed, kick.distance, toDegrees(kick.direction), toDegrees(kick.intended),
        kick.height);
  } else {
    text += "was not touched\n";
  }
  if (kick.fromWalk) text += "           this kick is made to begin out of steps: from a stand it may fail\n";
  return text;
}

std::string skillReportJson(const SkillTrial& trial, const SkillTrialSettings& settings) {
  nlohmann::ordered_json json = {{"skill", settings.skill},
                                 {"type", settings.agent.robotType},
                                 {"mirrored", settings.mirrored},
                                 {"result", resultName(trial.result)},
                                 {"duration_s", trial.duration},
                                 {"watched_s", static_cast<double>(trial.cycles.size()) * kCycleTime},
                                 {"fell", trial.fell},
                                 {"torso_height_end_m", trial.cycles.back().torsoHeight},
                                 {"tilt_end_deg", toDegrees(trial.cycles.back().tilt)},
                                 {"joints", jointsJson(trial)}};
  for (const SkillMark& mark : trial.marks)
    json["statements"].push_back({{"time_s", mark.time}, {"skill", mark.skill}, {"line", mark.line}});
  for (const motion::SkillPlayer::Stretch& stretch : trial.stretches)
    json["stretched_curves"].push_back(
        {{"line", stretch.line}, {"wanted_s", stretch.wanted}, {"taken_s", stretch.taken}});
  if (trial.kick) json["kick"] = toJson(*trial.kick);
  return json.dump(2) + "\n";
}

std::string skillReportSvg(const SkillTrial& trial, const SkillTrialSettings& settings) {
  std::string content;
  int panels = 0;
  const auto add = [&](const char* kind, const Plot& plot) {
    const PlotBox box{kPanelWidth * (panels % kColumns) + kPlotMargin.left,
                      topOf(panels / kColumns) + kPlotMargin.top,
                      kPanelWidth - kPlotMargin.left - kPlotMargin.right,
                      kPanelHeight - kPlotMargin.top - kPlotMargin.bottom};
    content += fmt::format("<g class='{}'>\n{}</g>\n", kind, drawPlot(plot, box));
    ++panels;
  };
  for (const JointId joint : trial.moved()) add("joint", jointPlot(trial, settings, joint));
  add("torso", torsoPlot(trial));
  if (trial.kick) add("ball", ballPlot(trial));
  const std::string head = fmt::format(
      "<text x='14' y='22' font-size='15' font-weight='bold'>{}: {} after {:.2f} s{}</text>\n"
      "<text x='14' y='42'>angles as the skill's text counts them; in brackets the joint's reach; upright "
      "lines: a statement begins, with its line in the file</text>\n",
      xmlText(title(settings)), resultName(trial.result), trial.duration,
      trial.fell ? ", the robot fell" : "");
  const double width = kPanelWidth * kColumns;
  return svgPicture(width, topOf((panels + kColumns - 1) / kColumns) + 8.0,
                    head +
                        drawLegend({{"told (target)", kTold, false},
                                    {"done (measured)", kDone, false},
                                    {"limit of the joint", kLimit, true}},
                                   width - 400.0, 22.0) +
                        content);
}

}  // namespace nonet::lab
