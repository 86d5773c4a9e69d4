// What the team stage wants of the body, and what motion gives to joint control.
#pragma once

#include <cstdint>
#include <limits>
#include <variant>

#include "nonet/math/inline_string.h"
#include "nonet/math/pose2.h"
#include "nonet/model/joints.h"

namespace nonet::motion {

/// Which parameter set the walk uses; Automatic: by target and ball (walk/control.h).
enum class WalkSet : std::uint8_t { Automatic, GoToTarget, Sprint, Sidestep, Positioning, Dribble };

/// A stable crouch.
struct Stand {
  WalkSet set = WalkSet::Automatic;
  bool soon = false;  // out of steps that are small already: two steps earlier, less quietly
};

/// Walks with this speed: m/s, m/s, rad/s in the robot frame; clamped to what the walk can do.
struct WalkVelocity {
  Pose2 velocity;
  WalkSet set = WalkSet::Automatic;
};

/// Walks to a pose in the present robot frame, and stops there or runs through it. From afar it faces the
/// target, near it the target's heading; with `turnAtOnce` that heading from the beginning.
struct WalkTo {
  Pose2 target;
  bool stopAtTarget = true;
  WalkSet set = WalkSet::Automatic;
  bool turnAtOnce = false;
};

/// Plays a skill of skills/*.skl to its end. `side` Right mirrors it.
struct PlaySkill {
  InlineString<32> name;
  model::Side side = model::Side::Left;
  friend bool operator==(const PlaySkill&, const PlaySkill&) = default;
};

/// Kicks the ball that lies at `ball` to `target` (both in the present robot frame, m). Motion chooses kick
/// and foot, takes the last steps and begins when the ball lies right.
struct KickTo {
  Vector2 ball = Vector2::Zero();
  Vector2 target = Vector2::Zero();
  Vector2 ballVelocity = Vector2::Zero();                 // robot axes, m/s
  double room = std::numeric_limits<double>::infinity();  // m, from the ball to the nearest opponent
  bool stops = false;                                     // a pass: it is to come to rest there, not beyond
  InlineString<32> kick;                                  // this one only; empty: the cheapest
};

/// Rising from a fall needs no request: motion does it by itself unless a skill runs.
using MotionRequest = std::variant<Stand, WalkVelocity, WalkTo, PlaySkill, KickTo>;

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
