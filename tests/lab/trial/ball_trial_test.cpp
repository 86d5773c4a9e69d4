// The ball skills as scenarios: seeded trials of whole agents, of which so many must succeed.
#include "nonet/lab/trial/ball_trial.h"

#include <memory>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "nonet/lab/reports/ball_report.h"
#include "nonet/lab/trial/game_trial.h"
#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/math/random.h"

#include "lab/trial/ball_drill.h"
#include "lab/trial_setup.h"

namespace nonet::lab {
namespace {

// The same lines as dribbleOnce's by a robot that is not told to keep the ball: it runs through it, as in
// play.
Dribble runThroughOnce(const agent::AgentSettings& agent, std::uint64_t seed) {
  Random random(seed);
  const BallScene scene = dribbleScene(random);
  const Vector2 way = scene.path.corners.back() - scene.path.corners.front();
  GameSituation situation = scene.situation;
  situation.players = {fieldPlayer(
      agent, scene.start,
      drilled(agent.parameters.team, scene.path.corners.back() + 0.5 * way, team::KickUse::Never))};
  RecordedTrial trial(quick(), situation, random.next());
  trial.run(30.0, [&] { return trial.playsOn(); });
  Dribble dribble;
  static_cast<DribbleResult&>(dribble) = measureDribble(trial.track(), scene.path);
  trial.charge(dribble);
  return dribble;
}

TEST(BallTrial, RunsThroughTheBallForTenMetres) {
  int arrived = 0;
  double speed = 0.0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Dribble trial = runThroughOnce(agentOfType(3), seed);
    arrived += trial.arrived && !trial.fell ? 1 : 0;
    speed += 0.25 * trial.speed;
  }
  EXPECT_GE(arrived, 3);
  EXPECT_GT(speed, 0.4);
}

// Slower, but the ball is hardly ever lost, which by running through it is the rule.
TEST(BallTrial, KeepsTheBallWhereRunningThroughItLosesIt) {
  double away = 0.0;
  double before = 0.0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    away += 0.25 * dribbleOnce(agentOfType(0), quick(), seed).away;
    before += 0.25 * runThroughOnce(agentOfType(0), seed).away;
  }
  EXPECT_LT(away, 0.25);
  EXPECT_GT(before, 2.0 * away);
  EXPECT_GT(before, 0.1);
}

// Straight ahead and through a slalom, with the ball at the feet nearly all of the time.
TEST(BallTrial, DribblesAndKeepsTheBall) {
  int lost = 0;
  for (const int type : {0, 2, 3}) {
    double straight = 0.0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const Dribble trial = dribbleOnce(agentOfType(type), quick(), seed);
      EXPECT_TRUE(trial.arrived && !trial.fell) << "type " << type << " seed " << seed;
      straight += 0.25 * trial.speed;
      lost += trial.lost ? 1 : 0;
      EXPECT_LT(trial.away, 0.2);
    }
    EXPECT_GT(straight, 0.45) << "type " << type;
    const Dribble slalom = slalomOnce(agentOfType(type), quick(), 1);
    EXPECT_FALSE(slalom.fell);
    EXPECT_LT(slalom.away, 0.25) << "type " << type;
  }
  EXPECT_LE(lost, 3) << "of 12";
}

// Of every type, whichever way it has to go around the ball.
TEST(BallTrial, ComesToItsPlaceForAKick) {
  for (int type = 0; type < 5; ++type) {
    int arrived = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed)
      arrived += approachOnce(agentOfType(type), quick(), seed).arrived ? 1 : 0;
    EXPECT_GE(arrived, 5) << "type " << type;
  }
}

// Toes and heels that turn beside a ball push it away.
TEST(BallTrial, ComesAroundTheBallWithoutTouchingIt) {
  for (int type = 0; type < 5; ++type) {
    int touched = 0;
    for (int i = 0; i < 6; ++i) {
      GameSituation situation;
      situation.ball = {-4.0, 0.2 * i};
      const Vector2 way(8.0, 0.0);
      const Pose2 start(situation.ball + 1.5 * unitVector(0.05 * (i - 2)), kPi);
      auto kicks = std::make_shared<bool>(false);
      const Mind mind =
          drilled(agentOfType(type).parameters.team, situation.ball + way, team::KickUse::Clear);
      situation.players = {
          fieldPlayer(agentOfType(type), start,
                      [mind, kicks](const world::WorldState& world, const motion::MotionState& m) {
                        *kicks = !m.kick.name.empty() && (m.kick.inPlace || m.busy);
                        return mind(world, m);
                      })};
      RecordedTrial trial(quick(), situation, static_cast<std::uint64_t>(i + 1));
      const auto moved = [&] { return (trial.track().back().ball - situation.ball).norm() > 0.1; };
      trial.run(8.0, [&] { return !*kicks && !moved(); });
      touched += *kicks ? 0 : 1;
    }
    EXPECT_LE(touched, 1) << "of 6, type " << type;
  }
}

// The same passes with and without the behaviour: going to the line of the ball holds more of them.
TEST(BallTrial, ReceivingHoldsMorePasses) {
  agent::AgentSettings with = agentOfType(0);
  agent::AgentSettings without = with;
  with.parameters.team.receive.use = true;
  without.parameters.team.receive.use = false;
  int held = 0;
  int before = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    held += receiveOnce(with, quick(), seed, false).held ? 1 : 0;
    before += receiveOnce(without, quick(), seed, false).held ? 1 : 0;
  }
  EXPECT_GE(held, 6);
  EXPECT_GT(held, before);
}

TEST(BallTrial, KeepsAPassThatItIsToKeep) {
  int held = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
    held += receiveOnce(agentOfType(1), quick(), seed, true).held ? 1 : 0;
  EXPECT_GE(held, 11);
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
  const agent::AgentSettings lame = lameAgent(0);
  double won = 0.0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) won += duelOnce(agentOfType(0), lame, quick(), seed).won;
  EXPECT_GE(won, 2.5);
}

double goalsIn(const agent::AgentSettings& agent) {
  constexpr int count = 10;
  Defence defence{agentOfType(0), agentOfType(2)};
  for (motion::WalkParameters* set :
       {&defence.back.parameters.motion.sets.goToTarget, &defence.back.parameters.motion.sets.positioning})
    set->gait.maxStepX *= 0.6;  // as fast as the teams of others
  double goals = 0.0;
  for (int seed = 1; seed <= count; ++seed) {
    const Attack trial = attackOnce(agent, defence, quick(), static_cast<std::uint64_t>(seed));
    EXPECT_LE((trial.goal ? 1 : 0) + (trial.out ? 1 : 0) + (trial.lost ? 1 : 0), 1);
    EXPECT_GE(trial.worth(), trial.goal ? 1.0 : 0.0);
    goals += trial.goal ? 1.0 / count : 0.0;
  }
  return goals;
}

// The same attacks with and without kicks at the goal.
TEST(BallTrial, ShotsEndMoreAttacksInTheGoal) {
  agent::AgentSettings without = agentOfType(2);
  without.parameters.team.shot.distance = 0.0;
  const double shots = goalsIn(agentOfType(2));
  EXPECT_GE(shots, 0.4);  // 0.64 of 200
  EXPECT_GT(shots, goalsIn(without));
}

// How many of ten robots that run to a ball at which an opponent stands are taken off for charging.
int chargesAtTheBall(double speed) {
  int charges = 0;
  Random random(7);
  for (int i = 0; i < 10; ++i) {
    agent::AgentSettings runner = agentOfType(2);
    runner.unum = 7;
    runner.parameters.team.charging.speed = speed;
    const Vector2 ball(random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0));
    const double from = random.uniform(-0.5, 0.5);
    const double beside = random.uniform(-1.0, 1.0);
    GameSituation situation;
    situation.ball = ball;
    situation.players = {{runner, false, Pose2(ball - 1.5 * unitVector(from), from), {}},
                         {agentOfType(0), true, Pose2(ball - 0.25 * unitVector(from + beside), from + beside),
                          [](const world::WorldState& /*world*/, const motion::MotionState& /*motion*/) {
                            return team::Action();
                          }}};
    GameTrial trial(quick(), situation, random.next());
    trial.run(4.0);
    charges += trial.fouls(0, sim::FoulType::Charging) > 0 ? 1 : 0;
  }
  return charges;
}

TEST(BallTrial, WhoSlowsDownBeforeAnOpponentIsNotTakenOff) {
  const int charges = chargesAtTheBall(team::TeamParameters{}.charging.speed);
  EXPECT_LE(charges, 2);
  EXPECT_GE(chargesAtTheBall(0.0), charges + 3);
}

TEST(BallTrial, SameSeedSameTrial) {
  const Reception first = receiveOnce(agentOfType(1), quick(), 5, true);
  const Reception second = receiveOnce(agentOfType(1), quick(), 5, true);
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
