// Everything the robot believes, as one plain value in the own team's field frame F (x to the opponent's
// goal). Each part carries the time of its last measurement and its uncertainty. Only `world` converts
// coordinates.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "nonet/math/pose2.h"
#include "nonet/math/types.h"
#include "nonet/protocol/percept.h"
#include "nonet/protocol/say_codec.h"
#include "nonet/world/body_state.h"

namespace nonet::world {

inline constexpr int kTeamSize = 11;
inline constexpr double kNever = -1e9;  // time stamp of what was never measured

struct FieldGeometry {
  double length = 30.0;       // m, goal line to goal line
  double width = 20.0;        // m
  double goalWidth = 2.1;     // m
  double goalDepth = 0.6;     // m
  double goalHeight = 0.8;    // m
  double areaLength = 1.8;    // m, penalty area from the goal line
  double areaWidth = 6.0;     // m
  double circleRadius = 2.0;  // m

  // In the own field frame: the opponent's goal line is at x = goalLine(), the touch lines at y =
  // +-touchLine().
  double goalLine() const { return 0.5 * length; }
  double touchLine() const { return 0.5 * width; }
  double post() const { return 0.5 * goalWidth; }
  Vector2 ownGoal() const { return {-goalLine(), 0.0}; }
  Vector2 theirGoal() const { return {goalLine(), 0.0}; }
  /// Whether a place is in the field, at least `margin` (m) from its lines.
  bool holds(const Vector2& p_F, double margin = 0.0) const {
    return std::abs(p_F.x()) < goalLine() - margin && std::abs(p_F.y()) < touchLine() - margin;
  }
  /// The nearest place in the field that is `margin` (m) from its lines.
  Vector2 nearestInside(const Vector2& p_F, double margin = 0.0) const {
    const double x = goalLine() - margin;
    const double y = touchLine() - margin;
    return {std::clamp(p_F.x(), -x, x), std::clamp(p_F.y(), -y, y)};
  }
};

/// Play modes from the own team's view.
enum class Phase : std::uint8_t {
  BeforeKickOff,
  OwnKickOff,
  OpponentKickOff,
  PlayOn,
  OwnKickIn,
  OpponentKickIn,
  OwnCorner,
  OpponentCorner,
  OwnGoalKick,
  OpponentGoalKick,
  OwnFreeKick,
  OpponentFreeKick,
  OwnDirectFreeKick,
  OpponentDirectFreeKick,
  OwnPass,
  OpponentPass,
  OwnGoal,
  OpponentGoal,
  GameOver,
  Other,
};

/// Everybody of us plays on; the own pass mode (server facts 4.9) is open play in which opponents are kept
/// off.
constexpr bool isOpenPlay(Phase phase) {
  return phase == Phase::PlayOn || phase == Phase::OwnPass;
}
constexpr bool isKickOff(Phase phase) {
  return phase == Phase::OwnKickOff || phase == Phase::OpponentKickOff;
}
/// Phases in which the own team takes the kick (kick-off to direct free kick), and in which the opponents do
/// (these and their pass mode).
constexpr bool isOwnSetPiece(Phase phase) {
  return phase == Phase::OwnKickOff || phase == Phase::OwnKickIn || phase == Phase::OwnCorner ||
         phase == Phase::OwnGoalKick || phase == Phase::OwnFreeKick || phase == Phase::OwnDirectFreeKick;
}
constexpr bool isOpponentSetPiece(Phase phase) {
  return phase == Phase::OpponentKickOff || phase == Phase::OpponentKickIn ||
         phase == Phase::OpponentCorner || phase == Phase::OpponentGoalKick ||
         phase == Phase::OpponentFreeKick || phase == Phase::OpponentDirectFreeKick ||
         phase == Phase::OpponentPass;
}

struct GameState {
  protocol::TeamName team;
  int unum = 0;                                        // 0 until the server confirmed it
  protocol::TeamSide side = protocol::TeamSide::None;  // side assigned by the server at init
  bool sidesSwapped = false;                           // second half with the sides changed
  Phase phase = Phase::BeforeKickOff;
  protocol::PlayMode playMode = protocol::PlayMode::Unknown;
  int half = 1;
  double time = 0.0;         // game time, s
  double phaseSince = 0.0;   // server time at which the phase began, s
  bool ballDropped = false;  // nobody took the set piece before this phase: the referee gave the ball free
  int ownScore = 0;
  int opponentScore = 0;
};

struct SelfState {
  Pose2 X_FR;                                      // torso on the ground, heading
  Matrix3 covariance = Matrix3::Identity();        // of (x, y, heading)
  Pose3 X_FC = Pose3::Identity();                  // camera
  Matrix3 cameraCovariance = Matrix3::Identity();  // of the camera's x, y (m) and the heading (rad)
  double height = 0.0;                             // of the torso, m
  bool localized = false;                          // good enough to act on
  double lastCorrection = kNever;                  // server time of the last landmark used, s
};

struct BallState {
  Vector3 p_FB = Vector3::Zero();            // m
  Vector3 v_FB = Vector3::Zero();            // m/s
  Vector2 p_RB = Vector2::Zero();            // in the robot frame on the ground, m
  Matrix2 covariance = Matrix2::Identity();  // of p_FB (x, y), m^2
  double lastSeen = kNever;                  // server time of the last own sighting, s
  double lastReported = kNever;              // server time of the last sighting told by a team mate, s
  double lastKick = kNever;                  // server time at which its motion last changed, s
  bool known = false;                        // seen or reported recently enough to act on
};

struct PlayerState {
  Pose2 X_FP;                      // position and (if headingKnown) heading
  Vector2 v_FP = Vector2::Zero();  // m/s
  double sigma = 1.0;              // m, standard deviation of the position
  double lastSeen = kNever;        // server time of the last sighting or report, s
  double lastSighted = kNever;     // server time of the last own sighting, s
  double lastTold = kNever;        // opponents: server time of the last sighting told by a team mate, s
  bool known = false;
  bool headingKnown = false;
  bool fallen = false;
  double fallenSince = kNever;  // server time at which that was first known, s

  void lies(bool down, double time) {
    if (down && !fallen) fallenSince = time;
    fallen = down;
  }
};

/// The last radio message of a team mate.
struct RadioReport {
  double time = kNever;  // server time at which it was heard, s
  protocol::SayMessage message;
};

/// A pass that a team mate has announced.
struct PassReport {
  double time = kNever;                 // server time at which it was heard, s
  int from = 0;                         // number of who kicks
  int receiver = 0;                     // number, perhaps one's own
  Vector2 p_FTarget = Vector2::Zero();  // where the ball can be met, m
  double kickAt = kNever;               // server time of the contact, s
  double thereAt = kNever;              // server time at which the ball is at p_FTarget, s
};

struct WorldState {
  double time = 0.0;  // server time, s
  FieldGeometry field;
  GameState game;
  BodyState body;
  SelfState self;
  BallState ball;
  std::array<PlayerState, kTeamSize + 1> teammates{};  // indexed by uniform number; [unum] is oneself
  std::array<PlayerState, kTeamSize + 1> opponents{};
  std::array<RadioReport, kTeamSize + 1> radio{};  // indexed by uniform number
  PassReport pass;                                 // the last one that was announced
};

}  // namespace nonet::world
