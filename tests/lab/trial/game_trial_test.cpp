#include "nonet/lab/trial/game_trial.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "nonet/math/angle.h"

#include "lab/trial_setup.h"

namespace nonet::lab {
namespace {

GamePlayer player(const Pose2& X_WR, bool rightTeam = false, const Mind& mind = {}) {
  GamePlayer result;
  result.agent = agentOfType(0);
  result.X_WR = X_WR;
  result.rightTeam = rightTeam;
  result.mind = mind;
  return result;
}

team::Action stand(const world::WorldState& /*world*/, const motion::MotionState& /*motion*/) {
  return {};
}

team::Action walk(const world::WorldState& /*world*/, const motion::MotionState& /*motion*/) {
  team::Action action;
  action.motion = motion::WalkVelocity{Pose2(0.6, 0.0, 0.0)};
  return action;
}

TEST(GameTrial, BeginsWithTheSituation) {
  GameSituation situation;
  situation.players = {player({-2.0, 1.0, 0.3}), player({3.0, -2.0, 2.0}, false, stand),
                       player({1.5, 0.5, -2.8}, true, stand)};
  situation.ball = {-0.5, 0.8};
  situation.ballVelocity = {0.4, -0.3};
  GameTrial trial(quick(), situation, 3);
  EXPECT_EQ(trial.time(), 0.0);
  EXPECT_EQ(trial.simulation().match().playMode, protocol::PlayMode::PlayOn);
  EXPECT_LT((trial.ball().head<2>() - situation.ball).norm(), 1e-6);
  EXPECT_LT((trial.ballVelocity().head<2>() - situation.ballVelocity).norm(), 1e-6);
  for (std::size_t i = 0; i < situation.players.size(); ++i) {
    const Pose2& wanted = situation.players[i].X_WR;
    EXPECT_LT((trial.pose(i).translation - wanted.translation).norm(), 0.1) << i;
    EXPECT_LT(std::abs(wrapAngle(trial.pose(i).rotation - wanted.rotation)), 0.15) << i;
    EXPECT_FALSE(trial.down(i));
    EXPECT_LT(trial.tilt(i), 0.2);
    // The right team sees the field turned by half a circle.
    const Pose2 truth = situation.players[i].rightTeam ? Pose2(0.0, 0.0, kPi) * trial.pose(i) : trial.pose(i);
    const Pose2& belief = trial.belief(i).self.X_FR;
    EXPECT_TRUE(trial.belief(i).self.localized) << i;
    EXPECT_LT((belief.translation - truth.translation).norm(), 0.2) << i;
    EXPECT_LT(std::abs(wrapAngle(belief.rotation - truth.rotation)), 0.2) << i;
  }
}

TEST(GameTrial, MindIsFollowedAndSees) {
  GameSituation situation;
  situation.players = {player({-3.0, 0.0, 0.5}, false, walk)};
  situation.ball = {0.0, 1.0};
  GameTrial trial(quick(), situation, 1);
  const Pose2 start = trial.pose(0);
  trial.run(3.0);
  EXPECT_NEAR(trial.time(), 3.0, 1e-9);
  EXPECT_GT((start.inverse() * trial.pose(0)).translation.x(), 0.6);
  const world::WorldState& belief = trial.belief(0);
  EXPECT_LT((belief.self.X_FR.translation - trial.pose(0).translation).norm(), 0.2);
  ASSERT_TRUE(belief.ball.known);
  EXPECT_LT((belief.ball.p_FB.head<2>() - trial.ball().head<2>()).norm(), 0.25);
}

TEST(GameTrial, SameSeedSameTrial) {
  const auto signature = [](std::uint64_t seed) {
    GameSituation situation;
    situation.players = {player({-1.0, 0.0, 0.0}), player({1.5, 0.2, kPi}, true)};
    GameTrial trial(quick(), situation, seed);
    trial.run(1.5);
    return trial.simulation().signature();
  };
  const std::uint64_t first = signature(7);
  EXPECT_EQ(signature(7), first);
  EXPECT_NE(signature(8), first);
}

TEST(GameTrial, CountsFoulsPerPlayer) {
  // Only one may stand in the own area: the second one that walks into it commits the foul.
  sim::Settings settings = quick();
  settings.maxPlayersInsideOwnArea = 1;
  GameSituation situation;
  situation.players = {player({-14.2, 1.0, 0.0}, false, stand), player({-12.6, -0.5, kPi}, false, walk),
                       player({-5.0, 0.0, 0.0}, false, stand)};
  for (std::size_t i = 0; i < 3; ++i) situation.players[i].agent.unum = static_cast<int>(i) + 2;
  GameTrial trial(settings, situation, 1);
  EXPECT_EQ(trial.fouls(1, sim::FoulType::IllegalDefence), 0);
  trial.run(4.0);
  EXPECT_GE(trial.fouls(1, sim::FoulType::IllegalDefence), 1);
  EXPECT_EQ(trial.fouls(0, sim::FoulType::IllegalDefence), 0);
  EXPECT_EQ(trial.fouls(2, sim::FoulType::IllegalDefence), 0);
  for (const std::size_t i : {std::size_t{0}, std::size_t{2}})
    EXPECT_EQ(trial.fouls(i, sim::FoulType::SelfCollision), 0);
}

TEST(GameTrial, NamesThePlayerThatTheRefereeRefuses) {
  GameSituation situation;
  situation.players = {player({-1.0, 0.0, 0.0}, false, stand), player({-2.0, 0.0, 0.0}, false, stand)};
  situation.players[0].agent.unum = situation.players[1].agent.unum = 4;
  EXPECT_THROW(GameTrial(quick(), situation, 1), std::runtime_error);
}

}  // namespace
}  // namespace nonet::lab
