// Which kick is chosen, and when it begins: against the cost worked out by hand, and with a point robot that
// follows the steps exactly or with a drift.
#include "nonet/motion/kick_control.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/math/random.h"
#include "nonet/motion/skill_language.h"

namespace nonet::motion {
namespace {

using model::Side;

constexpr const char* kSkills =
    "skill kick_a { kick { ball (0.2m, 5cm) within (3cm, 2cm) distance 3m..7m contact 0.3s from stand } }\n"
    "skill kick_b { kick { ball (0.1m, 6cm) within (3cm, 2cm) direction 90deg within 20deg distance 1m..3m "
    "contact 0.4s "
    "room 1m from stand types 0 4 } }\n"
    "skill no_kick { wait 1s }";

class Control : public testing::Test {
 protected:
  KickTo request(const Vector2& ball, const Vector2& way) const {
    KickTo kick;
    kick.ball = ball;
    kick.target = ball + way;
    return kick;
  }
  KickStep step(const KickTo& kick, double quiet = 0.0) { return control_.update(kick, walk_, quiet); }

  SkillLibrary library_{parseSkills(kSkills, "test.skl")};
  KickCatalogue catalogue_{library_, 0};
  KickParameters parameters_;
  KickControl control_{catalogue_, parameters_};
  WalkEngine walk_{model::robotModel(0)};  // it stands
};

TEST_F(Control, TheCatalogueHoldsBothFeetOfEachKickThatServesTheType) {
  const auto options = catalogue_.options();
  ASSERT_EQ(options.size(), 4U);
  EXPECT_EQ(options[0].name, "kick_a");
  EXPECT_EQ(options[1].foot, Side::Right);
  EXPECT_TRUE(options[1].head.p_RBall.isApprox(Vector2(0.2, -0.05)));
  EXPECT_DOUBLE_EQ(options[3].head.direction, toRadians(-90.0));
  EXPECT_EQ(KickCatalogue(library_, 1).options().size(), 2U);
}

TEST_F(Control, TakesTheNearerFoot) {
  EXPECT_EQ(step(request({0.2, 0.05}, {5.0, 0.0})).option->foot, Side::Left);
  control_.reset();
  EXPECT_EQ(step(request({0.2, -0.05}, {5.0, 0.0})).option->foot, Side::Right);
}

// The ball lies for a kick to the left; turning for the kick straight on costs more than its length.
TEST_F(Control, TakesTheCheaperDirectionUnlessAnOpponentIsNear) {
  KickTo kick = request({0.1, 0.06}, {0.0, 2.5});
  EXPECT_EQ(step(kick).option->name, "kick_b");
  control_.reset();
  kick.room = 0.9;
  EXPECT_EQ(step(kick).option->name, "kick_a");
}

TEST_F(Control, TakesTheOneThatIsNamed) {
  KickTo kick = request({0.2, 0.05}, {5.0, 0.0});
  kick.kick = std::string_view("kick_b");
  EXPECT_EQ(step(kick).option->name, "kick_b");
  kick.kick = std::string_view("kick_c");
  EXPECT_EQ(step(kick).option, nullptr);
}

// What a robot of type 0 has that stands and can do these kicks.
struct Kicks {
  explicit Kicks(const char* skills) : library(parseSkills(skills, "test.skl")) {}

  SkillLibrary library;
  KickCatalogue catalogue{library, 0};
  WalkEngine walk{model::robotModel(0)};
};

// Of two that lie equally near, the one that scales is for passes only, and only where the other would go too
// far.
TEST(KickChoice, TakesKicksThatScaleForPasses) {
  const Kicks kicks(
      "skill kick_far { kick { ball (0.2m, 5cm) within (3cm, 2cm) distance 3m..10m contact 0.3s from walk }\n"
      "wait 0.1s }\n"
      "skill kick_soft { kick { ball (0.2m, 5cm) within (3cm, 2cm) distance 2m..6m contact 0.3s from walk }\n"
      "move over 0.2s { left.knee -0.1rad * distance } }");
  const auto asked = [&](double distance, bool stops) {
    KickControl control(kicks.catalogue, KickParameters{});
    KickTo kick;
    kick.ball = {0.2, 0.05};
    kick.target = kick.ball + Vector2(distance, 0.0);
    kick.stops = stops;
    return control.update(kick, kicks.walk, 0.0);
  };
  for (const double distance : {2.0, 4.0, 6.0, 7.9}) {
    EXPECT_EQ(asked(distance, true).option->name, "kick_soft") << distance;
    EXPECT_DOUBLE_EQ(asked(distance, true).aim.distance, distance);
  }
  EXPECT_EQ(asked(8.1, true).option->name, "kick_far");  // 1.9 m too far instead of 2.1 m too short
  for (const double distance : {2.0, 4.0, 8.0}) EXPECT_EQ(asked(distance, false).option->name, "kick_far");
}

TEST(KickChoice, ChipsAreForThoseWhoAskForOne) {
  const Kicks kicks(
      "skill kick_low { kick { ball (0.2m, 5cm) within (3cm, 2cm) distance 3m..12m contact 0.3s "
      "from walk } }\n"
      "skill kick_over { kick { ball (0.2m, 5cm) within (3cm, 2cm) distance 2m..5m clears 0.7m "
      "within 4m contact "
      "0.3s from walk } }");
  KickControl control(kicks.catalogue, KickParameters{});
  KickTo kick;
  kick.ball = {0.2, 0.05};
  kick.target = {2.2, 0.05};
  EXPECT_EQ(control.update(kick, kicks.walk, 0.0).option->name, "kick_low") << "a metre too far";
  kick.kick = std::string_view("kick_over");
  EXPECT_EQ(control.update(kick, kicks.walk, 0.0).option->name, "kick_over");
}

TEST(KickChoice, ExactKicksAreForThoseWhoAskForOne) {
  const Kicks kicks(
      "skill kick_exact { kick { ball (0.2m, 5cm) within (3cm, 2cm) for 0.1s distance 3m..14m contact 0.3s "
      "room 2m from walk } }\n"
      "skill kick_plain { kick { ball (0.2m, 5cm) within (3cm, 2cm) distance 3m..5m contact 0.3s "
      "from walk } }");
  KickControl control(kicks.catalogue, KickParameters{});
  KickTo kick;
  kick.ball = {0.2, 0.05};
  kick.target = {14.2, 0.05};
  EXPECT_EQ(control.update(kick, kicks.walk, 0.0).option->name, "kick_plain") << "nine metres too short";
  kick.kick = std::string_view("kick_exact");
  kick.room = 1.9;
  EXPECT_EQ(control.update(kick, kicks.walk, 0.0).option, nullptr) << "somebody is near";
  kick.room = 2.1;
  EXPECT_EQ(control.update(kick, kicks.walk, 0.0).option->name, "kick_exact");
  kick.room = 1.9;
  EXPECT_EQ(control.update(kick, kicks.walk, 0.0).option->name, "kick_exact")
      << "not broken off for a little";
  kick.room = 1.5;
  EXPECT_EQ(control.update(kick, kicks.walk, 0.0).option, nullptr);
}

// Ten metres straight ahead of a ball that lies before the left foot.
KickTo straightKick() {
  KickTo kick;
  kick.ball = {0.2, 0.05};
  kick.target = {10.0, 0.05};
  return kick;
}

// For such a ball, wherever else about there it seems to lie.
constexpr const char* kOutOfTheWalk =
    "skill kick_k { kick { ball (0.2m, 5cm) within (9cm, 9cm) distance 3m..14m contact 0.3s from walk } }";

// On the spot, up to the end of a step that stands on this foot.
void stepUntilItStandsOn(Side foot, WalkEngine& walk, double pitch = 0.0, double speed = 0.0,
                         double aside = 0.0) {
  world::BodyState body;
  body.cycleTime = kCycleTime;
  body.pitch = pitch;
  WalkCommand command;
  command.walk = true;
  command.speed = Pose2(speed, aside, 0.0);
  JointTargets targets;
  for (int i = 0;
       i < 200 && (i < 20 || walk.standing() || walk.gait().stance != foot || walk.gait().phase < 1.0 - 1e-6);
       ++i)
    walk.update(body, WalkParameters{}, command, targets);
}

TEST(KickChoice, AKickOutOfTheWalkBeginsWhereAStepEndsAndNotFromAStand) {
  Kicks kicks(
      "skill kick_k { kick { ball (0.2m, 5cm) within (3cm, 3cm) distance 3m..14m contact 0.3s from walk } }");
  const KickTo kick = straightKick();
  KickControl control(kicks.catalogue, KickParameters{});
  EXPECT_TRUE(control.update(kick, kicks.walk, 1.0).inPlace);
  EXPECT_FALSE(control.update(kick, kicks.walk, 1.0).begin) << "stands";
  stepUntilItStandsOn(Side::Right, kicks.walk);
  EXPECT_FALSE(control.update(kick, kicks.walk, 0.0).begin) << "on the other foot";
  stepUntilItStandsOn(Side::Left, kicks.walk);
  const KickStep now = control.update(kick, kicks.walk, 0.0);
  ASSERT_EQ(now.option->foot, Side::Left);
  EXPECT_TRUE(now.begin);
}

// Out of steps aside the foot passes the ball; it may come as slowly as it can be hit, or roll away.
TEST(KickChoice, AKickOutOfTheWalkBeginsNeitherOutOfStepsAsideNorAtABallThatComes) {
  const auto begins = [](double aside, double rolling, const KickParameters& parameters) {
    Kicks kicks(kOutOfTheWalk);
    stepUntilItStandsOn(Side::Left, kicks.walk, 0.0, 0.0, aside);
    KickControl control(kicks.catalogue, parameters);
    KickTo kick = straightKick();
    kick.ballVelocity = {rolling, 0.0};
    return control.update(kick, kicks.walk, 0.0).begin;
  };
  const KickParameters p;
  KickParameters any;
  any.asidePace = any.comes = any.strideSpeed = 3.0;
  for (const double side : {-1.0, 1.0}) {
    EXPECT_FALSE(begins(side * 3.0 * p.asidePace, 0.0, p));
    EXPECT_TRUE(begins(side * 3.0 * p.asidePace, 0.0, any));
  }
  EXPECT_TRUE(begins(0.0, 0.0, p));
  EXPECT_FALSE(begins(0.0, -1.1 * p.comes, p));
  EXPECT_TRUE(begins(0.0, -1.1 * p.comes, any));
  EXPECT_TRUE(begins(0.0, -0.9 * p.comes, p));
  EXPECT_TRUE(begins(0.0, 1.1 * p.comes, p));
}

// It begins once the ball has lain about in its place, within twice the tolerance, for so long.
TEST(KickChoice, AKickThatIsToBeExactWaitsUntilTheBallHasLainInItsPlace) {
  Kicks kicks(
      "skill kick_exact { kick { ball (0.2m, 5cm) within (5mm, 5mm) for 0.1s direction 0deg within 4deg "
      "distance 3m..14m contact 0.3s from walk } }");
  stepUntilItStandsOn(Side::Left, kicks.walk);
  KickControl control(kicks.catalogue, KickParameters{});
  const auto begins = [&](double ahead, double turn = 0.0) {
    KickTo kick;
    kick.ball = {ahead, 0.05};
    kick.target = kick.ball + 10.0 * unitVector(turn);
    kick.kick = std::string_view("kick_exact");
    return control.update(kick, kicks.walk, 1.0).begin;
  };
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(begins(0.2)) << "cycle " << i;
  EXPECT_FALSE(begins(0.208)) << "not in its place, but the time goes on";
  EXPECT_TRUE(begins(0.2));
  EXPECT_TRUE(begins(0.2));
  EXPECT_FALSE(begins(0.215));
  EXPECT_FALSE(begins(0.2)) << "the time begins anew";
  for (int i = 0; i < 5; ++i) begins(0.2);
  EXPECT_FALSE(begins(0.2, toRadians(6.0)))
      << "its head wants the direction within less than motion.kick.angle";
  EXPECT_TRUE(begins(0.2, toRadians(3.0)));
}

// Steps on the spot say a speed ahead that leads nowhere: with it left out, the same steps seem to end nearer
// to the robot, and it walks on.
TEST(KickChoice, AnExactKickLeavesOutWhatStepsSayAndDoNotGo) {
  const auto stepsAhead = [](const std::string& within, double drift) {
    const std::string text = "skill kick_k { kick { ball (0.2m, 5cm) within " + within +
                             " distance 3m..14m contact 0.3s from walk } }";
    const Kicks kicks(text.c_str());
    KickParameters parameters;
    parameters.drift = drift;
    KickControl control(kicks.catalogue, parameters);
    KickTo kick;
    kick.ball = {0.21, 0.05};
    kick.target = {10.0, 0.05};
    kick.kick = std::string_view("kick_k");
    return control.update(kick, kicks.walk, 0.0).walk.velocity.translation.x();
  };
  const KickParameters p;
  EXPECT_NEAR(stepsAhead("(5mm, 5mm) for 0.1s", 0.07) - stepsAhead("(5mm, 5mm) for 0.1s", 0.0),
              p.gain * p.coast * 0.07, 1e-9);
  EXPECT_DOUBLE_EQ(stepsAhead("(5mm, 5mm)", 0.07), stepsAhead("(5mm, 5mm)", 0.0));
}

TEST_F(Control, KeepsItsChoiceThroughSmallChanges) {
  EXPECT_EQ(step(request({0.2, 0.01}, {5.0, 0.0})).option->foot, Side::Left);
  EXPECT_EQ(step(request({0.2, -0.01}, {5.0, 0.0})).option->foot, Side::Left);
  EXPECT_EQ(step(request({0.2, -0.09}, {5.0, 0.0})).option->foot, Side::Right);
}

TEST_F(Control, BeginsWhenTheBallLiesRightAndTheRobotIsQuiet) {
  const KickTo there = request({0.21, 0.045}, {5.0, 0.3});
  EXPECT_TRUE(step(there, 0.0).inPlace);
  EXPECT_FALSE(step(there, 0.0).begin);
  const KickStep now = step(there, 1.0);
  EXPECT_TRUE(now.begin);
  EXPECT_TRUE(now.aim.ball.isApprox(there.ball));
  EXPECT_FALSE(step(request({0.26, 0.05}, {5.0, 0.0}), 1.0).begin);
  EXPECT_FALSE(step(request({0.2, 0.05}, {5.0, 2.0}), 1.0).begin);
}

// kick_b sends the ball 90 degrees to the left, or up to 20 more or less.
TEST_F(Control, SendsTheBallAsideWithinWhatTheHeadDeclares) {
  const auto aimed = [&](double degrees) {
    control_.reset();
    KickTo kick = request({0.1, 0.06}, 2.5 * unitVector(toRadians(degrees)));
    kick.kick = std::string_view("kick_b");
    return step(kick, 1.0);
  };
  EXPECT_TRUE(aimed(90.0).begin);
  EXPECT_NEAR(aimed(107.0).aim.turn, toRadians(17.0), 1e-12);
  EXPECT_TRUE(aimed(107.0).begin);
  EXPECT_NEAR(aimed(73.0).aim.turn, -toRadians(17.0), 1e-12);
  EXPECT_TRUE(aimed(73.0).begin);
  EXPECT_FALSE(aimed(113.0).begin);
}

// Where a rolling ball will be when the foot meets it decides, not where it is.
TEST_F(Control, ReckonsWithTheBallsRoll) {
  KickTo kick = request({0.3, 0.05}, {5.0, 0.0});
  kick.ballVelocity = Vector2(-0.1 / (0.3 + 2 * kCycleTime), 0.0);
  const KickStep now = step(kick, 1.0);
  EXPECT_TRUE(now.begin);
  EXPECT_NEAR(now.aim.ball.x(), 0.2, 1e-9);
}

// With the same place of the ball, the steps go along with it and on to where it rolls.
TEST_F(Control, TheLastStepsFollowARollingBall) {
  const auto ahead = [&](double rolling) {
    KickTo kick = request({0.25, 0.05}, {5.0, 0.0});  // near: below the fastest steps
    kick.ballVelocity = Vector2(rolling, 0.0);
    return step(kick, 1.0).walk.velocity.translation.x();
  };
  EXPECT_GT(ahead(0.1), ahead(0.0) + 0.4 * 0.1);
  EXPECT_LT(ahead(-0.1), ahead(0.0) - 0.4 * 0.1);
}

// A point robot that walks as it is told, with a drift such as small steps have.
TEST_F(Control, TheLastStepsLeadToTheBeginFromAnywhere) {
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const Vector2 ball(random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0));
    const Vector2 target(10.0, 0.0);
    Pose2 robot(ball.x() - random.uniform(0.3, 0.8), ball.y() + random.uniform(-0.4, 0.4),
                random.uniform(-1.0, 1.0));
    const double way = random.uniform(-kPi, kPi);
    const Vector2 drift = 0.13 * kCycleTime * Vector2(std::cos(way), std::sin(way));
    control_.reset();
    bool began = false;
    for (int cycle = 0; cycle < 500 && !began; ++cycle) {
      KickTo kick;
      kick.ball = robot.inverse() * ball;
      kick.target = robot.inverse() * target;
      const KickStep now = step(kick, 1.0);
      began = now.begin;
      const Pose2& speed = now.walk.velocity;
      robot = robot * Pose2(kCycleTime * speed.translation + drift, kCycleTime * speed.rotation);
    }
    EXPECT_TRUE(began) << "trial " << trial;
  }
}

// A point robot with its ball to be behind: from all around it turns away from the ball before it comes near,
// and backs up to its place without overrunning the ball.
TEST(KickControl, ComesToABallBehindWithoutTouchingIt) {
  const SkillLibrary library(parseSkills(
      "skill kick_back { kick { ball (-0.15m, 5cm) within (35mm, 30mm) direction 180deg within 15deg "
      "distance 1m..3m contact 0.7s from stand } }",
      "test.skl"));
  const KickCatalogue catalogue(library, 0);
  const WalkEngine walk(model::robotModel(0));  // it stands: the steps look ahead by nothing
  const Vector2 ball(1.0, 2.0), target(4.0, 2.0);
  const Vector2 fastest(0.5, 0.3);  // m/s
  for (int bearing = -80; bearing <= 80; bearing += 20) {
    KickControl control(catalogue, KickParameters{});
    const double heading = toRadians(bearing);
    Pose2 X_WR(ball - 0.5 * unitVector(heading), heading);
    KickStep step;
    double nearest = 1.0;
    double time = 0.0;
    for (; time < 5.0 && !step.begin; time += kCycleTime) {
      KickTo request;
      request.ball = X_WR.inverse() * ball;
      request.target = X_WR.inverse() * target;
      step = control.update(request, walk, step.inPlace ? 1.0 : 0.0);
      const Pose2& v = step.walk.velocity;
      const Vector2 way = kCycleTime * v.translation.cwiseMax(-fastest).cwiseMin(fastest);
      X_WR = X_WR * Pose2(way, kCycleTime * std::clamp(v.rotation, -2.0, 2.0));
      nearest = std::min(nearest, (X_WR.translation - ball).norm());
    }
    EXPECT_LT(time, 4.0) << bearing;
    EXPECT_TRUE(step.begin) << bearing;
    EXPECT_GT(nearest, 0.12) << bearing;
    const Vector2 way = X_WR.rotate(Vector2(-1.0, 0.0));
    EXPECT_GT(way.x(), std::cos(toRadians(15.0))) << bearing;  // its back to the target
  }
}

// Slow because it was hit: its torso sees the ball elsewhere than its feet have it.
TEST(KickChoice, NoKickBeginsWhileTheRobotStumbles) {
  Kicks kicks(kOutOfTheWalk);
  const KickTo kick = straightKick();
  for (const double pitch : {0.0, 0.3}) {
    KickControl control(kicks.catalogue, KickParameters{});
    stepUntilItStandsOn(Side::Left, kicks.walk, pitch);
    EXPECT_EQ(control.update(kick, kicks.walk, 0.0).begin, pitch == 0.0) << pitch;
  }
}

// A cycle that took twice as long does not make the robot twice as fast.
TEST(KickChoice, ALostMessageDoesNotChangeWhatAKickIsTold) {
  const auto pace = [](double cycleTime) {
    Kicks kicks(kOutOfTheWalk);
    world::BodyState body;
    JointTargets targets;
    body.cycleTime = kCycleTime;
    for (int i = 0; i < 100; ++i)
      kicks.walk.update(body, WalkParameters{}, {.speed = Pose2(0.1, 0.0, 0.0), .walk = true}, targets);
    body.cycleTime = cycleTime;
    kicks.walk.update(body, WalkParameters{}, {.speed = Pose2(0.1, 0.0, 0.0), .walk = true}, targets);
    KickControl control(kicks.catalogue, KickParameters{});
    return control.update(straightKick(), kicks.walk, 0.0).aim.pace.x();
  };
  EXPECT_GT(pace(kCycleTime), 0.03);
  EXPECT_NEAR(pace(2.0 * kCycleTime), pace(kCycleTime), 1e-6);
}

// Out of steps back a swing is weak.
TEST(KickChoice, NoKickBeginsOutOfStepsBack) {
  Kicks kicks(kOutOfTheWalk);
  const KickTo kick = straightKick();
  for (const double speed : {-0.1, 0.1}) {
    KickControl control(kicks.catalogue, KickParameters{});
    kicks.walk.reset();
    stepUntilItStandsOn(Side::Left, kicks.walk, 0.0, speed);
    EXPECT_EQ(control.update(kick, kicks.walk, 0.0).begin, speed > 0.0) << speed;
  }
}

}  // namespace
}  // namespace nonet::motion
