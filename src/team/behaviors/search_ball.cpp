#include "nonet/team/behaviors.h"

namespace nonet::team {

namespace {

constexpr double kOneSide = 3.0;  // s

}  // namespace

// Only once the head has had time to look around does the body turn; that of the goalie stays.
std::optional<Action> searchBall(const Situation& s) {
  if (s.world.ball.known) return std::nullopt;
  const SearchParameters& p = s.parameters.ballSearch;
  const bool turn = s.role != Role::Goalie && s.world.time - s.world.ball.lastSeen > p.headFirst &&
                    s.world.time - s.world.game.phaseSince > p.afterStart;
  if (!turn) return Action(motion::Stand{}, "head");
  // Towards the side on which it was last; once it has been looked for there, all round.
  const bool round = s.world.time - s.world.ball.lastSeen > p.headFirst + kOneSide;
  const double speed = round || s.world.ball.p_RB.y() >= 0.0 ? p.turnSpeed : -p.turnSpeed;
  Action action(motion::WalkVelocity{Pose2(0.0, 0.0, speed)}, "turn");
  action.head = motion::HeadRequest{};
  return action;
}

}  // namespace nonet::team
