#include "nonet/team/behaviors.h"

#include "team/behaviors/take_place.h"

namespace nonet::team {

std::optional<Action> ownSetPiece(const Situation& s) {
  if (!s.setPlay) return std::nullopt;
  return Action(takePlace(s, rolePlace(s)), s.role == Role::Stopper ? "receive" : "place of the role");
}

}  // namespace nonet::team
