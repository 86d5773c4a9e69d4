#include <gtest/gtest.h>

#include "nonet/math/random.h"
#include "nonet/world/world_state.h"

namespace nonet::world {
namespace {

// Against the nearest of many sampled places of the field.
TEST(FieldGeometry, TheNearestPlaceInsideIsTheNearestOfAll) {
  Random random(4);
  FieldGeometry field;
  field.length = 20.0;
  field.width = 12.0;
  for (int trial = 0; trial < 50; ++trial) {
    const double margin = random.uniform(0.0, 1.0);
    const Vector2 place(random.uniform(-15.0, 15.0), random.uniform(-10.0, 10.0));
    const Vector2 inside = field.nearestInside(place, margin);
    EXPECT_TRUE(field.holds(inside, margin - 1e-9));
    EXPECT_EQ(field.holds(place, margin), inside == place);
    for (int i = 0; i < 500; ++i) {
      const Vector2 other(random.uniform(-10.0 + margin, 10.0 - margin),
                          random.uniform(-6.0 + margin, 6.0 - margin));
      EXPECT_GE((other - place).norm(), (inside - place).norm() - 1e-12);
    }
  }
}

TEST(FieldGeometry, TheGoalsAreOnTheGoalLines) {
  FieldGeometry field;
  field.length = 21.0;
  EXPECT_EQ(field.ownGoal(), Vector2(-10.5, 0.0));
  EXPECT_EQ(field.theirGoal(), Vector2(10.5, 0.0));
}

}  // namespace
}  // namespace nonet::world
