// The ball as seen by the one who plays it: where it should go, and how the robot stands to it.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "nonet/motion/kick_catalogue.h"
#include "nonet/team/action.h"
#include "nonet/team/parameters.h"
#include "nonet/world/world_state.h"

namespace nonet::team {

/// When to kick instead of dribbling. A kick sends the ball seven metres in a second and a half, but the last
/// steps must go to the right place, which an opponent at the ball does not allow.
enum class KickUse : std::uint8_t {
  Never,
  IfFree,  // no opponent near the ball or in its way
  Clear,   // as soon as no opponent is near the ball
};

/// What a player is to do with the ball whatever the game asks of it: for drills, trials and learning. It
/// goes on by its own eyes.
struct BallIntent {
  Vector2 p_FTarget = Vector2::Zero();  // own field frame, m
  KickUse use = KickUse::Never;
  std::optional<double> keep{};  // m, dribbled at most so far from the torso; else as far as it rolls
};

struct BallPlay {
  Vector2 p_FTarget = Vector2::Zero();  // own field frame, m
  KickUse use = KickUse::Never;
  std::optional<double> keep;            // m, dribbled at most so far from the torso
  std::string_view kick;                 // this one only; empty: the cheapest
  bool wait = false;                     // stand ready behind the ball, but do not touch it yet
  Vector2 p_FMeeting = Vector2::Zero();  // where the ball will be when one comes there, own field frame, m

  std::span<const Candidate> candidates{};  // among which the target was chosen; empty unless recorded

  // Robot frame, m.
  Vector2 ball = Vector2::Zero();
  Vector2 target = Vector2::Zero();
  double direction = 0.0;  // that the robot should face, rad: the ball's way, unless the kick goes aside
  Vector2 along = Vector2::UnitX();
  Vector2 aside = Vector2::UnitY();  // to the left of `along`
  double behind = 0.0;               // how far the robot is behind the ball
  double besides = 0.0;              // the ball to the left of the line through the robot

  /// A place behind the ball as it will lie when one comes there, facing the target; own field frame.
  Pose2 placeBehind(double distance) const;

  /// `direction` and what follows from it.
  void face(double heading);
};

/// Where a dribbled ball should go from its present place: to the goal, around an opponent that stands in
/// the way. `present`: where it was to go until now, rad, own field frame. What it weighed is written to
/// `record` unless that is null.
Vector2 ballTarget(const world::WorldState& world, const BallTargetParameters& parameters,
                   const std::optional<double>& present = {}, Candidates* record = nullptr);

/// The probability that a ball that is sent this way (rad, own field frame) crosses the goal line between the
/// posts, with this standard deviation (rad) of its direction; if nobody stops it.
double hitsGoal(const world::WorldState& world, double direction, double spread);

/// A ball that is pushed this way leaves the field before it has rolled out, and not into the goal.
bool rollsOut(const world::WorldState& world, const BallTargetParameters& parameters, double direction);

/// How much the opponents near the ball bar this direction of it (rad, own field frame), 0 .. 1.
double barred(const world::WorldState& world, const BallTargetParameters& parameters, double direction);

/// How much of the way is free of opponents: the distance of the nearest one from it, at most `widest`, m.
/// Those that the kick's ball flies over do not count.
double laneWidth(const world::WorldState& world, const Vector2& from, const Vector2& to, double widest,
                 const motion::KickHead& kick = {});

/// The ball lies right before the own goal: whoever is there plays it at once.
bool atOwnGoal(const world::WorldState& world);

/// One of ours is in the way so near to the ball that no kick passes it.
bool mateBars(const world::WorldState& world, const Vector2& from, const Vector2& to);

/// The place in the goal, and the kick for it, that most likely ends there. Nothing if none may: too far, too
/// near for the ball to be low again, somebody in the way. `present`: where the shot under way goes, rad, own
/// field frame; thereabouts less is asked for.
struct Shot {
  Vector2 p_FTarget = Vector2::Zero();
  std::string_view kick;
};
std::optional<Shot> bestShot(const world::WorldState& world, std::span<const motion::KickOption> kicks,
                             const ShotParameters& parameters, const std::optional<double>& present = {});

}  // namespace nonet::team
