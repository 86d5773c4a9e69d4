// The behaviours: each answers with an action when the situation calls for it, and with nothing otherwise.
// In src/team/behaviors/, a file for each or for two that go together; strategy.cpp orders them.
//
// They need the whole situation (situation.h) and remember nothing: the same situation gives the same action.
#pragma once

#include <optional>

#include "nonet/team/action.h"
#include "nonet/team/situation.h"

namespace nonet::team {

/// Goes to the place for the kick-off by beam, and waits there.
std::optional<Action> beforeKickOff(const Situation& situation);
/// Stands while there is nothing to decide: game over, a skill runs, the robot rises.
std::optional<Action> rest(const Situation& situation);
/// Looks around for a ball that nobody knows of.
std::optional<Action> searchBall(const Situation& situation);
/// Stands and looks around until it knows where it is.
std::optional<Action> findOneself(const Situation& situation);
/// Goalie: throws itself at a shot that it cannot walk to.
std::optional<Action> dive(const Situation& situation);
/// Own set piece: stands behind the ball until the receiver is in its place.
std::optional<Action> waitAtBall(const Situation& situation);
/// One's turn, the ball rolls and no opponent is near: to where it can be kicked once it has rolled out.
std::optional<Action> awaitBall(const Situation& situation);
/// One's turn, the ball rolls here: onto its line, facing it, and lets it come against the feet.
std::optional<Action> receive(const Situation& situation);
/// One's turn, from afar: to a place behind the ball as it will lie then.
std::optional<Action> goToBall(const Situation& situation);
/// One's turn, near, the goal can be hit: the last steps for the kick that does it, and the kick.
std::optional<Action> shoot(const Situation& situation);
/// One's turn, near, a mate can be first where it is worth more: the last steps for a pass, and the pass.
std::optional<Action> pass(const Situation& situation);
/// One's turn, near: the last steps to the place for a kick, and the kick.
std::optional<Action> kick(const Situation& situation);
/// One's turn, at the ball, an opponent is too: the last steps for a kick past it, and the kick.
std::optional<Action> kickAside(const Situation& situation);
/// One's turn, behind the ball: runs through it.
std::optional<Action> dribble(const Situation& situation);
/// One's turn, near but not behind the ball: around it.
std::optional<Action> goBehindBall(const Situation& situation);
/// Goalie: between ball and goal.
std::optional<Action> guardGoal(const Situation& situation);
/// The opponents take a kick: keeps the distance that the referee enforces, blocks the way to the own goal.
std::optional<Action> opponentSetPiece(const Situation& situation);
/// The own team takes a kick, another player takes it: receives, or stands in the formation.
std::optional<Action> ownSetPiece(const Situation& situation);
/// A pass to this player has been announced: to where it will be.
std::optional<Action> runToPass(const Situation& situation);
/// Stands in the place of one's role.
std::optional<Action> support(const Situation& situation);

/// Where the head goes unless a behaviour wants it elsewhere: to the ball, or all about if that is lost.
motion::HeadRequest lookAtBall(const world::WorldState& world);

}  // namespace nonet::team
