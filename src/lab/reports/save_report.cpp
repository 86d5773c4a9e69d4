#include "nonet/lab/reports/save_report.h"

#include <algorithm>
#include <array>
#include <cmath>

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
  inParallel(count, settings.threads, settings.progress, "shots", [&](int i) {
    Random random = seeds.fork(static_cast<std::uint64_t>(i));
    const Shot shot =
        challenge ? same[static_cast<std::size_t>(i % kChallengeShots)] : drawShot(kindOf(i), random);
    report.saves[static_cast<std::size_t>(i)] = saveOnce(settings.goalie, server, shot, random.next());
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

}  // namespace nonet::lab
