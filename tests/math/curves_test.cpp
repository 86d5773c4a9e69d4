#include <cmath>

#include <gtest/gtest.h>

#include "nonet/math/hermite_spline.h"
#include "nonet/math/random.h"
#include "nonet/math/types.h"

namespace nonet {
namespace {

// Oracle: a cubic is given by its ends' values and slopes, so the segment must be that cubic.
TEST(HermiteSegment, IsTheCubicWithTheSameEnds) {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const double c[4] = {random.normal(), random.normal(), random.normal(), random.normal()};
    const double duration = random.uniform(0.1, 3.0);
    const auto cubic = [&](double t) { return c[0] + t * (c[1] + t * (c[2] + t * c[3])); };
    const auto slope = [&](double t) { return c[1] + t * (2.0 * c[2] + 3.0 * t * c[3]); };
    const HermiteSegment<double> segment{cubic(0.0), cubic(duration), slope(0.0), slope(duration), duration};
    for (int i = 0; i <= 10; ++i) {
      const double t = duration * i / 10.0;
      EXPECT_NEAR(segment.at(t), cubic(t), 1e-12);
      EXPECT_NEAR(segment.velocityAt(t), slope(t), 1e-12);
      EXPECT_NEAR(segment.accelerationAt(t), 2.0 * c[2] + 6.0 * c[3] * t, 1e-9);
    }
  }
}

TEST(HermiteSpline, PassesItsKnotsAndItsDerivativesAgree) {
  Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    HermiteSpline<Vector3, 6> spline;
    double times[6];
    Vector3 positions[6];
    double time = random.normal();
    for (int i = 0; i < 6; ++i) {
      times[i] = time;
      positions[i] = Vector3(random.normal(), random.normal(), random.normal());
      ASSERT_TRUE(spline.add(time, positions[i], Vector3(random.normal(), random.normal(), random.normal())));
      time += random.uniform(0.1, 1.0);
    }
    if (trial % 2 == 0) spline.smoothInnerKnots();
    const double step = 1e-6;
    for (int i = 0; i < 6; ++i) {
      EXPECT_LT((spline.at(times[i]) - positions[i]).norm(), 1e-12);
      if (i == 0 || i == 5) continue;
      // C1: the slope is the same from both sides.
      const double near = 1e-7;
      const Vector3 before = (spline.at(times[i]) - spline.at(times[i] - near)) / near;
      const Vector3 after = (spline.at(times[i] + near) - spline.at(times[i])) / near;
      EXPECT_LT((before - after).norm(), 1e-3);
    }
    for (int i = 0; i < 40; ++i) {
      const double t = random.uniform(times[0] + step, times[5] - step);
      const Vector3 difference = (spline.at(t + step) - spline.at(t - step)) / (2.0 * step);
      EXPECT_LT((difference - spline.velocityAt(t)).norm(), 1e-5);
    }
    EXPECT_EQ(spline.at(times[0] - 1.0), positions[0]);
    EXPECT_EQ(spline.at(times[5] + 1.0), positions[5]);
  }
}

TEST(HermiteSpline, SmoothKnotsReproduceAParabola) {
  const auto parabola = [](double t) { return 1.0 - 2.0 * t + 3.0 * t * t; };
  const auto slope = [](double t) { return -2.0 + 6.0 * t; };
  HermiteSpline<double, 5> spline;
  for (const double t : {0.0, 0.3, 0.5, 1.4, 2.0}) {
    ASSERT_TRUE(spline.add(t, parabola(t), t == 0.0 || t == 2.0 ? slope(t) : 99.0));
  }
  spline.smoothInnerKnots();
  for (int i = 0; i <= 100; ++i) EXPECT_NEAR(spline.at(0.02 * i), parabola(0.02 * i), 1e-12);
}

TEST(HermiteSpline, RefusesWrongTimesAndTooManyKnots) {
  HermiteSpline<double, 2> spline;
  EXPECT_TRUE(spline.add(0.0, 1.0, 0.0));
  EXPECT_EQ(spline.at(5.0), 1.0);
  EXPECT_FALSE(spline.add(0.0, 2.0, 0.0));
  EXPECT_TRUE(spline.add(1.0, 2.0, 0.0));
  EXPECT_FALSE(spline.add(2.0, 3.0, 0.0));
  EXPECT_EQ(spline.size(), 2U);
  spline.clear();
  EXPECT_TRUE(spline.add(-1.0, 4.0, 0.0));
  EXPECT_EQ(spline.at(0.0), 4.0);
}

}  // namespace
}  // namespace nonet
