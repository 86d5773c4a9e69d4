// When the referee is asked for pass mode (server facts 4.9), and what is done and left in it.
#include "nonet/team/pass_mode.h"

#include <array>

#include <gtest/gtest.h>

#include "nonet/team/behavior.h"

#include "scene.h"

namespace nonet::team {
namespace {

using world::Phase;

// Number 5 behind a ball that lies, a mate where its kick ends, and an opponent that would come in between.
struct Disturbed : Scene {
  Disturbed() {
    parameters.passMode.use = true;
    motion::KickOption kick;
    kick.head.shortest = 3.0;
    kick.head.longest = 7.0;
    kick.head.contact = 1.0;
    slowKicks = {kick};
    motion.kicks = slowKicks;
    stand(Pose2());
    putBall({0.3, 0.0});
    put(world.teammates[8], Pose2(6.0, 0.5, 0.0));
    put(world.opponents[3], Pose2(0.5, 1.3, 0.0));
  }
  Disturbed(const Disturbed&) = delete;  // `motion` points into it
  bool asks() const { return wantsPassMode(situation(Role::OnBall)); }
  // The referee has given it.
  Situation given() {
    world.game.phase = Phase::OwnPass;
    world.game.phaseSince = world.time;
    return situation(Role::OnBall);
  }

  std::array<motion::KickOption, 1> slowKicks;
};

bool kicks(const Situation& s) {
  return std::holds_alternative<motion::KickTo>(decide(s).motion);
}

TEST(PassMode, IsAskedForWhereAnOpponentComesBeforeTheKick) {
  Disturbed scene;
  ASSERT_FALSE(kicks(scene.situation(Role::OnBall))) << "too little room";
  EXPECT_TRUE(scene.asks());
  EXPECT_TRUE(kicks(scene.given()));
}

TEST(PassMode, NotWhileTheRefereeWouldRefuse) {
  Disturbed setPiece;
  setPiece.world.game.phase = Phase::OwnKickIn;
  EXPECT_FALSE(setPiece.asks());
  Disturbed rolling;
  rolling.putBall({0.3, 0.0}, {0.35, 0.0});
  EXPECT_FALSE(rolling.asks());
  Disturbed far;
  far.putBall({0.6, 0.0});
  EXPECT_FALSE(far.asks()) << "more than half a metre from the ball";
  Disturbed crowded;
  crowded.put(crowded.world.opponents[3], Pose2(0.5, 0.8, 0.0));
  EXPECT_FALSE(crowded.asks()) << "an opponent is within a metre";
}

TEST(PassMode, NotWithoutNeed) {
  Disturbed scene;
  scene.world.opponents = {};
  EXPECT_FALSE(scene.asks()) << "nobody is there";
  scene.put(scene.world.opponents[3], Pose2(0.5, 3.5, 0.0));
  EXPECT_FALSE(scene.asks()) << "nobody is near";
  Disturbed without;
  without.parameters.passMode.use = false;
  EXPECT_FALSE(without.asks()) << "it is switched off";
}

TEST(PassMode, NotForAKickThatOpponentsTake) {
  Disturbed scene;
  scene.put(scene.world.opponents[7], Pose2(6.4, 0.0, 0.0));
  scene.put(scene.world.teammates[8], Pose2(2.0, 3.0, 0.0));
  EXPECT_FALSE(scene.asks());
}

// Who has it cannot score, so in front of the goal it would cost the shot.
TEST(PassMode, NotInFrontOfTheGoal) {
  Disturbed scene;
  scene.stand(Pose2(11.0, 0.0, 0.0));
  scene.putBall({11.3, 0.0});
  scene.put(scene.world.opponents[3], Pose2(11.5, 1.3, 0.0));
  scene.put(scene.world.teammates[8], Pose2(10.0, -4.0, 0.0));
  ASSERT_TRUE(kicks(scene.situation(Role::OnBall))) << "a shot";
  EXPECT_FALSE(scene.asks());
  EXPECT_FALSE(kicks(scene.given())) << "a goal would not count";
}

TEST(PassMode, TheOthersPlayOnAsInOpenPlay) {
  Disturbed scene;
  for (const Role role : {Role::Stopper, Role::ForwardLeft, Role::BackRight}) {
    scene.world.game.phase = Phase::PlayOn;
    const Action open = scene.decideAs(role);
    scene.world.game.phase = Phase::OwnPass;
    const Action given = scene.decideAs(role);
    EXPECT_EQ(given.reason.behavior, open.reason.behavior);
    EXPECT_NEAR((goalOf(scene, given) - goalOf(scene, open)).norm(), 0.0, 1e-9);
  }
}

// From cycle to cycle: it asks, it has got it, it kicks as soon as the body is in place.
TEST(PassMode, TheRobotAsksAndThenUsesTheTime) {
  Disturbed scene;
  Behavior behavior(scene.parameters);
  int asked = 0;
  const auto cycles = [&](int count) {
    for (int i = 0; i < count; ++i) {
      scene.world.time += 0.02;
      scene.world.ball.lastSeen = scene.world.time;
      asked += behavior.update(scene.world, scene.motion).passMode ? 1 : 0;
    }
  };
  cycles(60);
  ASSERT_EQ(behavior.role(), Role::OnBall);
  EXPECT_GT(asked, 10);
  scene.world.game.phase = Phase::OwnPass;
  scene.world.game.phaseSince = scene.world.time;
  asked = 0;
  cycles(20);
  EXPECT_TRUE(std::holds_alternative<motion::KickTo>(behavior.action().motion));
  EXPECT_EQ(asked, 0) << "it is given";
  cycles(190);
  EXPECT_FALSE(std::holds_alternative<motion::KickTo>(behavior.action().motion)) << "the time is nearly over";
}

}  // namespace
}  // namespace nonet::team
