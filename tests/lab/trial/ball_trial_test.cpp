// The ball skills as scenarios: seeded trials of whole agents, of which so many must succeed.
#include "nonet/lab/trial/ball_trial.h"

#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/lab/reports/ball_report.h"

namespace nonet::lab {
namespace {

agent::AgentConfig agentOfType(int type) {
  agent::AgentChoice choice;
  choice.robotType = type;
  return agent::makeAgentConfig(choice, NONET_SOURCE_DIR);
}

sim::Settings quick() {
  sim::Settings settings;
  settings.quickSolver = true;
  return settings;
}

TEST(BallTrial, DribblesTenMetres) {
  int arrived = 0;
  double speed = 0.0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Dribble trial = dribbleOnce(agentOfType(3), quick(), seed);
    arrived += trial.arrived && !trial.fell ? 1 : 0;
    speed += 0.25 * trial.speed;
  }
  EXPECT_GE(arrived, 3);
  EXPECT_GT(speed, 0.4);
}

// The same lines with the steered dribble, whose learned values lie in params/: slower, but the ball is
// hardly ever lost, which without it is the rule.
TEST(BallTrial, SteeredDribbleKeepsTheBall) {
  agent::AgentConfig steered = agentOfType(0);
  steered.parameters.team.dribble.steer = true;
  double away = 0.0;
  double before = 0.0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Dribble trial = dribbleOnce(steered, quick(), seed);
    EXPECT_FALSE(trial.fell);
    EXPECT_GT(trial.speed, 0.3);
    away += 0.25 * trial.away;
    before += 0.25 * dribbleOnce(agentOfType(0), quick(), seed).away;
  }
  EXPECT_LT(away, 0.25);
  EXPECT_GT(before, 2.0 * away);
}

TEST(BallTrial, ComesToItsPlaceForAKick) {
  int arrived = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    arrived += approachOnce(agentOfType(0), quick(), seed).arrived ? 1 : 0;
  EXPECT_GE(arrived, 5);
}

// The same passes with and without the behaviour: going to the line of the ball holds more of them.
TEST(BallTrial, ReceivingHoldsMorePasses) {
  agent::AgentConfig with = agentOfType(0);
  agent::AgentConfig without = with;
  with.parameters.team.receive.use = true;
  without.parameters.team.receive.use = false;
  int held = 0;
  int before = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    held += receiveOnce(with, quick(), seed).held ? 1 : 0;
    before += receiveOnce(without, quick(), seed).held ? 1 : 0;
  }
  EXPECT_GE(held, 6);
  EXPECT_GT(held, before);
}

TEST(BallTrial, RunsAndStops) {
  const lab::Run run = runOnce(agentOfType(3), quick(), 1);
  EXPECT_FALSE(run.fell);
  EXPECT_GT(run.speed, 1.0);
  EXPECT_GT(run.stopTime, 0.1);
  EXPECT_LT(run.stopTime, 2.0);
}

// Who does not move takes no duel.
TEST(BallTrial, OneThatCannotWalkLosesTheDuel) {
  agent::AgentConfig lame = agentOfType(0);
  lame.parameters.motion.sets.goToTarget.gait.maxStepX = 0.001;
  lame.parameters.motion.sets.positioning.gait.maxStepX = 0.001;
  double won = 0.0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) won += duelOnce(agentOfType(0), lame, quick(), seed).won;
  EXPECT_GE(won, 2.5);
}

TEST(BallTrial, SameSeedSameTrial) {
  const Reception first = receiveOnce(agentOfType(1), quick(), 5);
  const Reception second = receiveOnce(agentOfType(1), quick(), 5);
  EXPECT_EQ(first.closest, second.closest);
  EXPECT_EQ(first.time, second.time);
}

TEST(BallReport, ReportsWhatTheTrialsSay) {
  BallReportSettings settings;
  settings.agent = settings.opponent = agentOfType(2);
  settings.skill = "run";
  settings.trials = 1;
  settings.quickSolver = true;
  const BallReport report = measureBallSkills(settings);
  ASSERT_EQ(report.skills.size(), 1U);
  ASSERT_EQ(report.skills[0].figures.size(), 2U);
  EXPECT_EQ(report.skills[0].figures[0].key, "run_mps");
  EXPECT_GT(report.skills[0].figures[0].value.mean, 1.0);
  EXPECT_NE(ballReportJson(report, settings).find("\"stop_s\""), std::string::npos);
  settings.skill = "juggle";
  EXPECT_THROW(measureBallSkills(settings), std::runtime_error);
}

}  // namespace
}  // namespace nonet::lab
