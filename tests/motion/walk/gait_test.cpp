#include "nonet/motion/walk/gait.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "nonet/math/random.h"

namespace nonet::motion {
namespace {

using model::Side;

// A gait that is asked for one speed in every cycle, without any feedback.
struct GaitWalker {
  void step(const Pose2& speed, bool walk = true, double cycleTime = kCycleTime) {
    GaitInput input;
    input.cycleTime = cycleTime;
    input.command.speed = speed;
    input.command.walk = walk;
    step(input);
  }
  void step(const GaitInput& input) {
    gait.update(parameters, input);
    if (gait.state().standing) return;
    gait.moveSwingFoot(parameters, gait.landing(parameters, 0.0));
  }
  void run(const Pose2& speed, int cycles) {
    for (int i = 0; i < cycles; ++i) step(speed);
  }
  const Pose2& stepSize() const { return gait.state().step; }

  GaitParameters parameters;
  Gait gait;
};

// Nothing bounds the step but the filter.
GaitParameters unbounded() {
  GaitParameters p;
  p.maxStepX = p.maxStepXBack = p.maxStepY = 0.3;
  p.maxStepTheta = 1.5;
  p.combineExponent = 20.0;
  p.maxChangeX = p.maxChangeY = 0.3;
  p.maxChangeTheta = 1.5;
  return p;
}

TEST(Gait, StepSizeClosesItsGapAsAGeometricSeries) {
  GaitWalker walker;
  walker.parameters = unbounded();
  walker.parameters.deltaStepX = 0.15;
  walker.parameters.deltaStepY = 0.3;
  walker.parameters.deltaStepTheta = 0.05;
  const double duration = Gait::stepDuration(walker.parameters);
  for (int n = 1; n < 40; ++n) {
    walker.step(Pose2(0.5, -0.4, 1.0));
    EXPECT_NEAR(walker.stepSize().translation.x(), 0.5 * duration * (1.0 - std::pow(0.85, n)), 1e-12);
    EXPECT_NEAR(walker.stepSize().translation.y(), -0.4 * duration * (1.0 - std::pow(0.7, n)), 1e-12);
    EXPECT_NEAR(walker.stepSize().rotation, duration * (1.0 - std::pow(0.95, n)), 1e-12);
  }
}

TEST(Gait, StepSizeAfterALostMessageIsThatOfTwoCycles) {
  GaitWalker single;
  GaitWalker twice;
  single.parameters = twice.parameters = unbounded();
  for (int i = 0; i < 5; ++i) {
    single.run(Pose2(0.5, 0.2, 1.0), 2);
    twice.step(Pose2(0.5, 0.2, 1.0), true, 2 * kCycleTime);
    EXPECT_NEAR(single.stepSize().translation.x(), twice.stepSize().translation.x(), 1e-12);
    EXPECT_NEAR(single.stepSize().rotation, twice.stepSize().rotation, 1e-12);
  }
}

TEST(Gait, StepSizeGrowsByTheLargestChangeAtMost) {
  GaitWalker walker;
  walker.parameters = unbounded();
  walker.parameters.deltaStepX = 1.0;
  walker.parameters.maxChangeX = 0.003;
  walker.parameters.brake = 0.5;
  for (int n = 1; n < 10; ++n) {
    walker.step(Pose2(1.0, 0.0, 0.0));
    EXPECT_NEAR(walker.stepSize().translation.x(), 0.003 * n, 1e-12);
  }
  for (int n = 1; n < 10; ++n) {
    walker.step(Pose2(-1.0, 0.0, 0.0));
    EXPECT_NEAR(walker.stepSize().translation.x(), 0.027 - 0.5 * 0.003 * n, 1e-12);
  }
}

// Who asks for too much gets a step on the unit sphere of the norm, in the direction asked for.
TEST(Gait, CombinedStepsStayWithinTheSet) {
  Random random(5);
  for (int k = 0; k < 40; ++k) {
    GaitWalker walker;
    const GaitParameters& p = walker.parameters;
    const Pose2 wish(random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-20, 20));
    walker.run(wish, 300);
    const Pose2& step = walker.stepSize();
    const double maxX = step.translation.x() > 0.0 ? p.maxStepX : p.maxStepXBack;
    const double e = p.combineExponent;
    const double norm = std::pow(std::abs(step.translation.x()) / maxX, e) +
                        std::pow(std::abs(step.translation.y()) / p.maxStepY, e) +
                        std::pow(std::abs(step.rotation) / p.maxStepTheta, e);
    EXPECT_NEAR(norm, 1.0, 1e-6);
    EXPECT_NEAR(step.translation.x() * wish.rotation, step.rotation * wish.translation.x(), 1e-6);
    EXPECT_NEAR(step.translation.y() * wish.rotation, step.rotation * wish.translation.y(), 1e-6);
  }
}

TEST(Gait, BalanceTakesItsShareOfTheStep) {
  for (const bool stumbles : {false, true}) {
    GaitWalker walker;
    walker.parameters = unbounded();
    walker.parameters.deltaStepX = 0.2;
    walker.run(Pose2(0.5, 0.0, 0.0), 200);
    const double full = walker.stepSize().translation.x();
    GaitInput input;
    input.cycleTime = kCycleTime;
    input.command.speed = Pose2(0.5, 0.0, 0.0);
    input.command.walk = true;
    input.stepShare = 0.25;
    input.stumbles = stumbles;
    walker.step(input);
    EXPECT_NEAR(walker.stepSize().translation.x(), 0.25 * full, 1e-9);
    walker.step(Pose2(0.5, 0.0, 0.0));
    const double expected = stumbles ? 0.25 * full + 0.2 * 0.75 * full : full;
    EXPECT_NEAR(walker.stepSize().translation.x(), expected, 1e-9) << stumbles;
  }
}

TEST(Gait, FeetTakeTurnsInWholeCycles) {
  GaitWalker walker;
  walker.parameters.stepDuration = 0.093;  // 4.65 cycles: five
  std::vector<int> changes;
  Side stance = Side::Left;
  for (int i = 0; i < 51; ++i) {
    walker.step(Pose2(0.1, 0.0, 0.0));
    if (i > 0 && walker.gait.state().stance != stance) changes.push_back(i);
    stance = walker.gait.state().stance;
  }
  ASSERT_EQ(changes.size(), 10U);
  for (std::size_t i = 0; i < changes.size(); ++i) EXPECT_EQ(changes[i], 5 * (static_cast<int>(i) + 1));
}

// In a straight line each foot goes from half a step behind to half a step ahead, and back with the ground.
TEST(Gait, FeetGoHalfAStepAheadAndBehind) {
  GaitWalker walker;
  const Pose2 speed(0.3, 0.0, 0.0);
  walker.run(speed, 300);
  const double step = walker.stepSize().translation.x();
  EXPECT_NEAR(step, 0.3 * Gait::stepDuration(walker.parameters), 1e-9);
  int ends = 0;
  for (int i = 0; i < 60; ++i) {
    walker.step(speed);
    if (walker.gait.state().phase < 1.0 - 1e-9) continue;
    ++ends;
    const Side stance = walker.gait.state().stance;
    EXPECT_NEAR(walker.gait.foot(model::other(stance)).translation.x(), 0.5 * step, 1e-9);
    EXPECT_NEAR(walker.gait.foot(stance).translation.x(), -0.5 * step, 1e-9);
  }
  EXPECT_EQ(ends, 10);
}

// A foot on the ground stays where it is, whatever the way of the walk frame.
TEST(Gait, StanceFootDoesNotMoveOnTheGround) {
  GaitWalker walker;
  Random random(3);
  Pose2 X_FW;
  Pose2 ground;
  Side stance = Side::Left;
  Pose2 speed;
  for (int i = 0; i < 500; ++i) {
    if (i % 23 == 0) {
      speed = Pose2(random.uniform(-0.5, 0.5), random.uniform(-0.3, 0.3), random.uniform(-1.5, 1.5));
    }
    walker.step(speed);
    X_FW = X_FW * walker.gait.odometryStep();
    const Side now = walker.gait.state().stance;
    const Pose2 foot = X_FW * walker.gait.foot(now);
    if (i > 0 && now == stance) {
      EXPECT_LT((foot.translation - ground.translation).norm(), 1e-9);
      EXPECT_LT(std::abs(wrapAngle(foot.rotation - ground.rotation)), 1e-9);
    }
    stance = now;
    ground = foot;
  }
}

TEST(Gait, LiftsAsDeclared) {
  for (const double straightness : {0.0, 1.0}) {
    GaitWalker walker;
    walker.parameters.stepDuration = 0.4;
    walker.parameters.startLift = 0.5;
    walker.parameters.liftBegin = 0.2;
    walker.parameters.liftLength = 0.6;
    walker.parameters.liftStraightness = straightness;
    for (int i = 0; i < 40; ++i) {
      walker.step(Pose2{});
      const double u = (walker.gait.state().phase - 0.2) / 0.6;
      double expected = 0.0;
      if (u > 0.0 && u < 1.0) {
        expected = straightness > 0.5 ? 2.0 * std::min(u, 1.0 - u) : 0.5 * (1.0 - std::cos(2.0 * kPi * u));
      }
      EXPECT_NEAR(walker.gait.lift(walker.parameters), (i < 20 ? 0.5 : 1.0) * expected, 1e-9) << i;
    }
  }
}

// Speeding up by a constant change of the step, and on a circle v w towards its centre.
TEST(Gait, AccelerationIsThatOfTheWay) {
  GaitWalker walker;
  walker.parameters = unbounded();
  walker.parameters.deltaStepX = 1.0;
  walker.parameters.maxChangeX = 0.001;
  walker.parameters.accelerationFilter = 1.0;
  const double duration = Gait::stepDuration(walker.parameters);
  walker.run(Pose2(2.0, 0.0, 0.0), 50);
  EXPECT_NEAR(walker.gait.state().acceleration.x(), 0.001 / (duration * kCycleTime), 1e-9);
  walker.run(Pose2(0.3, 0.1, 0.8), 400);
  EXPECT_NEAR(walker.gait.state().acceleration.x(), -0.8 * 0.1, 1e-6);
  EXPECT_NEAR(walker.gait.state().acceleration.y(), 0.8 * 0.3, 1e-6);
}

TEST(Gait, StepsToTheSideItLeansTo) {
  for (const double lean : {-0.3, 0.3}) {
    GaitWalker walker;
    GaitInput input;
    input.cycleTime = kCycleTime;
    input.leanToLeft = lean;
    walker.step(input);
    EXPECT_TRUE(walker.gait.state().standing);
    input.leans = true;
    walker.step(input);
    EXPECT_FALSE(walker.gait.state().standing);
    EXPECT_EQ(walker.gait.state().stance, lean > 0.0 ? Side::Right : Side::Left);
  }
}

// It comes to a stand as soon as it is calm, and after a while even when it is not.
TEST(Gait, StandsWhenCalm) {
  const auto cyclesToStand = [](bool calm) {
    GaitWalker walker;
    walker.run(Pose2(0.1, 0.0, 0.0), 50);
    GaitInput input;
    input.cycleTime = kCycleTime;
    input.calm = calm;
    int cycles = 0;
    for (; !walker.gait.state().standing && cycles < 1000; ++cycles) walker.step(input);
    return cycles;
  };
  EXPECT_LT(cyclesToStand(true), 60);
  EXPECT_GT(cyclesToStand(false), 120);
  EXPECT_LT(cyclesToStand(false), 1000);
}

// Pushed out of its stand it steps until both feet have come home, however it came to that stand.
TEST(Gait, AStandingRobotThatIsPushedMakesSeveralSteps) {
  GaitWalker walker;
  walker.run(Pose2(0.1, 0.0, 0.0), 50);
  GaitInput input;
  input.cycleTime = kCycleTime;
  input.calm = true;
  for (int i = 0; i < 200; ++i) walker.step(input);
  ASSERT_TRUE(walker.gait.state().standing);
  input.leans = true;
  input.leanToLeft = 0.3;
  walker.step(input);
  input.leans = false;
  int cycles = 1;
  for (; !walker.gait.state().standing && cycles < 1000; ++cycles) walker.step(input);
  EXPECT_GT(cycles * kCycleTime, 2.5 * walker.gait.state().stepDuration);
}

TEST(Gait, FollowsAPushAtOnceWithinItsLargestStep) {
  const double duration = Gait::stepDuration(GaitParameters{});
  for (const double speed : {0.2, 5.0}) {
    GaitWalker walker;
    walker.run(Pose2(0.3, 0.1, 0.2), 60);
    const double turn = walker.stepSize().rotation;
    GaitInput input;
    input.cycleTime = kCycleTime;
    input.command = {.speed = Pose2(0.3, 0.1, 0.2), .walk = true};
    input.push = {.forward = -speed, .left = -speed};
    walker.step(input);
    const GaitParameters& p = walker.parameters;
    EXPECT_DOUBLE_EQ(walker.stepSize().translation.x(), std::max(-p.maxStepXBack, -speed * duration));
    EXPECT_DOUBLE_EQ(walker.stepSize().translation.y(), std::max(-p.maxStepY, -speed * duration));
    EXPECT_NEAR(walker.stepSize().rotation, turn, 1e-3);
    // And from there on it walks as it is told.
    const double before = walker.stepSize().translation.x();
    walker.step(Pose2(0.3, 0.1, 0.2));
    EXPECT_GT(walker.stepSize().translation.x(), before);
    EXPECT_LT(walker.stepSize().translation.x() - before, p.maxChangeX + 1e-12);
  }
}

}  // namespace
}  // namespace nonet::motion
