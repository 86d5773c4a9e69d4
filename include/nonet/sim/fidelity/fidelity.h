// How true the simulation is to the real server: replays the commands of a recorded experiment and compares
// every body, joint, gyro, accelerometer, foot force and the ball, cycle by cycle.
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "nonet/sim/physics/world.h"

namespace nonet::sim {

/// What one robot did and sensed in one cycle of a recording. Server axes and units of the file: degrees, m,
/// N.
struct RecordedRobot {
  std::vector<std::pair<model::JointId, float>> speeds;  // sent in answer to this message, rad/s
  std::map<model::JointId, double> joints;               // degrees, two decimals
  std::optional<Eigen::Vector3d> gyro;                   // deg/s
  std::optional<Eigen::Vector3d> accelerometer;          // m/s^2
  struct Foot {
    Eigen::Vector3d center;
    Eigen::Vector3d force;
  };
  std::map<model::BodyId, Foot> feet;  // those with contact
  struct Part {
    Eigen::Vector3d position;
    std::optional<Eigen::Matrix3d> rotation;
  };
  std::map<model::BodyId, Part> parts;
};

struct RecordedCycle {
  double time = 0.0;  // server time, s
  std::string playMode;
  std::vector<RecordedRobot> robots;  // one or two
  Eigen::Vector3d ball = Eigen::Vector3d::Zero();
  std::string trainer;  // command on the monitor port
  std::string extra;    // other effectors of the first robot, verbatim
  std::string message;  // the first robot's sense message, verbatim, if it was recorded
};

struct Recording {
  std::string scenario;
  int robotType = 0;
  std::vector<RecordedCycle> cycles;
};

/// Reads a `NAME.jsonl` or `NAME.jsonl.gz`. Throws std::runtime_error naming file and line.
Recording readRecording(const std::filesystem::path& file);

/// Differences of one cycle, largest over all bodies, joints, ... of all robots.
struct CycleError {
  double bodies = 0.0;         // m
  double ball = 0.0;           // m
  double joints = 0.0;         // degrees, of the values as printed
  double gyro = 0.0;           // deg/s, as printed
  double accelerometer = 0.0;  // m/s^2, as printed
  double footForce = 0.0;      // N, as printed
  double footCenter = 0.0;     // m, as printed
  int footContacts = 0;        // feet with contact in one and not in the other

  double position() const { return std::max(bodies, ball); }
};

struct FidelityResult {
  std::string scenario;
  bool knownHistory = false;  // what happened before the recording could be replayed too
  std::vector<CycleError> cycles;
  /// Time of the first cycle with a position error beyond 0.1 mm, 1 mm, 1 cm, s from the start.
  std::array<std::optional<double>, 3> firstOver;
  CycleError worst;

  /// Largest position error (m) of all cycles before `seconds`.
  double worstPositionBefore(double seconds) const;
};

inline constexpr std::array<double, 3> kFidelityLimits{1e-4, 1e-3, 1e-2};  // m

FidelityResult replay(const Recording& recording, const WorldSettings& settings = {});

/// A drawing of the position error over time with the three limits, logarithmic.
std::string drawFidelity(const FidelityResult& result);

}  // namespace nonet::sim
