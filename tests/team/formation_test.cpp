#include "nonet/team/formation.h"

#include <algorithm>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "nonet/math/random.h"
#include "nonet/team/role_assignment.h"

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
    const Formation formation = formationFor(ball, kFieldRoles, field, parameters);
    ASSERT_EQ(formation.count, kFieldRoles);
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

TEST(Formation, TheFartherBackJoinsAnAttackWhileTheOtherStaysAtHome) {
  const world::FieldGeometry field;
  const FormationParameters parameters;
  const Vector2 goal(-15.0, 0.0);
  for (double x = -12.0; x <= 12.0; x += 0.5) {
    for (double y = -8.0; y <= 8.0; y += 2.0) {
      const Vector2 ball(x, y);
      const Formation formation = formationFor(ball, 8, field, parameters);
      const Vector2 nearer = formation.positions[static_cast<int>(Role::BackLeft)];
      const Vector2 farther = formation.positions[static_cast<int>(Role::BackRight)];
      EXPECT_LT((nearer - goal).norm(), 5.0);
      if ((ball - goal).norm() <= parameters.joinFrom) {
        EXPECT_LT((farther - goal).norm(), 8.0) << ball;
      } else {
        EXPECT_NEAR((farther - ball).norm(), parameters.joinBehind, 0.5) << ball;
        EXPECT_LT((farther - goal).norm(), (ball - goal).norm()) << ball;
      }
    }
  }
}

TEST(Formation, TheNearerBackComesForwardWhileNoOpponentIsBehindIt) {
  const world::FieldGeometry field;
  const FormationParameters parameters;
  const Vector2 goal = field.ownGoal();
  Random random(17);
  int compared = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Vector2 ball(random.uniform(-14.0, 14.0), random.uniform(-9.0, 9.0));
    std::vector<world::PlayerState> opponents(4);
    double foremost = 40.0;
    for (world::PlayerState& opponent : opponents) {
      opponent.X_FP.translation = {random.uniform(-14.0, 14.0), random.uniform(-9.0, 9.0)};
      opponent.known = random.uniform(0.0, 1.0) < 0.5;
      if (opponent.known) foremost = std::min(foremost, (opponent.X_FP.translation - goal).norm());
    }
    const Formation formation = formationFor(ball, 8, field, parameters, {}, opponents);
    const Vector2 place = formation.positions[static_cast<std::size_t>(Role::BackLeft)];
    const double home = std::min(parameters.firstBackFromGoal, 0.5 * (ball - goal).norm());
    double line = home;
    if (foremost < 40.0 && foremost - 3.0 > home) line = std::min(foremost - 3.0, (ball - goal).norm() - 5.0);
    line = std::max(line, home);
    const Vector2 along = (ball - goal).normalized();
    const Vector2 wanted = goal + line * along + parameters.backAside * Vector2(-along.y(), along.x());
    // Where places come together (near the ball, the lines and the own goal) it may give way.
    const Vector2 stopper = formation.positions[static_cast<std::size_t>(Role::Stopper)];
    if ((wanted - ball).norm() < 1.5 || (wanted - stopper).norm() < 1.5 || wanted.x() < -13.0) continue;
    ++compared;
    ASSERT_LT((place - wanted).norm(), 1e-9) << "ball " << ball.transpose();
  }
  EXPECT_GT(compared, 1000);
}

class Marking : public testing::Test {
 protected:
  Marking() { parameters.markWithin = 12.0; }

  void opponent(double x, double y) {
    world::PlayerState player;
    player.known = true;
    player.X_FP.translation = {x, y};
    opponents.push_back(player);
  }

  Vector2 place(Role role, const Vector2& ball) const {
    return formationFor(ball, 8, field, parameters, {}, opponents).positions[static_cast<std::size_t>(role)];
  }

  world::FieldGeometry field;
  FormationParameters parameters;
  std::vector<world::PlayerState> opponents;
};

TEST_F(Marking, TheWingsStandBetweenTheirGoalAndWhoIsNearestToIt) {
  const Vector2 ball(-6.0, 0.0);
  opponent(-8.0, 4.0);
  opponent(-9.0, -5.0);
  opponent(-5.0, 5.0);  // less dangerous
  opponent(-6.5, 0.3);  // at the ball
  opponent(2.0, 1.0);   // far
  const auto guards = [&](Role role, const Vector2& threat) {
    const Vector2 way = field.ownGoal() - threat;
    EXPECT_LT((place(role, ball) - (threat + 0.6 * way.normalized())).norm(), 1e-9);
  };
  guards(Role::WingLeft, {-8.0, 4.0});
  guards(Role::WingRight, {-9.0, -5.0});
  std::reverse(opponents.begin(), opponents.end());
  guards(Role::WingLeft, {-8.0, 4.0});
  guards(Role::WingRight, {-9.0, -5.0});
  opponents[4].known = false;  // that at (-8, 4)
  guards(Role::WingLeft, {-5.0, 5.0});
}

TEST_F(Marking, TheNearerWingGoesToTheOnlyOne) {
  const Vector2 ball(-6.0, 0.0);
  const Vector2 left = place(Role::WingLeft, ball);
  const Vector2 right = place(Role::WingRight, ball);
  opponent(-9.0, -3.0);
  EXPECT_EQ(place(Role::WingLeft, ball), left);
  EXPECT_NE(place(Role::WingRight, ball), right);
}

TEST_F(Marking, IsForTheOwnGoalOnly) {
  opponent(-9.0, -3.0);
  const FormationParameters marks = parameters;
  for (double x = -13.0; x <= 13.0; x += 0.5) {
    const Vector2 ball(x, 1.0);
    parameters = marks;
    const Vector2 marking = place(Role::WingRight, ball);
    parameters.markWithin = 0.0;
    const bool marked = marking != place(Role::WingRight, ball);
    EXPECT_EQ(marked, (ball - field.ownGoal()).norm() < marks.markWithin) << x;
  }
}

// Illegal defence (server facts 4.10): goalie, the one on the ball and one back are the three that may be
// there.
TEST(Formation, KeepsTheOtherPlayersOutOfTheOwnPenaltyArea) {
  const world::FieldGeometry field;
  for (double x = -14.5; x <= -5.0; x += 0.5) {
    for (double y = -9.0; y <= 9.0; y += 0.5) {
      const Formation formation = formationFor({x, y}, kFieldRoles, field, {});
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
      for (const int count : {8, kFieldRoles}) {
        const Formation formation = formationFor({x, y}, count, field, {});
        for (int i = 0; i < formation.count; ++i)
          for (int j = 0; j < i; ++j)
            EXPECT_GT((formation.positions[i] - formation.positions[j]).norm(), 0.7)
                << i << " and " << j << " of " << count << " for a ball at " << x << " " << y;
      }
    }
  }
}

std::vector<VariantParameters> formationVariants() {
  std::vector<VariantParameters> variants(3);
  variants[0].defense = true;
  variants[1].boxes = true;
  variants[2].wall = true;
  return variants;
}

TEST(FormationVariants, AreLegalAndLeaveRoomWhereverTheBallIs) {
  const world::FieldGeometry field;
  FormationParameters parameters;
  parameters.apart = 0.7;
  for (const VariantParameters& variant : formationVariants()) {
    for (double x = -14.5; x <= 14.5; x += 1.0) {
      for (double y = -9.5; y <= 9.5; y += 1.0) {
        const Formation formation = formationFor({x, y}, 8, field, parameters, variant);
        EXPECT_EQ(formation.positions[0], Vector2(x, y)) << "one is on the ball";
        int inOwnArea = 0;
        for (int i = 1; i < formation.count; ++i) {
          const Vector2 place = formation.positions[i];
          EXPECT_LE(std::abs(place.x()), 15.0);
          EXPECT_LE(std::abs(place.y()), 10.0);
          inOwnArea += place.x() < -13.2 && std::abs(place.y()) < 3.0 ? 1 : 0;
          for (int j = 1; j < i; ++j) EXPECT_GT((place - formation.positions[j]).norm(), 0.65);
        }
        EXPECT_LE(inOwnArea, 1) << "ball at " << x << " " << y;
      }
    }
  }
}

// What the names promise, with the ball in midfield where nothing has to give way.
TEST(FormationVariants, AreWhatTheirNamesSay) {
  const world::FieldGeometry field;
  const std::vector<VariantParameters> variants = formationVariants();
  FormationParameters parameters;
  parameters.apart = 0.7;
  const Vector2 ball(2.0, 3.0);
  const auto near = [](const Formation& formation, const Vector2& place, double reach) {
    return std::count_if(formation.positions.begin(), formation.positions.begin() + formation.count,
                         [&](const Vector2& p) { return (p - place).norm() < reach; });
  };
  const Formation defense = formationFor(ball, 8, field, parameters, variants[0]);
  EXPECT_EQ(near(defense, ball, 4.0), 2) << "on the ball and behind it";
  EXPECT_EQ(near(defense, {-15.0, 0.0}, 10.0), 6);

  const Formation wall = formationFor(ball, 8, field, parameters, variants[2]);
  EXPECT_EQ(near(wall, ball, 1.2), 3);
  for (int i = 1; i < wall.count; ++i) {
    const Vector2 way = ball - Vector2(-15.0, 0.0);
    const double along = (wall.positions[i] - Vector2(-15.0, 0.0)).dot(way) / way.squaredNorm();
    EXPECT_GT(along, 0.0);
    EXPECT_LT(along, 1.0) << "between ball and goal";
  }

  // The boxes stay where they are: a ball that moves by 1 m moves no place by more than half of that.
  const Formation boxes = formationFor(ball, 8, field, parameters, variants[1]);
  const Formation moved = formationFor(ball + Vector2(1.0, 0.0), 8, field, parameters, variants[1]);
  for (int i = 1; i < boxes.count; ++i) EXPECT_LE((boxes.positions[i] - moved.positions[i]).norm(), 0.51);
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
  for (const double length : {30.0, 21.0}) {
    world::FieldGeometry field;
    field.length = length;
    field.width = length * 2.0 / 3.0;
    const auto place = [&](int unum, bool own) { return kickOffPose(unum, own, field, {}).translation; };
    for (const bool own : {true, false})
      for (int a = 1; a <= world::kTeamSize; ++a)
        for (int b = a + 1; b <= world::kTeamSize; ++b)
          EXPECT_GT((place(a, own) - place(b, own)).norm(), 0.7) << a << " and " << b;
  }
}

// All but the one that goes to the ball are where they are to be.
TEST(KickOffFormation, NobodyMovesWithSevenASideAndMore) {
  const world::FieldGeometry field;
  RoleAssigner assigner;
  const Formation formation = kickOffFormation(Vector2::Zero(), field, {});
  for (const int last : {7, 8, 9, 10, 11}) {
    std::vector<Vector2> places;
    for (int unum = 2; unum <= last; ++unum) places.push_back(kickOffPose(unum, true, field, {}).translation);
    const auto nearer = [](const Vector2& a, const Vector2& b) { return a.norm() < b.norm(); };
    places.erase(std::min_element(places.begin(), places.end(), nearer));
    const std::span<const Vector2> wanted(formation.positions.data() + 1, places.size());
    const Assignment assignment = assigner.assign(places, wanted);
    for (std::size_t i = 0; i < places.size(); ++i)
      EXPECT_LT((wanted[static_cast<std::size_t>(assignment[i])] - places[i]).norm(), 1e-9) << last;
  }
}

}  // namespace
}  // namespace nonet::team
