#include <cmath>

#include <gtest/gtest.h>

#include "nonet/math/angle.h"
#include "nonet/math/inline_string.h"
#include "nonet/math/pose2.h"
#include "nonet/math/random.h"
#include "nonet/math/rotation.h"
#include "nonet/math/straight_way.h"

namespace nonet {
namespace {

TEST(Angle, WrapsIntoOneTurn) {
  EXPECT_EQ(wrapAngle(0.0), 0.0);
  EXPECT_EQ(wrapAngle(kPi), kPi);
  EXPECT_EQ(wrapAngle(-kPi), kPi);
  Random random(1);
  for (int i = 0; i < 10000; ++i) {
    const double angle = random.uniform(-50.0, 50.0);
    const double wrapped = wrapAngle(angle);
    EXPECT_GT(wrapped, -kPi);
    EXPECT_LE(wrapped, kPi);
    EXPECT_NEAR(std::sin(wrapped), std::sin(angle), 1e-13);
    EXPECT_NEAR(std::cos(wrapped), std::cos(angle), 1e-13);
  }
  EXPECT_NEAR(angleDifference(-3.0, 3.0), 2.0 * kPi - 6.0, 1e-15);
  EXPECT_NEAR(toDegrees(toRadians(123.4)), 123.4, 1e-12);
  using namespace literals;
  EXPECT_EQ(90_deg, toRadians(90.0));
  EXPECT_EQ(0.5_deg, toRadians(0.5));
}

// Oracle: 3x3 matrices.
TEST(Pose2, ComposesLikeMatrices) {
  Random random(2);
  const auto matrix = [](const Pose2& pose) {
    Matrix3 m;
    m << std::cos(pose.rotation), -std::sin(pose.rotation), pose.translation.x(),  //
        std::sin(pose.rotation), std::cos(pose.rotation), pose.translation.y(),    //
        0.0, 0.0, 1.0;
    return m;
  };
  const auto any = [&] {
    return Pose2(random.uniform(-10, 10), random.uniform(-10, 10), random.uniform(-kPi, kPi));
  };
  for (int i = 0; i < 1000; ++i) {
    const Pose2 a = any();
    const Pose2 b = any();
    const Vector2 p(random.normal(), random.normal());
    EXPECT_LT((matrix(a * b) - matrix(a) * matrix(b)).norm(), 1e-12);
    EXPECT_LT((matrix(a.inverse()) - Matrix3(matrix(a).inverse())).norm(), 1e-12);
    EXPECT_LT((a * p - (matrix(a) * Vector3(p.x(), p.y(), 1.0)).head<2>()).norm(), 1e-12);
    EXPECT_LT((a.rotate(p) - (matrix(a) * Vector3(p.x(), p.y(), 0.0)).head<2>()).norm(), 1e-12);
    const Pose2 none = a * a.inverse();
    EXPECT_LT(none.translation.norm(), 1e-13);
    EXPECT_NEAR(none.rotation, 0.0, 1e-15);
  }
}

TEST(InlineString, KeepsWhatFits) {
  InlineString<4> text("abc");
  EXPECT_EQ(text, "abc");
  EXPECT_FALSE(text.assign("abcde"));
  EXPECT_EQ(text.view(), "abcd");
  EXPECT_TRUE(text.assign(""));
  EXPECT_TRUE(text.empty());
  EXPECT_FALSE(text == InlineString<4>("a"));
}

Vector3 anyVector(Random& random, double most) {
  Vector3 v;
  for (double& x : v) x = random.uniform(-most, most);
  return v;
}

// Against the exponential's own series.
TEST(Rotation, IsTheSumOfTheExponentialSeries) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const Vector3 rotation = i == 0 ? Vector3(1e-13, 0.0, 0.0) : anyVector(random, 1.5);
    Matrix3 sum = Matrix3::Identity();
    Matrix3 term = Matrix3::Identity();
    for (int n = 1; n < 40; ++n) {
      term = Matrix3(term * skew(rotation) / n);
      sum += term;
    }
    EXPECT_LT((exponential(rotation) - sum).norm(), 1e-12) << rotation.transpose();
    EXPECT_LT((logarithm(exponential(rotation)) - rotation).norm(), 1e-7) << rotation.transpose();
    EXPECT_LT((skew(rotation) * sum.col(1) - rotation.cross(Vector3(sum.col(1)))).norm(), 1e-15);
  }
}

TEST(Rotation, TheHeadingOfATurnAboutZIsItsAngle) {
  for (double angle = -3.0; angle <= 3.0; angle += 0.1) {
    EXPECT_NEAR(yawOf(turnAboutZ(angle)), angle, 1e-12);
    EXPECT_LT((turnAboutZ(angle) - exponential(Vector3(0.0, 0.0, angle))).norm(), 1e-12);
  }
}

// Against every point of the way in steps of a millimetre.
TEST(StraightWay, TheNearestIsTheNearestOfAllItsPoints) {
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    const Vector2 from = anyVector(random, 3.0).head<2>();
    const Vector2 to = i == 0 ? from : Vector2(anyVector(random, 3.0).head<2>());
    const Vector2 point = anyVector(random, 5.0).head<2>();
    const StraightWay way(from, to);
    EXPECT_NEAR(way.length(), (to - from).norm(), 1e-8);
    double nearest = (point - to).norm();
    double at = way.length();
    for (double passed = 0.0; passed < way.length(); passed += 0.001) {
      const double distance = (from + passed / way.length() * (to - from) - point).norm();
      if (distance < nearest) {
        nearest = distance;
        at = passed;
      }
    }
    EXPECT_NEAR(way.distanceTo(point), nearest, 1e-3);
    EXPECT_NEAR(way.nearestTo(point), at, 2e-3);
    if (i == 0) continue;
    const auto [ahead, aside] = way.placeOf(point);
    const Vector2 along = (to - from).normalized();
    EXPECT_LT((from + ahead * along + aside * Vector2(-along.y(), along.x()) - point).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace nonet
