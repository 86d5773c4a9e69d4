// The approach as a kinematic scenario: a point robot that follows the requests at walking speed must bring
// itself behind the ball without touching it, then drive it towards the target, from any start.
#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include <gtest/gtest.h>

#include "nonet/math/direction.h"
#include "nonet/math/random.h"
#include "nonet/team/behaviors.h"

#include "scene.h"

namespace nonet::team {
namespace {

struct Outcome {
  bool pushed = false;
  double pushError = 0.0;  // angle between the first push and the wanted direction
};

Outcome approach(const Pose2& start, const Vector2& ball, const Vector2& target) {
  Scene scene;
  world::WorldState& world = scene.world;
  scene.stand(start);
  scene.putBall(ball);
  for (int cycle = 0; cycle < 2000; ++cycle) {
    world.ball.p_RB = world.self.X_FR.inverse() * ball;
    const auto request = std::get<motion::WalkTo>(scene.handleBall(target, KickUse::Never));
    const double distance = request.target.translation.norm();
    const double step = std::min(0.01, distance);  // 0.5 m/s
    const Vector2 move =
        distance > 1e-9 ? Vector2(request.target.translation * (step / distance)) : Vector2::Zero();
    const double turn = std::clamp(request.target.rotation, -0.03, 0.03);
    world.self.X_FR = world.self.X_FR * Pose2(move, turn);
    const Vector2 offset = world.self.X_FR.inverse() * ball;
    if (offset.norm() < 0.14) {  // the feet reach the ball
      const Vector2 way = target - ball;
      const Vector2 push = world.self.X_FR.rotate(move);
      return {true, std::abs(angleDifference(std::atan2(push.y(), push.x()), std::atan2(way.y(), way.x())))};
    }
  }
  return {};
}

TEST(PlayBall, FirstTouchIsTowardsTheTargetFromAnyStart) {
  Random random(5);
  int good = 0;
  const int trials = 400;
  for (int trial = 0; trial < trials; ++trial) {
    const Vector2 ball(random.uniform(-8, 8), random.uniform(-6, 6));
    const double angle = random.uniform(-kPi, kPi);
    const double distance = random.uniform(0.4, 4.0);
    const Pose2 start(ball.x() + distance * std::cos(angle), ball.y() + distance * std::sin(angle),
                      random.uniform(-kPi, kPi));
    const Outcome outcome = approach(start, ball, Vector2(15.0, 0.0));
    if (outcome.pushed && outcome.pushError < 0.7) ++good;
  }
  EXPECT_GE(good, trials * 95 / 100) << good << " of " << trials;
}

// Small steps of a real walk lead somewhere else, or nowhere: here it drifts with 0.13 m/s.
bool comesToKick(const Pose2& start, const Vector2& ball, const Vector2& target, const Vector2& drift) {
  Scene scene;
  world::WorldState& world = scene.world;
  scene.stand(start);
  scene.putBall(ball);
  for (int cycle = 0; cycle < 1000; ++cycle) {
    world.ball.p_RB = world.self.X_FR.inverse() * ball;
    const motion::MotionRequest request = scene.handleBall(target, KickUse::IfFree);
    if (std::holds_alternative<motion::KickTo>(request)) return true;
    Pose2 speed;
    if (const auto* velocity = std::get_if<motion::WalkVelocity>(&request)) speed = velocity->velocity;
    if (const auto* way = std::get_if<motion::WalkTo>(&request)) {
      speed.translation = 0.5 * way->target.translation.normalized();
      speed.rotation = std::clamp(way->target.rotation, -1.5, 1.5);
    }
    world.self.X_FR =
        world.self.X_FR * Pose2(kCycleTime * (speed.translation + drift), kCycleTime * speed.rotation);
  }
  return false;
}

TEST(PlayBall, ComesToItsKickAlsoWhenSmallStepsLeadElsewhere) {
  Random random(11);
  for (int trial = 0; trial < 200; ++trial) {
    const Vector2 ball(random.uniform(-8, 8), random.uniform(-6, 6));
    const Pose2 start(ball.x() - random.uniform(0.5, 2.0), ball.y() + random.uniform(-1.0, 1.0),
                      random.uniform(-1.0, 1.0));
    const double direction = random.uniform(-kPi, kPi);
    const Vector2 drift = 0.13 * Vector2(std::cos(direction), std::sin(direction));
    EXPECT_TRUE(comesToKick(start, ball, Vector2(15.0, 0.0), drift)) << "trial " << trial;
  }
}

// In its place behind a ball on the middle line, with one opponent on the field: does it ask for a kick?
bool kicksAtTheGoal(const TeamParameters& parameters, double ballX, const Vector2& opponent) {
  Scene scene;
  scene.parameters = parameters;
  scene.stand(Pose2(ballX - 0.25, 0.0, 0.0));
  scene.putBall({ballX, 0.0});
  Scene::put(scene.world.opponents[4], Pose2(opponent, kPi));
  return std::holds_alternative<motion::KickTo>(scene.handleBall({15.2, 0.0}, KickUse::IfFree));
}

// An opponent beside the ball forbids a kick, but not a shot with a free way.
TEST(PlayBall, ShootsWithAnOpponentBesideItIfTheWayIsFree) {
  const auto kicks = [](double ballX, const Vector2& opponent, double shotDistance) {
    TeamParameters parameters;
    parameters.shot.distance = shotDistance;
    return kicksAtTheGoal(parameters, ballX, opponent);
  };
  EXPECT_FALSE(kicks(10.0, {10.0, 0.8}, 0.0));
  EXPECT_TRUE(kicks(10.0, {10.0, 0.8}, 7.0));
  EXPECT_FALSE(kicks(5.0, {5.0, 0.8}, 20.0)) << "farther from the goal than the ball goes";
  EXPECT_FALSE(kicks(10.0, {10.0, 0.2}, 7.0)) << "no room";
}

motion::KickOption kickFor(const char* name, double longest) {
  motion::KickOption kick;
  kick.name = name;
  kick.head.shortest = 2.0;
  kick.head.longest = longest;
  return kick;
}

std::string kickOfShot(const world::WorldState& world, std::span<const motion::KickOption> kicks) {
  const std::optional<Shot> best = bestShot(world, kicks, {});
  return best ? std::string(best->kick) : "none";
}

TEST(PlayBall, ChipsOnlyOverSomebody) {
  world::WorldState world;
  world.ball.p_FB = Vector3(10.8, 0.0, 0.042);
  motion::KickOption chip = kickFor("chip", 5.0);
  chip.head.apex = 1.05;
  chip.head.apexAt = 1.8;
  chip.head.apexSpread = 0.15;
  chip.head.clears = 0.7;
  chip.head.lands = 4.0;
  const std::array kicks{chip, kickFor("low", 8.0)};
  EXPECT_EQ(kickOfShot(world, kicks), "low");
  for (const int unum : {4, 5, 6})
    Scene::put(world.opponents[static_cast<std::size_t>(unum)], Pose2(12.6, 0.5 * (unum - 5), kPi));
  EXPECT_EQ(kickOfShot(world, kicks), "chip") << "a wall of three where the ball is highest";
}

TEST(PlayBall, ShotsWithAKickThatNeedsRoomOrTimeAreForWhereNoOtherServes) {
  world::WorldState world;
  world.ball.p_FB = Vector3(8.0, 0.0, 0.042);
  motion::KickOption exact = kickFor("exact", 14.0);
  exact.head.room = 2.0;
  exact.head.steady = 0.5;
  const auto shot = [&](double longest) {
    return kickOfShot(world, std::array{exact, kickFor("plain", longest)});
  };
  EXPECT_EQ(shot(12.0), "plain");
  EXPECT_EQ(shot(6.0), "exact") << "the other one does not reach the goal";
  Scene::put(world.opponents[5], Pose2(6.5, 1.0, 0.0));
  EXPECT_EQ(shot(6.0), "none") << "somebody is at 1.8 m";
}

TEST(PlayBall, ShootsOverRobotsButNotOverTheBar) {
  world::WorldState world;
  world.ball.p_FB = Vector3(10.0, 0.0, 0.042);
  const motion::KickOption low = kickFor("low", 8.0);
  motion::KickOption high = kickFor("high", 12.0);
  high.head.apex = 1.2;
  high.head.apexAt = 2.8;
  high.head.apexSpread = 0.2;
  const auto shoots = [&](double ballX, const Vector2& opponent, const motion::KickOption& kick) {
    world.ball.p_FB.x() = ballX;
    Scene::put(world.opponents[4], Pose2(opponent, kPi));
    return bestShot(world, std::array{kick}, {}).has_value();
  };
  const Vector2 away(0.0, 9.0);
  EXPECT_TRUE(shoots(10.0, away, low));
  EXPECT_TRUE(shoots(10.0, away, high));
  EXPECT_FALSE(shoots(11.0, away, high)) << "over the bar";
  EXPECT_FALSE(shoots(7.0, away, low)) << "too far";
  EXPECT_TRUE(shoots(7.0, away, high));
  // A wall of three across the way.
  Scene::put(world.opponents[5], Pose2(12.0, 0.5, kPi));
  Scene::put(world.opponents[6], Pose2(12.0, -0.5, kPi));
  EXPECT_FALSE(shoots(10.0, {12.0, 0.0}, low));
  EXPECT_TRUE(shoots(10.0, {12.0, 0.0}, high)) << "it flies over them";
}

// Behind a ball before the goal, with a gap between two opponents, who was asked for this kick before.
bool shootsThrough(double gap, double behind, const motion::MotionRequest& before) {
  constexpr double kBall = 10.0;
  Scene scene;
  scene.stand(Pose2(kBall - behind, 0.0, 0.0));
  scene.putBall({kBall, 0.0});
  Scene::put(scene.world.opponents[4], Pose2(kBall + 1.2, 0.5 * gap, kPi));
  Scene::put(scene.world.opponents[5], Pose2(kBall + 1.2, -0.5 * gap, kPi));
  scene.motion.request = before;
  Situation situation = assess(scene.world, scene.parameters, scene.motion);
  situation.play = playTowards(situation, scene.world.field.theirGoal(), KickUse::IfFree);
  return shoot(situation).has_value();
}

// Opponents come nearer while the robot takes its last steps.
TEST(PlayBall, AShotUnderWayGoesOnThroughAGapThatCloses) {
  motion::KickTo straight;
  straight.ball = {0.25, 0.0};
  straight.target = {5.25, 0.0};
  motion::KickTo aside = straight;
  aside.target = straight.ball + 5.0 * unitVector(0.6);
  motion::KickTo pass = straight;
  pass.stops = true;
  EXPECT_TRUE(shootsThrough(0.6, 0.25, motion::Stand{}));
  EXPECT_FALSE(shootsThrough(0.4, 0.25, motion::Stand{}));
  EXPECT_TRUE(shootsThrough(0.4, 0.25, straight));
  EXPECT_FALSE(shootsThrough(0.3, 0.25, straight)) << "there are limits";
  EXPECT_FALSE(shootsThrough(0.4, 0.4, straight)) << "it is still some steps from the ball";
  EXPECT_FALSE(shootsThrough(0.4, 0.25, aside)) << "another kick";
  EXPECT_FALSE(shootsThrough(0.4, 0.25, pass)) << "another kick";
}

// An opponent straight ahead leaves both sides alike; who has begun to pass it on one side goes on there,
// until the other one is better by more than `keep`.
TEST(PlayBall, GoesAroundAnOpponentOnTheSideWhereItBegan) {
  world::WorldState world;
  world.ball.p_FB = Vector3(0.0, 0.0, 0.042);
  Scene::put(world.opponents[4], Pose2(0.4, 0.0, kPi));
  const BallTargetParameters p;
  for (const double side : {-1.0, 1.0}) {
    const double present = side * toRadians(45.0);
    const Vector2 kept = ballTarget(world, p, present);
    EXPECT_GT(side * kept.y(), 0.3);
    // The opponent takes a step to that side.
    world.opponents[4].X_FP.translation.y() = side * 0.01;
    EXPECT_GT(side * ballTarget(world, p, present).y(), 0.3);
    world.opponents[4].X_FP.translation.y() = side * 0.4;
    EXPECT_LT(side * ballTarget(world, p, present).y(), 0.3) << "now that side is barred";
    world.opponents[4].X_FP.translation.y() = 0.0;
  }
}

// Nothing but the place where a kick of 0.9 x 7 m ends is different.
TEST(PlayBall, KicksOnlyToWhereOneOfUsIsFirst) {
  const auto kicks = [](double ballX, const Vector2& opponent, double lead) {
    TeamParameters parameters;
    parameters.ball.kickLead = lead;
    return kicksAtTheGoal(parameters, ballX, opponent);
  };
  EXPECT_FALSE(kicks(-5.0, {1.3, 1.0}, 0.0)) << "it waits there";
  EXPECT_TRUE(kicks(-5.0, {1.3, 1.0}, -100.0)) << "nobody asks";
  EXPECT_TRUE(kicks(-5.0, {1.3, 9.0}, 0.0)) << "9 m at 0.6 m/s are longer than 6.5 m at 0.9";
  EXPECT_FALSE(kicks(-5.0, {1.3, 9.0}, 10.0)) << "but not by so much";
  EXPECT_TRUE(kicks(10.0, {14.5, 1.5}, 0.0)) << "a shot ends in the goal";
}

// A robot on the last steps to its kick does not ask again who will be first where the ball goes, and an
// opponent that comes up to it leaves less room than a kick needs that is only begun.
TEST(PlayBall, AKickThatIsLinedUpIsHeld) {
  const auto kicks = [](const motion::MotionRequest& before, const Vector2& opponent, double turned,
                        double hold) {
    Scene scene;
    scene.parameters.ball.kickHold = hold;
    scene.stand(Pose2(-5.25, 0.0, 0.0));
    scene.putBall({-5.0, 0.0});
    Scene::put(scene.world.opponents[4], Pose2(opponent, kPi));
    scene.motion.request = before;
    Situation s = assess(scene.world, scene.parameters, scene.motion);
    s.play = playTowards(s, s.ball() + 10.0 * unitVector(turned), KickUse::IfFree);
    const std::optional<Action> action = kick(s);
    return action && std::holds_alternative<motion::KickTo>(action->motion);
  };
  motion::KickTo lined;
  lined.ball = {0.25, 0.0};
  lined.target = {10.25, 0.0};
  const motion::Stand none;
  const Vector2 waits(1.3, 1.0);
  EXPECT_FALSE(kicks(none, waits, 0.0, 0.5)) << "an opponent is first where it ends";
  EXPECT_TRUE(kicks(lined, waits, 0.0, 0.5));
  EXPECT_FALSE(kicks(lined, waits, 0.0, 0.2)) << "some steps from the ball";
  const Vector2 comes(-4.2, 0.5);
  EXPECT_FALSE(kicks(none, comes, 0.0, 0.5));
  EXPECT_TRUE(kicks(lined, comes, 0.0, 0.5));
  EXPECT_FALSE(kicks(lined, {-4.7, 0.4}, 0.0, 0.5)) << "no room";
  EXPECT_FALSE(kicks(lined, waits, 0.6, 0.5)) << "quite another way";
  motion::KickTo pass = lined;
  pass.stops = true;
  EXPECT_FALSE(kicks(pass, waits, 0.0, 0.5)) << "another kick";
}

// From beside the goal a ball towards the far post crosses the line between the posts, but mostly misses.
TEST(PlayBall, AKickThatHardlyScoresIsNoShot) {
  const auto kicks = [](const Vector2& ball) {
    Scene scene;
    scene.parameters.shot.distance = 0.0;
    const Vector2 target(15.2, 0.2);
    const double direction = directionOf(target - ball);
    scene.stand(Pose2(ball - 0.25 * unitVector(direction), direction));
    scene.putBall(ball);
    return std::holds_alternative<motion::KickTo>(scene.handleBall(target, KickUse::IfFree));
  };
  EXPECT_TRUE(kicks({10.5, 2.5}));
  EXPECT_FALSE(kicks({13.5, 5.0}));
}

// Right before the own goal there is no time to go around the ball.
TEST(PlayBall, PushesTheBallAwayFromTheOwnGoalAsItStands) {
  const auto pushes = [](const Vector2& ball, double heading) {
    Scene scene;
    scene.parameters.ball.kick = false;
    scene.stand(Pose2(ball - 0.25 * unitVector(heading), heading));
    scene.putBall(ball);
    const Action action = scene.decideAs(Role::OnBall);
    return action.reason.behavior == std::string_view("dribble");
  };
  EXPECT_TRUE(pushes({-14.8, -0.4}, toRadians(-83.0))) << "past the post";
  EXPECT_FALSE(pushes({-14.8, 0.4}, toRadians(-83.0))) << "along before the goal";
  EXPECT_FALSE(pushes({-14.6, 0.0}, toRadians(-140.0))) << "into it";
  EXPECT_TRUE(pushes({-14.6, 0.0}, toRadians(60.0)));
  EXPECT_FALSE(pushes({0.0, -0.4}, toRadians(-83.0))) << "elsewhere there is";
}

// Straight ahead through the ball, from this place behind it: is it dribbled, and how far off is the next
// place?
struct Touch {
  bool dribbled = false;
  double apart = 0.0;  // m, of the place that the robot goes to from the ball
};
Touch touch(const Vector2& ball, double pushed, double heading) {
  Scene scene;
  scene.parameters.ball.kick = false;
  scene.stand(Pose2(ball - 0.2 * unitVector(pushed), heading));
  scene.putBall(ball);
  const Action action = scene.decideAs(Role::OnBall);
  return {action.reason.behavior == std::string_view("dribble"), (goalOf(scene, action) - ball).norm()};
}

TEST(PlayBall, DoesNotPushABallOutBesideTheGoal) {
  // The target lies 44 degrees to the right, the push leads 15 degrees: over the line at y = 1.25.
  const Vector2 ball(13.7, 1.6);
  const Touch out = touch(ball, toRadians(-15.0), toRadians(-30.0));
  EXPECT_FALSE(out.dribbled);
  EXPECT_NEAR(out.apart, BallHandlingParameters{}.standOff, 1e-6) << "not so near that the foot touches it";
  EXPECT_TRUE(touch(ball, toRadians(-35.0), toRadians(-30.0)).dribbled) << "this leads into the goal";
  EXPECT_TRUE(touch({0.0, 1.6}, toRadians(-8.0), toRadians(-6.0)).dribbled) << "no line is near";
}

TEST(PlayBall, KicksNothingOutOfTheField) {
  const auto kicks = [](const Vector2& ball, const Vector2& target) {
    Scene scene;
    scene.parameters.shot.distance = 0.0;
    const double direction = directionOf(target - ball);
    scene.stand(Pose2(ball - 0.25 * unitVector(direction), direction));
    scene.putBall(ball);
    return std::holds_alternative<motion::KickTo>(scene.handleBall(target, KickUse::IfFree));
  };
  EXPECT_TRUE(kicks({0.0, 4.0}, {2.0, 4.0}));
  EXPECT_FALSE(kicks({0.0, 4.0}, {0.0, 6.0})) << "6.3 m on is beyond the touch line";
  EXPECT_FALSE(kicks({10.0, 4.0}, {12.0, 4.0})) << "beside the goal";
  EXPECT_TRUE(kicks({10.0, 4.0}, {15.0, 0.0})) << "into the goal";
}

TEST(BallTarget, HitsTheGoalAsOftenAsBallsThatAreDrawn) {
  Random random(3);
  for (int trial = 0; trial < 40; ++trial) {
    world::WorldState world;
    const Vector2 ball(random.uniform(9.0, 14.8), random.uniform(-4.0, 4.0));
    world.ball.p_FB = Vector3(ball.x(), ball.y(), 0.042);
    const double spread = random.uniform(0.05, 0.3);
    const double direction = directionOf(Vector2(15.0, 0.0) - ball) + random.uniform(-0.4, 0.4);
    constexpr int kDraws = 20000;
    int hits = 0;
    for (int i = 0; i < kDraws; ++i) {
      const Vector2 way = unitVector(direction + spread * random.normal());
      if (way.x() <= 0.0) continue;
      hits +=
          std::abs(ball.y() + (15.0 - ball.x()) / way.x() * way.y()) < 0.5 * world.field.goalWidth ? 1 : 0;
    }
    EXPECT_NEAR(hitsGoal(world, direction, spread), static_cast<double>(hits) / kDraws, 0.012) << trial;
  }
}

// The oracle rolls the ball centimetre by centimetre.
TEST(BallTarget, RollsOutWhereItLeavesTheFieldFirst) {
  Random random(4);
  BallTargetParameters p;
  p.rollsOn = 2.0;
  int out = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    world::WorldState world;
    const Vector2 ball(random.uniform(-14.5, 14.9), random.uniform(-9.7, 9.7));
    world.ball.p_FB = Vector3(ball.x(), ball.y(), 0.042);
    const double direction = random.uniform(-kPi, kPi);
    bool rollsOutThere = false;
    for (double rolled = 0.0; rolled < p.rollsOn; rolled += 0.01) {
      const Vector2 at = ball + rolled * unitVector(direction);
      if (at.x() > 15.0) {
        rollsOutThere = std::abs(at.y()) > 0.5 * world.field.goalWidth - p.postMargin;
        break;
      }
      if (at.x() > -15.0 && std::abs(at.y()) < 10.0 - p.touchLineMargin) continue;
      rollsOutThere = true;
      break;
    }
    // Within a centimetre of a post or of the end of the way they may differ.
    const bool near = rollsOut(world, p, direction + 0.01) != rollsOut(world, p, direction - 0.01);
    const Vector2 end = ball + p.rollsOn * unitVector(direction);
    const bool edge = std::abs(std::abs(end.x()) - 15.0) < 0.02 || std::abs(std::abs(end.y()) - 9.8) < 0.02;
    if (near || edge) continue;
    EXPECT_EQ(rollsOut(world, p, direction), rollsOutThere) << ball.transpose() << " at " << direction;
    out += rollsOutThere ? 1 : 0;
  }
  EXPECT_GT(out, 200);
}

TEST(BallTarget, LiesInTheGoalOrBringsTheBallBackToTheMiddle) {
  const BallTargetParameters p;
  world::WorldState world;
  int brought = 0;
  for (double x = -15; x <= 15; x += 0.5) {
    for (double y = -10; y <= 10; y += 0.5) {
      world.ball.p_FB = Vector3(x, y, 0.042);
      const Vector2 target = ballTarget(world, p);
      if (x > 15.0 - p.cornerDepth && std::abs(y) > 1.05 + p.cornerAside) {
        EXPECT_EQ(target, Vector2(15.0 - p.cornerBack, 0.0)) << "from beside the goal, " << x << " " << y;
        ++brought;
      } else {
        EXPECT_GT(target.x(), 15.0) << x << " " << y;
        EXPECT_LT(std::abs(target.y()), 1.05) << x << " " << y;
      }
    }
  }
  EXPECT_EQ(brought, 72) << "18 on either side of the goal, in two rows";
}

// Close to the goal the ball goes where the goalie is not, on whichever side that is; never beside the goal.
TEST(BallTarget, AimsAtTheOpenPartOfTheGoal) {
  Random random(11);
  for (int trial = 0; trial < 500; ++trial) {
    world::WorldState world;
    const Vector2 ball(random.uniform(12.0, 13.5), random.uniform(-0.6, 0.6));
    world.ball.p_FB = Vector3(ball.x(), ball.y(), 0.042);
    world.self.X_FR = Pose2(ball.x() - 0.3, ball.y(), 0.0);
    world::PlayerState& goalie = world.opponents[1];
    goalie.known = true;
    const double side = random.uniform() < 0.5 ? -1.0 : 1.0;
    goalie.X_FP = Pose2(14.6, 0.55 * side, kPi);
    const Vector2 target = ballTarget(world, {});
    EXPECT_GT(target.x(), 15.0);
    EXPECT_LT(std::abs(target.y()), 0.5 * world.field.goalWidth - 0.2);
    EXPECT_LT(target.y() * side, 0.0)
        << "goalie at " << goalie.X_FP.translation.y() << ", ball at " << ball.y();
  }
}

TEST(PlayBall, DoesNotKickIntoAMateAtTheBall) {
  Scene scene;
  scene.putBall({0.5, 0.0});
  EXPECT_TRUE(std::holds_alternative<motion::KickTo>(scene.handleBall({15.0, 0.0}, KickUse::IfFree)));
  Scene::put(scene.world.teammates[7], Pose2(0.55, 0.1, 0.0));
  scene.world.teammates[7].fallen = true;
  EXPECT_FALSE(std::holds_alternative<motion::KickTo>(scene.handleBall({15.0, 0.0}, KickUse::IfFree)));
}

TEST(PlayBall, DoesNotShootAtAMateRightInFront) {
  Scene scene;
  scene.stand(Pose2(9.5, 0.0, 0.0));
  scene.putBall({10.0, 0.0});
  const auto shoots = [&] { return shoot(scene.situation(Role::OnBall)).has_value(); };
  EXPECT_TRUE(shoots());
  Scene::put(scene.world.teammates[7], Pose2(11.0, 0.0, 0.0));
  EXPECT_TRUE(mateBars(scene.world, {10.0, 0.0}, {15.0, 0.0}));
  EXPECT_FALSE(mateBars(scene.world, {10.0, 0.0}, {15.0, 2.0}));
  EXPECT_FALSE(mateBars(scene.world, {9.4, 0.0}, {15.0, 0.0})) << "it is far enough";
  EXPECT_FALSE(shoots());
  Scene::put(scene.world.teammates[7], Pose2(11.0, 0.6, 0.0));
  EXPECT_TRUE(shoots());
}

}  // namespace
}  // namespace nonet::team
