// A match as the viewer plays it: one row of 32-bit numbers per message of the monitor stream, and what
// happened (goals, falls, kicks, fouls). The browser gets the rows as they lie here.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "nonet/model/joints.h"
#include "nonet/protocol/monitor_reader.h"

namespace nonet::app {

/// Angles of all joints, from where the bodies are (rad).
model::JointArray jointAngles(const protocol::MonitorRobot& robot);

struct TrackEvent {
  enum class Kind { Goal, Fall, Kick, Foul, Mode };
  Kind kind = Kind::Mode;
  std::size_t frame = 0;
  protocol::TeamSide side = protocol::TeamSide::None;
  int unum = 0;      // 0: nobody's
  std::string text;  // name of the foul or of the new play mode
};

/// What the teams on the two sides are called from a row on; empty as long as unknown.
struct TeamNames {
  std::size_t frame = 0;
  std::string left;
  std::string right;
};

class Track {
 public:
  // Row: game time s, play mode, half, goals left, goals right, ball position (m) and orientation (quaternion
  // x y z w), then per slot: robot type + 1 (0: nobody), torso position (m), orientation (robot's axes:
  // forward, left, up), joint angles (rad). World coordinates. The slots are left 1..11, right 1..11.
  static constexpr std::size_t kGameFloats = 12;
  static constexpr std::size_t kRobotFloats = 8 + model::kJointCount;
  static constexpr std::size_t kSlots = 22;
  static constexpr std::size_t kRowFloats = kGameFloats + kSlots * kRobotFloats;

  /// `step`: time between two messages (s) until the stream itself has shown it.
  explicit Track(double step) : step_(step) {}

  /// The state after one more message.
  void add(const protocol::MonitorReader& reader);

  std::size_t frames() const { return rows_.size() / kRowFloats; }
  /// Time between two rows, s: the most frequent step of the game's clock. That clock stands still before the
  /// kick-off, so it cannot be the axis of the player.
  double step() const;
  const std::vector<TrackEvent>& events() const { return events_; }
  /// More than one entry where teams have changed sides.
  const std::vector<TeamNames>& names() const { return names_; }
  std::span<const float> rows(std::size_t from) const;

  /// What the browser asks for: "from" and "events" are what it has already. Four bytes of length, that many
  /// bytes of JSON, then the rows, all little-endian.
  /// `live`: the state of the connection, empty for a log.
  std::string message(std::size_t from, std::size_t eventsFrom, std::string_view source,
                      std::string_view live) const;

 private:
  void addNames(const protocol::MonitorGame& game);
  void addRobot(const protocol::MonitorRobot& robot, float* row);
  void findEvents(const protocol::MonitorReader& reader);
  void findKick(const protocol::MonitorReader& reader);
  void event(TrackEvent::Kind kind, protocol::TeamSide side, int unum, std::string text = {});

  double step_;
  std::vector<float> rows_;
  std::vector<TrackEvent> events_;
  std::vector<TeamNames> names_;
  std::map<int, long> steps_;  // how often the clock went on by so many cycles
  std::map<std::string, double, std::less<>> field_;
  protocol::MonitorGame game_;  // of the row before
  std::array<bool, kSlots> down_{};
  std::optional<Vector2> ballBefore_;
  Vector2 ballVelocity_ = Vector2::Zero();
  std::size_t framesSinceKick_ = 1'000'000;  // there was none
};

/// All shapes of the five robot types for the browser: bodies with parent, offset, anchor, axis and joint.
nlohmann::json robotShapes();

/// Reads a monitor log, plain or compressed. `problem`, if given, gets one sentence with the file's name and
/// up to where it was read if it is torn or damaged. Throws protocol::LogError if there is no message in it.
Track readMonitorLog(const std::string& path, std::string* problem = nullptr);

}  // namespace nonet::app
