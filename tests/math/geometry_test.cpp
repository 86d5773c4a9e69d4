#include <cmath>

#include <gtest/gtest.h>

#include "nonet/math/angle.h"
#include "nonet/math/inline_string.h"
#include "nonet/math/pose2.h"
#include "nonet/math/random.h"

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

}  // namespace
}  // namespace nonet
