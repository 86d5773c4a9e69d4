#include "nonet/team/formation.h"

#include <gtest/gtest.h>

#include "nonet/math/random.h"

namespace nonet::team {
namespace {

TEST(Formation, StaysInsideTheFieldWhereverTheBallIs) {
  Random random(3);
  const FormationParameters parameters;
  for (int trial = 0; trial < 1000; ++trial) {
    world::FieldGeometry field;
    if (trial % 2 == 1) {
      field.length = 21.0;
      field.width = 14.0;
    }
    const Vector2 ball(random.uniform(-0.5, 0.5) * field.length, random.uniform(-0.5, 0.5) * field.width);
    const Formation formation = formationFor(ball, kMaxAssigned, field, parameters);
    ASSERT_EQ(formation.count, kMaxAssigned);
    for (int i = 0; i < formation.count; ++i) {
      EXPECT_LE(std::abs(formation.positions[i].x()), 0.5 * field.length);
      EXPECT_LE(std::abs(formation.positions[i].y()), 0.5 * field.width);
    }
  }
}

TEST(Formation, BacksStandBetweenTheirGoalAndTheBall) {
  const world::FieldGeometry field;
  const FormationParameters parameters;
  const Vector2 goal(-15.0, 0.0);
  for (double x = -14.0; x <= 14.0; x += 1.0) {
    for (double y = -9.0; y <= 9.0; y += 1.5) {
      const Vector2 ball(x, y);
      const Formation formation = formationFor(ball, 8, field, parameters);
      for (const Role back : {Role::BackLeft, Role::BackRight}) {
        const Vector2 place = formation.positions[static_cast<int>(back)];
        const Vector2 along = (ball - goal).normalized();
        // With the ball in the own penalty area a third field player there would be sent out again.
        if (back == Role::BackRight && x < -13.2 && std::abs(y) < 3.0) continue;
        EXPECT_LT((place - goal).dot(along), (ball - goal).norm());
      }
    }
  }
}

// Illegal defence (server facts 4.10): goalie, the one on the ball and one back are the three that may be
// there.
TEST(Formation, KeepsTheOtherPlayersOutOfTheOwnPenaltyArea) {
  const world::FieldGeometry field;
  for (double x = -14.5; x <= -5.0; x += 0.5) {
    for (double y = -9.0; y <= 9.0; y += 0.5) {
      const Formation formation = formationFor({x, y}, kMaxAssigned, field, {});
      for (int i = 1; i < formation.count; ++i) {
        if (static_cast<Role>(i) == Role::BackLeft) continue;
        const Vector2 place = formation.positions[i];
        EXPECT_FALSE(place.x() < -13.2 && std::abs(place.y()) < 3.0)
            << i << " for a ball at " << x << " " << y;
      }
    }
  }
}

TEST(Formation, LeavesRoomBetweenThePlacesAlsoNearLinesAndGoals) {
  const world::FieldGeometry field;
  for (double x = -14.5; x <= 14.5; x += 0.5) {
    for (double y = -9.5; y <= 9.5; y += 0.5) {
      // Nine and eleven players with the goalie.
      for (const int count : {8, kMaxAssigned}) {
        const Formation formation = formationFor({x, y}, count, field, {});
        for (int i = 0; i < formation.count; ++i)
          for (int j = 0; j < i; ++j)
            EXPECT_GT((formation.positions[i] - formation.positions[j]).norm(), 0.7)
                << i << " and " << j << " of " << count << " for a ball at " << x << " " << y;
      }
    }
  }
}

TEST(KickOffPose, IsInTheOwnHalfAndOutsideTheCircleForTheOtherSide) {
  for (const double length : {30.0, 21.0}) {
    world::FieldGeometry field;
    field.length = length;
    field.width = length * 2.0 / 3.0;
    for (int unum = 1; unum <= world::kTeamSize; ++unum) {
      const Pose2 own = kickOffPose(unum, true, field, {});
      const Pose2 other = kickOffPose(unum, false, field, {});
      EXPECT_LT(own.translation.x(), 0.0) << unum;
      EXPECT_GT(own.translation.x(), -0.5 * length);
      EXPECT_LT(std::abs(other.translation.y()), 0.5 * field.width);
      // Robots are moved away if their outline meets the circle: 0.3 m of margin.
      EXPECT_GT(other.translation.norm(), field.circleRadius + 0.3) << unum;
    }
  }
}

TEST(KickOffPose, KeepsPlayersApart) {
  const world::FieldGeometry field;
  for (const bool own : {true, false})
    for (int a = 1; a <= world::kTeamSize; ++a)
      for (int b = a + 1; b <= world::kTeamSize; ++b)
        EXPECT_GT(
            (kickOffPose(a, own, field, {}).translation - kickOffPose(b, own, field, {}).translation).norm(),
            0.7)
            << a << " and " << b;
}

}  // namespace
}  // namespace nonet::team
