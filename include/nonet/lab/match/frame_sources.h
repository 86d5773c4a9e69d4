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
#include "nonet/protocol/log_file.h"
#include "nonet/protocol/monitor_reader.h"
#include "nonet/sim/simulation.h"

namespace nonet::lab {

/// Frames of a simulation.
class SimulationFrames {
 public:
  /// After each cycle. A frame every fifth cycle (0.1 s), and at once when play mode, score or fouls change;
  /// otherwise nullptr. Valid until the next call.
  const Frame* cycle(const sim::Simulation& simulation);
  /// What an agent takes for its role at present; kept until it changes. A literal.
  void setRole(sim::AgentHandle agent, std::string_view role) { minds_[agent].role = role; }
  /// The kick that an agent carries out in this cycle, if any. Must outlive the frames.
  void setKick(sim::AgentHandle agent, std::string_view kick);

 private:
  Frame frame_;
  std::optional<protocol::TeamName> first_;  // name of team 0
  struct Mind {                              // of an agent, as far as it is told
    std::string_view role;
    std::string_view kick;
    long kickedAt = 0;  // cycle in which that kick was last carried out
  };
  std::map<sim::AgentHandle, Mind> minds_;
  long cycles_ = 0;
  std::size_t fouls_ = 0;
  int cyclesToNext_ = 0;
};

/// Frames of a monitor stream, message by message.
class MonitorFrames {
 public:
  /// One message. True if it gave a frame; false if it could not be understood, or before the first full
  /// scene.
  bool message(std::string_view text);
  const Frame& frame() const { return frame_; }
  const StatisticsField& field() const { return field_; }
  /// Names of teams 0 and 1; empty as long as unknown.
  const std::array<std::string, 2>& teams() const { return teams_; }
  /// What the stream says now: half, who plays on which side.
  const protocol::MonitorGame& game() const { return reader_.game(); }

 private:
  void takeRobots();

  protocol::MonitorReader reader_;
  Frame frame_;
  StatisticsField field_;
  std::array<std::string, 2> teams_;
};

/// How a monitor log ends, as protocol::LogReader has it: torn, as that of a killed server, or damaged.
struct MonitorLogEnd {
  protocol::LogReader::End end = protocol::LogReader::End::Whole;
  std::string problem;  // one sentence with the file's name and up to where it was read; empty if whole
};

/// Reads a monitor log: one message a line, or messages behind their length as on the wire; plain, gzip or
/// zstd. Calls `use` for each frame, also of a log that is torn or damaged farther on. Throws
/// std::runtime_error if there is no file or nothing in it is a monitor message.
MonitorLogEnd readMonitorLog(const std::string& path,
                             const std::function<void(const MonitorFrames& stream)>& use);

}  // namespace nonet::lab
