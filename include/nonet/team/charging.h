// Charging fouls: who runs into an opponent is taken off the field for ten seconds (server facts 4.10).
#pragma once

#include <optional>

#include "nonet/team/situation.h"

namespace nonet::team {

/// The same way, but slowly, when the referee would call the contact with an opponent on it a charge, or when
/// it may touch one far from the ball, where there is nothing to win; nothing when the request may stay.
std::optional<motion::MotionRequest> spareOpponents(const Situation& situation,
                                                    const motion::MotionRequest& request);

}  // namespace nonet::team
