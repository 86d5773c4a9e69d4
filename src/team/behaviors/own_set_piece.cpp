#include "nonet/team/behaviors.h"

#include "team/behaviors/take_place.h"

namespace nonet::team {

std::optional<Action> ownSetPiece(const Situation& s) {
  if (!s.setPlay || s.role == Role::OnBall) return std::nullopt;  // that is the ball itself: support
  return Action(takePlace(s, rolePlace(s)), s.role == Role::Stopper ? "receive" : "place of the role");
}

}  // namespace nonet::team
