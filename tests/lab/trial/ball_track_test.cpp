// The measures of the ball skills against tracks whose answer is known, because they were made by hand.
#include "nonet/lab/trial/ball_track.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "nonet/math/angle.h"
#include "nonet/math/types.h"

namespace nonet::lab {
namespace {

/// The ball at p(t), the torso `apart` behind it along x, a sample each cycle from 0 to `seconds`.
template <class Place>
BallTrack trackOf(double seconds, double apart, const Place& p) {
  BallTrack track;
  for (int i = 0; i <= std::lround(seconds / kCycleTime); ++i) {
    const double time = i * kCycleTime;
    const Vector2 ball = p(time);
    track.push_back({time, ball, Pose2(ball.x() - apart, ball.y(), 0.0)});
  }
  return track;
}

/// Along the legs of a path at this speed.
Vector2 onPath(const BallPath& path, double way) {
  for (std::size_t i = 1; i < path.corners.size(); ++i) {
    const Vector2 leg = path.corners[i] - path.corners[i - 1];
    if (way <= leg.norm()) return path.corners[i - 1] + way * leg.normalized();
    way -= leg.norm();
  }
  return path.corners.back();
}

TEST(BallTrack, DribblesAsFastAsTheBallGoes) {
  // Lies for 2 s, then goes 10 m at 0.8 m/s: the time before the touch does not count.
  const BallTrack track =
      trackOf(20.0, 0.2, [](double t) { return Vector2(1.0 + 0.8 * std::clamp(t - 2.0, 0.0, 14.0), 2.0); });
  const DribbleResult result = measureDribble(track, straightPath({1.0, 2.0, 0.0}, 10.0));
  EXPECT_TRUE(result.arrived);
  EXPECT_FALSE(result.lost);
  EXPECT_NEAR(result.progress, 10.0, 1e-9);
  EXPECT_NEAR(result.speed, 0.8, 0.01);
}

TEST(BallTrack, DribbleThatEndsHalfWay) {
  const BallTrack track = trackOf(10.0, 0.2, [](double t) { return Vector2(std::min(0.5 * t, 4.0), 0.0); });
  const DribbleResult result = measureDribble(track, straightPath({}, 10.0));
  EXPECT_FALSE(result.arrived);
  EXPECT_NEAR(result.progress, 4.0, 1e-9);
  EXPECT_NEAR(result.speed, 0.4, 0.01);  // of the whole time
}

TEST(BallTrack, BallIsLostFarFromTheTorsoOrFromTheLine) {
  const auto straight = [](double t) { return Vector2(t, 0.0); };
  EXPECT_FALSE(measureDribble(trackOf(11.0, 0.59, straight), straightPath({}, 10.0)).lost);
  const DribbleResult far = measureDribble(trackOf(11.0, 0.61, straight), straightPath({}, 10.0));
  EXPECT_TRUE(far.lost);
  EXPECT_TRUE(far.tooFar);
  EXPECT_NEAR(far.away, 1.0, 1e-9);
  // Beside the line by more than 0.3 m from 6 to 8 m of 10.
  const auto aside = [](double t) { return Vector2(t, t > 6.0 && t < 8.0 ? 0.31 : 0.0); };
  const DribbleResult result = measureDribble(trackOf(11.0, 0.2, aside), straightPath({}, 10.0));
  EXPECT_TRUE(result.arrived);
  EXPECT_TRUE(result.lost);
  EXPECT_FALSE(result.tooFar);
  EXPECT_NEAR(result.away, 0.2, 0.01);
}

TEST(BallTrack, SlalomHasItsTurns) {
  const BallPath path = slalomPath({1.0, -2.0, 0.3}, 6, toRadians(60.0), 2.0);
  ASSERT_EQ(path.corners.size(), 8U);
  EXPECT_NEAR(path.length(), 14.0, 1e-9);
  for (std::size_t i = 1; i + 1 < path.corners.size(); ++i) {
    const Vector2 in = path.corners[i] - path.corners[i - 1];
    const Vector2 out = path.corners[i + 1] - path.corners[i];
    EXPECT_NEAR(in.norm(), 2.0, 1e-9);
    const double turn = std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
    EXPECT_NEAR(std::abs(turn), toRadians(60.0), 1e-9);
    EXPECT_EQ(turn < 0.0, i % 2 == 1) << i;  // to the right first
  }
  // The middle line leads straight ahead: after two legs the path is on it.
  const Vector2 onLine = Pose2(1.0, -2.0, 0.3).inverse() * path.corners[2];
  EXPECT_NEAR(onLine.y(), 0.0, 1e-9);
}

TEST(BallTrack, SlalomCountsCornerByCorner) {
  BallPath path = slalomPath({}, 6, toRadians(60.0), 2.0);
  path.width = 0.6;
  const auto exact = [&](double t) { return onPath(path, 0.5 * t); };
  const DribbleResult result = measureDribble(trackOf(30.0, 0.2, exact), path);
  EXPECT_TRUE(result.arrived);
  EXPECT_FALSE(result.lost);
  EXPECT_NEAR(result.speed, 0.5, 0.01);
  // Straight ahead misses the first corner by more than a metre, and nothing beyond it counts.
  const auto cut = [&](double t) { return Vector2(0.5 * t, -0.2); };
  EXPECT_FALSE(measureDribble(trackOf(40.0, 0.2, cut), path).arrived);
}

/// The torso at the origin, the ball on the x axis at distance d(t).
template <class Distance>
BallTrack comingBall(double seconds, const Distance& d) {
  BallTrack track;
  for (int i = 0; i <= std::lround(seconds / kCycleTime); ++i) {
    const double time = i * kCycleTime;
    track.push_back({time, Vector2(d(time), 0.0), Pose2()});
  }
  return track;
}

TEST(BallTrack, HeldIsNearAndSlowForAWhile) {
  const ReceiveResult stopped =
      measureReceive(comingBall(5.0, [](double t) { return std::max(3.0 - 2.0 * t, 0.15); }), {});
  EXPECT_TRUE(stopped.held);
  EXPECT_NEAR(stopped.closest, 0.15, 1e-9);
  EXPECT_NEAR(stopped.time, 1.4, 0.1);
  EXPECT_NEAR(stopped.rebound, 0.15, 1e-9);
}

TEST(BallTrack, ReboundPassAndSlowPassingAreNotHeld) {
  const ReceiveResult rebound = measureReceive(
      comingBall(5.0, [](double t) { return t < 1.4 ? 3.0 - 2.0 * t : 0.2 + 1.0 * (t - 1.4); }), {});
  EXPECT_FALSE(rebound.held);
  EXPECT_NEAR(rebound.rebound, 1.2, 0.05);
  EXPECT_FALSE(measureReceive(comingBall(5.0, [](double t) { return 3.0 - 2.0 * t; }), {}).held);
  // Half a second within reach, but on its way.
  EXPECT_FALSE(measureReceive(comingBall(8.0, [](double t) { return 3.0 - 1.0 * t; }), {}).held);
}

TEST(BallTrack, HeldTooLateIsNotHeld) {
  // Near at once, then away, and back to rest after 1 and after 3 seconds.
  const auto backAt = [](double back) {
    return comingBall(6.0, [=](double t) { return t < 0.1 ? 0.2 : t < back ? 0.8 : 0.2; });
  };
  EXPECT_TRUE(measureReceive(backAt(1.0), {}).held);
  EXPECT_FALSE(measureReceive(backAt(3.0), {}).held);
}

/// The torso on the x axis at x(t).
template <class Way>
BallTrack running(double seconds, const Way& x) {
  BallTrack track;
  for (int i = 0; i <= std::lround(seconds / kCycleTime); ++i) {
    const double time = i * kCycleTime;
    track.push_back({time, Vector2::Zero(), Pose2(x(time), 0.0, 0.0)});
  }
  return track;
}

TEST(BallTrack, RunIsMeasuredBeyondItsStart) {
  // 3 m at 0.5 m/s, then 1.5 m/s.
  const auto x = [](double t) { return t < 6.0 ? 0.5 * t : 3.0 + 1.5 * (t - 6.0); };
  EXPECT_NEAR(runSpeed(running(10.0, x), 3.0, 3.0), 1.5, 0.01);
  EXPECT_EQ(runSpeed(running(8.9, x), 3.0, 3.0), 0.0);  // not yet 3 s
}

TEST(BallTrack, StopTakesUntilTheLastMotion) {
  // Ordered at 2 s, moves on at 1 m/s until 2.6 s, stands, and slips once more at 2.8 s.
  const auto x = [](double t) { return std::min(t, 2.6) + (t > 2.8 ? 0.05 : 0.0); };
  EXPECT_NEAR(stopTime(running(5.0, x), 2.0, 0.08), 0.9, 0.03);  // the slip is seen over a tenth of a second
  const auto quiet = [](double t) { return std::min(t, 2.6); };
  EXPECT_NEAR(stopTime(running(5.0, quiet), 2.0, 0.08), 0.7, 0.03);
}

}  // namespace
}  // namespace nonet::lab
