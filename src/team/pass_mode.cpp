#include "nonet/team/pass_mode.h"

#include "nonet/team/behaviors.h"

namespace nonet::team {

namespace {

// As far as one can see: the referee, who knows better, refuses without harm.
bool refereeAgrees(const Situation& s) {
  const PassModeParameters& p = s.parameters.passMode;
  return s.phase() == world::Phase::PlayOn && s.world.ball.v_FB.head<2>().norm() < p.rolling &&
         s.play->ball.norm() < kPassModeReach && s.nearestOpponent > p.room;
}

}  // namespace

bool wantsPassMode(const Situation& s) {
  const PassModeParameters& p = s.parameters.passMode;
  if (!p.use || !s.play || s.play->use == KickUse::Never) return false;
  if (!refereeAgrees(s) || s.nearestOpponent > p.disturbed || shoot(s)) return false;
  Situation then = s;
  then.undisturbed = kPassModeTime;
  then.mayScore = false;
  return pass(then) || kick(then);
}

}  // namespace nonet::team
