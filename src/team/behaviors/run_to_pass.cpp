#include "nonet/team/behaviors.h"
#include "nonet/team/navigation.h"

#include "team/behaviors/take_place.h"

namespace nonet::team {

namespace {

// It has been told to this player, and the ball is not yet overdue; once it was kicked it goes there.
bool awaits(const Situation& s) {
  const world::PassReport& pass = s.world.pass;
  const PassParameters& p = s.parameters.pass;
  if (pass.receiver != s.world.game.unum || !world::isOpenPlay(s.phase())) return false;
  if (s.world.time > pass.thereAt + p.late) return false;
  if (s.world.time < pass.kickAt + p.late) return true;
  const Vector2 rest = s.forecast.at(s.parameters.pace.longestRoll);
  return (rest - pass.p_FTarget).norm() < p.strays;
}

}  // namespace

std::optional<Action> runToPass(const Situation& s) {
  if (!s.acts() || s.role == Role::Goalie || !awaits(s)) return std::nullopt;
  const Vector2 place = s.world.pass.p_FTarget;
  const Vector2 onward = (place - s.ball()).normalized();
  return Action(takePlace(s, place + s.parameters.pass.before * onward), "where the pass will be");
}

}  // namespace nonet::team
