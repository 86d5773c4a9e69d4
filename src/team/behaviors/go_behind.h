// The way behind the ball, for whoever wants to play it.
#pragma once

#include "nonet/team/situation.h"

namespace nonet::team {

/// Around the ball to the place from which it goes where the play wants it.
Action goBehind(const Situation& situation, const BallPlay& play);

}  // namespace nonet::team
