#include "nonet/team/behaviors.h"

namespace nonet::team {

std::optional<Action> rest(const Situation& s) {
  if (s.free()) return std::nullopt;
  const bool body = s.motion.busy || s.motion.rising;
  return Action(motion::Stand{}, body ? "the body is busy" : "no game");
}

}  // namespace nonet::team
