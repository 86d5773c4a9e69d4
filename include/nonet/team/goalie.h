// What the goalie's behaviours share (behaviors/guard_goal.cpp, dive.cpp): its place, and the shot
// that comes.
#pragma once

#include <optional>

#include "nonet/math/pose2.h"
#include "nonet/team/goalie_parameters.h"
#include "nonet/team/situation.h"

namespace nonet::team {

/// Where the goalie waits while the ball is at p_FB, facing it, and if there is room that far from it; own
/// field frame, m.
Pose2 guardPlace(const Vector2& p_FB, const world::FieldGeometry& field, const GoalieParameters& parameters,
                 double clear = 0.0);

/// A ball that will be in the goal unless the goalie meets it. It meets it where the ball crosses the robot's
/// lateral axis, or under a lob on a parallel line `back` behind the robot, to which it can step in time.
struct ComingShot {
  double time = 0.0;    // s from now until the ball crosses that line
  double aside = 0.0;   // m along the line, left positive
  double height = 0.0;  // m, of the ball's centre there
  double back = 0.0;    // m, of the line behind the robot
};
std::optional<ComingShot> comingShot(const Situation& situation);

/// Where the goalie's own kicks go: away from the goal, to the side on which the ball is, or from the middle
/// to the side that the goalie faces. A goal kick goes away from the mate that waits for a push; in play the
/// kick goes to the other side if a mate stands in its way and none there. Own field frame, m.
Vector2 clearanceTarget(const Situation& situation);

}  // namespace nonet::team
