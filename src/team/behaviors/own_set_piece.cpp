#include <algorithm>

#include "nonet/team/behaviors.h"

#include "team/behaviors/take_place.h"

namespace nonet::team {

std::optional<Action> ownSetPiece(const Situation& s) {
  if (!s.setPlay) return std::nullopt;
  const bool receives = s.role == Role::Stopper;
  Vector2 place = receives ? s.setPlay->p_FReceiver : rolePlace(s);
  if (s.phase() == world::Phase::OwnKickOff)
    place.x() = std::min(place.x(), -s.parameters.setPlay.kickOffLine);
  return Action(takePlace(s, place), receives ? "receive" : "place of the role");
}

}  // namespace nonet::team
