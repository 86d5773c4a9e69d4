// Kicks to the side for who does not face the ball's way, and how near opponents may be when one kicks. The
// oracle: how the robot stands, and a point robot that walks as it is asked to.
#include <array>
#include <optional>

#include <gtest/gtest.h>

#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/math/random.h"
#include "nonet/motion/kick_catalogue.h"

#include "scene.h"

namespace nonet::team {
namespace {

constexpr double kToSide = toRadians(60.0);
const Vector2 kTarget(9.0, 0.0);

// A robot with a kick straight on, and one 60 degrees to the side with either foot; the ball at (1, 0).
struct Turned : Scene {
  explicit Turned(const Pose2& X_FR) {
    motion::KickOption straight;
    straight.name = "straight";
    straight.head.p_RBall = {0.17, 0.03};
    straight.head.contact = 0.2;
    straight.head.fromWalk = true;
    straight.head.longest = 10.0;
    motion::KickOption side = straight;
    side.name = "side";
    side.head.direction = -kToSide;
    side.head.longest = 7.0;
    kicks = {straight, straight, side, side};
    kicks[1].foot = kicks[3].foot = model::Side::Right;
    kicks[1].head = motion::mirroredHead(straight.head);
    kicks[3].head = motion::mirroredHead(side.head);
    motion.kicks = kicks;
    parameters.shot.distance = 0.0;
    stand(X_FR);
  }
  // At this distance behind the ball as seen by who faces this way.
  static Pose2 behind(double distance, double heading) {
    return {Vector2(1.0, 0.0) - distance * unitVector(heading), heading};
  }
  // The name of the kick that is asked for, "" if any will do; nothing while the robot still walks.
  std::optional<std::string> asksFor() const {
    const motion::MotionRequest request = handleBall(kTarget, KickUse::Clear);
    const auto* kick = std::get_if<motion::KickTo>(&request);
    if (kick == nullptr) return std::nullopt;
    EXPECT_LT((world.self.X_FR * kick->target - kTarget).norm(), 1e-9) << "the ball's target stays";
    return std::string(kick->kick.view());
  }
  std::array<motion::KickOption, 4> kicks;
};

TEST(PlayAside, WhoFacesTheWayOfASideKickUsesIt) {
  EXPECT_EQ(Turned(Turned::behind(0.25, 0.0)).asksFor(), "");
  EXPECT_EQ(Turned(Turned::behind(0.25, kToSide)).asksFor(), "side");
  EXPECT_EQ(Turned(Turned::behind(0.25, -kToSide)).asksFor(), "side");
  EXPECT_EQ(Turned(Turned::behind(0.25, toRadians(15.0))).asksFor(), "")
      << "little to turn, three metres more";
}

TEST(PlayAside, OnlyTheKickThatIsNamed) {
  const auto kicks = [](double heading, const char* name) {
    const Turned scene(Turned::behind(0.25, heading));
    Situation situation = assess(scene.world, scene.parameters, scene.motion);
    situation.play = playTowards(situation, kTarget, KickUse::Clear);
    situation.play->kick = name;
    const std::optional<Action> action = kick(situation);
    return action && std::holds_alternative<motion::KickTo>(action->motion);
  };
  EXPECT_TRUE(kicks(kToSide, "side"));
  EXPECT_FALSE(kicks(kToSide, "straight")) << "it must go behind the ball first";
  EXPECT_TRUE(kicks(0.0, "straight"));
  EXPECT_FALSE(kicks(0.0, "side"));
}

TEST(PlayAside, OneInItsPlaceNeedsNoMoreRoomThanAStraightOne) {
  Turned scene(Turned::behind(0.17, kToSide));
  Scene::put(scene.world.opponents[3], Pose2(1.0, 0.0, 0.0) * Pose2(0.6, 0.0, 0.0));
  EXPECT_FALSE(scene.asksFor()) << "too near to begin";
  motion::KickTo last;
  last.kick.assign("side");
  scene.motion.request = last;
  scene.motion.kick.name = "side";
  scene.motion.kick.inPlace = true;
  EXPECT_EQ(scene.asksFor(), "side");
}

TEST(PlayAside, OneThatIsLinedUpForIsKept) {
  // Between the two, where the straight one would be chosen anew.
  const auto asksFor = [](double heading, bool lined) {
    Turned scene(Turned::behind(0.25, heading));
    motion::KickTo last;
    last.kick.assign("side");
    if (lined) scene.motion.request = last;
    return scene.asksFor();
  };
  int kept = 0;
  for (int degrees = 0; degrees <= 60; ++degrees) {
    const auto fresh = asksFor(toRadians(degrees), false);
    const auto lined = asksFor(toRadians(degrees), true);
    EXPECT_TRUE(fresh != "side" || lined == "side") << degrees;
    if (fresh == "" && lined == "side") ++kept;
  }
  EXPECT_GT(kept, 3);
}

// s until it asks for a kick, walking with 0.7 m/s and turning with 2.5 rad/s.
double timeToKick(const Pose2& start, double sideLoss) {
  Turned scene(start);
  scene.parameters.ball.sideLoss = sideLoss;
  const Vector2 ball = scene.world.ball.p_FB.head<2>();
  for (int cycle = 0; cycle < 500; ++cycle) {
    const motion::MotionRequest request = scene.handleBall(kTarget, KickUse::Clear);
    const auto* walk = std::get_if<motion::WalkTo>(&request);
    if (walk == nullptr) return cycle * kCycleTime;
    const double step = std::min(0.7 * kCycleTime, walk->target.translation.norm());
    const double most = 2.5 * kCycleTime;
    const Vector2 move = step * walk->target.translation.normalized();
    scene.world.self.X_FR =
        scene.world.self.X_FR * Pose2(move, std::clamp(walk->target.rotation, -most, most));
    scene.world.ball.p_RB = scene.world.self.X_FR.inverse() * ball;
  }
  return 500 * kCycleTime;
}

TEST(PlayAside, ComesOffSoonerFromInFrontOfTheBall) {
  Random random(3);
  constexpr double kNever = 10.0;
  double saved = 0.0;
  const int trials = 100;
  for (int i = 0; i < trials; ++i) {
    const double from = random.uniform(toRadians(100.0), toRadians(260.0));
    const Pose2 start = Turned::behind(0.8, from);
    const double aside = timeToKick(start, 0.1);
    const double straight = timeToKick(start, kNever);
    EXPECT_LT(straight, 9.0);
    saved += (straight - aside) / trials;
  }
  EXPECT_GT(saved, 0.2);
}

// In line an opponent may be nearer than for who must still go around the ball.
TEST(Kick, TheMoreTimeItTakesTheMoreRoomItNeeds) {
  const auto kicksAt = [](const Pose2& X_FR, double opponent) {
    Turned scene(X_FR);
    Scene::put(scene.world.opponents[4], Pose2(Vector2(1.0, opponent), 0.0));
    return scene.asksFor().has_value();
  };
  const Pose2 near = Turned::behind(0.2, 0.0);
  const Pose2 far = Turned::behind(0.85, 0.0);
  EXPECT_TRUE(kicksAt(near, 1.1));
  EXPECT_FALSE(kicksAt(near, 0.5));
  EXPECT_FALSE(kicksAt(far, 1.1));
  EXPECT_TRUE(kicksAt(far, 1.9)) << "nobody needs more room than kickOpponentDistance";
}

}  // namespace
}  // namespace nonet::team
