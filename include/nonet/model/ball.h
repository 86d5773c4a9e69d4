// The ball as the server has it (server facts 3.3).
#pragma once

namespace nonet::model {

inline constexpr double kBallRadius = 0.042;  // m

}  // namespace nonet::model
