#include "nonet/lab/reports/ball_report.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "nonet/lab/trial/scrum_trial.h"
#include "nonet/lab/trial/siege_trial.h"
#include "nonet/math/random.h"

#include "lab/common/parallel.h"

namespace nonet::lab {

namespace {

// All trials of one skill; every skill has the same seeds.
template <class Trial>
auto repeated(const BallReportSettings& settings, const std::string& skill, const Trial& trial) {
  using Result = decltype(trial(std::uint64_t{}));
  std::vector<Result> results(static_cast<std::size_t>(settings.trials));
  const Random seeds(settings.seed);
  inParallel(settings.trials, settings.threads, settings.progress, skill, [&](int i) {
    results[static_cast<std::size_t>(i)] = trial(seeds.fork(static_cast<std::uint64_t>(i)).next());
  });
  return results;
}

// The mean of what `value` says of the trials for which `counts`.
template <class Result, class Value, class Counts>
BallFigure figure(const std::string& key, const char* what, const std::vector<Result>& results,
                  const Value& value, const Counts& counts) {
  std::vector<double> sample;
  for (const Result& result : results) {
    if (counts(result)) sample.push_back(static_cast<double>(value(result)));
  }
  const auto count = static_cast<int>(sample.size());
  if constexpr (std::is_same_v<std::decay_t<decltype(value(results.front()))>, bool>) {
    const auto hits = static_cast<std::size_t>(std::count(sample.begin(), sample.end(), 1.0));
    return {key, what, estimateShare(hits, sample.size()), count};
  }
  return {key, what, estimate(sample), count};
}

template <class Result, class Value>
BallFigure figure(const std::string& key, const char* what, const std::vector<Result>& results,
                  const Value& value) {
  return figure(key, what, results, value, [](const Result&) { return true; });
}

// How near the ball was kept.
void addKeeping(BallSkillReport& report, const std::string& skill, const std::vector<Dribble>& trials) {
  const auto add = [&](const char* key, const char* what, const auto& value) {
    report.figures.push_back(figure(skill + key, what, trials, value));
  };
  add("_kept", "share never lost", [](const Dribble& t) { return t.arrived && !t.lost; });
  add("_near", "share never too far from the torso", [](const Dribble& t) { return t.arrived && !t.tooFar; });
  add("_away", "share of the time lost", [](const Dribble& t) { return t.away; });
  add("_apart_m", "m, farthest from the torso", [](const Dribble& t) { return t.apart; });
  add("_aside_m", "m, farthest from the path", [](const Dribble& t) { return t.aside; });
}

template <class Result>
BallSkillReport reportOf(const std::string& skill, const std::vector<Result>& results,
                         std::vector<BallFigure> figures) {
  BallSkillReport report;
  report.skill = skill;
  report.figures = std::move(figures);
  report.trials = static_cast<int>(results.size());
  for (const Result& result : results) {
    report.falls += result.fell ? 1 : 0;
    report.selfCollisions += result.selfCollisions;
    report.simulated += result.simulated;
  }
  return report;
}

BallSkillReport measureApproach(const BallReportSettings& s, const sim::Settings& server) {
  const auto trials = repeated(s, "approach", [&](auto seed) { return approachOnce(s.agent, server, seed); });
  const auto arrived = [](const Approach& trial) { return trial.arrived; };
  return reportOf(
      "approach", trials,
      {figure(
           "approach_s", "s until in place", trials, [](const auto& t) { return t.time; }, arrived),
       figure("approach_share", "share in place within 10 s", trials, arrived)});
}

BallSkillReport measureDribbling(const BallReportSettings& s, const sim::Settings& server) {
  const auto trials = repeated(s, "dribble", [&](auto seed) { return dribbleOnce(s.agent, server, seed); });
  BallSkillReport report = reportOf(
      "dribble", trials,
      {figure("dribble_mps", "m/s of the ball over 10 m", trials, [](const auto& t) { return t.speed; })});
  addKeeping(report, "dribble", trials);
  return report;
}

BallSkillReport measureSlalom(const BallReportSettings& s, const sim::Settings& server, BallReport& all) {
  auto trials = repeated(s, "slalom", [&](auto seed) { return slalomOnce(s.agent, server, seed); });
  BallSkillReport report = reportOf(
      "slalom", trials,
      {figure("slalom_mps", "m/s of the ball along the path", trials, [](const auto& t) { return t.speed; }),
       figure("slalom_arrived", "share at the end within 60 s", trials,
              [](const auto& t) { return t.arrived; })});
  addKeeping(report, "slalom", trials);
  all.slaloms = std::move(trials);
  return report;
}

BallSkillReport measureDrive(const BallReportSettings& s, const sim::Settings& server) {
  const auto trials = repeated(s, "drive", [&](auto seed) { return driveOnce(s.agent, server, seed); });
  return reportOf("drive", trials,
                  {figure("drive_m", "m nearer to the goal in 15 s; a goal: its way times 15 s / its time",
                          trials, [](const auto& t) { return t.gained; }),
                   figure("drive_goals", "share with a goal", trials, [](const auto& t) { return t.goal; })});
}

BallSkillReport measureDuel(const BallReportSettings& s, const sim::Settings& server) {
  const auto trials =
      repeated(s, "duel", [&](auto seed) { return duelOnce(s.agent, s.opponent, server, seed); });
  return reportOf(
      "duel", trials,
      {figure("duel_share", "share won", trials, [](const auto& t) { return t.won; }),
       figure("duel_open", "share undecided", trials, [](const auto& t) { return t.won == 0.5; })});
}

BallSkillReport measureAttack(const BallReportSettings& s, const sim::Settings& server) {
  const Defence defence{s.goalie, s.opponent};
  const auto trials =
      repeated(s, "attack", [&](auto seed) { return attackOnce(s.agent, defence, server, seed); });
  const auto goal = [](const Attack& trial) { return trial.goal; };
  return reportOf(
      "attack", trials,
      {figure("attack_goals", "share with a goal", trials, goal),
       figure("attack_out", "share out of the field", trials, [](const auto& t) { return t.out; }),
       figure("attack_lost", "share driven away", trials, [](const auto& t) { return t.lost; }),
       figure("attack_charged", "share taken off for charging", trials,
              [](const auto& t) { return t.charged; }),
       figure(
           "attack_s", "s until the goal", trials, [](const auto& t) { return t.simulated; }, goal)});
}

BallSkillReport measureSiege(const BallReportSettings& s, const sim::Settings& server) {
  const auto trials =
      repeated(s, "siege", [&](auto seed) { return siegeOnce(s.agent, s.wall, server, seed); });
  const auto row = [&](const char* key, const char* what, bool Siege::*value) {
    return figure(std::string("siege_") + key, what, trials, [value](const Siege& t) { return t.*value; });
  };
  return reportOf(
      "siege", trials,
      {row("goals", "share with a goal of the four", &Siege::goal),
       row("corners", "share with a corner", &Siege::corner),
       row("out", "share out of the field", &Siege::out), row("lost", "share driven away", &Siege::lost),
       row("charged", "share with one charging", &Siege::charged),
       row("opponent_charged", "share with one of the wall", &Siege::opponentCharged),
       figure(
           "siege_s", "s until the goal", trials, [](const auto& t) { return t.simulated; },
           [](const Siege& t) { return t.goal; })});
}

BallSkillReport measureScrum(ScrumBall ball, const BallReportSettings& s, const sim::Settings& server) {
  const std::string name = ball == ScrumBall::Loose ? "loose" : "scrum";
  const auto trials =
      repeated(s, name, [&](auto seed) { return scrumOnce(ball, s.agent, s.opponent, server, seed); });
  const auto row = [&](const char* key, const char* what, double Scrum::*value) {
    return figure(name + key, what, trials, [value](const Scrum& t) { return t.*value; });
  };
  return reportOf(name, trials,
                  {row("_m", "m gained by three against three", &Scrum::gained),
                   row("_territory_m", "m, the same over the time", &Scrum::territory),
                   row("_falls", "falls of the three", &Scrum::falls),
                   row("_opponent_falls", "falls of the others", &Scrum::opponentFalls),
                   row("_charges", "of the three that charge", &Scrum::charges),
                   row("_opponent_charges", "of the others", &Scrum::opponentCharges)});
}

BallSkillReport measureReceiving(const BallReportSettings& s, const sim::Settings& server) {
  const auto trials =
      repeated(s, "receive", [&](auto seed) { return receiveOnce(s.agent, server, seed, true); });
  return reportOf("receive", trials,
                  {figure("receive_share", "share held", trials, [](const auto& t) { return t.held; }),
                   figure("receive_rebound_m", "m from the robot after the touch", trials,
                          [](const auto& t) { return t.rebound; })});
}

BallSkillReport measureRun(const BallReportSettings& s, const sim::Settings& server) {
  const auto trials = repeated(s, "run", [&](auto seed) { return runOnce(s.agent, server, seed); });
  return reportOf(
      "run", trials,
      {figure("run_mps", "m/s beyond 3 m, for 3 s", trials, [](const auto& t) { return t.speed; }),
       figure(
           "stop_s", "s from the run to a stand", trials, [](const auto& t) { return t.stopTime; },
           [](const auto& t) { return !t.fell; })});
}

BallSkillReport measure(const std::string& skill, const BallReportSettings& s, const sim::Settings& server,
                        BallReport& all) {
  if (skill == "approach") return measureApproach(s, server);
  if (skill == "dribble") return measureDribbling(s, server);
  if (skill == "slalom") return measureSlalom(s, server, all);
  if (skill == "drive") return measureDrive(s, server);
  if (skill == "duel") return measureDuel(s, server);
  if (skill == "attack") return measureAttack(s, server);
  if (skill == "siege") return measureSiege(s, server);
  if (skill == "scrum") return measureScrum(ScrumBall::Contested, s, server);
  if (skill == "loose") return measureScrum(ScrumBall::Loose, s, server);
  if (skill == "receive") return measureReceiving(s, server);
  if (skill == "run") return measureRun(s, server);
  throw std::runtime_error(
      fmt::format("unknown ball skill '{}': use all or one of {}", skill, fmt::join(ballSkillNames(), ", ")));
}

}  // namespace

std::vector<std::string> ballSkillNames() {
  return {"approach", "dribble", "slalom", "drive",   "duel", "attack",
          "siege",    "scrum",   "loose",  "receive", "run"};
}

std::vector<std::string> ballSkillsWithOpponents() {
  return {"duel", "attack", "siege", "scrum", "loose"};
}

BallReport measureBallSkills(const BallReportSettings& settings) {
  sim::Settings server;
  server.quickSolver = settings.quickSolver;
  BallReport report;
  const std::vector<std::string> names =
      settings.skill == "all" ? ballSkillNames() : std::vector<std::string>{settings.skill};
  for (const std::string& name : names) {
    report.skills.push_back(measure(name, settings, server, report));
  }
  return report;
}

std::string ballReportTable(const BallReport& report) {
  std::string out = fmt::format("{:<10} {:<32} {:>8} {:>7} {:>7} {:>6} {:>6}\n", "skill", "measure", "mean",
                                "+-", "trials", "falls", "fouls");
  for (const BallSkillReport& skill : report.skills) {
    for (const BallFigure& figure : skill.figures) {
      const bool first = &figure == &skill.figures.front();
      out += fmt::format("{:<10} {:<32} {:>8.3f} {:>7} {:>7} {:>6} {:>6}\n", first ? skill.skill : "",
                         figure.what, figure.value.mean, errorText(figure.value.ci95), figure.trials,
                         first ? fmt::format("{}", skill.falls) : "",
                         first ? fmt::format("{}", skill.selfCollisions) : "");
    }
  }
  return out + "+-: half width of the 95 % interval; falls: trials with one; fouls: self-collisions\n";
}

std::string ballReportJson(const BallReport& report, const BallReportSettings& settings) {
  nlohmann::ordered_json json;
  json["type"] = settings.agent.robotType;
  json["seed"] = settings.seed;
  int trials = 0;
  int falls = 0;
  for (const BallSkillReport& skill : report.skills) {
    for (const BallFigure& figure : skill.figures) {
      json[figure.key] = {
          {"mean", figure.value.mean}, {"ci95", figure.value.ci95}, {"trials", figure.trials}};
    }
    json["falls_of"][skill.skill] = skill.falls;
    json["self_collisions"][skill.skill] = skill.selfCollisions;
    trials += skill.trials;
    falls += skill.falls;
  }
  json["falls"] = {{"mean", trials > 0 ? static_cast<double>(falls) / trials : 0.0}, {"trials", trials}};
  return json.dump(2) + "\n";
}

}  // namespace nonet::lab
