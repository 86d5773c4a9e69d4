// Where frames come from: a simulation in this process, or a monitor stream, live or from a file.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nonet/lab/match/frame.h"
#include "nonet/lab/match/statistics.h"
#include "nonet/sim/simulation.h"

namespace nonet::lab {

/// Frames of a simulation.
class SimulationFrames {
 public:
  /// After each cycle. A frame every fifth cycle (0.1 s), and at once when play mode, score or fouls change;
  /// otherwise nullptr. Valid until the next call.
  const Frame* cycle(const sim::Simulation& simulation);
  /// What an agent takes for its role at present; kept until it changes. A literal.
  void setRole(sim::AgentHandle agent, std::string_view role) { roles_[agent] = role; }

 private:
  Frame frame_;
  std::optional<protocol::TeamName> first_;  // name of team 0
  std::map<sim::AgentHandle, std::string_view> roles_;
  std::size_t fouls_ = 0;
  int cyclesToNext_ = 0;
};

/// Follows a monitor stream (server facts 5.1, 5.2) message by message: full scenes name the nodes, the
/// differences after them keep their order.
class MonitorFrames {
 public:
  /// One message. True if it gave a frame; false if it could not be understood, or before the first full
  /// scene.
  bool message(std::string_view text);
  const Frame& frame() const { return frame_; }
  const StatisticsField& field() const { return field_; }
  /// Names of teams 0 and 1; empty as long as unknown.
  const std::array<std::string, 2>& teams() const { return teams_; }

 private:
  struct Scene;  // what one pass over the nodes finds

  bool environment(std::string_view text);
  void predicate(std::string_view name, const std::vector<std::string_view>& values);
  bool nodes(std::string_view text, bool full);

  Frame frame_;
  StatisticsField field_;
  std::array<std::string, 2> teams_;
  std::array<std::string, 2> sides_;  // names of the left and the right team now
  std::array<int, 2> scores_{};       // of the left and the right team now
  std::vector<FrameFoul> newFouls_;   // team: 0 left, 1 right
  std::map<int, int> robotOfNode_;    // number of a torso's node in the scene -> index in frame_.robots
  std::vector<bool> right_;           // beside frame_.robots
  int ballNode_ = -1;
};

/// Reads a monitor log: one message a line, or messages behind their length as on the wire; plain, gzip or
/// zstd. Calls `use` for each frame. Throws std::runtime_error if there is no file or nothing in it is a
/// monitor message.
void readMonitorLog(const std::string& path, const std::function<void(const MonitorFrames& stream)>& use);

}  // namespace nonet::lab
