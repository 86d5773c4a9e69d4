// A skill as data: what a skills/*.skl file says after parsing. The language is described in
// skills/README.md.
//
// Parameter values are already in place: every number here is final, in SI units. Angles of joints are those
// of the left side; the right joint takes the mirrored angle.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nonet/config/parameters.h"
#include "nonet/math/types.h"
#include "nonet/model/joints.h"

namespace nonet::motion {

/// A named value that params files and the optimizer may change.
struct SkillParameter {
  std::string name;
  double value = 0.0;
  config::Unit unit = config::Unit::None;
  std::optional<config::Range> range;  // absent: only files may change it
};

/// Joints whose angle changes sign between left and right.
bool mirrorsSign(model::JointId joint);

/// What a kick is told when it begins.
struct KickAim {
  Vector2 ball = Vector2::Zero();  // where it will find the ball, robot frame on the ground, m
  double turn = 0.0;               // how far to the left of its own direction the ball should go, rad
  Vector2 pace = Vector2::Zero();  // of the steps out of which it begins, robot axes, m/s
  double distance = 0.0;           // how far the ball should go, m
};

/// What a kick can suit itself to when it begins, as the left foot does it: how far ahead of its place
/// (KickHead::p_RBall) and to the left of it the ball is believed to lie, m; how far to the left of the
/// kick's own direction it should go, rad; the pace of the steps, ahead and to the left, m/s; how far the
/// ball should go, within what the head serves, m.
constexpr int kKickInputs = 6;
constexpr int kDistanceInput = 5;
using KickInputs = Eigen::Matrix<double, kKickInputs, 1>;

struct KickHead;
/// What a kick of this head is told, `mirrored` for the right foot. Beyond what kicks are made for the inputs
/// do not grow: 8 cm, 0.5 rad, 1 m/s.
KickInputs kickInputs(const KickAim& aim, const KickHead& head, bool mirrored);

/// A number of a skill: `constant` and a multiple of each input.
struct KickValue {
  double constant = 0.0;
  KickInputs per = KickInputs::Zero();

  double at(const KickInputs& inputs) const { return constant + per.dot(inputs); }
};

struct JointGoal {
  model::JointId joint = model::JointId::Head1;
  KickValue angle;  // rad, of this very joint (already mirrored for the right side)
  KickValue after;  // s, how long a swing waits with this joint
};

/// What a skill says of itself that kicks the ball: team, motion and the reports read it. For the left foot;
/// the mirrored skill kicks with the right one.
struct KickHead {
  Vector2 p_RBall = Vector2::Zero();    // place of the ball seen from the stand, m
  Vector2 tolerance = Vector2::Zero();  // how far from there it may lie, ahead and aside, m
  double steady = 0.0;                  // s that it has lain about there before the kick begins; 0: at once
  double direction = 0.0;               // of the ball's way, robot frame, rad
  double turn = 0.0;                    // how far to either side of that it can send the ball, rad
  double shortest = 0.0;                // distances that it serves, m
  double longest = 0.0;
  double apex = 0.0;         // m, height of the flying ball where it is highest, in the median; 0: it rolls
  double apexAt = 0.0;       // m from where it lay to there
  double apexSpread = 0.0;   // m, standard deviation of heights
  double clears = 0.0;       // m: a chip, to be so high a metre from where it lay; 0: none
  double lands = 0.0;        // m: and to come down no farther off
  double low = 0.0;          // m: a kick to be no higher, below a bar; 0: as high as it likes
  double contact = 0.0;      // s from the begin of the skill to the foot's contact with the ball
  double room = 0.0;         // m that no opponent may be nearer to the ball
  std::uint32_t types = 31;  // bit per robot type
  bool fromWalk = false;     // begins out of steps; otherwise from a quiet stand
  bool scales = false;       // the ball goes as far as is asked for; otherwise always about `longest`

  bool serves(int robotType) const { return ((types >> robotType) & 1U) != 0; }
  /// The ball goes where the robot faces, give or take what can be varied; otherwise to the side.
  bool isStraight() const { return std::abs(direction) <= turn; }
  /// Over somebody: done only when it is asked for by name.
  bool isChip() const { return clears > 0.0; }
  /// It waits until the ball has lain in its place.
  bool isExact() const { return steady > 0.0; }
  /// Who wants just any kick gets another one.
  bool onlyByName() const { return isChip() || isExact(); }
  /// The nearest opponent is so far from the ball, m. A kick that was chosen is not given up for a little.
  bool hasRoom(double nearest, bool chosen = false) const {
    constexpr double kKeeps = 0.8;
    return nearest >= (chosen ? kKeeps : 1.0) * room;
  }
  /// The ball lies behind the robot: a kick with the heel.
  bool isBackward() const { return p_RBall.x() < 0.0; }
  /// The probability that the ball is lower than `height` (m) so far (m) from where it lay. Its first flight
  /// is a parabola; a ball that has landed does not rise so high again.
  double fliesBelow(double height, double distance) const;
};

/// Pose of a sole in the torso frame, or relative to the ball (curves "from ball").
struct FootGoal {
  model::Side side = model::Side::Left;
  Vector3 position = Vector3::Zero();      // m
  Vector3 rollPitchYaw = Vector3::Zero();  // rad, applied as yaw, then pitch, then roll
};

/// What a kick suits itself to moves and turns its foot: on top of its joints' angles, as the left foot does
/// it.
struct FootShift {
  model::Side side = model::Side::Left;
  std::array<KickValue, 3> way;  // torso frame, m
  KickValue yaw;                 // about the torso's vertical axis, rad
};

enum class Quantity : std::uint8_t { Time, Pitch, Roll, Rate, Height, BallDistance, BallX, BallY };

/// Condition tree in a flat list; children are indices into the same list.
struct ConditionNode {
  enum class Kind : std::uint8_t {
    Not,
    And,
    Or,
    Upright,
    Fallen,
    FallenFront,
    FallenBack,
    FallenLeft,
    FallenRight,
    ContactLeft,
    ContactRight,
    Less,
    Greater,
  };
  Kind kind = Kind::Upright;
  int first = -1;
  int second = -1;
  Quantity quantity = Quantity::Time;
  double value = 0.0;
};

struct Instruction {
  static constexpr std::size_t kMostPoints = 12;
  enum class Kind : std::uint8_t {
    MoveOver,   // to the goals in `value` seconds
    MoveAt,     // to the goals at `value` rad/s; the joint with the longest way decides the end
    Swing,      // to the goals, every joint as fast as it can after its delay; over after `value` seconds
    Curve,      // one foot along a spline through `points`, to the goals beside it, in `value` seconds
    Wait,       // `value` seconds
    WaitUntil,  // the condition, at most `value` seconds
    Branch,     // to `target` if the condition does not hold
    Jump,       // to `target`
    Loop,       // back to `target`, `count` times in all; `slot` is the counter
    Call,       // skill `callee` of the library
    Stiffness,  // `value` for the joints in `joints`
    End,
    Fail,
  };
  Kind kind = Kind::End;
  double value = 0.0;
  KickValue duration;  // s, of MoveOver and Swing
  std::vector<JointGoal> joints;
  std::vector<FootGoal> feet;
  std::vector<FootShift> shifts;
  std::vector<FootGoal> points;  // of a curve, at most kMostPoints, all of one side
  bool fromBall = false;         // the points are relative to the ball
  bool stand = false;            // every joint that has no goal of its own goes to the stand
  int condition = -1;
  int target = 0;
  int count = 0;
  int slot = 0;
  std::string calleeName;
  int callee = -1;  // filled by the library
  bool mirrored = false;
  int line = 0;
  int column = 0;
};

struct Skill {
  std::string name;
  std::string file;
  std::string textFile;  // where its statements stand: another file than `file` if it is `like` a skill there
  std::optional<KickHead> kick;
  std::vector<SkillParameter> parameters;
  std::vector<Instruction> program;
  std::vector<ConditionNode> conditions;
  int loopSlots = 0;
};

}  // namespace nonet::motion
