// A scene on the field for tests of the team: what one robot believes, and what it decides.
#pragma once

#include <array>

#include "nonet/team/behaviors.h"
#include "nonet/team/situation.h"
#include "nonet/team/strategy.h"

namespace nonet::team {

/// Number 5 in open play, at the centre spot, the ball a metre ahead; nobody else is known.
struct Scene {
  Scene() {
    world.time = 100.0;
    world.game.unum = 5;
    world.game.phase = world::Phase::PlayOn;
    world.self.localized = true;
    world.ball.known = true;
    world.ball.lastSeen = world.time;
    stand(Pose2());
    putBall({1.0, 0.0});
    static const std::array<motion::KickOption, 1> kicks = [] {
      motion::KickOption kick;
      kick.head.shortest = 3.0;
      kick.head.longest = 7.0;
      return std::array{kick};
    }();
    motion.kicks = kicks;  // the body can kick; how is its own business
  }
  void stand(const Pose2& X_FR) {
    world.self.X_FR = X_FR;
    put(world.teammates[static_cast<std::size_t>(world.game.unum)], X_FR);
    putBall(world.ball.p_FB.head<2>());
  }
  void putBall(const Vector2& place, const Vector2& speed = Vector2::Zero()) {
    world.ball.p_FB = Vector3(place.x(), place.y(), 0.0403);
    world.ball.v_FB = Vector3(speed.x(), speed.y(), 0.0);
    world.ball.p_RB = world.self.X_FR.inverse() * place;
  }
  static void put(world::PlayerState& player, const Pose2& pose) {
    player.known = player.headingKnown = true;
    player.X_FP = pose;
  }

  /// The situation of a player with this role; `play` follows from it.
  Situation situation(Role role) const {
    Situation situation = assess(world, parameters, motion);
    situation.role = role;
    situation.onBall = role == Role::OnBall ? world.game.unum : 0;
    situation.claims = role == Role::Goalie && goalieWantsBall(situation, false);
    situation.play = ownTurn(situation);
    return situation;
  }
  Action decideAs(Role role) const { return decide(situation(role)); }

  /// Near the ball: what the one whose turn it is asks of the body.
  motion::MotionRequest handleBall(const Vector2& p_FTarget, KickUse use) const {
    Situation situation = assess(world, parameters, motion);
    situation.play = playTowards(situation, p_FTarget, use);
    for (const auto& behavior : {shoot, kick, dribble, goBehindBall})
      if (const auto action = behavior(situation)) return action->motion;
    return motion::Stand{};
  }

  world::WorldState world;
  TeamParameters parameters;
  motion::MotionState motion;
};

/// Where the request leads from the robot's place, own field frame, m.
inline Vector2 goalOf(const Scene& scene, const Action& action) {
  const auto* walk = std::get_if<motion::WalkTo>(&action.motion);
  return scene.world.self.X_FR * (walk != nullptr ? walk->target.translation : Vector2(0.0, 0.0));
}

}  // namespace nonet::team
