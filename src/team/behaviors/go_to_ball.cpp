#include <algorithm>
#include <variant>

#include "nonet/team/behaviors.h"
#include "nonet/team/navigation.h"

namespace nonet::team {

std::optional<Action> waitAtBall(const Situation& s) {
  if (!s.play || !s.play->wait) return std::nullopt;
  Caution caution;
  caution.robots = s.parameters.avoidDistance;
  caution.ball = s.parameters.ball.waitRoom;
  const bool notPut = ballNotPut(s.world);
  const double nearest = notPut ? kUntilPut : 0.0;
  caution.ball = std::max(caution.ball, nearest);
  const Pose2 place = s.play->placeBehind(std::max(s.parameters.ball.waitBehind, nearest));
  return Action(walkTo(s.world, s.parameters.navigation, place, caution),
                notPut ? "for the referee" : "for the receiver");
}

std::optional<Action> goToBall(const Situation& s) {
  if (!s.play || s.play->ball.norm() < s.parameters.ball.handleDistance) return std::nullopt;
  Caution caution;
  caution.robots = s.parameters.ball.wayRoom;
  caution.duel = true;
  const Pose2 place = s.play->placeBehind(s.parameters.ball.behindBall);
  Action action(walkTo(s.world, s.parameters.navigation, place, caution), "from afar");
  if (auto* walk = std::get_if<motion::WalkTo>(&action.motion)) walk->stopAtTarget = false;
  action.reason.candidates = s.play->candidates;
  return action;
}

}  // namespace nonet::team
