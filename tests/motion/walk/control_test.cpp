#include "nonet/motion/walk/control.h"

#include <cmath>

#include <gtest/gtest.h>

#include "nonet/model/robot_model.h"

namespace nonet::motion {
namespace {

class WalkControlTest : public testing::Test {
 protected:
  WalkControlTest() {
    world.game.unum = 5;
    world.self.localized = true;
    world.body.cycleTime = kCycleTime;
    // Team mate 5 is the robot itself.
    world.teammates[5] = {.X_FP = world.self.X_FR, .known = true};
    walk.target = Pose2(3.0, 0.0, 0.0);
  }
  static WalkSelection selection() {
    WalkSelection chosen;
    chosen.usePositioning = true;
    chosen.positioningDistance = 0.5;
    chosen.crowdDistance = 1.0;
    return chosen;
  }
  WalkSet setFor(const MotionRequest& request) {
    control.update(world, request, targets);
    return control.set();
  }
  void placeOpponent(double x, bool known = true) {
    world.opponents[5] = {.X_FP = Pose2(x, 0.0, 0.0), .known = known};
  }

  world::WorldState world;
  WalkTo walk;
  JointTargets targets;
  WalkControl control{model::robotModel(0), WalkSets{}, selection()};
};

TEST_F(WalkControlTest, WalksAloneWithTheGoToTargetSet) {
  EXPECT_EQ(setFor(walk), WalkSet::GoToTarget);
}

TEST_F(WalkControlTest, StandsWithThePositioningSet) {
  EXPECT_EQ(setFor(walk), WalkSet::GoToTarget);
  EXPECT_EQ(setFor(MotionRequest{}), WalkSet::Positioning);
}

TEST_F(WalkControlTest, TakesThePositioningSetNearOthersAndKeepsItForAWhile) {
  EXPECT_EQ(setFor(walk), WalkSet::GoToTarget);
  placeOpponent(1.2);
  EXPECT_EQ(setFor(walk), WalkSet::GoToTarget);
  placeOpponent(0.9);
  EXPECT_EQ(setFor(walk), WalkSet::Positioning);
  placeOpponent(1.2);
  EXPECT_EQ(setFor(walk), WalkSet::Positioning) << "not to and fro at the border";
  placeOpponent(1.4);
  EXPECT_EQ(setFor(walk), WalkSet::GoToTarget);
}

TEST_F(WalkControlTest, OnALongWayOnlyThoseInItAreACrowd) {
  const auto setBeside = [&](const world::PlayerState& mate, const Vector2& target) {
    world.teammates[7] = mate;
    WalkControl fresh(model::robotModel(0), WalkSets{}, selection());
    fresh.update(world, WalkTo{.target = Pose2(target, 0.0)}, targets);
    return fresh.set();
  };
  const Vector2 ahead(3.0, 0.0);
  const world::PlayerState beside{.X_FP = Pose2(0.3, 0.9, 0.0), .known = true};
  EXPECT_EQ(setBeside(beside, ahead), WalkSet::GoToTarget);
  EXPECT_EQ(setBeside(beside, {1.5, 0.0}), WalkSet::Positioning) << "a short way";
  EXPECT_EQ(setBeside(beside, {0.0, 3.0}), WalkSet::Positioning) << "not where the robot faces";
  world::PlayerState crossing{.X_FP = Pose2(0.8, 0.5, 0.0), .v_FP = Vector2(0.8, 0.5), .known = true};
  EXPECT_EQ(setBeside(crossing, ahead), WalkSet::GoToTarget) << "it leaves the way";
  crossing.v_FP = Vector2(0.0, -0.8);
  EXPECT_EQ(setBeside(crossing, ahead), WalkSet::Positioning) << "it comes into the way";
  const world::PlayerState shoulder{.X_FP = Pose2(-0.2, 0.4, 0.0), .v_FP = Vector2(0.0, 0.5), .known = true};
  EXPECT_EQ(setBeside(shoulder, ahead), WalkSet::Positioning) << "near, wherever it goes";
  world::PlayerState far{.X_FP = Pose2(0.0, -0.95, 0.0), .v_FP = Vector2(1.6, 1.0), .known = true};
  EXPECT_EQ(setBeside(far, ahead), WalkSet::Positioning) << "runs along and comes nearer";
  far.fallen = true;
  EXPECT_EQ(setBeside(far, ahead), WalkSet::GoToTarget) << "who lies stays where it is";
}

TEST_F(WalkControlTest, CountsOnlyPlayersItKnows) {
  placeOpponent(0.4, false);
  EXPECT_EQ(setFor(walk), WalkSet::GoToTarget);
  placeOpponent(0.4);
  world.self.localized = false;
  EXPECT_EQ(setFor(walk), WalkSet::GoToTarget) << "distances mean nothing to who is lost";
}

TEST_F(WalkControlTest, TakesThePositioningSetNearTheBall) {
  EXPECT_EQ(setFor(walk), WalkSet::GoToTarget);
  world.ball.known = true;
  world.ball.p_RB = Vector2(0.0, 0.6);
  EXPECT_EQ(setFor(walk), WalkSet::GoToTarget);
  world.ball.p_RB = Vector2(0.0, 0.4);
  EXPECT_EQ(setFor(walk), WalkSet::Positioning);
}

TEST_F(WalkControlTest, TakesThePositioningSetUntilAStumbleIsOver) {
  EXPECT_EQ(setFor(walk), WalkSet::GoToTarget);
  const double tilt = WalkSelection{}.positioningTilt;
  const auto setAt = [&](double error) {
    setFor(walk);
    // The engine's error is that against the lean of the step in force, and it learns of it a cycle later.
    world.body.pitch += error - control.engine().measurement().tilt.pitch;
    setFor(walk);
    return setFor(walk);
  };
  EXPECT_EQ(setAt(0.9 * tilt), WalkSet::GoToTarget);
  EXPECT_EQ(setAt(1.1 * tilt), WalkSet::Positioning);
  EXPECT_EQ(setAt(0.5 * tilt), WalkSet::Positioning);
  EXPECT_EQ(setAt(0.2 * tilt), WalkSet::GoToTarget);
}

TEST_F(WalkControlTest, DoesAsTheRequestSays) {
  placeOpponent(0.4);
  walk.set = WalkSet::GoToTarget;
  EXPECT_EQ(setFor(walk), WalkSet::GoToTarget);
}

TEST_F(WalkControlTest, DribblesWithTheDribbleSetIfTheTypeHasOne) {
  WalkSelection chosen = selection();
  const WalkVelocity wanted{Pose2(0.5, 0.0, 0.0), WalkSet::Dribble};
  EXPECT_EQ(setFor(wanted), WalkSet::GoToTarget) << "as if nothing were said";
  chosen.useDribble = true;
  WalkControl dribbler(model::robotModel(0), WalkSets{}, chosen);
  const auto setOf = [&](const MotionRequest& request) {
    dribbler.update(world, request, targets);
    return dribbler.set();
  };
  EXPECT_EQ(setOf(WalkVelocity{wanted.velocity}), WalkSet::GoToTarget) << "only where it is asked for";
  EXPECT_EQ(setOf(wanted), WalkSet::Dribble);
  world.body.pitch = 2.0 * chosen.positioningTilt;
  setOf(wanted);
  EXPECT_EQ(setOf(wanted), WalkSet::Positioning) << "who stumbles";
}

TEST_F(WalkControlTest, SprintsStraightAheadOnly) {
  WalkSelection chosen = selection();
  chosen.useSprint = true;
  chosen.sprintDistance = 1.0;
  chosen.sprintUntil = 0.6;
  WalkControl sprinter(model::robotModel(0), WalkSets{}, chosen);
  const auto setOf = [&](const Pose2& target) {
    walk.target = target;
    sprinter.update(world, walk, targets);
    return sprinter.set();
  };
  EXPECT_EQ(setOf(Pose2(3.0, 0.5, 0.0)), WalkSet::Sprint);
  EXPECT_EQ(setOf(Pose2(3.0, 1.0, 0.0)), WalkSet::GoToTarget);
  EXPECT_EQ(setOf(Pose2(0.9, 0.0, 0.0)), WalkSet::GoToTarget);
  EXPECT_EQ(setOf(Pose2(1.1, 0.0, 0.0)), WalkSet::Sprint);
  EXPECT_EQ(setOf(Pose2(0.9, 0.0, 0.0)), WalkSet::Sprint) << "kept";
  EXPECT_EQ(setOf(Pose2(0.5, 0.0, 0.0)), WalkSet::GoToTarget);
  placeOpponent(0.8);
  EXPECT_EQ(setOf(Pose2(3.0, 0.0, 0.0)), WalkSet::Positioning) << "others come first";
}

class Sprinter : public WalkControlTest {
 protected:
  Sprinter() {
    for (int i = 0; i < 100; ++i) sprintTo(walk);
    EXPECT_EQ(sprinter.set(), WalkSet::Sprint);
    EXPECT_GT(step(), 0.12);
  }
  static WalkSelection sprinting() {
    WalkSelection chosen = selection();
    chosen.useSprint = true;
    return chosen;
  }
  static WalkSets longSteps() {
    WalkSets sets;
    sets.sprint.gait.maxStepX = 0.15;
    sets.sprint.balance.comErrorNormal = 1.0;  // no body moves in this test
    sets.sprint.balance.comErrorMost = 2.0;
    return sets;
  }
  void sprintTo(const MotionRequest& request) { sprinter.update(world, request, targets); }
  double step() const { return sprinter.engine().gait().step.translation.x(); }

  WalkControl sprinter{model::robotModel(0), longSteps(), sprinting()};
};

// From full steps the set changes only once they have become short, and the robot slows down until then.
TEST_F(Sprinter, RunsOutBeforeTheSetChanges) {
  double last = step();
  int cycles = 0;
  for (; sprinter.set() == WalkSet::Sprint && cycles < 50; ++cycles) {
    EXPECT_LE(step(), last);
    last = step();
    sprintTo(MotionRequest{});
  }
  EXPECT_EQ(sprinter.set(), WalkSet::Positioning);
  EXPECT_GT(cycles, 5);
  EXPECT_LT(last, 0.1);
}

TEST_F(Sprinter, RunsOutToTheEndThoughTheTargetIsAheadAgain) {
  WalkTo turned = walk;
  turned.target = Pose2(3.0, 1.5, 0.0);
  for (int i = 0; i < 10; ++i) sprintTo(turned);
  double last = step();
  ASSERT_GT(last, longSteps().sprint.gait.stopStep);
  while (last > longSteps().sprint.gait.stopStep) {
    sprintTo(walk);
    ASSERT_LT(step(), last);
    EXPECT_EQ(sprinter.set(), WalkSet::Sprint);
    last = step();
  }
  for (int i = 0; i < 10; ++i) sprintTo(walk);
  EXPECT_GT(step(), last) << "then it runs again";
  EXPECT_EQ(sprinter.set(), WalkSet::Sprint);
}

// Who sees the target aside for a cycle or two runs on.
TEST_F(Sprinter, DoesNotRunOutForAMoment) {
  WalkTo turned = walk;
  turned.target = Pose2(3.0, 1.5, 0.0);
  const double before = step();
  for (int i = 0; i < 2; ++i) sprintTo(turned);
  EXPECT_LT(step(), before);
  for (int i = 0; i < 50; ++i) {
    sprintTo(walk);
    ASSERT_GT(step(), 0.12);
  }
  EXPECT_EQ(sprinter.set(), WalkSet::Sprint);
}

class Sidestepper : public WalkControlTest {
 protected:
  static WalkSelection sidestepping() {
    WalkSelection chosen = selection();
    chosen.useSidestep = true;
    return chosen;
  }
  WalkSet setFor(const Pose2& velocity) {
    sidestepper.update(world, WalkVelocity{velocity}, targets);
    return sidestepper.set();
  }

  WalkControl sidestepper{model::robotModel(0), WalkSets{}, sidestepping()};
};

TEST_F(Sidestepper, WalksSidewaysAndBackwardWithTheSidestepSet) {
  EXPECT_EQ(setFor(Pose2(1.0, 0.0, 0.0)), WalkSet::GoToTarget);
  EXPECT_EQ(setFor(Pose2(0.0, 1.0, 0.0)), WalkSet::Sidestep);
  EXPECT_EQ(setFor(Pose2(1.0, 0.0, 0.0)), WalkSet::GoToTarget);
  EXPECT_EQ(setFor(Pose2(-1.0, -0.1, 0.0)), WalkSet::Sidestep);
  EXPECT_EQ(setFor(Pose2(0.0, 0.1, 0.0)), WalkSet::GoToTarget) << "so slow that every set can do it";
}

TEST_F(Sidestepper, KeepsTheSetForAWhile) {
  const double angle = WalkSelection{}.sidestepAngle;
  const auto aside = [](double direction) { return Pose2(std::cos(direction), std::sin(direction), 0.0); };
  EXPECT_EQ(setFor(aside(0.9 * angle)), WalkSet::GoToTarget);
  EXPECT_EQ(setFor(aside(1.1 * angle)), WalkSet::Sidestep);
  EXPECT_EQ(setFor(aside(0.9 * angle)), WalkSet::Sidestep) << "not to and fro at the border";
  EXPECT_EQ(setFor(aside(0.7 * angle)), WalkSet::GoToTarget);
}

TEST_F(Sidestepper, TurnsWithTheGoToTargetSet) {
  EXPECT_EQ(setFor(Pose2(0.0, 1.0, 2.0)), WalkSet::GoToTarget);
  EXPECT_EQ(setFor(Pose2(0.0, 1.0, 0.1)), WalkSet::Sidestep);
  EXPECT_EQ(setFor(Pose2(0.0, 0.0, 0.1)), WalkSet::GoToTarget);
  // To a target behind, too, which the robot turns to.
  walk.target = Pose2(-3.0, 0.5, 3.0);
  sidestepper.update(world, walk, targets);
  EXPECT_EQ(sidestepper.set(), WalkSet::GoToTarget);
  // But not to one at the side that is to be reached as the robot stands.
  walk.target = Pose2(0.0, 0.24, 0.0);
  sidestepper.update(world, walk, targets);
  EXPECT_EQ(sidestepper.set(), WalkSet::Sidestep);
}

}  // namespace
}  // namespace nonet::motion
