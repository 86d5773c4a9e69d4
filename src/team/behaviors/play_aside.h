// Kicks to the side for who does not face the ball's way: less to turn, so they come off sooner.
#pragma once

#include <optional>
#include <string_view>

#include "nonet/team/situation.h"

namespace nonet::team {

/// How far the kick of that name takes the ball in play, the longest of all for an empty name, m.
double kickLength(const Situation& situation, std::string_view kick);

/// s until the foot meets the ball in the play's kick; if it names none, in the soonest straight one.
double contactTime(const Situation& situation, const BallPlay& play);

/// The same play with a kick to the side, if the time until contact, and the distance that it goes less far,
/// cost less than with any straight kick, or if the straight ones are out of question. Of a play that names
/// its kick only that one counts.
std::optional<BallPlay> playAside(const Situation& situation, const BallPlay& straight, bool mayStraight);

}  // namespace nonet::team
