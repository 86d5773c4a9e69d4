#include "lab/trial/kicker.h"

#include <variant>

#include "nonet/math/direction.h"
#include "nonet/team/behaviors.h"

namespace nonet::lab {

Kicker::Kicker(const team::TeamParameters& parameters, const Vector2& p_FTarget, const std::string& kick)
    : parameters_(parameters), p_FTarget_(p_FTarget) {
  kick_.assign(kick);
}

team::Action Kicker::operator()(const world::WorldState& world, const motion::MotionState& state) {
  motion = state;
  if (!world.ball.known || !world.self.localized || state.busy || state.rising) return {};
  team::Situation situation = team::assess(world, parameters_, state);
  situation.play = team::playTowards(situation, p_FTarget_, team::KickUse::Clear);
  for (const auto& behavior : {team::goToBall, team::kick, team::goBehindBall}) {
    std::optional<team::Action> action = behavior(situation);
    if (!action) continue;
    if (auto* request = std::get_if<motion::KickTo>(&action->motion)) request->kick = kick_;
    action->head = team::lookAtBall(world);
    return *action;
  }
  return {};
}

KickGame kickGame(const agent::AgentConfig& agent, const KickScene& scene, Random& random) {
  // Where lines and goals are as far as anywhere on average.
  const Vector2 ball(random.uniform(-8.0, 4.0), random.uniform(-5.0, 5.0));
  const double heading = random.uniform(-0.7, 0.7);
  KickGame game;
  game.p_FTarget = ball + scene.distance * unitVector(heading);
  const double from = heading + scene.bearing;
  game.kicker = std::make_shared<Kicker>(agent.parameters.team, game.p_FTarget, scene.kick);
  const Mind mind = [kicker = game.kicker](const world::WorldState& world,
                                           const motion::MotionState& motion) {
    return (*kicker)(world, motion);
  };
  game.situation.players = {{agent, false, Pose2(ball - scene.start * unitVector(from), from), mind}};
  game.situation.ball = ball;
  const double way = random.uniform(-kPi, kPi);
  game.situation.ballVelocity =
      scene.rolling * random.uniform(0.0, 1.0) * unitVector(way) + scene.pushed * unitVector(heading);
  return game;
}

}  // namespace nonet::lab
