#include "nonet/team/pass.h"

#include "nonet/team/behaviors.h"

#include "team/behaviors/kick_action.h"

namespace nonet::team {

namespace {

bool canPass(const Situation& s) {
  const PassParameters& p = s.parameters.pass;
  const BallHandlingParameters& ball = s.parameters.ball;
  if (!p.use || !ball.kick || !s.play || s.play->use != KickUse::IfFree) return false;
  if (!world::isOpenPlay(s.phase()) || s.world.ball.v_FB.head<2>().norm() > ball.kickRolling) return false;
  const auto* kick = std::get_if<motion::KickTo>(&s.motion.request);
  const bool under = kick != nullptr && kick->stops;
  // Another kick is not given up on its last steps for a pass that has yet to be lined up.
  if (kickUnderWay(s, ball.kickHold)) return false;
  const double share = s.motion.kickInPlace() ? ball.kickPress : under ? p.press : 1.0;
  return s.undisturbed > 0.0 || s.nearestOpponent >= share * p.room;
}

}  // namespace

std::optional<Action> pass(const Situation& s) {
  if (!canPass(s)) return std::nullopt;
  const std::optional<Pass> best = bestPass(s);
  if (!best) return std::nullopt;
  BallPlay play = playTowards(s, best->p_FTarget, s.play->use);
  play.kick = best->kick;
  Action action = kickAction(s, play, s.motion.kickInPlace() ? "in place" : "line up");
  std::get<motion::KickTo>(action.motion).stops = true;
  action.pass = PassAnnouncement{best->receiver, best->p_FTarget, s.world.time + best->untilKick,
                                 s.world.time + best->untilThere};
  return action;
}

}  // namespace nonet::team
