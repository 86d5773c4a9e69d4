// Passes in open play: who gets one, when none is played, and what the receiver does. The oracle: straight
// lines and who is nearer, on a field of 30 x 20 m.
#include "nonet/team/pass.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "nonet/math/straight_way.h"

#include "scene.h"

namespace nonet::team {
namespace {

constexpr int kReceiver = 8;

// The robot stands behind the ball, an opponent bars the way ahead, a mate is free on the left.
struct Passing : Scene {
  Passing() {
    motion::KickOption kick;
    kick.name = "pass";
    kick.head.p_RBall = {0.18, 0.05};
    kick.head.shortest = 2.0;
    kick.head.longest = 6.0;
    kick.head.contact = 0.22;
    kick.head.fromWalk = true;
    kick.head.scales = true;
    kicks = {kick};
    motion.kicks = kicks;
    stand(Pose2(0.8, 0.0, 0.3));
    put(world.opponents[3], Pose2(2.4, -0.3, kPi));
    put(world.teammates[kReceiver], Pose2(4.5, 2.5, 0.0));
  }
  std::optional<Pass> best() const { return bestPass(situation(Role::OnBall)); }
  /// What the body was asked for while it lines up the best one.
  motion::KickTo linedUp() const {
    motion::KickTo request;
    request.ball = world.ball.p_RB;
    request.target = world.self.X_FR.inverse() * best().value().p_FTarget;
    request.stops = true;
    request.kick = std::string_view("pass");
    return request;
  }
  Vector2 mate() const { return world.teammates[kReceiver].X_FP.translation; }

  std::array<motion::KickOption, 1> kicks;
};

TEST(Pass, GoesToAFreeMateAhead) {
  const Passing scene;
  const Action action = scene.decideAs(Role::OnBall);
  EXPECT_EQ(action.reason.behavior, "pass");
  const auto& request = std::get<motion::KickTo>(action.motion);
  EXPECT_TRUE(request.stops);
  EXPECT_EQ(request.kick.view(), "pass");
  const Vector2 target = scene.world.self.X_FR * request.target;
  EXPECT_LT((target - scene.mate()).norm(), 2.1) << "where it stands, or up to two steps of a run ahead";
  EXPECT_GE(target.x(), scene.mate().x() - 1e-9);
  ASSERT_TRUE(action.pass);
  EXPECT_EQ(action.pass->receiver, kReceiver);
  EXPECT_LT((action.pass->p_FTarget - target).norm(), 1e-9);
  EXPECT_GT(action.pass->kickAt, scene.world.time + scene.kicks[0].head.contact);
  EXPECT_GT(action.pass->thereAt, action.pass->kickAt);
}

TEST(Pass, NotThroughAnOpponent) {
  Passing scene;
  const Vector2 middle = 0.5 * (scene.mate() + Vector2(1.0, 0.0));
  Scene::put(scene.world.opponents[4], Pose2(middle, kPi));
  EXPECT_FALSE(scene.best());
}

TEST(Pass, NotToWhereAnOpponentIsFirst) {
  Passing scene;
  // Between the mate and the goal, and nearer to every place that it could be sent to than the mate is.
  for (int i = 0; i < 3; ++i)
    Scene::put(scene.world.opponents[static_cast<std::size_t>(5 + i)],
               Pose2(scene.mate() + Vector2(0.2 + i, 0.3 - 0.2 * i), kPi));
  EXPECT_FALSE(scene.best());
}

// Near the own goal, with an opponent in the way, going on is worth less than nothing.
TEST(Pass, AHopelessOneIsNoneNearTheOwnGoalEither) {
  Passing scene;
  scene.putBall({-10.0, 0.0});
  scene.stand(Pose2(-10.2, 0.0, 0.3));
  Scene::put(scene.world.opponents[3], Pose2(-8.6, -0.3, kPi));
  Scene::put(scene.world.teammates[kReceiver], Pose2(-6.5, 2.5, 0.0));
  Scene::put(scene.world.opponents[4], Pose2(0.5 * (scene.mate() + Vector2(-10.0, 0.0)), kPi));
  EXPECT_FALSE(scene.best()) << "through an opponent";
  scene.world.opponents[4].known = false;
  for (int i = 0; i < 3; ++i)
    Scene::put(scene.world.opponents[static_cast<std::size_t>(5 + i)],
               Pose2(scene.mate() + Vector2(0.2 + i, 0.3 - 0.2 * i), kPi));
  EXPECT_FALSE(scene.best()) << "to where an opponent is first";
}

TEST(Pass, NotBackwardsWhileTheWayIsFree) {
  Passing scene;
  scene.world.opponents[3].known = false;
  Scene::put(scene.world.teammates[kReceiver], Pose2(-2.5, 2.5, 0.0));
  EXPECT_FALSE(scene.best());
}

TEST(Pass, NotFartherThanAnyKickServes) {
  Passing scene;
  Scene::put(scene.world.teammates[kReceiver], Pose2(8.0, 3.0, 0.0));
  EXPECT_FALSE(scene.best());
}

// Short ones do not pay near the goal, where a push may score.
TEST(Pass, ShortOnesOnlyFarFromTheGoal) {
  Passing scene;
  scene.parameters.pass.runStep = 0.0;  // to where the mate stands
  Scene::put(scene.world.teammates[kReceiver], Pose2(3.0, 2.0, 0.0));
  const auto pass = scene.best();
  ASSERT_TRUE(pass);
  const Vector2 way = pass->p_FTarget - scene.world.ball.p_FB.head<2>();
  EXPECT_LT(way.norm(), scene.parameters.pass.least);
  scene.parameters.pass.far = 15.0;
  EXPECT_FALSE(scene.best());
  scene.parameters.pass.far = 10.0;
  scene.parameters.pass.farPressed = 0.3;
  EXPECT_FALSE(scene.best()) << "whoever has time runs on";
  scene.parameters.pass.farPressed = 4.0;
  // In the own half, where a free mate behind looks better than a ball that opponents bar.
  scene.putBall({-6.0, 0.0});
  scene.stand(Pose2(-5.95, -0.2, 1.8));
  for (std::size_t i = 0; i < 5; ++i)
    Scene::put(scene.world.opponents[3 + i], Pose2(-4.6, 0.5 * static_cast<double>(i) - 1.0, kPi));
  Scene::put(scene.world.teammates[kReceiver], Pose2(-6.6, 2.7, 0.0));
  EXPECT_FALSE(scene.best()) << "back";
  scene.parameters.pass.least = scene.parameters.pass.farLeast;
  scene.parameters.pass.better = scene.parameters.pass.farBetter;
  EXPECT_TRUE(scene.best()) << "only for that";
}

TEST(Pass, NotNowUnderPressureNorWithARollingBall) {
  Passing scene;
  Scene::put(scene.world.opponents[6], Pose2(0.6, 0.5, 0.0));
  EXPECT_FALSE(pass(scene.situation(Role::OnBall)));
  Passing rolls;
  rolls.putBall({1.0, 0.0}, {0.6, 0.0});
  EXPECT_FALSE(pass(rolls.situation(Role::OnBall)));
  Passing off;
  off.parameters.pass.use = false;
  EXPECT_FALSE(pass(off.situation(Role::OnBall)));
}

TEST(Pass, TakesTheMostValuableOfAll) {
  Passing scene;
  Scene::put(scene.world.teammates[7], Pose2(3.0, -3.5, 0.0));
  Scene::put(scene.world.teammates[9], Pose2(-1.5, 3.0, 0.0));
  Candidates all;
  const auto best = bestPass(scene.situation(Role::OnBall), &all);
  ASSERT_TRUE(best);
  ASSERT_GE(all.all().size(), 6u);
  const auto most =
      std::max_element(all.all().begin(), all.all().end(),
                       [](const Candidate& a, const Candidate& b) { return a.value < b.value; });
  EXPECT_DOUBLE_EQ(best->value, most->value);
  EXPECT_LT((best->p_FTarget - most->p_F).norm(), 1e-12);
}

// The team's radio has told this player of a pass to `receiver`, the kick comes in a second.
struct Awaiting : Scene {
  explicit Awaiting(int receiver = 5) {
    stand(Pose2(2.0, 3.0, 0.0));
    putBall({-2.0, 0.0});
    world.pass = {world.time, 7, receiver, Vector2(4.0, 3.0), world.time + 1.0, world.time + 3.0};
  }
};

TEST(RunToPass, TheReceiverGoesThereBeforeTheKick) {
  const Awaiting scene;
  const Action action = scene.decideAs(Role::WingLeft);
  EXPECT_EQ(action.reason.behavior, "run to pass");
  const Vector2 place = goalOf(scene, action);
  const Vector2 onward = (scene.world.pass.p_FTarget - scene.world.ball.p_FB.head<2>()).normalized();
  const Vector2 expected = scene.world.pass.p_FTarget + scene.parameters.pass.before * onward;
  EXPECT_LT((place - expected).norm(), 1e-9);
}

TEST(RunToPass, OthersDoNot) {
  const Awaiting scene(6);
  EXPECT_EQ(scene.decideAs(Role::WingLeft).reason.behavior, "support");
}

TEST(RunToPass, ForgetsAPassThatDoesNotCome) {
  Awaiting scene;
  scene.world.time = scene.world.pass.kickAt + scene.parameters.pass.late + 0.1;
  scene.world.ball.lastSeen = scene.world.time;
  EXPECT_EQ(scene.decideAs(Role::WingLeft).reason.behavior, "support") << "the ball still lies there";
  // It rolls here, and comes to rest two metres beside the place at the most.
  scene.putBall({0.0, 1.5}, {4.2, 1.6});
  EXPECT_EQ(scene.decideAs(Role::WingLeft).reason.behavior, "run to pass");
  scene.world.time = scene.world.pass.thereAt + scene.parameters.pass.late + 0.1;
  scene.world.ball.lastSeen = scene.world.time;
  EXPECT_EQ(scene.decideAs(Role::WingLeft).reason.behavior, "support") << "it is too late";
}

TEST(Pass, NotThroughAnOpponentThatLiesThere) {
  Passing scene;
  ASSERT_TRUE(scene.best());
  const Vector2 middle = 0.5 * (scene.mate() + Vector2(1.0, 0.0));
  Scene::put(scene.world.opponents[4], Pose2(middle, kPi));
  scene.world.opponents[4].fallen = true;
  const std::optional<Pass> past = scene.best();
  EXPECT_TRUE(!past || StraightWay(scene.world.ball.p_FB.head<2>(), past->p_FTarget).distanceTo(middle) > 0.2)
      << "past it, if at all";
}

TEST(Pass, NotToAMateThatHasFallenSilent) {
  Passing scene;
  scene.world.radio[kReceiver].time = scene.world.time - scene.parameters.agreement.goneAfter + 0.1;
  EXPECT_TRUE(scene.best());
  scene.world.radio[kReceiver].time = scene.world.time - scene.parameters.agreement.goneAfter - 0.1;
  EXPECT_FALSE(scene.best());
}

// An opponent that comes up to the robot on its last steps.
TEST(Pass, GoesOnUnderPressure) {
  Passing scene;
  const motion::KickTo lined = scene.linedUp();
  scene.world.opponents[3].known = false;
  const auto passes = [&](double away) {
    Scene::put(scene.world.opponents[6], Pose2(1.0 - 0.6 * away, -0.8 * away, 0.0));
    return pass(scene.situation(Role::OnBall)).has_value();
  };
  scene.parameters.pass.better = -1.0;
  scene.parameters.pass.press = 0.6;
  EXPECT_FALSE(passes(0.7));
  scene.motion.request = lined;
  EXPECT_TRUE(passes(0.7));
  scene.parameters.pass.press = 1.0;
  EXPECT_FALSE(passes(0.7));
}

TEST(Pass, ComesTooLateOnTheLastStepsToAnotherKick) {
  Passing scene;
  motion::KickTo kick = scene.linedUp();
  kick.stops = false;
  scene.motion.request = kick;
  EXPECT_FALSE(pass(scene.situation(Role::OnBall)));
  scene.parameters.ball.kickHold = 0.1;
  EXPECT_TRUE(pass(scene.situation(Role::OnBall))) << "while the ball is farther away than that";
}

// A lane that is just too narrow to begin with.
TEST(Pass, OneThatIsBeingLinedUpIsNotGivenUpForALittle) {
  Passing scene;
  const motion::KickTo lined = scene.linedUp();
  const Vector2 middle = 0.5 * (scene.mate() + Vector2(1.0, 0.0));
  const Vector2 aside = Vector2(-2.5, 3.5).normalized();
  int held = 0, given = 0;
  for (double off = 1.5; off > 0.0; off -= 0.02) {
    Scene::put(scene.world.opponents[4], Pose2(middle + off * aside, kPi));
    scene.motion.request = motion::Stand{};
    const bool begun = scene.best().has_value();
    scene.motion.request = lined;
    const bool goesOn = scene.best().has_value();
    EXPECT_TRUE(goesOn || !begun) << off;
    held += goesOn && !begun ? 1 : 0;
    given += goesOn ? 0 : 1;
  }
  EXPECT_GT(held, 0);
  EXPECT_GT(given, 5) << "but it is given up";
}

}  // namespace
}  // namespace nonet::team
