// What the robot does with the ball at its feet, and how fast it runs: seeded trials of every ball skill
// (lab/trial/ball_trial.h) as a table, as JSON and as a picture of the slalom's paths.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "nonet/lab/common/progress.h"
#include "nonet/lab/common/statistics.h"
#include "nonet/lab/trial/ball_trial.h"

namespace nonet::lab {

struct BallReportSettings {
  agent::AgentSettings agent;
  agent::AgentSettings opponent;  // in the duel, before the goal and in scrums
  agent::AgentSettings goalie;    // the opponents'
  Defence wall;                   // those of the siege
  std::string skill = "all";      // or one of ballSkillNames()
  int trials = 50;                // of each skill
  std::uint64_t seed = 1;
  int threads = 0;  // 0: all processors
  bool quickSolver = false;
  TrialProgress progress{};
};

/// One row: what counts, over all trials of a skill.
struct BallFigure {
  std::string key;   // of the JSON: "approach_s"
  std::string what;  // "approach, s"
  Estimate value;
  int trials = 0;  // that the value is the mean of
};

struct BallSkillReport {
  std::string skill;
  std::vector<BallFigure> figures;
  int trials = 0;
  int falls = 0;           // trials with a fall
  int selfCollisions = 0;  // fouls
  double simulated = 0.0;  // s
};

struct BallReport {
  std::vector<BallSkillReport> skills;
  std::vector<Dribble> slaloms;  // for the picture
};

/// approach, dribble, slalom, drive, duel, attack, siege, scrum, loose, receive, run.
std::vector<std::string> ballSkillNames();
/// Those of them with opponents.
std::vector<std::string> ballSkillsWithOpponents();

/// Throws std::runtime_error that names the skills if the one wanted is unknown.
BallReport measureBallSkills(const BallReportSettings& settings);
std::string ballReportTable(const BallReport& report);
std::string ballReportJson(const BallReport& report, const BallReportSettings& settings);
/// The balls' ways through it, all with the first turn to the right.
std::string slalomSvg(const std::vector<Dribble>& slaloms, const BallReportSettings& settings);

}  // namespace nonet::lab
