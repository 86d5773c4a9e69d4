#include "nonet/motion/walk/balance.h"

#include <deque>

#include <gtest/gtest.h>

#include "nonet/math/random.h"

namespace nonet::motion {
namespace {

// A torso that turns steadily has, after the time looked ahead, the tilt that is reckoned now.
TEST(Balance, TiltIsAgainstTheWantedLeanAndLooksAhead) {
  BalanceParameters p;
  p.tiltLookAhead = 0.04;
  const Attitude wanted{.pitch = 0.1, .roll = -0.05};
  const Vector3 gyro(0.5, -2.0, 9.0);
  const auto torsoAt = [&](double time) {
    return Attitude{.pitch = 0.2 + gyro.y() * time, .roll = 0.1 + gyro.x() * time};
  };
  const Tilt ahead = tiltAgainst(p, torsoAt(0.0), gyro, wanted);
  const Tilt then = tiltAgainst(BalanceParameters{}, torsoAt(0.04), gyro, wanted);
  EXPECT_NEAR(ahead.pitch, then.pitch, 1e-12);
  EXPECT_NEAR(ahead.roll, then.roll, 1e-12);
  EXPECT_EQ(ahead.pitchRate, -2.0);
  EXPECT_EQ(ahead.rollRate, 0.5);
  const Tilt none = tiltAgainst(BalanceParameters{}, wanted, Vector3::Zero(), wanted);
  EXPECT_EQ(none.largest(), 0.0);
}

TEST(Balance, StepsShrinkWithTheErrorOfTheCentreOfMass) {
  BalanceParameters p;
  p.comErrorNormal = 0.02;
  p.comErrorMost = 0.1;
  EXPECT_EQ(stepShare(p, 0.0), 1.0);
  EXPECT_EQ(stepShare(p, 0.02), 1.0);
  EXPECT_NEAR(stepShare(p, 0.04), 0.75, 1e-12);
  EXPECT_NEAR(stepShare(p, 0.09), 0.125, 1e-12);
  EXPECT_EQ(stepShare(p, 0.2), 0.0);
  p.comErrorMost = 0.01;  // the wrong way round: a threshold
  EXPECT_EQ(stepShare(p, 0.005), 1.0);
  EXPECT_EQ(stepShare(p, 0.015), 0.0);
}

TEST(Balance, StandsUprightOrWithASmallError) {
  const BalanceParameters p;
  WalkMeasurement measurement;
  measurement.comError = 2.0 * p.comErrorNormal;
  EXPECT_TRUE(isCalm(p, measurement));
  measurement.tilt.roll = -0.1;
  EXPECT_FALSE(isCalm(p, measurement));
  measurement.comError = 0.5 * p.comErrorNormal;
  EXPECT_TRUE(isCalm(p, measurement));
  EXPECT_FALSE(leansTooFar(measurement.tilt));
  measurement.tilt.pitch = -0.2;
  EXPECT_TRUE(leansTooFar(measurement.tilt));
}

// With a gain of 1 the command is as far on the other side as the torso is on this one.
TEST(Balance, HipsLeanAgainstTheTilt) {
  BalanceParameters p;
  p.hipPitchGain = p.hipRollGain = 1.0;
  const Attitude wanted{.pitch = 0.1, .roll = -0.05};
  const Attitude torso{.pitch = 0.3, .roll = 0.1};
  const Attitude lean = steadied(p, wanted, tiltAgainst(p, torso, Vector3(1.0, 1.0, 0.0), wanted));
  EXPECT_NEAR(0.5 * (lean.pitch + torso.pitch), wanted.pitch, 1e-12);
  EXPECT_NEAR(0.5 * (lean.roll + torso.roll), wanted.roll, 1e-12);
  p = BalanceParameters{};
  p.hipPitchRateGain = 0.02;
  p.hipRollRateGain = 0.03;
  const Attitude slowed = steadied(p, wanted, {.pitchRate = 2.0, .rollRate = -1.0});
  EXPECT_NEAR(slowed.pitch, wanted.pitch - 0.04, 1e-12);
  EXPECT_NEAR(slowed.roll, wanted.roll + 0.03, 1e-12);
}

// A sole below a torso that tilts: with the whole tilt taken out it is parallel to the ground.
TEST(Balance, SwingFootLandsLevel) {
  BalanceParameters p;
  p.swingLevelGain = 1.0;
  for (const bool roll : {false, true}) {
    Tilt tilt;
    (roll ? tilt.roll : tilt.pitch) = 0.3;
    const Attitude taken = swingLevel(p, tilt);
    const Matrix3 R_GS = rotationOf(Attitude{.pitch = tilt.pitch, .roll = tilt.roll}) *
                         rotationOf(Attitude{.pitch = -taken.pitch, .roll = -taken.roll});
    EXPECT_TRUE(R_GS.isIdentity(1e-12));
  }
}

TEST(Balance, AnklesAndLandingFollowTiltAndRate) {
  BalanceParameters p;
  p.anklePitchGain = 0.5;
  p.anklePitchRateGain = 0.1;
  p.ankleRollGain = -0.25;
  p.ankleRollRateGain = 0.2;
  p.stepPitchGain = 0.3;
  p.stepPitchRateGain = 0.01;
  p.stepRollGain = 0.2;
  p.stepRollRateGain = 0.02;
  const Tilt tilt{.pitch = 0.1, .pitchRate = 1.0, .roll = -0.2, .rollRate = -2.0};
  EXPECT_NEAR(ankleTurn(p, tilt).pitch, 0.15, 1e-12);
  EXPECT_NEAR(ankleTurn(p, tilt).roll, -0.35, 1e-12);
  EXPECT_NEAR(landingShift(p, tilt).x(), 0.04, 1e-12);
  EXPECT_NEAR(landingShift(p, tilt).y(), 0.08, 1e-12) << "it falls to the left";
}

// Against a list that keeps everything.
TEST(CommandHistory, GivesWhatWasCommandedThen) {
  CommandHistory history;
  std::deque<double> all;
  Random random(7);
  for (int i = 0; i < 100; ++i) {
    if (i == 60) {
      history.reset();
      all.clear();
    }
    all.push_front(random.uniform(-1.0, 1.0));
    history.add({.torsoYaw = all.front()});
    const CommandHistory::Command* then = history.measuredNow();  // two cycles old
    ASSERT_EQ(then != nullptr, all.size() > 2);
    if (then != nullptr) {
      EXPECT_EQ(then->torsoYaw, all[2]);
    }
  }
}

}  // namespace
}  // namespace nonet::motion
