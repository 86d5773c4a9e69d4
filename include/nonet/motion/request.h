// What the team stage wants of the body, and what motion gives to joint control.
#pragma once

#include <cstdint>

#include "nonet/math/inline_string.h"
#include "nonet/math/pose2.h"
#include "nonet/model/joints.h"

namespace nonet::motion {

/// Which parameter set the walk uses; Automatic: by target and ball (walk_control.h).
enum class WalkSet : std::uint8_t { Automatic, GoToTarget, Sprint, Sidestep, Positioning };

/// Rising from a fall needs no request: motion does it by itself unless the request is Skill or Dive.
struct MotionRequest {
  enum class Kind : std::uint8_t {
    Stand,         // stable crouch
    WalkVelocity,  // `velocity`: m/s, m/s, rad/s in the robot frame; clamped to what the walk can do
    WalkTo,        // `target`: pose in the present robot frame; `stopAtTarget` or run through
    Skill,         // a named skill from skills/*.skl, to its end
    Kick,          // towards `target.translation` (robot frame) the ball that lies at `ball` (robot frame)
  };
  Kind kind = Kind::Stand;
  Pose2 velocity;
  Pose2 target;
  bool stopAtTarget = true;
  WalkSet set = WalkSet::Automatic;
  Vector2 ball = Vector2::Zero();
  InlineString<32> skill;
  model::Side side = model::Side::Left;  // mirror of the skill, kicking foot
};

struct HeadRequest {
  enum class Kind : std::uint8_t { Look, Point, Scan } kind = Kind::Scan;
  Vector3 p_RP = Vector3::Zero();  // Point: in the torso frame, m
  double pan = 0.0;                // Look: rad
  double tilt = 0.0;               // Look: rad, positive = down
};

/// Target angles for the next cycle, and how stiffly to follow them.
struct JointTargets {
  model::JointArray angles{};     // rad
  model::JointArray stiffness{};  // 0 = let go (speed 0 command), 1 = full gain
};

}  // namespace nonet::motion
