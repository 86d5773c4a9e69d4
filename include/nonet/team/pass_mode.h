// Pass mode (server facts 4.9): who asks the referee for it has the ball to himself for four seconds or until
// the first touch, and cannot score for ten seconds until a team mate has touched the ball, too.
#pragma once

#include "nonet/team/situation.h"

namespace nonet::team {

constexpr double kPassModeTime = 4.0;     // s that opponents are kept off the ball
constexpr double kPassModeReach = 0.5;    // m from the ball to the one who asks
constexpr double kPassModeNoGoal = 10.0;  // s after pass mode in which the kicker alone cannot score

/// Whether to ask for it: an opponent is near enough to disturb, the goal cannot be hit, and there is a kick
/// or a pass that comes off if nobody disturbs.
bool wantsPassMode(const Situation& situation);

}  // namespace nonet::team
