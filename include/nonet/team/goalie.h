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

/// A ball that will be in the goal unless the goalie meets it: where it passes the robot, or under a lob
/// behind it, as far as it can step back.
struct ComingShot {
  double time = 0.0;    // s from now until it crosses the robot's lateral axis, or one so far behind it:
  double aside = 0.0;   // m along that axis, left positive
  double height = 0.0;  // m, of the ball's centre there
  double back = 0.0;    // m
};
std::optional<ComingShot> comingShot(const Situation& situation);

/// Where the goalie's own kicks go: out of the way of the goal, to the side on which the ball is, in the
/// middle to where the goalie faces; at a goal kick away from who waits for a push,
/// elsewhere not through a mate where the other side is free. Own field frame, m.
Vector2 clearanceTarget(const Situation& situation);

}  // namespace nonet::team
