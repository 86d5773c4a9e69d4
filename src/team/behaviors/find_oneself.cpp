#include "nonet/team/behaviors.h"

namespace nonet::team {

std::optional<Action> findOneself(const Situation& s) {
  if (s.world.self.localized) return std::nullopt;
  return Action(motion::Stand{}, "lost");
}

}  // namespace nonet::team
