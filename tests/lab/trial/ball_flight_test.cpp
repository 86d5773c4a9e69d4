// Oracle: parabolas in closed form, cycle by cycle.
#include "lab/trial/ball_flight.h"

#include <gtest/gtest.h>

#include "nonet/math/types.h"
#include "nonet/world/ball_law.h"

namespace nonet::lab {
namespace {

constexpr double kG = 9.81;
constexpr double kCycle = 0.02;

world::BallMotion thrown(double ahead, double up, double time) {
  return {{2.0 + ahead * time, -1.0, world::kBallRestHeight + up * time - 0.5 * kG * time * time},
          {ahead, 0.0, up - kG * time}};
}

Kick flightUntil(double ahead, double up, double end) {
  BallFlight flight(Vector2(2.0, -1.0));
  for (double time = 0.0; time < end; time += kCycle) flight.note(thrown(ahead, up, time));
  Kick kick;
  flight.tell(kick);
  return kick;
}

TEST(BallFlight, TellsHeightAMetreOnAndWhereItLands) {
  for (const double ahead : {2.5, 4.0, 6.0}) {
    const double up = 4.0;
    const double lasts = 2.0 * up / kG;
    const Kick kick = flightUntil(ahead, up, lasts);
    // Noted in the first cycle beyond a metre.
    const double time = 1.0 / ahead;
    const double expected = thrown(ahead, up, time).p_FB.z();
    EXPECT_NEAR(kick.height, expected, kCycle * (up + kG * lasts / 2.0)) << ahead;
    EXPECT_NEAR(kick.landing, ahead * lasts, 1.5 * kCycle * ahead) << ahead;
    EXPECT_NEAR(kick.highest, world::kBallRestHeight + up * up / (2.0 * kG), 0.01) << ahead;
    // In the middle of its flight it is known where it will land.
    EXPECT_NEAR(flightUntil(ahead, up, 0.6 * lasts).landing, ahead * lasts, 1.5 * kCycle * ahead) << ahead;
  }
}

TEST(BallFlight, ARollingBallDoesNotLand) {
  BallFlight flight(Vector2::Zero());
  for (int i = 0; i < 100; ++i) flight.note({{0.03 * i, 0.0, world::kBallRestHeight}, {1.5, 0.0, 0.0}});
  Kick kick;
  flight.tell(kick);
  EXPECT_EQ(kick.landing, 0.0);
  EXPECT_NEAR(kick.height, world::kBallRestHeight, 1e-12);
}

TEST(Chips, AreHighEnoughAndDownSoonEnough) {
  motion::KickHead head;
  head.clears = 0.7;
  head.lands = 4.0;
  Kick kick;
  kick.height = 0.71;
  kick.landing = 3.9;
  EXPECT_TRUE(kick.clears(head));
  kick.landing = 4.1;
  EXPECT_FALSE(kick.clears(head));
  kick.landing = 3.9;
  kick.height = 0.69;
  EXPECT_FALSE(kick.clears(head));
}

}  // namespace
}  // namespace nonet::lab
