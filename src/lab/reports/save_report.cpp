#include "nonet/lab/reports/save_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lab/common/parallel.h"

namespace nonet::lab {

namespace {

constexpr int kChallengeShots = 12;

ShotKind kindOf(int i) {
  return i % 2 == 0 ? ShotKind::Rolling : ShotKind::Flying;
}

std::vector<Save> only(const std::vector<Save>& saves, ShotKind kind) {
  std::vector<Save> result;
  std::copy_if(saves.begin(), saves.end(), std::back_inserter(result),
               [&](const Save& save) { return save.shot.kind == kind; });
  return result;
}

std::string row(const char* name, const SaveStatistics& s) {
  return fmt::format("{:<8} {:>7} {:>6} {:>6.1f}% {:>8} {:>6} {:>9} {:>7.2f} {:>10} {:>8}\n", name, s.trials,
                     s.saved, 100.0 * s.savedShare(), s.touched, s.falls, s.upAgain, s.riseTime, s.ownGoals,
                     s.cleared);
}

nlohmann::ordered_json jsonOf(const SaveStatistics& s) {
  return {{"trials", s.trials},        {"saved", s.saved},        {"saved_share", s.savedShare()},
          {"touched", s.touched},      {"falls", s.falls},        {"up_after_fall", s.upAgain},
          {"down_mean_s", s.riseTime}, {"own_goals", s.ownGoals}, {"cleared", s.cleared}};
}

// Metres to picture coordinates: the goal at the left, left of the field up; below it the goal from the
// front.
constexpr double kScale = 50.0;
constexpr double kLeftEdge = 60.0;
constexpr double kMiddle = 330.0;
constexpr double kGround = 760.0;
constexpr double kFront = 380.0;  // middle of the goal from the front
constexpr double kFrontScale = 150.0;

std::string circle(double x, double y, double radius, const char* color) {
  return fmt::format("<circle cx='{:.0f}' cy='{:.0f}' r='{:.0f}' fill='{}' fill-opacity='0.7'/>\n", x, y,
                     radius, color);
}

std::string pictureOf(const Save& save) {
  const char* color = save.saved ? "#27a" : "#c33";
  std::string points;
  for (const Vector3& p : save.path)
    points += fmt::format("{:.0f},{:.0f} ", kLeftEdge + kScale * (p.x() + 15.0), kMiddle - kScale * p.y());
  std::string out =
      fmt::format("<polyline fill='none' stroke='{}' stroke-opacity='0.35' points='{}'/>\n", color, points);
  const Vector2& start = save.X_WStart.translation;
  out += circle(kLeftEdge + kScale * (start.x() + 15.0), kMiddle - kScale * start.y(), 2.0, "#555");
  const auto crossing = freeCrossing(save.shot);
  // From the front the left side of the own goal is on the right.
  if (crossing)
    out += circle(kFront + kFrontScale * crossing->y, kGround - kFrontScale * crossing->height,
                  save.shot.kind == ShotKind::Rolling ? 3.0 : 5.0, color);
  return out;
}

}  // namespace

std::vector<Shot> challengeShots(std::uint64_t seed) {
  std::vector<Shot> shots;
  const Random seeds(seed);
  for (int i = 0; i < kChallengeShots; ++i) {
    Random random = seeds.fork(static_cast<std::uint64_t>(i));
    shots.push_back(drawShot(kindOf(i), random));
  }
  return shots;
}

SaveStatistics saveStatistics(const std::vector<Save>& saves) {
  SaveStatistics s;
  s.trials = static_cast<int>(saves.size());
  for (const Save& save : saves) {
    s.saved += save.saved ? 1 : 0;
    s.touched += save.touched ? 1 : 0;
    s.ownGoals += save.ownGoal ? 1 : 0;
    s.cleared += save.cleared ? 1 : 0;
    if (!save.fell) continue;
    ++s.falls;
    s.upAgain += save.up ? 1 : 0;
    s.riseTime += save.riseTime;
  }
  s.riseTime /= std::max(1, s.falls);
  return s;
}

SaveReport measureSaves(const SaveReportSettings& settings) {
  const bool challenge = settings.challenge > 0;
  const std::vector<Shot> same = challenge ? challengeShots(settings.seed) : std::vector<Shot>{};
  const int count = challenge ? settings.challenge * kChallengeShots : 2 * settings.trials;
  sim::Settings server;
  server.quickSolver = settings.quickSolver;
  const Random seeds(settings.seed);
  SaveReport report;
  report.saves.resize(static_cast<std::size_t>(count));
  std::mutex mutex;
  int done = 0;
  inParallel(count, settings.threads, [&](int i) {
    Random random = seeds.fork(static_cast<std::uint64_t>(i));
    const Shot shot =
        challenge ? same[static_cast<std::size_t>(i % kChallengeShots)] : drawShot(kindOf(i), random);
    report.saves[static_cast<std::size_t>(i)] = saveOnce(settings.goalie, server, shot, random.next());
    const std::lock_guard lock(mutex);
    ++done;
    if (settings.progress) settings.progress(done, count);
  });
  report.rolling = saveStatistics(only(report.saves, ShotKind::Rolling));
  report.flying = saveStatistics(only(report.saves, ShotKind::Flying));
  report.all = saveStatistics(report.saves);
  return report;
}

std::string saveReportTable(const SaveReport& report) {
  std::string out =
      fmt::format("{:<8} {:>7} {:>6} {:>7} {:>8} {:>6} {:>9} {:>7} {:>10} {:>8}\n", "shots", "trials",
                  "saved", "share", "touched", "falls", "up again", "down s", "own goals", "cleared");
  return out + row("rolling", report.rolling) + row("flying", report.flying) + row("all", report.all);
}

std::string saveReportJson(const SaveReport& report, const SaveReportSettings& settings) {
  nlohmann::ordered_json json = jsonOf(report.all);
  json["type"] = settings.goalie.robotType;
  json["seed"] = settings.seed;
  json["rolling"] = jsonOf(report.rolling);
  json["flying"] = jsonOf(report.flying);
  auto& shots = json["shots"] = nlohmann::ordered_json::array();
  for (const Save& save : report.saves) {
    const Vector3& p = save.shot.p_WB;
    const Vector3& v = save.shot.v_WB;
    shots.push_back({{"kind", save.shot.kind == ShotKind::Rolling ? "rolling" : "flying"},
                     {"place_m", {p.x(), p.y()}},
                     {"velocity_m_s", {v.x(), v.y(), v.z()}},
                     {"aside_m", save.aside},
                     {"answer", save.answer},
                     {"answer_s", save.answerTime},
                     {"touched", save.touched},
                     {"saved", save.saved},
                     {"own_goal", save.ownGoal},
                     {"fell", save.fell},
                     {"up", save.up},
                     {"cleared", save.cleared}});
  }
  return json.dump(2) + "\n";
}

std::string saveReportSvg(const SaveReport& report) {
  std::string out = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 760 800' font-family='sans-serif' "
      "font-size='13'>\n"
      "<rect width='100%' height='100%' fill='white'/>\n<text x='20' y='24' font-size='16'>{} shots, {:.1f} "
      "% "
      "saved</text>\n<text x='20' y='44'>blue: saved; red: goal; grey: where the goalie stood; below: where "
      "the "
      "free ball crosses the line (small: rolling), seen from the field</text>\n",
      report.all.trials, 100.0 * report.all.savedShare());
  out +=
      fmt::format("<rect x='{:.0f}' y='{:.1f}' width='{:.0f}' height='{:.0f}' fill='#eee' stroke='#555'/>\n",
                  kLeftEdge - 0.6 * kScale, kMiddle - 1.05 * kScale, 0.6 * kScale, 2.1 * kScale);
  out += fmt::format(
      "<rect x='{:.1f}' y='{:.0f}' width='{:.0f}' height='{:.0f}' fill='#eee' stroke='#555'/>\n",
      kFront - 1.05 * kFrontScale, kGround - 0.8 * kFrontScale, 2.1 * kFrontScale, 0.8 * kFrontScale);
  for (const Save& save : report.saves) out += pictureOf(save);
  return out + "</svg>\n";
}

}  // namespace nonet::lab
