// What to do with the ball: every kick direction and the dribble, valued by where the ball then is and who is
// first there. Values are goals: what the ball is worth to us there, less what it is worth to the opponents
// if they get it.
//
//   V = P(nobody steps in the way) * [ P(we are first) * worth(end) - P(they are first) * worth'(end) ]
//
// for every kick of the catalogue with its own length and time, with worth falling exponentially with the
// distance from the goal, worth' the same for the other goal, and everything weighed with the probability
// that the kick comes off before an opponent is at the ball. A shot that crosses the line between the posts
// is worth a goal.
#pragma once

#include <optional>
#include <string_view>

#include "nonet/team/situation.h"

namespace nonet::team {

struct BallChoice {
  bool kick = false;                    // otherwise dribble
  Vector2 p_FTarget = Vector2::Zero();  // where the ball is to go, own field frame, m
  double value = 0.0;
  std::string_view with;  // name of the kick
};

/// The best thing to do with an own set piece: the pass to the one who stands next to it, or a kick to where
/// one of us is first. Nobody can disturb it. Candidates are written to `record` unless it is null.
BallChoice chooseSetPiece(const Situation& situation, Candidates* record = nullptr);

/// The best thing to do for the one whose turn it is; candidates are written to `record` unless it is null.
BallChoice chooseAction(const Situation& situation, Candidates* record = nullptr);

/// The direction of the ball's way in the kick that motion was asked for last, rad, own field frame.
std::optional<double> presentKick(const Situation& situation);

/// A kick in this direction is the `present` one, if there is any; rad, own field frame.
bool isSameKick(const std::optional<double>& present, double direction);

/// s until an opponent can be at p_F; one that lies rises first. Infinite if none is known.
double opponentsTime(const Situation& situation, const Vector2& p_F);

/// s until one of our field players can be at p_F, likewise; but for the taker of a set piece.
double teammatesTime(const Situation& s, const Vector2& p_F);

/// Goals that a ball of ours at p_F is worth.
double worthOf(const Vector2& p_F, const world::FieldGeometry& field, const ChoiceParameters& parameters);

/// What a kick in this direction (rad, own field frame) that carries `length` metres is worth once it leaves
/// the foot, as if it came off for certain. Whether a ball that crosses the goal line counts.
double kickValue(const Situation& situation, double direction, double length, bool mayScore = true);

}  // namespace nonet::team
