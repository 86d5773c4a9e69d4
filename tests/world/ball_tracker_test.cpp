// The ball's law and its filter against recorded rolls, drops and kicks of the real server.
#include "nonet/world/ball_tracker.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "nonet/world/ball_law.h"

#include "recording.h"
#include "vision_simulator.h"

namespace nonet::world {
namespace {

/// Positions of the ball, one per cycle.
using Trace = std::vector<Vector3>;

const Trace& trace(const std::string& name) {
  static const std::map<std::string, Trace> traces = [] {
    std::map<std::string, Trace> result;
    protocol::LogReader reader(test::dataPath("ball.txt.gz"));
    protocol::LogLine line;
    while (reader.next(line)) {
      if (line.kind == protocol::LogLine::Kind::Comment) continue;
      std::istringstream text{std::string(line.text)};
      std::string scenario;
      double time = 0.0;
      Vector3 p;
      text >> scenario >> time >> p.x() >> p.y() >> p.z();
      Trace& ball = result[scenario];
      // The rolls begin with the recording: let the ball lie for a while before.
      if (ball.empty()) ball.assign(40, p);
      ball.push_back(p);
    }
    return result;
  }();
  return traces.at(name);
}

BallMotion motionAt(const Trace& ball, std::size_t i) {
  return {ball[i], (ball[i] - ball[i - 1]) / kCycleTime};
}

/// First index at which the ball moves on its own (not put there by the trainer).
std::size_t firstMove(const Trace& ball) {
  for (std::size_t i = 2; i < ball.size(); ++i) {
    const double step = (ball[i] - ball[i - 1]).norm();
    const double before = (ball[i - 1] - ball[i - 2]).norm();
    if (step > 0.002 && step < 0.2 && before < 0.2) return i;
  }
  return ball.size();
}

TEST(BallLaw, RollsLikeTheRecordedBall) {
  for (const char* name : {"ball_roll_1", "ball_roll_4", "ball_roll_6"}) {
    const Trace& ball = trace(name);
    const std::size_t start = firstMove(ball) + 8;  // it slides for five cycles before it rolls
    BallMotion motion = motionAt(ball, start);
    const double speed = motion.v_FB.norm();
    EXPECT_LT((restPlace(motion) - ball.back().head<2>()).norm(), 0.02 * speed + 0.005) << name;
    for (std::size_t i = start + 1; i < std::min(start + 150, ball.size()); ++i) {
      stepBall(motion, kCycleTime);
      ASSERT_LT((motion.p_FB - ball[i]).head<2>().norm(), 0.02 * speed + 0.005) << name << " " << i;
    }
  }
}

TEST(BallLaw, FliesAndBouncesLikeTheRecordedBall) {
  const Trace& ball = trace("ball_drop");
  const std::size_t start = firstMove(ball) + 1;
  BallMotion motion = motionAt(ball, start);
  double highest = 0.0;
  double recorded = 0.0;
  bool bounced = false;
  bool recordBounced = false;
  for (std::size_t i = start + 1; i < start + 50; ++i) {
    stepBall(motion, kCycleTime);
    bounced |= motion.v_FB.z() > 0.0;
    recordBounced |= ball[i].z() > ball[i - 1].z();
    if (!bounced && !recordBounced) {
      EXPECT_LT(std::abs(motion.p_FB.z() - ball[i].z()), 0.01);
    }
    if (bounced) highest = std::max(highest, motion.p_FB.z());
    if (recordBounced) recorded = std::max(recorded, ball[i].z());
  }
  EXPECT_NEAR(highest, recorded, 0.08);
}

TEST(BallLaw, PredictsWhereAKickEnds) {
  const Trace& ball = trace("kick");
  const std::size_t start = firstMove(ball) + 4;
  const Vector2 rest = restPlace(motionAt(ball, start));
  const Vector2 end = restPlace(motionAt(ball, ball.size() - 1));
  EXPECT_LT((rest - end).norm(), 0.35);
}

TEST(BallLaw, CrossingAgreesWithStepping) {
  Random random(5);
  int crossed = 0;
  for (int i = 0; i < 600; ++i) {
    BallMotion motion{
        {random.uniform(-14, 0), random.uniform(-5, 5), kBallRestHeight},
        {random.uniform(-8, 8), random.uniform(-3, 3), random.below(2) == 0 ? 0.0 : random.uniform(0, 4)}};
    const auto crossing = crossingOfLine(motion, -15.0);
    // Oracle: small steps until the line or until rest.
    BallMotion stepped = motion;
    double time = 0.0;
    while (stepped.p_FB.x() > -15.0 && stepped.v_FB.norm() > 1e-3) {
      stepBall(stepped, kCycleTime);
      time += kCycleTime;
    }
    const bool expected = stepped.p_FB.x() <= -15.0;
    if (!expected && restPlace(motion).x() < -14.99) continue;  // stops on the line
    ASSERT_EQ(crossing.has_value(), expected) << i;
    if (!crossing) continue;
    ++crossed;
    EXPECT_NEAR(crossing->time, time, kCycleTime + 1e-6);
    EXPECT_NEAR(crossing->y, stepped.p_FB.y(), 0.07);
  }
  EXPECT_GT(crossed, 50);
}

/// Follows a recorded ball as seen by a robot that knows its own pose. Calls `check` after each cycle.
/// `away`: from the eyes to the ball at the begin, in units of 2.9 m.
template <typename Check>
void follow(const Trace& ball, std::size_t first, std::uint64_t seed, const Check& check, double away = 1.0) {
  test::VisionSimulator eyes(seed, {});
  SelfState self;
  self.X_FC.translation() = ball[first] + Vector3(-2.5 * away, -1.5 * away, 0.5);
  self.X_FC.linear() = Eigen::AngleAxisd(0.5, Vector3::UnitZ()).toRotationMatrix();
  self.cameraCovariance = Vector3(1e-5, 1e-5, 1e-6).asDiagonal();
  self.X_FR = Pose2(self.X_FC.translation().x(), self.X_FC.translation().y(), 0.5);
  BallTracker tracker;
  BallState state;
  for (std::size_t i = first; i < ball.size(); ++i) {
    const double time = static_cast<double>(i) * kCycleTime;
    tracker.predict(kCycleTime);
    if (i % 3 == 0) {
      protocol::Vision vision;
      vision.ball = eyes.point(self.X_FC, ball[i]);
      tracker.see(vision, self, eyes.offset, time);
    }
    tracker.fill(state, self, time);
    check(i, state);
  }
}

TEST(BallTracker, FollowsRollsWithinCentimetres) {
  for (const char* name : {"ball_roll_1", "ball_roll_4", "kick"}) {
    const Trace& ball = trace(name);
    const std::size_t start = firstMove(ball);
    std::vector<double> errors;
    follow(ball, start - 30, 3, [&](std::size_t i, const BallState& state) {
      if (i < start || i > start + 100) return;
      errors.push_back((state.p_FB - ball[i]).head<2>().norm());
    });
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[errors.size() / 2], 0.05) << name;
    EXPECT_LT(errors[errors.size() * 95 / 100], 0.12) << name;
  }
}

TEST(BallTracker, PredictsTheRestAfterAThirdOfASecond) {
  const Trace& ball = trace("ball_roll_4");
  const std::size_t start = firstMove(ball);
  int good = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Vector2 rest = Vector2::Zero();
    follow(ball, start - 30, seed, [&](std::size_t i, const BallState& state) {
      if (i == start + 15) rest = restPlace({state.p_FB, state.v_FB});
    });
    good += (rest - ball.back().head<2>()).norm() < 0.5 ? 1 : 0;
  }
  EXPECT_GE(good, 38);
}

// Noise must not lift it: a flying ball goes elsewhere.
TEST(BallTracker, ARollingBallIsHardlyEverBelievedToFly) {
  for (const double away : {0.5, 1.0, 2.0, 3.0}) {
    for (const char* name : {"ball_roll_4", "ball_roll_6"}) {
      const Trace& ball = trace(name);
      const std::size_t start = firstMove(ball);
      int flies = 0;
      int count = 0;
      for (std::uint64_t seed = 0; seed < 30; ++seed) {
        follow(
            ball, start - 30, seed,
            [&](std::size_t i, const BallState& state) {
              if (i > start + 100) return;
              flies += isFlying({state.p_FB, state.v_FB}) ? 1 : 0;
              ++count;
            },
            away);
      }
      EXPECT_LE(flies, count / 50) << name << " from " << 2.9 * away << " m, of " << count;
    }
  }
}

TEST(BallTracker, NoticesTheKick) {
  const Trace& ball = trace("kick");
  const std::size_t start = firstMove(ball);
  double noticed = kNever;
  follow(ball, start - 30, 4, [&](std::size_t i, const BallState& state) {
    if (i < start - 1) {
      EXPECT_LT(state.v_FB.head<2>().norm(), 0.3);
    }
    if (i == start + 12) noticed = state.lastKick;
  });
  EXPECT_NEAR(noticed, static_cast<double>(start) * kCycleTime, 0.15);
}

TEST(BallTracker, SpeaksOfItsErrorHonestly) {
  const Trace& ball = trace("ball_roll_4");
  const std::size_t start = firstMove(ball) + 20;
  int inside = 0;
  int count = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    follow(ball, start, seed, [&](std::size_t i, const BallState& state) {
      if (i < start + 10 || i > start + 120) return;
      const Vector2 error = (state.p_FB - ball[i]).head<2>();
      inside += error.dot(state.covariance.inverse() * error) < 5.991 ? 1 : 0;
      ++count;
    });
  }
  EXPECT_GE(inside, count * 88 / 100);
}

TEST(BallTracker, ForgetsWhatShouldBeInSightAndIsNot) {
  SelfState self;
  self.localized = true;
  self.X_FC.translation() = Vector3(0, 0, 0.5);
  self.cameraCovariance = Vector3(1e-4, 1e-4, 1e-5).asDiagonal();
  BallTracker tracker;
  BallState state;
  protocol::Vision vision;
  test::VisionSimulator eyes(1, {});
  vision.ball = eyes.point(self.X_FC, Vector3(3, 0, 0.04));
  double time = 1.0;
  tracker.see(vision, self, eyes.offset, time);
  tracker.fill(state, self, time);
  EXPECT_TRUE(state.known);
  vision.ball.reset();
  for (int i = 0; i < 4; ++i) {
    time += 0.06;
    tracker.predict(0.06);
    tracker.see(vision, self, eyes.offset, time);
  }
  tracker.fill(state, self, time);
  EXPECT_FALSE(state.known);
}

// A mate tells of a ball at 1 s, where one looks then and sees none, in so many messages.
BallTracker toldButNotSeen(const SelfState& self, int messages) {
  BallTracker tracker;
  tracker.hear({Vector2(3, 0), Vector2(0, 0), 1.0, 1.0, 0.2}, 1.0);
  for (int i = 1; i <= messages; ++i) {
    tracker.predict(0.06);
    tracker.see({}, self, Vector3::Zero(), 1.0 + 0.06 * i);
  }
  return tracker;
}

// A mate tells of it, it is not there, and the mate tells the same again.
TEST(BallTracker, WhatWasMissedIsNotThereThoughItIsToldAgain) {
  SelfState self;
  self.localized = true;
  self.X_FC.translation() = Vector3(0, 0, 0.5);
  BallState state;
  BallTracker tracker = toldButNotSeen(self, 5);
  const auto isKnownAfter = [&](double seenAt) {
    tracker.hear({Vector2(3, 0), Vector2(0, 0), seenAt, 1.4, 0.2}, 1.4);
    tracker.fill(state, self, 1.4);
    return state.known;
  };
  EXPECT_FALSE(isKnownAfter(1.0));
  EXPECT_TRUE(isKnownAfter(1.4));
}

TEST(BallTracker, WhoDoesNotKnowWhereItStandsMissesNothing) {
  SelfState self;
  self.X_FC.translation() = Vector3(0, 0, 0.5);
  BallState state;
  BallTracker tracker = toldButNotSeen(self, 9);
  tracker.fill(state, self, 1.6);
  EXPECT_TRUE(state.known);
}

// From afar a soft push shows after several sightings only: that it came at the last one would make it fast.
TEST(BallTracker, ASoftPushIsNotBelievedToBeAKick) {
  const Trace& ball = trace("ball_roll_1");
  const std::size_t start = firstMove(ball);
  const double speed = motionAt(ball, start + 2).v_FB.norm();
  for (const double away : {1.7, 3.4}) {
    std::vector<double> most;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      double fastest = 0.0;
      follow(
          ball, start - 30, seed,
          [&](std::size_t i, const BallState& state) {
            if (i >= start && i < start + 60) fastest = std::max(fastest, state.v_FB.head<2>().norm());
          },
          away);
      most.push_back(fastest);
    }
    std::sort(most.begin(), most.end());
    EXPECT_LT(most[20], 1.6 * speed) << "from " << 2.9 * away << " m";
  }
}

// What noise takes for a bounce takes no speed.
TEST(BallTracker, NoiseOfTheHeightDoesNotBrakeARollingBall) {
  const Trace& ball = trace("ball_roll_6");
  const std::size_t start = firstMove(ball);
  double sum = 0.0;
  constexpr int kSeeds = 60;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    follow(
        ball, start - 30, seed,
        [&](std::size_t i, const BallState& state) {
          if (i != start + 12) return;
          sum += std::pow(state.v_FB.head<2>().norm() - motionAt(ball, i).v_FB.head<2>().norm(), 2);
        },
        3.0);
  }
  EXPECT_LT(std::sqrt(sum / kSeeds), 0.12);
}

// Oracle: the law of the ball itself, stepped from the kick on.
TEST(BallTracker, AToldFlightEndsWhereTheBallLands) {
  for (const double age : {0.0, 0.2, 0.5, 1.0}) {
    BallMotion ball{{-2.0, 1.0, kBallRestHeight}, {7.0, 2.0, 4.0}};
    const double landsIn = landingTime(ball);
    BallTracker tracker;
    tracker.hear({ball.p_FB.head<2>(), ball.v_FB.head<2>(), 10.0 - age, 10.0 - age, 0.1, landsIn}, 10.0);
    double flown = 0.0;
    for (; flown < age - 1e-9; flown += kCycleTime) stepBall(ball, kCycleTime);
    BallState told;
    tracker.fill(told, {}, 10.0);
    EXPECT_LT((told.p_FB - ball.p_FB).head<2>().norm(), 0.25) << age;
    EXPECT_NEAR(told.v_FB.z(), ball.v_FB.z(), 0.3) << age;
    // Half a second on, by the tracker and by the law.
    for (int i = 0; i < 25; ++i) {
      tracker.predict(kCycleTime);
      stepBall(ball, kCycleTime);
    }
    tracker.fill(told, {}, 10.5);
    EXPECT_LT((told.p_FB - ball.p_FB).head<2>().norm(), 0.35) << age;
  }
}

TEST(BallLaw, LandsWhenSteppingSays) {
  for (const double lift : {0.0, 1.0, 3.0, 5.0, -2.0}) {
    for (const double height : {kBallRestHeight, 0.5, 1.5}) {
      BallMotion ball{{0.0, 0.0, height}, {6.0, 0.0, lift}};
      const double expected = landingTime(ball);
      if (!isFlying(ball) || expected < 0.01) continue;
      double time = 0.0;
      while (ball.v_FB.z() > 0.0 || ball.p_FB.z() > kBallRestHeight + 1e-9) {
        stepBall(ball, 0.001);
        time += 0.001;
        if (ball.p_FB.z() == kBallRestHeight) break;  // put there by the bounce
      }
      EXPECT_NEAR(time, expected, 0.06 * expected + 0.002) << lift << " " << height;
    }
  }
  EXPECT_EQ(landingTime({{0.0, 0.0, kBallRestHeight}, {9.0, 0.0, 0.0}}), 0.0);
}

// Oracle: the law stepped cycle by cycle, for rolls and for flights that bounce.
TEST(BallLaw, AFreeBallGoesWhereSteppingSays) {
  for (const double lift : {0.0, 1.0, 3.0, 6.0, -2.0}) {
    for (const double height : {kBallRestHeight, 1.0}) {
      BallMotion ball{{1.0, -2.0, height}, {-4.0, 3.0, lift}};
      const FreeBall free(ball);
      const Vector2 begin = ball.p_FB.head<2>();
      double rolls = 0.0;
      double slow = 0.0;
      for (int i = 1; i <= 400; ++i) {
        const double before = (ball.p_FB.head<2>() - begin).norm();
        stepBall(ball, kCycleTime);
        const double time = i * kCycleTime;
        // In the air the law steps as the server does, whose drag differs from the closed form by 0.4 %.
        EXPECT_LT((free.at(time) - ball.p_FB.head<2>()).norm(), 0.01 + 0.004 * before) << lift << " " << time;
        if (isFlying(ball)) rolls = time;
        if (ball.v_FB.head<2>().norm() > 0.3) slow = time;
        const double gone = (ball.p_FB.head<2>() - begin).norm();
        if (gone > before + 0.01) {
          EXPECT_NEAR(free.goneAfter(0.5 * (before + gone)), time - 0.5 * kCycleTime, kCycleTime + 0.01);
        }
      }
      EXPECT_NEAR(free.rollsAfter(), rolls, kCycleTime + 1e-9) << lift << " " << height;
      EXPECT_NEAR(free.slowAfter(0.3), slow, 2.0 * kCycleTime) << lift << " " << height;
      EXPECT_LT((free.at(60.0) - restPlace(ball)).norm(), 0.03);
      EXPECT_TRUE(std::isinf(free.goneAfter(30.0)));
    }
  }
  const FreeBall still({{1.0, 2.0, kBallRestHeight}, Vector3::Zero()});
  EXPECT_EQ(still.at(3.0), Vector2(1.0, 2.0));
  EXPECT_EQ(still.slowAfter(0.3), 0.0);
  EXPECT_TRUE(std::isinf(still.goneAfter(0.1)));
}

TEST(BallTracker, UsesTeamMatesByAge) {
  SelfState self;
  BallTracker tracker;
  BallState state;
  tracker.hear({Vector2(4, 2), Vector2(0, 0), 9.5, 9.5, 0.2}, 10.0);
  tracker.fill(state, self, 10.0);
  EXPECT_TRUE(state.known);
  EXPECT_LT((state.p_FB.head<2>() - Vector2(4, 2)).norm(), 1e-6);
  // An older report does not move a newer one.
  tracker.hear({Vector2(-8, 2), Vector2(0, 0), 9.0, 9.0, 0.2}, 10.0);
  tracker.fill(state, self, 10.0);
  EXPECT_LT((state.p_FB.head<2>() - Vector2(4, 2)).norm(), 1e-6);
  // A rolling ball has moved on since.
  tracker.hear({Vector2(0, 0), Vector2(2, 0), 11.0, 11.0, 0.1}, 12.0);
  tracker.fill(state, self, 12.0);
  EXPECT_NEAR(state.p_FB.x(), 2.0 / kRollDecay * (1.0 - std::exp(-kRollDecay)), 0.05);
}

}  // namespace
}  // namespace nonet::world
