#include "nonet/motion/walk/engine.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "nonet/math/random.h"
#include "nonet/model/kinematics.h"

namespace nonet::motion {
namespace {

using model::Side;

// A body that follows every target at once and stays upright: the engine without physics.
class Walker {
 public:
  explicit Walker(int type, const WalkParameters& parameters = {})
      : parameters(parameters), model(model::robotModel(type)), engine(model) {
    body.cycleTime = kCycleTime;
  }

  void step(const Pose2& speed, bool walk = true) {
    previous = targets.angles;
    engine.update(body, parameters, {.speed = speed, .walk = walk}, targets);
    body.joints = targets.angles;
    model::forwardKinematics(model, body.joints, body.bodies);
    body.p_RCom = model::centerOfMass(model, body.bodies);
    X_FW = X_FW * engine.odometryStep();
  }
  void run(const Pose2& speed, int cycles, bool walk = true) {
    for (int i = 0; i < cycles; ++i) step(speed, walk);
  }
  double largestChange() const {
    double largest = 0.0;
    for (std::size_t i = 0; i < model::kJointCount; ++i) {
      largest = std::max(largest, std::abs(targets.angles[i] - previous[i]));
    }
    return largest;
  }
  Pose3 sole(Side side) const { return model::solePose(model, body.bodies, side); }

  WalkParameters parameters;
  const model::RobotModel& model;
  WalkEngine engine;
  world::BodyState body;
  JointTargets targets;
  model::JointArray previous{};
  Pose2 X_FW;  // walk frame on the ground
};

TEST(WalkEngine, StandsSymmetricallyAtItsHeight) {
  for (int type = 0; type < model::kRobotTypeCount; ++type) {
    Walker walker(type);
    walker.run(Pose2{}, 5, false);
    EXPECT_TRUE(walker.engine.standing());
    const Pose3 left = walker.sole(Side::Left);
    const Pose3 right = walker.sole(Side::Right);
    EXPECT_NEAR(left.translation().z(),
                -walker.parameters.pendulum.torsoHeight * walker.model.standingHeight(), 1e-9);
    EXPECT_NEAR(left.translation().x(), walker.parameters.pendulum.feetAhead, 1e-9);
    EXPECT_NEAR(left.translation().y() - right.translation().y(), walker.parameters.gait.footSeparation,
                1e-9);
    EXPECT_LT((left.translation().cwiseProduct(Vector3(1, -1, 1)) - right.translation()).norm(), 1e-9);
    EXPECT_TRUE(left.linear().isIdentity(1e-9));
  }
}

// In the walk frame on the ground the stance foot does not move, whatever the speed (no slipping is planned).
// The torso's own motion over the walk frame is the pendulum's, so it is taken out by the other foot at rest:
// compare through the torso offset that both soles share while standing still in W.
// Also while the torso turns to and fro.
void expectStanceFootOnTheGround(double torsoYawStep) {
  WalkParameters parameters;
  parameters.posture.yawPerStep = torsoYawStep;
  parameters.pendulum.swayFactor = 0.0;  // torso exactly over the walk frame
  parameters.pendulum.surgeFactor = 0.0;
  Walker walker(0, parameters);
  Random random(3);
  Pose2 speed;
  Side stance = Side::Left;
  Pose2 ground;
  bool known = false;
  for (int i = 0; i < 600; ++i) {
    if (i % 23 == 0) {
      speed = Pose2(random.uniform(-0.5, 0.5), random.uniform(-0.3, 0.3), random.uniform(-1.5, 1.5));
    }
    walker.step(speed);
    if (walker.engine.trace().reach != model::Reach::Exact) {
      known = false;
      continue;
    }
    const GaitState& gait = walker.engine.gait();
    const Side now = gait.stance;
    const double torsoYaw =
        sideSign(now) * (2.0 * gait.phase - 1.0) * torsoYawStep * gait.step.translation.x();
    const Pose3 X_RS = walker.sole(now);
    const double yaw = std::atan2(X_RS.linear()(1, 0), X_RS.linear()(0, 0));
    const Pose2 foot =
        walker.X_FW * Pose2(Vector2::Zero(), torsoYaw) *
        Pose2(X_RS.translation().x() - parameters.pendulum.feetAhead, X_RS.translation().y(), yaw);
    if (known && now == stance) {
      EXPECT_LT((foot.translation - ground.translation).norm(), 1e-6) << i;
      EXPECT_LT(std::abs(wrapAngle(foot.rotation - ground.rotation)), 1e-6) << i;
    }
    stance = now;
    ground = foot;
    known = true;
  }
}

TEST(WalkEngine, StanceFootStaysOnTheGround) {
  expectStanceFootOnTheGround(0.0);
}

TEST(WalkEngine, StanceFootStaysOnTheGroundBelowATurningTorso) {
  expectStanceFootOnTheGround(3.0);
}

// The hip of the foot ahead is ahead, and that foot points outwards.
TEST(WalkEngine, TurnsTheTorsoWithTheSteps) {
  WalkParameters parameters;
  parameters.posture.yawPerStep = 3.0;
  parameters.gait.footYawPerTorsoYaw = 1.0;
  Walker walker(0, parameters);
  double least = 1.0;
  double most = -1.0;
  for (int i = 0; i < 200; ++i) {
    walker.step(Pose2(1.0, 0.0, 0.0));
    if (i < 100) continue;
    const Pose3 X_RS = walker.sole(Side::Left);
    const double yaw = std::atan2(X_RS.linear()(1, 0), X_RS.linear()(0, 0));
    least = std::min(least, yaw);
    most = std::max(most, yaw);
    if (X_RS.translation().x() > 0.02) {
      EXPECT_GT(yaw, 0.0);
    }
  }
  const double amplitude = 3.0 * parameters.gait.maxStepX;
  EXPECT_NEAR(most, 2.0 * amplitude, 0.1 * amplitude);
  EXPECT_NEAR(least, 0.0, 0.4 * amplitude);
}

// Position and velocity of the pendulum match when the feet change: sideways the torso's motion relative to
// the middle of the feet has no kink, which shows in second differences as small as inside a step.
TEST(WalkEngine, PendulumMatchesAtTheChangeOfFeet) {
  WalkParameters parameters;
  parameters.gait.stepDuration = 0.4;  // 20 cycles: smooth enough to see a kink
  parameters.gait.stepHeight = 0.0;
  Walker walker(0, parameters);
  walker.run(Pose2(0.05, 0.0, 0.0), 200);
  std::vector<double> y;
  std::vector<int> changes;
  Side stance = walker.engine.gait().stance;
  for (int i = 0; i < 200; ++i) {
    walker.step(Pose2(0.05, 0.0, 0.0));
    y.push_back(-0.5 *
                (walker.sole(Side::Left).translation().y() + walker.sole(Side::Right).translation().y()));
    if (walker.engine.gait().stance != stance) changes.push_back(i);
    stance = walker.engine.gait().stance;
  }
  ASSERT_GE(changes.size(), 5U);
  double speed = 0.0;
  for (std::size_t i = 1; i < y.size(); ++i) speed = std::max(speed, std::abs(y[i] - y[i - 1]));
  ASSERT_GT(speed, 1e-4);
  const double k = std::sqrt(kGravity / parameters.pendulum.height);
  for (const int c : changes) {
    if (c < 2 || c + 2 >= static_cast<int>(y.size())) continue;
    const auto at = static_cast<std::size_t>(c);
    // Acceleration of the pendulum is at most k^2 times its distance from the foot; a jump of the velocity by
    // only a tenth of it would be far more.
    const double bend = std::abs(y[at + 1] - 2.0 * y[at] + y[at - 1]);
    EXPECT_LT(bend, 2.0 * k * k * 0.5 * parameters.gait.footSeparation * kCycleTime * kCycleTime);
    EXPECT_GT((y[at + 1] - y[at]) * (y[at] - y[at - 1]), 0.0);  // it swings on in the same direction
  }
}

TEST(WalkEngine, ReachesTheSpeedAskedFor) {
  Walker walker(0);
  const Pose2 wish(0.2, 0.1, 0.4);
  walker.run(wish, 200);
  const Pose2 begin = walker.X_FW;
  const int cycles = 60;
  double turned = 0.0;
  for (int i = 0; i < cycles; ++i) {
    walker.step(wish);
    turned += walker.engine.odometryStep().rotation;
  }
  EXPECT_NEAR(turned, wish.rotation * cycles * kCycleTime, 1e-6);
  // On a circle: chord of the arc walked.
  const double arc = wish.translation.norm() * cycles * kCycleTime;
  const double chord = 2.0 * arc / turned * std::sin(0.5 * turned);
  EXPECT_NEAR((walker.X_FW.translation - begin.translation).norm(), chord, 1e-3);
}

TEST(WalkEngine, StopsWithTheFeetTogether) {
  Random random(11);
  for (int k = 0; k < 20; ++k) {
    Walker walker(k % model::kRobotTypeCount);
    walker.run(Pose2(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-3, 3)), 50 + k);
    EXPECT_FALSE(walker.engine.standing());
    int cycles = 0;
    while (!walker.engine.standing() && cycles < 200) {
      walker.step(Pose2{}, false);
      ++cycles;
    }
    EXPECT_LT(cycles, 100);
    const Pose3 left = walker.sole(Side::Left);
    const Pose3 right = walker.sole(Side::Right);
    EXPECT_NEAR(left.translation().x(), right.translation().x(), 1e-3);
    EXPECT_NEAR(left.translation().z(), right.translation().z(), 1e-6);
    EXPECT_NEAR(left.translation().y() - right.translation().y(), walker.parameters.gait.footSeparation,
                2e-3);
  }
}

// No jump at any moment: speeds and sets change at random cycles. The bound is what the steady gait itself
// moves in one cycle, with a margin.
TEST(WalkEngine, NothingJumpsWhenSpeedOrSetChange) {
  WalkParameters other;
  other.pendulum.torsoHeight = 0.8;
  other.gait.footSeparation = 0.13;
  other.gait.stepHeight = 0.05;
  other.gait.stepDuration = 0.2;
  other.posture.torsoPitch = 0.1;
  const WalkParameters sets[2] = {WalkParameters{}, other};
  double steady = 0.0;
  for (const WalkParameters& set : sets) {
    for (int direction = 0; direction < 8; ++direction) {
      Walker walker(0, set);
      const Pose2 wish(std::cos(direction * kPi / 4), std::sin(direction * kPi / 4), direction % 3 - 1.0);
      walker.run(wish, 100);
      for (int i = 0; i < 50; ++i) {
        walker.step(wish);
        steady = std::max(steady, walker.largestChange());
      }
    }
  }
  for (const std::uint64_t seed : {1, 2, 3}) {
    Walker walker(0);
    Random random(seed);
    walker.run(Pose2{}, 10, false);
    WalkParameters from = sets[0];
    int target = 0;
    double share = 1.0;
    Pose2 speed;
    bool walk = true;
    double largest = 0.0;
    for (int i = 0; i < 1500; ++i) {
      if (random.below(30) == 0) {
        speed = Pose2(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-3, 3));
        walk = random.below(4) != 0;
      }
      if (random.below(40) == 0) {
        from = walker.parameters;
        target = 1 - target;
        share = 0.0;
      }
      share = std::min(1.0, share + kCycleTime / 0.1);
      walker.parameters = blend(from, sets[target], share);
      walker.step(speed, walk);
      largest = std::max(largest, walker.largestChange());
    }
    EXPECT_LT(largest, 1.5 * steady);
  }
}

// The first message of all ends no cycle: it must leave nothing in the engine that is not a number.
TEST(WalkEngine, SurvivesCyclesOfNoLength) {
  Walker walker(0);
  walker.body.cycleTime = 0.0;
  walker.step(Pose2(0.3, 0.1, 0.5));
  walker.body.cycleTime = kCycleTime;
  walker.run(Pose2(0.3, 0.1, 0.5), 50);
  for (const double angle : walker.targets.angles) EXPECT_TRUE(std::isfinite(angle));
  EXPECT_GT(walker.X_FW.translation.norm(), 0.05);
}

// With half of the side step between the feet the closing foot comes beside the other one, never across it.
TEST(WalkEngine, SideStepsDoNotCrossTheFeet) {
  for (const double sideOut : {0.0, 0.5}) {
    WalkParameters parameters;
    parameters.gait.widthPerSideStep = sideOut;
    parameters.gait.swingBegin = 0.0;
    parameters.gait.swingLength = 1.0;
    Walker walker(0, parameters);
    walker.run(Pose2(0.0, 0.3, 0.0), 100);
    double nearest = 1.0;
    for (int i = 0; i < 100; ++i) {
      walker.step(Pose2(0.0, 0.3, 0.0));
      nearest = std::min(
          nearest, walker.sole(Side::Left).translation().y() - walker.sole(Side::Right).translation().y());
    }
    const double step = 0.3 * Gait::stepDuration(parameters.gait);
    EXPECT_NEAR(nearest, parameters.gait.footSeparation - (1.0 - 2.0 * sideOut) * step, 1e-6) << sideOut;
  }
}

// A pendulum of height h that accelerates by a leans h a / g ahead of its foot; in a curve a = v w inwards.
TEST(WalkEngine, TorsoShiftsIntoTheCurve) {
  const Pose2 speed(0.3, 0.0, 0.8);
  const auto middleOfFeet = [&](double shift, double roll) {
    WalkParameters parameters;
    parameters.pendulum.accelerationShiftY = shift;
    parameters.posture.accelerationRoll = roll;
    parameters.gait.combineExponent = 20.0;
    parameters.balance.stepRollGain = parameters.balance.swingLevelGain =
        0.0;  // this body stays upright: no feedback
    Walker walker(0, parameters);
    walker.run(speed, 200);
    Vector3 sum = Vector3::Zero();
    const int whole = 2 * static_cast<int>(std::lround(Gait::stepDuration(parameters.gait) / kCycleTime));
    for (int i = 0; i < whole; ++i) {
      walker.step(speed);
      sum += 0.5 * (walker.sole(Side::Left).translation() + walker.sole(Side::Right).translation());
    }
    return Vector3(sum / whole);
  };
  const WalkParameters parameters;
  const double expected = parameters.pendulum.height / kGravity * 0.3 * 0.8;
  const Vector3 upright = middleOfFeet(0.0, 0.0);
  EXPECT_NEAR(middleOfFeet(1.0, 0.0).y(), upright.y() - expected, 1e-6) << "turns left, so the torso is left";
  const double angle = 0.3 * 0.8 / kGravity;
  const Vector3 leaning = middleOfFeet(0.0, 1.0);
  EXPECT_NEAR(leaning.y(), upright.y() * std::cos(angle) - upright.z() * std::sin(angle), 1e-6);
}

// Level feet below a leaning torso: the commanded soles are turned by the tilt against the torso, as far as
// it is beyond the limit, and below the limit nothing changes at all.
TEST(WalkEngine, LevelsTheFeetBelowATorsoThatTiltsFar) {
  for (const double tilt : {-0.5, -0.3, -0.1, 0.1, 0.3, 0.5}) {
    for (const bool roll : {false, true}) {
      WalkParameters plain;
      plain.balance.swingLevelGain = 0.0;
      plain.balance.stepPitchGain = plain.balance.stepRollGain = 0.0;
      WalkParameters levelling = plain;
      levelling.recovery.farTilt = 0.2;
      levelling.recovery.levelGain = 1.0;
      Walker without(0, plain);
      Walker with(0, levelling);
      for (Walker* walker : {&without, &with}) {
        (roll ? walker->body.roll : walker->body.pitch) = tilt;
        walker->run(Pose2{}, 7);
      }
      const double beyond = tilt - std::clamp(tilt, -0.2, 0.2);
      const Vector3 axis = roll ? Vector3::UnitX() : Vector3::UnitY();
      for (const Side side : {Side::Left, Side::Right}) {
        const std::size_t foot = motion::index(side);
        const Pose3& before = without.engine.trace().feet[foot];
        const Pose3 expected = Eigen::AngleAxisd(-beyond, axis) * before;
        const Pose3& after = with.engine.trace().feet[foot];
        EXPECT_TRUE(after.isApprox(expected, 1e-9)) << "tilt " << tilt << (roll ? " roll" : " pitch");
      }
    }
  }
}

TEST(WalkEngine, StepsToWhereItFalls) {
  for (const double tilt : {-0.5, -0.25, 0.1, 0.4}) {
    WalkParameters plain;
    WalkParameters catching;
    catching.recovery.farTilt = 0.2;
    catching.recovery.stepGain = 0.3;
    Walker without(0, plain);
    Walker with(0, catching);
    const int cycles = static_cast<int>(std::lround(Gait::stepDuration(plain.gait) / kCycleTime));
    for (Walker* walker : {&without, &with}) {
      walker->body.pitch = tilt;
      walker->body.roll = -tilt;  // to the left
      walker->run(Pose2{}, cycles);
    }
    const double beyond = tilt - std::clamp(tilt, -0.2, 0.2);
    const std::size_t swing = motion::index(model::other(with.engine.gait().stance));
    const Vector3 moved =
        with.engine.trace().feet[swing].translation() - without.engine.trace().feet[swing].translation();
    EXPECT_NEAR(moved.x(), 0.3 * beyond, 1e-9) << tilt;
    EXPECT_NEAR(moved.y(), 0.3 * beyond, 1e-9) << tilt;
  }
}

// Whatever way it faces in the frame in which the body's speed is known.
TEST(WalkEngine, StepsBackWhenItIsPushedBack) {
  for (const double yaw : {0.0, 1.2, -2.5}) {
    for (const double speed : {-0.1, -0.3}) {
      Walker walker(0);
      walker.body.yaw = yaw;
      walker.run(Pose2(0.3, 0.0, 0.0), 50);
      walker.body.pitch = -0.18;
      const Vector2 v_G = Eigen::Rotation2Dd(yaw) * Vector2(speed, 0.0);
      walker.body.v_GR = Vector3(v_G.x(), v_G.y(), 0.0);
      walker.step(Pose2(0.3, 0.0, 0.0));
      const double step = walker.engine.gait().step.translation.x();
      if (speed > -0.2) {
        EXPECT_GT(step, 0.0) << "slower than pushedSpeed";
      } else {
        EXPECT_NEAR(step, speed * Gait::stepDuration(walker.parameters.gait), 1e-9) << yaw;
      }
    }
  }
}

// While it stumbles the error of the centre of mass makes its steps small. Upright again it speeds up as from
// a stand.
TEST(WalkEngine, DoesNotLeapBackToFullSpeedAfterAStumble) {
  Walker walker(0);
  walker.run(Pose2(1.0, 0.0, 0.0), 100);
  const double full = walker.engine.gait().step.translation.x();
  walker.body.pitch = 0.3;
  walker.run(Pose2(1.0, 0.0, 0.0), 20);
  double before = walker.engine.gait().step.translation.x();
  EXPECT_LT(before, 0.5 * full);
  walker.body.pitch = 0.0;
  walker.step(Pose2(1.0, 0.0, 0.0));  // the error of the cycle before still counts
  for (int i = 0; i < 60; ++i) {
    before = walker.engine.gait().step.translation.x();
    walker.step(Pose2(1.0, 0.0, 0.0));
    EXPECT_LT(walker.engine.gait().step.translation.x() - before, walker.parameters.gait.maxChangeX + 1e-9)
        << i;
  }
  EXPECT_NEAR(walker.engine.gait().step.translation.x(), full, 1e-3);
}

// Outside what a physical reading would allow nothing breaks: finite angles within the limits for random sets
// from the whole declared ranges.
TEST(WalkEngine, SurvivesEverySetWithinTheRanges) {
  Random random(17);
  for (int k = 0; k < 300; ++k) {
    WalkParameters parameters;
    for (auto& field : config::fieldsOf(parameters)) {
      *field.real = random.uniform(field.declaration.range.low, field.declaration.range.high);
    }
    Walker walker(k % model::kRobotTypeCount, parameters);
    for (int i = 0; i < 60; ++i) {
      walker.body.pitch = random.uniform(-1.5, 1.5);
      walker.body.roll = random.uniform(-1.5, 1.5);
      walker.body.gyro = Vector3(random.normal(), random.normal(), random.normal()) * 5.0;
      walker.step(Pose2(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9)), i % 20 < 15);
      for (const model::JointSpec& joint : walker.model.joints()) {
        ASSERT_TRUE(std::isfinite(walker.targets.angles[model::index(joint.id)])) << k << " " << i;
      }
    }
  }
}

}  // namespace
}  // namespace nonet::motion
