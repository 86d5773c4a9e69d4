#include <cmath>

#include "nonet/team/behaviors.h"

namespace nonet::team {

std::optional<Action> dribble(const Situation& s) {
  if (!s.play) return std::nullopt;
  const BallPlay& play = *s.play;
  const BallHandlingParameters& p = s.parameters.ball;
  const bool aligned = play.behind > p.alignedBehind && std::abs(play.direction) < p.alignedAngle &&
                       std::abs(play.besides) < p.alignedAside;
  if (!aligned) return std::nullopt;
  const Pose2 through(play.ball + p.dribbleThrough * play.along, play.direction);
  Action action(motion::WalkTo{through, false}, "through the ball");
  action.reason.candidates = play.candidates;
  return action;
}

}  // namespace nonet::team
