// When the goalkeeper dives and when it goes to the ball: a dive costs the time of rising, so everything that
// a dive does not change must not cause one.
#include "nonet/team/goalie.h"

#include <utility>

#include <gtest/gtest.h>

#include "nonet/team/situation_tracker.h"
#include "nonet/world/ball_law.h"

#include "scene.h"

namespace nonet::team {
namespace {

Scene goalieScene(const Vector2& ball, const Vector2& speed) {
  Scene scene;
  scene.world.game.unum = 1;
  scene.stand(Pose2(-14.4, 0.0, 0.0));
  scene.putBall(ball, speed);
  return scene;
}

bool dives(const Vector2& place, const Vector2& speed) {
  const Action action = goalieScene(place, speed).decideAs(Role::Goalie);
  EXPECT_EQ(action.reason.behavior == "dive", std::holds_alternative<motion::PlaySkill>(action.motion));
  return action.reason.behavior == "dive";
}

TEST(Goalie, DivesForAShotBesideIt) {
  for (const double side : {1.0, -1.0}) {
    const Action action = goalieScene({-12.8, side * 0.7}, {-4.0, 0.0}).decideAs(Role::Goalie);
    ASSERT_TRUE(std::holds_alternative<motion::PlaySkill>(action.motion));
    EXPECT_EQ(std::get<motion::PlaySkill>(action.motion).side,
              side > 0.0 ? model::Side::Left : model::Side::Right);
  }
}

// Nearer balls along the ground are blocked, without a fall; high ones are not.
TEST(Goalie, BlocksWhatPassesNear) {
  const auto skill = [](double aside, double height, double lift, double x = -13.2) {
    Scene scene = goalieScene({x, aside}, {-4.0, 0.0});
    scene.world.ball.p_FB.z() = height;
    scene.world.ball.v_FB.z() = lift;
    const Action action = scene.decideAs(Role::Goalie);
    const auto* request = std::get_if<motion::PlaySkill>(&action.motion);
    return std::string(request == nullptr ? "" : request->name.view());
  };
  EXPECT_EQ(skill(0.27, world::kBallRestHeight, 0.0), "block");
  EXPECT_EQ(skill(-0.27, world::kBallRestHeight, 0.0), "block");
  EXPECT_EQ(skill(0.6, world::kBallRestHeight, 0.0), "dive");
  EXPECT_EQ(skill(0.27, 0.4, 2.0, -13.7), "dive");
  EXPECT_EQ(skill(0.27, 0.4, 2.0, -12.8), "") << "the body would be past it";
  EXPECT_EQ(skill(0.0, world::kBallRestHeight, 0.0), "") << "comes to it";
  EXPECT_EQ(skill(0.6, 1.0, 3.0), "") << "flies over the goal";
}

TEST(Goalie, DoesNotThrowItselfAtWhatItHasNotSeen) {
  Scene scene = goalieScene({-12.8, 0.7}, {-4.0, 0.0});
  EXPECT_EQ(scene.decideAs(Role::Goalie).reason.behavior, "dive");
  scene.world.ball.lastSeen = scene.world.time - 0.5;
  EXPECT_NE(scene.decideAs(Role::Goalie).reason.behavior, "dive");
}

// Oracle: the ball's law step by step, turned into the robot's frame.
TEST(Goalie, ForeseesWhereAShotPasses) {
  for (const double heading : {-0.6, 0.0, 0.6}) {
    for (const double lift : {0.0, 2.0}) {
      Scene scene = goalieScene({-10.0, 1.0}, {-7.0, -1.0});
      scene.stand(Pose2(-14.4, 0.1, heading));
      scene.putBall({-10.0, 1.0}, {-7.0, -1.0});
      scene.world.ball.v_FB.z() = lift;
      const Situation situation = scene.situation(Role::Goalie);
      const std::optional<ComingShot> shot = comingShot(situation);
      ASSERT_TRUE(shot) << heading << " " << lift;
      world::BallMotion ball{scene.world.ball.p_FB, scene.world.ball.v_FB};
      const Pose2 X_RF = scene.world.self.X_FR.inverse();
      double time = 0.0;
      Vector2 place = X_RF * Vector2(ball.p_FB.head<2>());
      while (place.x() > 0.0) {
        world::stepBall(ball, kCycleTime);
        time += kCycleTime;
        place = X_RF * Vector2(ball.p_FB.head<2>());
      }
      EXPECT_NEAR(shot->time, time, kCycleTime);
      EXPECT_NEAR(shot->aside, place.y(), 0.04);
      EXPECT_NEAR(shot->height, ball.p_FB.z(), 0.08);
    }
  }
}

TEST(Goalie, SeesNoShotInABallThatMissesOrStops) {
  const auto comes = [](const Vector2& place, const Vector2& speed) {
    const Scene scene = goalieScene(place, speed);
    const Situation situation = scene.situation(Role::Goalie);
    return comingShot(situation).has_value();
  };
  EXPECT_TRUE(comes({-12.5, 0.7}, {-4.0, 0.0}));
  EXPECT_FALSE(comes({-12.5, 0.7}, {4.0, 0.0})) << "goes away";
  EXPECT_FALSE(comes({-12.5, 0.7}, {-4.0, 2.5})) << "passes the post";
  EXPECT_FALSE(comes({-10.0, 0.7}, {-4.0, 0.0})) << "stops";
  EXPECT_FALSE(comes({-14.6, 0.7}, {-4.0, 0.0})) << "is past the goalie";
}

// By steps aside, without turning: the eyes stay on the ball and the dive begins from there.
TEST(Goalie, StepsIntoTheWayOfAShotThatLeavesTime) {
  const Scene scene = goalieScene({-6.0, 0.35}, {-11.0, 0.0});
  const Action action = scene.decideAs(Role::Goalie);
  EXPECT_EQ(action.reason.behavior, "guard goal");
  const auto* walk = std::get_if<motion::WalkVelocity>(&action.motion);
  ASSERT_NE(walk, nullptr);
  EXPECT_EQ(walk->velocity.translation.x(), 0.0);
  EXPECT_GT(walk->velocity.translation.y(), 0.5);
  EXPECT_EQ(walk->velocity.rotation, 0.0);
}

// Heights by the ball's law, step by step: above the head where the goalie stands, under the bar at the line.
TEST(Goalie, StepsBackUnderALob) {
  const GoalieParameters parameters;
  constexpr double kOff = 0.1;  // m: a crossing's height leaves out the drag on the way up and down
  int lobs = 0;
  for (double lift = 4.0; lift < 6.0; lift += 0.05) {
    Scene scene = goalieScene({-9.0, 0.1}, {-8.0, 0.0});
    scene.stand(Pose2(-14.1, 0.0, 0.0));
    scene.putBall({-9.0, 0.1}, {-8.0, 0.0});
    scene.world.ball.v_FB.z() = lift;
    const auto heightAt = [&](double x) {
      world::BallMotion ball{scene.world.ball.p_FB, scene.world.ball.v_FB};
      for (int i = 0; i < 2000 && ball.p_FB.x() > x; ++i) world::stepBall(ball, 0.002);
      return ball.p_FB.x() > x ? 0.0 : ball.p_FB.z();
    };
    const double above = heightAt(-14.1);
    if (above < parameters.standHeight + kOff || above > 0.6 ||
        heightAt(-14.8) > parameters.standHeight - 0.05)
      continue;
    ++lobs;
    const std::optional<ComingShot> shot = comingShot(scene.situation(Role::Goalie));
    ASSERT_TRUE(shot) << lift;
    EXPECT_GT(shot->back, 0.0) << lift;
    EXPECT_LT(heightAt(-14.1 - shot->back), parameters.standHeight + kOff);
    EXPECT_GT(heightAt(-14.1 - shot->back + 0.1), parameters.standHeight - kOff) << "no farther than it must";
    const Action action = scene.decideAs(Role::Goalie);
    const auto* walk = std::get_if<motion::WalkVelocity>(&action.motion);
    ASSERT_NE(walk, nullptr);
    EXPECT_LT(walk->velocity.translation.x(), -0.2);
    EXPECT_GT(walk->velocity.translation.y(), 0.0);
    scene.parameters.goalie.backSpeed = 0.0;
    const std::optional<ComingShot> stands = comingShot(scene.situation(Role::Goalie));
    EXPECT_EQ(stands ? stands->back : 0.0, 0.0);
  }
  EXPECT_GT(lobs, 0);
}

// In a second it will be behind the line beside the goal, near enough to be claimed.
TEST(Goalie, DoesNotGoAfterABallThatLeavesTheField) {
  EXPECT_FALSE(goalieScene({-13.0, 1.3}, {-3.5, 0.6}).situation(Role::Goalie).claims);
  EXPECT_TRUE(goalieScene({-13.0, 1.3}, {-1.5, 0.3}).situation(Role::Goalie).claims) << "this one stays";
}

TEST(Goalie, ABusyOneLeavesTheBallToANearerMate) {
  Scene scene = goalieScene({-13.5, 0.2}, {0.0, 0.0});
  SituationTracker tracker(scene.parameters);
  EXPECT_TRUE(tracker.update(scene.world, scene.motion).claims);
  scene.motion.busy = true;
  Scene::put(scene.world.teammates[6], Pose2(-13.3, 0.4, kPi));
  scene.world.teammates[6].fallen = true;
  EXPECT_TRUE(tracker.update(scene.world, scene.motion).claims);
  scene.world.teammates[6].fallen = false;
  EXPECT_FALSE(tracker.update(scene.world, scene.motion).claims);
}

TEST(Goalie, DoesNotClearIntoAMate) {
  Scene scene = goalieScene({-14.0, 0.6}, {0.0, 0.0});
  const Vector2 free = clearanceTarget(scene.situation(Role::Goalie));
  EXPECT_GT(free.y(), 0.0);
  Scene::put(scene.world.teammates[6],
             Pose2(Vector2(-14.0, 0.6) + (free - Vector2(-14.0, 0.6)).normalized(), 0.0));
  EXPECT_LT(clearanceTarget(scene.situation(Role::Goalie)).y(), 0.0);
}

// A shot will soon lie in the goal: that is no reason to walk there.
TEST(Goalie, DoesNotClaimAShot) {
  const Scene scene = goalieScene({-10.0, 0.3}, {-9.0, 0.0});
  EXPECT_TRUE(comingShot(scene.situation(Role::Goalie)).has_value());
  EXPECT_FALSE(scene.situation(Role::Goalie).claims);
}

TEST(Goalie, NarrowsTheAngle) {
  const GoalieParameters parameters;
  const world::FieldGeometry field;
  for (const Vector2& ball : {Vector2(-12.0, 2.0), Vector2(-5.0, -4.0), Vector2(0.0, 0.0)}) {
    const Pose2 place = guardPlace(ball, field, parameters);
    const Vector2 goal(-15.0, 0.0);
    const Vector2 way = ball - goal;
    const Vector2 stands = place.translation - goal;
    EXPECT_NEAR(way.x() * stands.y() - way.y() * stands.x(), 0.0, 1e-9) << "on the line to the goal's middle";
    EXPECT_GT(way.dot(stands), 0.0);
    EXPECT_LE(stands.norm(), parameters.outOfGoal + 1e-9);
    EXPECT_NEAR((place.inverse() * ball).y(), 0.0, 1e-9) << "faces it";
  }
}

TEST(Goalie, DoesNotWaitForAMateThatMayNotTouchTheBall) {
  Scene scene = goalieScene({-13.3, 0.3}, {0.0, 0.0});
  Scene::put(scene.world.teammates[3], Pose2(-13.6, 0.3, 0.0));
  Situation s = scene.situation(Role::Goalie);
  EXPECT_FALSE(goalieWantsBall(s, false)) << "the mate is there";
  s.banned = 3;
  EXPECT_TRUE(goalieWantsBall(s, false));
}

TEST(Goalie, NeverGuardsWhereTheBallLies) {
  for (double ahead = 0.55; ahead < 2.0; ahead += 0.05) {
    const Vector2 ball(-15.0 + ahead, 0.2);
    const Pose2 place = guardPlace(ball, {}, {});
    EXPECT_GT((ball - place.translation).norm(), 0.25) << ahead;
    EXPECT_LT(place.translation.x(), ball.x()) << ahead;
  }
}

TEST(Goalie, GoesAroundABallThatHasPassedIt) {
  Scene scene = goalieScene({-14.2, 0.05}, {0.0, 0.0});
  scene.stand(Pose2(-13.5, 0.0, kPi));
  Situation s = scene.situation(Role::Goalie);
  s.claims = false;
  const std::optional<Action> action = guardGoal(s);
  ASSERT_TRUE(action);
  const auto* walk = std::get_if<motion::WalkTo>(&action->motion);
  ASSERT_NE(walk, nullptr);
  const Vector2 way = walk->target.translation;
  const Vector2 toBall = scene.world.ball.p_RB.head<2>();
  const double along = std::clamp(way.dot(toBall) / way.squaredNorm(), 0.0, 1.0);
  EXPECT_GT((toBall - along * way).norm(), 0.2);
}

TEST(Goalie, LeavesTheBallOfAnOpponentThatIsSoonerUnlessItIsAtTheGoal) {
  Scene scene = goalieScene({-13.3, 0.3}, {0.0, 0.0});
  EXPECT_TRUE(scene.situation(Role::Goalie).claims) << "alone";
  Scene::put(scene.world.opponents[9], Pose2(-13.0, 0.4, kPi));
  EXPECT_FALSE(scene.situation(Role::Goalie).claims) << "the opponent has it";
  Scene::put(scene.world.opponents[9], Pose2(-9.0, 0.4, kPi));
  EXPECT_TRUE(scene.situation(Role::Goalie).claims) << "the opponent is far";
  scene.putBall({-14.2, 0.3});
  Scene::put(scene.world.opponents[9], Pose2(-13.9, 0.4, kPi));
  EXPECT_TRUE(scene.situation(Role::Goalie).claims) << "at the goal it is fought for";
}

TEST(Goalie, StaysInItsAreaInAPenaltyShootOut) {
  Scene scene = goalieScene({-13.4, 0.3}, {0.0, 0.0});
  EXPECT_TRUE(scene.situation(Role::Goalie).claims);
  scene.parameters.goalie.stayInArea = true;
  EXPECT_FALSE(scene.situation(Role::Goalie).claims);
  scene.putBall({-14.2, 0.3});
  EXPECT_TRUE(scene.situation(Role::Goalie).claims);
}

TEST(Goalie, DoesNotDiveWhereThatChangesNothing) {
  EXPECT_FALSE(dives({-12.5, 0.05}, {-4.0, 0.0})) << "straight at it";
  EXPECT_FALSE(dives({-12.5, 2.0}, {-4.0, 0.0})) << "wide of the goal";
  EXPECT_FALSE(dives({-10.0, 0.7}, {-2.0, 0.0})) << "stops on the way: 2 m/s roll 1.9 m";
  EXPECT_FALSE(dives({-8.0, 0.7}, {-8.0, 0.0})) << "seconds away: it can still step aside";
  EXPECT_FALSE(dives({-12.5, 0.7}, {4.0, 0.0})) << "going away";
}

TEST(Goalie, ClaimsABallNearTheGoalUnlessAMateIsSooner) {
  Scene scene = goalieScene({-13.5, 0.8}, {0.0, 0.0});
  EXPECT_TRUE(scene.situation(Role::Goalie).claims);
  EXPECT_EQ(scene.decideAs(Role::Goalie).reason.behavior, "go to ball");
  Scene::put(scene.world.teammates[3], Pose2(-13.7, 0.8, 0.0));
  EXPECT_FALSE(scene.situation(Role::Goalie).claims);
  EXPECT_EQ(scene.decideAs(Role::Goalie).reason.behavior, "guard goal");
}

TEST(Goalie, KeepsItsClaimInALargerRegion) {
  const TeamParameters parameters;
  const double attack = parameters.goalie.attackDistance;
  for (const auto& [distance, first, again] :
       {std::tuple{0.9 * attack, true, true}, {1.2 * attack, false, true}, {1.5 * attack, false, false}}) {
    const Scene scene = goalieScene({-15.0 + distance, 0.0}, {0.0, 0.0});
    const Situation situation = scene.situation(Role::Goalie);
    EXPECT_EQ(goalieWantsBall(situation, false), first) << distance;
    EXPECT_EQ(goalieWantsBall(situation, true), again) << distance;
  }
}

// It cannot change its mind while it kicks, but the ball is nobody's any more once it has gone.
TEST(Goalie, ItsClaimEndsWithItsClearance) {
  Scene scene = goalieScene({-13.5, 0.2}, {0.0, 0.0});
  SituationTracker tracker(scene.parameters);
  EXPECT_TRUE(tracker.update(scene.world, scene.motion).claims);
  scene.motion.busy = true;
  EXPECT_TRUE(tracker.update(scene.world, scene.motion).claims);
  scene.putBall({-12.8, 0.6}, {5.0, 2.0});
  EXPECT_FALSE(tracker.update(scene.world, scene.motion).claims);
}

// In the middle the ball's side is what the eyes tell.
TEST(Goalie, KeepsTheSideToWhichItClears) {
  for (const double heading : {-0.3, 0.3}) {
    for (const double y : {-0.02, 0.02}) {
      Scene scene;
      scene.world.game.unum = 1;
      scene.stand(Pose2(-14.4, 0.0, heading));
      scene.putBall({-14.0, y});
      EXPECT_GT(clearanceTarget(scene.situation(Role::Goalie)).y() * heading, 0.0);
      scene.putBall({-14.0, 100.0 * y});
      EXPECT_GT(clearanceTarget(scene.situation(Role::Goalie)).y() * y, 0.0);
    }
  }
}

// Whatever it sees and wherever it faces: it kicks past the one who waits for a pass.
TEST(Goalie, KicksAGoalKickPastItsReceiver) {
  for (const double heading : {-0.3, 0.3}) {
    for (const double y : {-0.02, 0.02}) {
      Scene scene;
      scene.world.game.unum = 1;
      scene.world.game.phase = world::Phase::OwnGoalKick;
      scene.stand(Pose2(-14.4, 0.0, heading));
      scene.putBall({-14.0, y});
      const Situation s = scene.situation(Role::Goalie);
      ASSERT_TRUE(s.setPlay);
      const Vector2 way = (clearanceTarget(s) - s.ball()).normalized();
      const Vector2 receiver = s.setPlay->p_FReceiver - s.ball();
      EXPECT_GT(std::abs(way.x() * receiver.y() - way.y() * receiver.x()), 0.7) << "m beside the way";
    }
  }
}

// Who is on the ball when the goalie claims it stands ready, but not where the goalie kicks.
TEST(Goalie, TheOneOnTheBallLeavesItTheWay) {
  const std::pair<world::Phase, Vector2> kBalls[] = {{world::Phase::PlayOn, {-13.0, -1.0}},
                                                     {world::Phase::PlayOn, {-13.0, 1.0}},
                                                     {world::Phase::OwnGoalKick, {-14.0, 0.0}}};
  for (const auto& [phase, ball] : kBalls) {
    Scene scene;
    scene.world.game.phase = phase;
    scene.stand(Pose2(ball + Vector2(1.0, 0.0), kPi));
    scene.putBall(ball);
    scene.world.radio[1].time = scene.world.time;
    scene.world.radio[1].message.timeToBall = 0.5;
    const Action action = scene.decideAs(Role::OnBall);
    ASSERT_EQ(action.reason.detail, "beside the ball");
    const Vector2 place = scene.world.self.X_FR * std::get<motion::WalkTo>(action.motion).target.translation;
    const Situation s = scene.situation(Role::OnBall);
    const Vector2 way = (clearanceTarget(s) - s.ball()).normalized();
    const Vector2 off = place - s.ball();
    EXPECT_GT(std::abs(way.x() * off.y() - way.y() * off.x()), 0.7) << "m beside the way";
  }
}

TEST(Goalie, StaysBetweenBallAndGoal) {
  for (const double y : {-6.0, 0.0, 6.0}) {
    const Scene scene = goalieScene({-5.0, y}, {0.0, 0.0});
    const Action action = scene.decideAs(Role::Goalie);
    EXPECT_EQ(action.reason.behavior, "guard goal");
    const Vector2 place = goalOf(scene, action);
    EXPECT_NEAR((place - Vector2(-15.0, 0.0)).norm(), scene.parameters.goalie.outOfGoal, 0.15);
    EXPECT_GE(place.y() * y, 0.0);
  }
}

// Server facts 4.7: who is in the circle is carried away.
TEST(Goalie, LeavesTheCircleOfTheirFreeKickIfThereIsRoom) {
  Scene scene = goalieScene({-12.0, 0.0}, {0.0, 0.0});
  scene.stand(Pose2(-14.9, 0.0, 0.0));
  scene.world.game.phase = world::Phase::OpponentFreeKick;
  const double clear = scene.situation(Role::Goalie).clearOfOpponentKick();
  const Pose2 there = guardPlace({-12.0, 0.0}, {}, {}, clear);
  EXPECT_GE((there.translation - Vector2(-12.0, 0.0)).norm(), clear - 1e-9);
  EXPECT_LT((guardPlace({-12.0, 0.0}, {}, {}).translation - Vector2(-12.0, 0.0)).norm(), clear);
  const Action action = scene.decideAs(Role::Goalie);
  EXPECT_EQ(action.reason.behavior, "guard goal");
  EXPECT_GE((goalOf(scene, action) - Vector2(-12.0, 0.0)).norm(), clear - 0.15);
}

TEST(Goalie, DoesNotWaitForAMateThatHasFallenSilent) {
  Scene scene = goalieScene({-13.3, 0.3}, {0.0, 0.0});
  Scene::put(scene.world.teammates[3], Pose2(-13.6, 0.3, 0.0));
  EXPECT_FALSE(goalieWantsBall(scene.situation(Role::Goalie), false)) << "the mate is there";
  scene.world.radio[3].time = scene.world.time - scene.parameters.agreement.goneAfter - 0.1;
  EXPECT_TRUE(goalieWantsBall(scene.situation(Role::Goalie), false));
}

}  // namespace
}  // namespace nonet::team
