// One sense message, typed. Filled by parsePercept() from text, or by the simulation in process: both give
// the same values to the last bit (the simulation rounds as the text does).
//
// Axes and signs are those of the robot frame (x forward, y left, z up); the server's torso axes (x right, y
// forward) are turned here, at the edge. Angles are radians, azimuth positive to the left, elevation positive
// up. All containers keep their memory between messages: parsing allocates nothing in steady state.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "nonet/math/inline_string.h"
#include "nonet/math/types.h"
#include "nonet/model/joints.h"
#include "nonet/protocol/play_mode.h"

namespace nonet::protocol {

using TeamName = InlineString<64>;

/// Names of the landmarks are absolute: L is the goal that the server's left team defends in the first half.
enum class Landmark : std::uint8_t { F1L, F2L, F1R, F2R, G1L, G2L, G1R, G2R };
inline constexpr std::size_t kLandmarkCount = 8;
std::string_view landmarkName(Landmark landmark);

enum class BodyPart : std::uint8_t { Head, RLowerArm, LLowerArm, RFoot, LFoot };
inline constexpr std::size_t kBodyPartCount = 5;
std::string_view bodyPartName(BodyPart part);

enum class TeamSide : std::uint8_t { None, Left, Right };

/// Measured from the camera, in camera axes (x forward, y left, z up).
struct Polar {
  double distance = 0.0;   // m
  double azimuth = 0.0;    // rad
  double elevation = 0.0;  // rad

  Vector3 cartesian() const;  // p_CP, m
  /// The real server sends ends of lines that are not (server facts 2.7).
  bool isFinite() const {
    return std::isfinite(distance) && std::isfinite(azimuth) && std::isfinite(elevation);
  }
};

struct SeenLandmark {
  Landmark id = Landmark::F1L;
  Polar at;
};

struct SeenPlayer {
  TeamName team;
  int unum = 0;
  std::array<std::optional<Polar>, kBodyPartCount> parts;  // indexed by BodyPart
};

struct SeenLine {
  Polar begin;
  Polar end;
};

/// What stood at which place of the See list, so that a message can be written back unchanged.
enum class SeenKind : std::uint8_t { Landmark, Ball, Player, Line, MyPosition, MyOrientation, BallPosition };

struct Vision {
  std::vector<SeenLandmark> landmarks;
  std::optional<Polar> ball;
  std::vector<SeenPlayer> players;
  std::vector<SeenLine> lines;
  // Ground truth, only when a server was told to send it. Used by measurements, never by the agent's
  // decisions.
  std::optional<Vector3> truePosition;      // mypos: head centre in the own team's field frame, m
  std::optional<double> trueHeading;        // myorien: direction of the head's forward axis, rad
  std::optional<Vector3> trueBallPosition;  // ballpos, m
  std::vector<SeenKind> order;

  void clear();
};

struct Heard {
  TeamName team;      // empty if the server does not label messages
  double time = 0.0;  // game time, s
  bool self = false;  // the listener's own message
  double direction =
      0.0;  // rad, bearing in the listener's field frame (not relative to its heading); 0 if self
  InlineString<64> message;
};

struct FootForce {
  Vector3 center = Vector3::Zero();  // point of attack in the foot's (toe's) frame, robot axes, m
  Vector3 force = Vector3::Zero();   // N, same frame
};
enum class ForceSensor : std::uint8_t { RFoot, LFoot, RToe, LToe };
inline constexpr std::size_t kForceSensorCount = 4;

struct GameStatus {
  std::optional<int> unum;       // only in the first message after the team was assigned
  std::optional<TeamSide> side;  // likewise
  std::optional<int> scoreLeft;  // absent if the server does not report scores
  std::optional<int> scoreRight;
  double time = 0.0;  // game time, s
  PlayMode playMode = PlayMode::Unknown;
  InlineString<32> playModeText;  // as sent, also when unknown
};

/// Predicates in the order received (joints and force sensors individually), for writing the message back.
enum class PerceptKind : std::uint8_t { Time, GameState, Hear, Gyro, Accelerometer, Joint, See, Force };
struct PerceptEntry {
  PerceptKind kind = PerceptKind::Time;
  std::uint8_t item = 0;  // JointId, ForceSensor or index of the heard message
};

struct Percept {
  double time = 0.0;  // server time, s
  GameStatus game;
  Vector3 gyro = Vector3::Zero();  // rad/s, robot axes (x roll, y pitch: positive = nose down, z yaw)
  Vector3 accelerometer =
      Vector3::Zero();              // m/s^2, robot axes, (0,0,9.81) at rest; one cycle older than the rest
  model::JointArray joints{};       // rad
  std::uint32_t jointsPresent = 0;  // bit per JointId
  std::array<std::optional<FootForce>, kForceSensorCount>
      forces;                    // indexed by ForceSensor; absent without contact
  std::optional<Vision> vision;  // every third message
  std::vector<Heard> heard;
  std::vector<PerceptEntry> order;
  int unknownTokens = 0;  // predicates or values that were skipped

  /// Empties everything but keeps the memory (also that of `vision`).
  void clear();
  /// The vision record to fill: reuses the memory of an earlier one.
  Vision& beginVision();

 private:
  std::optional<Vision> spareVision_;
};

}  // namespace nonet::protocol
