// Body state against recordings of the real server with the exact pose of the torso in every cycle.
#include "nonet/world/body_tracker.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "nonet/math/angle.h"
#include "nonet/world/world_state.h"

#include "recording.h"

namespace nonet::world {
namespace {

constexpr double kLying = 1.3;  // rad of true tilt: on the ground, but for a limb

struct Comparison {
  double tiltError = 0.0;      // rad, largest
  double headingError = 0.0;   // rad, largest
  double heightError = 0.0;    // m, largest while upright
  double distanceError = 0.0;  // m, at the end of the recording
  double fallenAt = kNever;    // s after the first message
  double fallingAt = kNever;
  double lyingAt = kNever;
  Posture last = Posture::Upright;
};

Comparison compare(const std::string& file) {
  BodyTracker tracker(model::robotModel(0), {});
  BodyState state;
  Comparison result;
  std::optional<Pose3> first;
  Matrix3 R_WG = Matrix3::Identity();
  double start = 0.0;
  test::readRecording(
      file, [&](const protocol::Percept& percept) { tracker.update(percept, state); },
      [&](const Pose3& X_WR) {
        if (!first) {
          first = X_WR;
          R_WG = X_WR.linear() * state.R_GR.transpose();
          start = state.time;
        }
        const Matrix3 error = X_WR.linear() * (R_WG * state.R_GR).transpose();
        result.tiltError = std::max(result.tiltError, std::acos(std::min(1.0, error(2, 2))));
        result.headingError = std::max(result.headingError, std::abs(std::atan2(error(1, 0), error(0, 0))));
        if (state.posture == Posture::Upright) {
          result.heightError =
              std::max(result.heightError, std::abs(X_WR.translation().z() - state.torsoHeight));
        }
        const Vector3 moved = R_WG.transpose() * (X_WR.translation() - first->translation());
        result.distanceError = (moved - state.p_GR).head<2>().norm();
        if (state.posture == Posture::Falling && result.fallingAt == kNever) {
          result.fallingAt = state.time - start;
        }
        if (isFallen(state.posture) && result.fallenAt == kNever) result.fallenAt = state.time - start;
        const double trueTilt = std::acos(std::clamp(X_WR.linear()(2, 2), -1.0, 1.0));
        if (trueTilt > kLying && result.lyingAt == kNever) result.lyingAt = state.time - start;
        result.last = state.posture;
      });
  return result;
}

TEST(BodyTracker, FollowsAWalkThatEndsInAFall) {
  const Comparison result = compare("walk_until_fall.log.gz");
  EXPECT_LT(result.tiltError, toRadians(0.3));
  EXPECT_LT(result.headingError, toRadians(0.05));
  EXPECT_LT(result.heightError, 0.03);
  EXPECT_LT(result.distanceError, 0.10);  // after 10 s
  EXPECT_GT(result.fallenAt, 0.0);
  EXPECT_TRUE(isFallen(result.last));
}

TEST(BodyTracker, TellsTheDirectionOfAFall) {
  EXPECT_EQ(compare("fall_front.log.gz").last, Posture::FallenFront);
  EXPECT_EQ(compare("fall_back.log.gz").last, Posture::FallenBack);
  EXPECT_EQ(compare("fall_right.log.gz").last, Posture::FallenRight);
}

TEST(BodyTracker, NoticesAFallBeforeTheGround) {
  for (const char* file : {"fall_front.log.gz", "fall_back.log.gz", "fall_right.log.gz"}) {
    const Comparison result = compare(file);
    ASSERT_GT(result.fallingAt, 0.0) << file;
    EXPECT_LT(result.fallingAt, result.fallenAt) << file;
    EXPECT_GE(result.lyingAt - result.fallingAt, 0.1) << file;
  }
}

/// A standing robot's message.
protocol::Percept standing(double time) {
  protocol::Percept percept;
  percept.time = time;
  percept.accelerometer = {0.0, 0.0, kGravity};
  percept.jointsPresent = ~0U;
  for (const auto sensor : {protocol::ForceSensor::LFoot, protocol::ForceSensor::RFoot}) {
    percept.forces[static_cast<std::size_t>(sensor)] = protocol::FootForce{{0, 0, -0.01}, {0, 0, 22.6}};
  }
  return percept;
}

TEST(BodyTracker, CountsCyclesBehindRoundedTimes) {
  // Server times drift against the print grid, so single steps look like 0.01 or 0.03.
  for (const double start : {3.0, 3.004, 3.0049, 3.005, 3.0096, 3.0133}) {
    BodyTracker tracker(model::robotModel(0), {});
    BodyState state;
    int cycles = 0;
    for (int k = 0; k < 3000; ++k) {
      const double exact = start + k * 0.02 * (1.0 - 3e-6);
      protocol::Percept percept = standing(std::round(exact * 100.0) / 100.0);
      percept.joints[0] = 1e-4 * (k % 2);  // awake
      ASSERT_TRUE(tracker.update(percept, state));
      if (k > 0) cycles += static_cast<int>(std::lround(state.cycleTime / 0.02));
    }
    EXPECT_EQ(cycles, 2999) << start;
  }
}

TEST(BodyTracker, RepeatedMessagesChangeNothingAndLostOnesAreCounted) {
  BodyTracker tracker(model::robotModel(0), {});
  BodyState state;
  ASSERT_TRUE(tracker.update(standing(5.0), state));
  ASSERT_TRUE(tracker.update(standing(5.02), state));
  const BodyState before = state;
  EXPECT_FALSE(tracker.update(standing(5.02), state));
  EXPECT_EQ(before.p_GR, state.p_GR);
  ASSERT_TRUE(tracker.update(standing(5.10), state));
  EXPECT_NEAR(state.cycleTime, 0.08, 1e-9);
}

// A beam sets the robot upright without turning it: the gyro sees nothing of it.
TEST(BodyTracker, WhoIsPutUprightStands) {
  BodyTracker tracker(model::robotModel(0), {});
  BodyState state;
  test::readRecording("fall_back.log.gz", [&](const protocol::Percept& percept) {
    tracker.update(percept, state);
    EXPECT_FALSE(state.putUpright);
  });
  ASSERT_TRUE(isFallen(state.posture));
  const double yaw = state.yaw;
  tracker.putUpright(state);
  EXPECT_TRUE(state.putUpright);
  EXPECT_EQ(state.posture, Posture::Upright);
  EXPECT_NEAR(std::acos(state.R_GR(2, 2)), 0.0, 1e-6);
  EXPECT_NEAR(state.yaw, yaw, 1e-9);
  tracker.update(standing(state.time + kCycleTime), state);
  EXPECT_FALSE(state.putUpright);
  EXPECT_EQ(state.posture, Posture::Upright);
}

// It leans at 0.8 rad on something and does not move: not upright, and not falling for ever.
TEST(BodyTracker, WhoLeansForLongCountsAsFallen) {
  BodyTracker tracker(model::robotModel(0), {});
  BodyState state;
  int cycle = 0;
  double pitch = 0.0;
  const auto turn = [&](double rate, double seconds) {
    for (const int end = cycle + static_cast<int>(seconds / kCycleTime); cycle < end; ++cycle) {
      pitch += kCycleTime * rate;
      protocol::Percept percept = standing(5.0 + cycle * kCycleTime);
      percept.gyro = Vector3(0.0, rate, 0.0);
      percept.accelerometer = kGravity * Vector3(-std::sin(pitch), 0.0, std::cos(pitch));
      percept.joints[0] = 1e-4 * (cycle % 2);  // awake
      tracker.update(percept, state);
    }
  };
  turn(0.0, 0.2);
  turn(1.6, 0.5);
  turn(0.0, 1.0);
  EXPECT_FALSE(isFallen(state.posture)) << "it may come up again";
  turn(0.0, 1.5);
  EXPECT_EQ(state.posture, Posture::FallenFront);
  turn(-1.6, 0.5);
  EXPECT_EQ(state.posture, Posture::Upright);
}

TEST(BodyTracker, IntegratesLostTurns) {
  // A constant turn of 1 rad/s about z, every third message lost.
  BodyTracker tracker(model::robotModel(0), {});
  BodyState state;
  int k = 0;
  for (; k <= 150; ++k) {
    if (k % 3 == 1) continue;
    protocol::Percept percept = standing(5.0 + 0.02 * k);
    percept.gyro = {0.0, 0.0, 1.0};
    percept.joints[0] = 1e-4 * (k % 2);
    tracker.update(percept, state);
  }
  EXPECT_NEAR(angleDifference(state.yaw, 150 * 0.02), 0.0, 0.01);
}

TEST(BodyTracker, AFrozenSenseDoesNotDrift) {
  // A sleeping robot repeats its last senses for ever (server facts 3.4), also a small rate.
  BodyTracker tracker(model::robotModel(0), {});
  BodyState state;
  for (int k = 0; k < 3000; ++k) {
    protocol::Percept percept = standing(5.0 + 0.02 * k);
    percept.gyro = {0.0, 0.0, toRadians(0.05)};
    percept.accelerometer = {0.02, 0.0, 9.82};
    tracker.update(percept, state);
  }
  EXPECT_TRUE(state.asleep);
  EXPECT_LT(std::abs(state.yaw), toRadians(0.01));
  EXPECT_LT(state.p_GR.head<2>().norm(), 0.001);
  EXPECT_EQ(state.v_GR, Vector3::Zero());
}

TEST(BodyTracker, CombinesFootAndToe) {
  // Type 4: two thirds of the load on the foot, one third on the toe.
  BodyTracker tracker(model::robotModel(4), {});
  BodyState state;
  protocol::Percept percept = standing(5.0);
  percept.forces = {};
  percept.forces[static_cast<std::size_t>(protocol::ForceSensor::LFoot)] = {{0.0, 0.0, -0.01}, {0, 0, 20.0}};
  percept.forces[static_cast<std::size_t>(protocol::ForceSensor::LToe)] = {{0.0, 0.0, -0.005}, {0, 0, 10.0}};
  tracker.update(percept, state);
  const auto left = static_cast<std::size_t>(model::Side::Left);
  const auto right = static_cast<std::size_t>(model::Side::Right);
  EXPECT_TRUE(state.footContact[left]);
  EXPECT_FALSE(state.footContact[right]);
  EXPECT_NEAR(state.footForce[left].z(), 30.0, 1e-9);
  EXPECT_NEAR(state.torsoHeight, 0.385, 2e-3);
}

// The server may send "nan" (server facts 1.5).
TEST(BodyTracker, WhatIsNoNumberLeavesTheStateAsItWas) {
  const double nan = std::nan("");
  BodyTracker tracker(model::robotModel(0), {});
  BodyState state;
  for (int i = 1; i < 50; ++i) tracker.update(standing(1.0 + i * kCycleTime), state);
  protocol::Percept broken = standing(2.0);
  broken.joints.fill(nan);
  broken.gyro.setConstant(nan);
  broken.accelerometer.setConstant(nan);
  for (auto& force : broken.forces)
    if (force) force->force.setConstant(nan);
  tracker.update(broken, state);
  for (int i = 1; i < 20; ++i) tracker.update(standing(2.0 + i * kCycleTime), state);
  EXPECT_TRUE(state.R_GR.allFinite());
  EXPECT_TRUE(state.v_GR.allFinite());
  EXPECT_TRUE(std::isfinite(state.torsoHeight));
  for (const double joint : state.joints) EXPECT_TRUE(std::isfinite(joint));
  EXPECT_EQ(state.posture, Posture::Upright);
}

}  // namespace
}  // namespace nonet::world
