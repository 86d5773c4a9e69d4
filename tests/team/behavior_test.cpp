// The stage as a whole: a message in, an action out, with a reason, a place to look at and something to say.
#include "nonet/team/behavior.h"

#include <gtest/gtest.h>

#include "nonet/math/direction.h"
#include "nonet/protocol/say_codec.h"

#include "scene.h"

namespace nonet::team {
namespace {

class Stage : public testing::Test {
 protected:
  const Action& cycle() {
    scene.world.time += kCycleTime;
    scene.world.ball.lastSeen = scene.world.time;
    return behavior.update(scene.world, scene.motion);
  }

  Scene scene;
  Behavior behavior{scene.parameters};
};

// Alone on the field it votes for itself, goes to the ball and says so to whoever listens.
TEST_F(Stage, AloneItPlaysTheBallAndSaysSo) {
  std::optional<protocol::SayMessage> said;
  for (int i = 0; i < 60; ++i) {
    const Action& action = cycle();
    ASSERT_TRUE(action.head);
    ASSERT_FALSE(action.reason.behavior.empty());
    if (action.say) said = protocol::decodeSay(action.say->view(), scene.world.game.team);
  }
  EXPECT_EQ(behavior.role(), Role::OnBall);
  EXPECT_EQ(behavior.action().reason.behavior, "go to ball");
  ASSERT_TRUE(said);
  EXPECT_EQ(said->unum, 5);
  ASSERT_TRUE(said->timeToBall);
  EXPECT_NEAR(*said->timeToBall, 1.0 / scene.parameters.pace.walkSpeed, 0.3);
}

TEST_F(Stage, BeamsOnceInAPhase) {
  scene.world.game.phase = world::Phase::BeforeKickOff;
  scene.world.game.phaseSince = scene.world.time;
  scene.world.self.localized = false;
  int beams = 0;
  for (int i = 0; i < 100; ++i) beams += cycle().beam ? 1 : 0;
  EXPECT_EQ(beams, 1);
  scene.world.game.phase = world::Phase::OpponentGoal;
  scene.world.game.phaseSince = scene.world.time;
  for (int i = 0; i < 100; ++i) beams += cycle().beam ? 1 : 0;
  EXPECT_EQ(beams, 2);
}

// A kick that was asked for is held through small drifts: that depends on what motion was asked last.
TEST_F(Stage, HoldsAKickThatItAskedFor) {
  scene.stand(Pose2(0.0, 0.0, 0.0));
  scene.putBall({0.05, 0.055});  // too near to begin its last steps
  for (int i = 0; i < 60; ++i) cycle();
  ASSERT_EQ(behavior.role(), Role::OnBall);
  EXPECT_FALSE(std::holds_alternative<motion::KickTo>(cycle().motion));
  scene.motion.request = motion::KickTo{};
  scene.motion.kick.inPlace = true;
  EXPECT_TRUE(std::holds_alternative<motion::KickTo>(cycle().motion));
}

// Another has the ball, and this one's place, behind that, lies in another direction than the ball.
TEST_F(Stage, WhoWalksFarFromTheBallLooksAlongItsWayNowAndThen) {
  scene.putBall({-6.0, 0.0});
  Scene::put(scene.world.teammates[7], Pose2(-6.3, 0.0, 0.0));
  scene.stand(Pose2(-8.5, 1.5, 0.0));
  scene.parameters.formation.stopperBehind = 2.0;
  behavior = Behavior(scene.parameters);
  int along = 0;
  int atBall = 0;
  for (int i = 0; i < 200; ++i) {
    const Action& action = cycle();
    const auto* walk = std::get_if<motion::WalkTo>(&action.motion);
    if (walk == nullptr || walk->target.translation.norm() < scene.parameters.glance.farToGo) continue;
    if (action.head->kind == motion::HeadRequest::Kind::Look) {
      EXPECT_NEAR(action.head->pan, directionOf(walk->target.translation), 1e-12);
      ++along;
    } else {
      ++atBall;
    }
  }
  const GlanceParameters& p = scene.parameters.glance;
  ASSERT_GT(along, 10);
  EXPECT_NEAR(along / static_cast<double>(along + atBall), p.length / p.every, 0.15);
}

// One that stands beside it, and that it lost from sight: it looks there until it sees it.
TEST_F(Stage, LooksAtAnOpponentNearByThatItDoesNotSee) {
  scene.putBall({-6.0, 0.0});
  Scene::put(scene.world.teammates[7], Pose2(-6.3, 0.0, 0.0));
  scene.stand(Pose2(-8.5, 1.5, 0.0));
  scene.parameters.formation.stopperBehind = 2.0;
  const auto looks = [&](double away, double unseen) {
    Scene::put(scene.world.opponents[3], Pose2(-8.5, 1.5 + away, 0.0));
    behavior = Behavior(scene.parameters);
    int there = 0;
    for (int i = 0; i < 100; ++i) {
      scene.world.opponents[3].lastSighted = scene.world.time - unseen;
      const Action& action = cycle();
      const bool look = action.head->kind == motion::HeadRequest::Kind::Look;
      there += look && std::abs(action.head->pan - kPi / 2) < 1e-9 ? 1 : 0;
    }
    return there;
  };
  EXPECT_NEAR(looks(0.8, 0.3), 50, 5);
  EXPECT_EQ(looks(0.8, 0.05), 0) << "it sees it";
  EXPECT_EQ(looks(2.0, 0.3), 0) << "far away";
}

// It has not seen the ball for a while; a mate tells where it is, right or wrong.
TEST(LookAtBall, WhereAMateSaysItIsByTurnsWithLookingAround) {
  Scene scene;
  scene.world.ball.lastReported = scene.world.time - 0.3;
  const auto looks = [&](double unseen) {
    scene.world.ball.lastSeen = scene.world.time - unseen;
    return lookAtBall(scene.world).kind == motion::HeadRequest::Kind::Point;
  };
  EXPECT_TRUE(looks(0.1));
  EXPECT_TRUE(looks(2.2)) << "as soon as it does not know itself any more";
  EXPECT_FALSE(looks(4.0)) << "it was not there";
  EXPECT_TRUE(looks(5.5));
  scene.world.ball.lastReported = scene.world.time - 1.0;
  EXPECT_FALSE(looks(2.2));
  EXPECT_TRUE(looks(1.9));
}

TEST_F(Stage, TheSameWorldsGiveTheSameActions) {
  Behavior other(scene.parameters);
  for (int i = 0; i < 100; ++i) {
    scene.putBall({1.0 + 0.01 * i, 0.2});
    const Action& action = cycle();
    const Action& again = other.update(scene.world, scene.motion);
    EXPECT_EQ(action.reason.behavior, again.reason.behavior);
    EXPECT_EQ(action.motion.index(), again.motion.index());
    EXPECT_EQ(action.say.has_value(), again.say.has_value());
  }
}

}  // namespace
}  // namespace nonet::team
