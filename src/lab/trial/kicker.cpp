#include "lab/trial/kicker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/team/behaviors.h"
#include "nonet/world/ball_law.h"

namespace nonet::lab {

namespace {

constexpr double kNearBall = 0.6;  // m, from where on motion can go around the ball by itself
constexpr double kAtFeet = 0.17;   // m, so far ahead of the robot a pass rolls out
constexpr double kSlides = 1.06;   // a ball that is put there slides first, and comes less far
constexpr double kPassOff = 0.1;   // m, and so far elsewhere
constexpr double kPassTurn = 0.3;  // rad, by which the robot that waits for it faces off the target

}  // namespace

Kicker::Kicker(const team::TeamParameters& parameters, const Vector2& p_FTarget, const KickScene& scene)
    : parameters_(parameters), p_FTarget_(p_FTarget), stops_(scene.stops), awaits_(scene.passed > 0.0) {
  kick_.assign(scene.kick);
}

bool Kicker::liesBehind() const {
  return std::any_of(motion.kicks.begin(), motion.kicks.end(), [&](const motion::KickOption& option) {
    return option.name == kick_.view() && option.head.isBackward();
  });
}

// The team's behaviours go behind the ball to face its target. For a kick to the rear motion does all of the
// last way.
team::Action Kicker::turnRound(const world::WorldState& world) const {
  motion::KickTo request;
  request.ball = world.ball.p_RB;
  request.ballVelocity = world.self.X_FR.inverse().rotate(world.ball.v_FB.head<2>());
  request.target = world.self.X_FR.inverse() * p_FTarget_;
  request.kick = kick_;
  request.stops = stops_;
  team::Action action(request, "turn round");
  action.head = team::lookAtBall(world);
  return action;
}

team::Action Kicker::operator()(const world::WorldState& world, const motion::MotionState& state) {
  motion = state;
  if (!world.ball.known || !world.self.localized || state.busy || state.rising) return {};
  if (liesBehind() && world.ball.p_RB.norm() < kNearBall) return turnRound(world);
  team::Situation situation = team::assess(world, parameters_, state);
  situation.play = team::playTowards(situation, p_FTarget_, team::KickUse::Clear);
  situation.play->kick = kick_.view();
  for (const auto& behavior : {team::awaitBall, team::goToBall, team::kick, team::goBehindBall}) {
    if (behavior == team::awaitBall && !awaits_) continue;
    std::optional<team::Action> action = behavior(situation);
    if (!action) continue;
    if (auto* request = std::get_if<motion::KickTo>(&action->motion)) request->stops = stops_;
    action->head = team::lookAtBall(world);
    return *action;
  }
  return {};
}

KickGame kickGame(const agent::AgentSettings& agent, const KickScene& scene, Random& random) {
  // Where lines and goals are as far as anywhere on average.
  const double across = random.uniform(-5.0, 5.0);
  const Vector2 ball(random.uniform(-8.0, 4.0), across);
  const double heading = random.uniform(-0.7, 0.7);
  KickGame game;
  game.p_FTarget = ball + scene.distance * unitVector(heading);
  const double from = heading + scene.bearing;
  game.kicker = std::make_shared<Kicker>(agent.parameters.team, game.p_FTarget, scene);
  const Mind mind = [kicker = game.kicker](const world::WorldState& world,
                                           const motion::MotionState& motion) {
    return (*kicker)(world, motion);
  };
  if (scene.passed > 0.0) {
    const Vector2 off(random.uniform(-kPassOff, kPassOff), random.uniform(-kPassOff, kPassOff));
    const Pose2 start(ball - kAtFeet * unitVector(heading) + off,
                      heading + random.uniform(-kPassTurn, kPassTurn));
    game.situation.players = {{agent, false, start, mind}};
    game.situation.ballVelocity = -scene.passed * unitVector(from);
    game.situation.ball = ball + scene.passed / (kSlides * world::kRollDecay) * unitVector(from);
    return game;
  }
  game.situation.players = {{agent, false, Pose2(ball - scene.start * unitVector(from), from), mind}};
  game.situation.ball = ball;
  const double way = random.uniform(-kPi, kPi);
  game.situation.ballVelocity =
      scene.rolling * random.uniform(0.0, 1.0) * unitVector(way) + scene.pushed * unitVector(heading);
  return game;
}

}  // namespace nonet::lab
