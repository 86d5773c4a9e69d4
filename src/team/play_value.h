// What an action with the ball is made of: who is first where, what stands in the way, how long a kick takes,
// what the ball is worth. Shared by the choices of ball_choice.cpp and pass.cpp.
#pragma once

#include "nonet/motion/skill.h"
#include "nonet/team/situation.h"

namespace nonet::team {

constexpr double kStopped = 0.3;    // probability that a ball which an opponent stops is ours all the same
constexpr double kContested = 0.5;  // that the ball is ours when a kick does not come off

/// Goals that the ball at p_F (own field frame, m) is worth when it is ours with this probability.
double valueAt(const Situation& situation, const Vector2& p_F, double ours);

/// s until this player is at p_F, going `pace` m/s; infinite for one that is not known.
double arrival(const world::PlayerState& player, const Vector2& p_F, double pace, double risingTime);

/// That we need `ours` and they `theirs` seconds, which may be infinite: the probability that we are first.
double probabilityFirst(double ours, double theirs, double spread);

/// The opponent that most likely stops a ball on its way: where, and with which probability any of them does.
struct Block {
  double probability = 0.0;
  Vector2 p_F = Vector2::Zero();
};

/// Of the ball on the straight way from where it lies.
Block blockOf(const Situation& situation, const Vector2& end);

/// Of a ball that is worth `free` unless it is stopped.
double valueUnlessStopped(const Situation& situation, const Block& block, double free);

/// s from now until the foot meets the ball in this kick, when the robot must face this direction for it
/// (rad, own field frame; docs/results.md, contact times).
double timeToContact(const Situation& situation, const motion::KickHead& kick, double direction);

/// s until an opponent plays the ball where it lies; infinite if none is known.
double timeLeftAtBall(const Situation& situation);

/// Of running on with the ball.
double dribbleValue(const Situation& situation);

}  // namespace nonet::team
