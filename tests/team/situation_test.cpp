#include "nonet/team/situation.h"

#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include <gtest/gtest.h>

#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/math/random.h"
#include "nonet/team/formation.h"
#include "nonet/team/goalie.h"
#include "nonet/team/situation_tracker.h"

#include "scene.h"

namespace nonet::team {
namespace {

TEST(Situation, KnowsWhoIsHowFarFromTheBall) {
  Scene scene;
  Scene::put(scene.world.teammates[3], Pose2(0.9, 0.1, 0.0));
  Scene::put(scene.world.opponents[4], Pose2(1.0, 2.0, 0.0));
  Scene::put(scene.world.opponents[8], Pose2(1.0, 0.4, 0.0));
  scene.world.opponents[8].fallen = true;
  const Situation s = scene.situation(Role::Stopper);
  EXPECT_DOUBLE_EQ(s.nearestOpponent, 2.0) << "who lies on the ground does not count";
  EXPECT_LT(s.timeToBall[3], s.timeToBall[5]);
  EXPECT_TRUE(std::isinf(s.timeToBall[4])) << "nobody has seen number 4";
  // Oracle: one metre straight ahead of a robot that faces the ball and the goal.
  EXPECT_NEAR(s.timeToBall[5], 1.0 / scene.parameters.pace.walkSpeed, 0.05);
}

TEST(Situation, AnOpponentCarriesTheBallThatItWalksAfterUnlessOneOfUsHasItNearer) {
  Scene scene;
  Scene::put(scene.world.opponents[4], Pose2(1.4, 0.0, kPi));
  scene.world.opponents[4].v_FP = {-0.5, 0.0};
  EXPECT_LT((scene.situation(Role::OnBall).forecast.at(1.0) - Vector2(0.5, 0.0)).norm(), 1e-9);
  scene.stand(Pose2(0.7, 0.0, 0.0));
  EXPECT_LT((scene.situation(Role::OnBall).forecast.at(1.0) - Vector2(1.0, 0.0)).norm(), 1e-9);
  scene.world.teammates[5].fallen = true;
  EXPECT_LT((scene.situation(Role::OnBall).forecast.at(1.0) - Vector2(0.5, 0.0)).norm(), 1e-9);
}

// However fast it rolls, and wherever it is met.
TEST(Situation, ABallIsNeverMetBeyondItsTargetAroundAnOpponent) {
  for (const double speed : {0.0, 2.0, 4.0, 6.0}) {
    Scene scene;
    scene.putBall({1.0, 0.0}, {speed, 0.0});
    Scene::put(scene.world.opponents[4], Pose2(1.6, 0.1, kPi));
    const Situation s = scene.situation(Role::OnBall);
    const Vector2 way = s.p_FTarget - s.ball();
    ASSERT_GT(std::abs(way.y()), 0.3) << "around it";
    for (const double time : {0.0, 1.0, 5.0})
      EXPECT_GT((s.p_FTarget - s.forecast.free().at(time)).dot(way), 0.0) << speed << " " << time;
  }
}

// The geometry of the turn against the angle between two vectors, in fuzzed scenes.
TEST(Situation, TheOwnTurnDescribesTheBallAsTheRobotSeesIt) {
  Random random(8);
  for (int trial = 0; trial < 300; ++trial) {
    Scene scene;
    scene.putBall({random.uniform(-14, 14), random.uniform(-9, 9)});
    scene.stand(Pose2(random.uniform(-14, 14), random.uniform(-9, 9), random.uniform(-kPi, kPi)));
    const Situation s = scene.situation(Role::OnBall);
    ASSERT_TRUE(s.play);
    const Vector2 forward = s.world.self.X_FR.rotate(Vector2::UnitX());
    const Vector2 onward = (s.play->p_FTarget - s.ball()).normalized();
    EXPECT_NEAR(std::cos(s.play->direction), forward.dot(onward), 1e-9);
    const Vector2 offset = s.ball() - s.world.self.X_FR.translation;
    EXPECT_NEAR(s.play->behind, offset.dot(onward), 1e-9);
    EXPECT_NEAR(std::hypot(s.play->behind, s.play->besides), offset.norm(), 1e-9);
    // A ball at rest is met where it lies, and the place behind it looks over it at the target.
    EXPECT_LT((s.play->p_FMeeting - s.ball()).norm(), 1e-12);
    const Pose2 behind = s.play->placeBehind(0.3);
    EXPECT_LT((behind * Vector2(0.3, 0.0) - s.ball()).norm(), 1e-9);
  }
}

TEST(SituationTracker, TellsWhatWasWeighedOnlyWhenAsked) {
  Scene scene;
  scene.stand(Pose2(12.0, 0.0, 0.0));
  scene.putBall({12.5, 0.2});
  SituationTracker tracker(scene.parameters);
  EXPECT_TRUE(tracker.update(scene.world, scene.motion).targets.empty());
  tracker.recordCandidates(true);
  for (int cycle = 0; cycle < 3; ++cycle) {
    const Situation s = tracker.update(scene.world, scene.motion);
    ASSERT_EQ(s.targets.size(), 7U) << "places in the goal, of this cycle only";
    const auto* best = &s.targets[0];
    for (const Candidate& candidate : s.targets)
      if (candidate.value > best->value) best = &candidate;
    EXPECT_EQ(best->p_F, s.p_FTarget) << "the best one was chosen";
  }
}

// A penalty shoot-out: nobody to wait for, and the goal to go to.
TEST(Situation, WhoIsAloneAgainstAGoalieTakesTheKickOffTowardsTheGoal) {
  Scene scene;
  scene.world.game.phase = world::Phase::OwnKickOff;
  scene.world.game.phaseSince = scene.world.time - 1.0;
  scene.putBall({0.0, 0.0});
  scene.stand(Pose2(-0.4, 0.0, 0.0));
  Scene::put(scene.world.opponents[1], Pose2(14.5, 0.0, kPi));
  const Situation alone = scene.situation(Role::OnBall);
  ASSERT_TRUE(alone.play);
  EXPECT_FALSE(alone.play->wait);
  EXPECT_EQ(alone.play->p_FTarget, alone.p_FTarget);
  Scene::put(scene.world.teammates[7], Pose2(-5.0, 0.0, 0.0));
  const Situation withMate = scene.situation(Role::OnBall);
  ASSERT_TRUE(withMate.play);
  EXPECT_TRUE(withMate.play->wait) << "for the receiver";
}

// A push is a touch of each foot, and the second one is a free kick for the others.
TEST(Situation, TheKickOffIsKickedIfAKickGoesAsFarAsItIsAskedTo) {
  Scene scene;
  scene.world.game.phase = world::Phase::OwnKickOff;
  scene.world.game.phaseSince = scene.world.time - 1.0;
  scene.putBall({0.0, 0.0});
  const double angle = scene.parameters.setPlay.kickOffAngle;
  scene.stand(Pose2(-0.25 * unitVector(angle), angle));
  Scene::put(scene.world.teammates[6], kickOffPose(6, true, scene.world.field, scene.parameters.setPlay));
  Scene::put(scene.world.teammates[7], Pose2(-0.6, 5.0, 0.0));
  motion::KickOption pass = scene.motion.kicks.front();
  pass.name = "as far as asked";
  pass.head.scales = true;
  pass.head.shortest = 2.0;
  pass.head.longest = 6.0;
  const std::array kicks{scene.motion.kicks.front(), pass};

  const Situation pushed = scene.situation(Role::OnBall);
  ASSERT_TRUE(pushed.play);
  EXPECT_EQ(pushed.play->use, KickUse::Never) << "no such kick";
  scene.motion.kicks = kicks;
  const Situation kicked = scene.situation(Role::OnBall);
  ASSERT_TRUE(kicked.play);
  EXPECT_EQ(kicked.play->use, KickUse::Clear);
  EXPECT_EQ(kicked.play->kick, pass.name);
  EXPECT_FALSE(kicked.play->wait) << "the receiver stands there";
  EXPECT_FALSE(dribble(kicked));
  const Action action = decide(kicked);
  EXPECT_TRUE(std::holds_alternative<motion::KickTo>(action.motion)) << action.reason.behavior;

  Scene::put(scene.world.teammates[6], Pose2(-6.0, -3.0, 0.0));
  EXPECT_TRUE(scene.situation(Role::OnBall).play->wait) << "for the receiver";
  scene.world.teammates[6].known = scene.world.teammates[7].known = false;
  Scene::put(scene.world.teammates[1], Pose2(-14.3, 0.0, 0.0));
  Scene::put(scene.world.opponents[1], Pose2(14.3, 0.0, 0.0));
  const Situation withGoalie = scene.situation(Role::OnBall);
  EXPECT_FALSE(withGoalie.play->wait) << "for nobody";
  EXPECT_EQ(withGoalie.play->p_FTarget, withGoalie.p_FTarget);
}

// Whoever may not kick walks through the ball, rather than stand before it until the server drops it.
TEST(Situation, SetPiecesArePushedByWhoDoesNotKick) {
  for (const world::Phase phase :
       {world::Phase::OwnKickOff, world::Phase::OwnKickIn, world::Phase::OwnFreeKick}) {
    Scene scene;
    scene.world.game.phase = phase;
    scene.world.game.phaseSince = scene.world.time - 9.0;
    scene.putBall({0.0, 0.0});
    Scene::put(scene.world.teammates[6], Pose2(-4.0, -3.0, 0.0));
    Scene::put(scene.world.teammates[7], Pose2(-4.0, 5.0, 0.0));
    scene.parameters.ball.kick = false;
    const Situation seen = scene.situation(Role::OnBall);
    const Vector2 along = seen.setPlay->p_FTarget.normalized();
    scene.stand(Pose2(-0.2 * along, directionOf(along)));
    EXPECT_EQ(scene.decideAs(Role::OnBall).reason.behavior, "dribble") << static_cast<int>(phase);
  }
}

// Roles are given by the places that are taken: else the one who stands ready leaves and another must come.
TEST(Situation, TheReceiverOfASetPieceIsWhoStandsNextToItsPlace) {
  const std::pair<world::Phase, Vector2> kPieces[] = {{world::Phase::OwnKickOff, {0.0, 0.0}},
                                                      {world::Phase::OwnKickIn, {3.0, 10.0}},
                                                      {world::Phase::OwnCorner, {15.0, 10.0}},
                                                      {world::Phase::OwnCorner, {15.0, -10.0}},
                                                      {world::Phase::OwnGoalKick, {-14.0, 1.0}}};
  for (const auto& [phase, ball] : kPieces) {
    Scene scene;
    scene.world.game.phase = phase;
    scene.putBall(ball);
    const Situation s = scene.situation(Role::Stopper);
    ASSERT_TRUE(s.setPlay);
    EXPECT_LT((s.formation.positions[1] - s.setPlay->p_FReceiver).norm(), 0.5);
    for (int i = 1; i < s.formation.count && phase == world::Phase::OwnKickOff; ++i)
      EXPECT_LE(s.formation.positions[static_cast<std::size_t>(i)].x(), -0.5) << "in the own half";
    for (int i = 2; i < s.formation.count; ++i)
      EXPECT_GT((s.formation.positions[static_cast<std::size_t>(i)] - s.setPlay->p_FReceiver).norm(), 0.7)
          << "nobody else is to stand there: " << i << " at ball " << ball.transpose();
  }
}

// The kick of 0.9 x 7 m goes to the side of the receiver that waits for another one; most of us are to be
// nearer to where it ends than to where it begins.
TEST(Situation, AtAGoalKickTheOthersAreWhereItComesDown) {
  Scene scene;
  scene.world.game.phase = world::Phase::OwnGoalKick;
  scene.putBall({-14.0, 0.0});
  const auto nearer = [&] {
    const Situation s = scene.situation(Role::Stopper);
    const Vector2 end = s.ball() + 6.3 * (clearanceTarget(s) - s.ball()).normalized();
    int count = 0;
    for (int i = 2; i < s.formation.count; ++i) {
      const Vector2& place = s.formation.positions[static_cast<std::size_t>(i)];
      count += (place - end).norm() < (place - s.ball()).norm() ? 1 : 0;
    }
    return count;
  };
  const int with = nearer();
  EXPECT_GE(with, 5);
  scene.parameters.ball.kick = false;
  EXPECT_LT(nearer(), with);
}

// Rising takes its time from the fall on; who has not come up by then tries again.
TEST(Situation, WhoHasLainForLongerIsSoonerAtTheBall) {
  Scene scene;
  const double upright = scene.situation(Role::Stopper).timeToBall[5];
  const double rising = scene.parameters.pace.risingTime;
  const auto time = [&](double lain) {
    scene.world.teammates[5].fallen = false;
    scene.world.teammates[5].lies(true, scene.world.time - lain);
    scene.world.teammates[5].lies(true, scene.world.time);
    return scene.situation(Role::Stopper).timeToBall[5];
  };
  EXPECT_NEAR(time(0.0), upright + rising, 1e-9);
  EXPECT_NEAR(time(1.0), upright + rising - 1.0, 1e-9);
  EXPECT_GT(time(rising - 0.01), upright + 0.2);
  EXPECT_NEAR(time(rising + 1.0), time(1.0), 1e-9);
}

// The blocker stands on the edge of the circle that the referee clears: nobody else is sent there.
TEST(Situation, AtTheirSetPiecesNobodyStandsWhereTheBlockerDoes) {
  Scene scene;
  const auto expectRoom = [&](world::Phase phase, const Vector2& ball) {
    scene.world.game.phase = phase;
    scene.putBall(ball);
    const Situation s = scene.situation(Role::Stopper);
    const Vector2 blocker = ball + s.clearOfOpponentKick() * (s.world.field.ownGoal() - ball).normalized();
    for (std::size_t i = 1; i < 8; ++i)
      EXPECT_GT((s.formation.positions[i] - blocker).norm(), 0.9)
          << "role " << i << " ball " << ball.transpose();
  };
  expectRoom(world::Phase::OpponentKickOff, {0.0, 0.0});
  expectRoom(world::Phase::OpponentGoalKick, {14.0, 0.0});
  for (double x = -9.0; x < 14.0; x += 1.0) {
    expectRoom(world::Phase::OpponentKickIn, {x, 9.958});
    expectRoom(world::Phase::OpponentFreeKick, {x, -3.0});
  }
}

TEST(Situation, AtTheirGoalKickPlacesAreThoseOfABallThatHasComeDown) {
  Scene scene;
  scene.putBall({4.5, 0.0});
  const Formation there = scene.situation(Role::Stopper).formation;
  scene.putBall({14.0, 0.0});
  scene.world.game.phase = world::Phase::OpponentGoalKick;
  const Formation places = scene.situation(Role::Stopper).formation;
  for (std::size_t i = 0; i < places.positions.size(); ++i)
    EXPECT_LT((places.positions[i] - there.positions[i]).norm(), 1e-9) << "role " << i;
}

// Who runs ahead when it is over need not turn first. At other set pieces all wait for the ball.
TEST(Situation, AtTheirKickOffAllFaceTheirGoal) {
  Scene scene;
  scene.putBall({0.0, 0.0});
  // Of a robot that has come to the place of its role.
  const auto headingOf = [&](Role role, world::Phase phase) {
    scene.world.game.phase = phase;
    scene.stand(Pose2(-2.0, 0.5, 0.0));
    for (int i = 0; i < 10; ++i) scene.stand(Pose2(goalOf(scene, scene.decideAs(role)), 1.0));
    const Action action = scene.decideAs(role);
    EXPECT_EQ(action.reason.behavior, "opponent set piece");
    const auto* walk = std::get_if<motion::WalkTo>(&action.motion);
    EXPECT_NE(walk, nullptr);
    return wrapAngle(scene.world.self.X_FR.rotation + (walk == nullptr ? 0.0 : walk->target.rotation));
  };
  for (const Role role : {Role::ForwardLeft, Role::ForwardRight, Role::Stopper}) {
    EXPECT_NEAR(headingOf(role, world::Phase::OpponentKickOff), 0.0, 1e-9) << static_cast<int>(role);
    const double heading = headingOf(role, world::Phase::OpponentFreeKick);
    const double toBall = directionOf(-scene.world.self.X_FR.translation);
    EXPECT_NEAR(wrapAngle(heading - toBall), 0.0, 1e-9) << static_cast<int>(role);
  }
}

// Before the referee puts the ball a touch does not count, and who is near is pushed away.
TEST(Situation, TheTakerKeepsAwayUntilTheBallIsPut) {
  Scene scene;
  scene.putBall({5.0, 9.958});
  scene.stand(Pose2(4.8, 9.9, 0.0));
  scene.world.game.phase = world::Phase::OwnKickIn;
  scene.world.game.phaseSince = scene.world.time - 0.5;
  Action action = scene.decideAs(Role::OnBall);
  EXPECT_EQ(action.reason.behavior, "wait at ball");
  EXPECT_GT((goalOf(scene, action) - Vector2(5.0, 9.958)).norm(), 0.5);
  // The receiver is there.
  scene.world.game.phaseSince = scene.world.time - 1.2;
  Scene::put(scene.world.teammates[6], Pose2(scene.situation(Role::OnBall).setPlay->p_FReceiver, 0.0));
  action = scene.decideAs(Role::OnBall);
  EXPECT_NE(action.reason.behavior, "wait at ball");
  // At the kick-off the ball lies there from the first cycle on.
  scene.putBall({0.0, 0.0});
  scene.stand(Pose2(-0.3, 0.0, 0.0));
  scene.world.game.phase = world::Phase::OwnKickOff;
  scene.world.game.phaseSince = scene.world.time - 0.5;
  Scene::put(scene.world.teammates[6], Pose2(scene.situation(Role::OnBall).setPlay->p_FReceiver, 0.0));
  EXPECT_NE(scene.decideAs(Role::OnBall).reason.behavior, "wait at ball");
}

}  // namespace
}  // namespace nonet::team
