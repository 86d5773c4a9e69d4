#include "nonet/team/behaviors.h"
#include "nonet/team/formation.h"

namespace nonet::team {

namespace {

// After a goal the team that conceded it kicks off; the left team has the kick-off of the first half, the
// right one that of the second.
bool ownKickOffNext(const world::GameState& game) {
  if (game.phase == world::Phase::OwnGoal) return false;
  if (game.phase == world::Phase::OpponentGoal) return true;
  const bool left = game.side == protocol::TeamSide::Left;
  const bool firstHalf = game.time < 1.0;
  return left == firstHalf;
}

}  // namespace

std::optional<Action> beforeKickOff(const Situation& s) {
  if (!s.waitsForKickOff()) return std::nullopt;
  Action action(motion::Stand{}, "wait");
  const world::GameState& game = s.world.game;
  if (game.unum == 0) return action;  // the server has not said yet who we are
  const TeamParameters& p = s.parameters;
  const Pose2 place = kickOffPose(game.unum, ownKickOffNext(game), s.world.field, p.setPlay);
  // Once at the beginning of the phase; again if we ended up elsewhere (pushed, or the first one came too
  // early), or lie there: a beam is the fastest way up.
  const double distance = (s.world.self.X_FR.translation - place.translation).norm();
  const bool wrong =
      world::isFallen(s.world.body.posture) || (s.world.self.localized && distance > p.beam.elsewhere);
  const bool again = wrong && s.world.time - s.lastBeam > p.beam.again;
  if (s.lastBeam >= game.phaseSince && !again) return action;
  action.beam = place;
  action.reason.detail = "beam";
  return action;
}

}  // namespace nonet::team
