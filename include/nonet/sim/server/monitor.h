// The monitor stream (server facts 5.1-5.4): the scene as RoboViz and log players read it, whole (RSG) or as
// differences (RDS), and the log file of it.
#pragma once

#include <array>
#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "nonet/protocol/compressed_file.h"
#include "nonet/sim/simulation.h"

namespace nonet::sim {

/// Writes the messages of one stream. All monitors of a server share one, so that a difference message fits
/// what every one of them has.
class MonitorStream {
 public:
  explicit MonitorStream(const Simulation& simulation);

  /// A full message for a client that has just connected. The stream of the others goes on unchanged: nobody
  /// misses a foul or a goal because somebody else has come.
  const std::string& full();
  /// The next message of the stream: full when the scene has changed since the last one or `wantFull`, else
  /// differences.
  const std::string& next(bool wantFull = false);
  /// True if the last message was a full one.
  bool lastWasFull() const { return lastWasFull_; }

 private:
  using Matrix = std::array<float, 16>;  // column-major

  // How the scene is written: Whole, or as differences; the first of these repeats the visibility of every
  // mesh.
  enum class Form { Whole, FirstDifference, Difference };

  void writeEnvironment(bool all);
  void writeGameState(bool all);
  void writeScene(Form form, const std::vector<AgentInfo>& agents, bool remember);
  void writeRobot(const AgentInfo& agent, Form form);
  void writeBody(const AgentInfo& agent, const model::BodySpec& body, Form form);
  void openMoving(const ScenePose& pose, Form form);
  void mesh(Form form, std::string_view file, const std::array<float, 3>& scale, std::string_view materials);
  void standardShape(Form form, std::string_view load, const std::array<float, 3>& scale,
                     std::string_view material);

  const Simulation& simulation_;
  std::string text_;
  std::string staticWhole_;
  std::string staticFirstDifference_;
  std::string staticDifference_;
  bool lastWasFull_ = false;
  bool remember_ = true;  // whether what is being written counts as sent
  std::uint64_t sentScene_ = 0;
  bool anySent_ = false;
  bool firstDifference_ = false;
  std::vector<Matrix> sentMatrices_;  // of everything that moves, in the order of the scene
  std::size_t slot_ = 0;
  std::size_t agentSlot_ = 0;
  std::vector<bool> sentSelected_;  // per agent
  std::size_t sentFouls_ = 0;
  // What is only sent on change.
  struct SentGameState {
    bool teamLeft = false;
    bool teamRight = false;
    int half = -1;
    int scoreLeft = -1;
    int scoreRight = -1;
    int playMode = -1;
  } sent_;
};

/// A sparkmonitor.log: one message per line, every 0.2 s as the server's, a full one at least every 15
/// messages and at each change of the scene. Compressed with zstd, but plain if the name ends in ".log":
/// other programs read those. Throws std::runtime_error naming the file if it cannot be opened.
class MonitorLog {
 public:
  /// `cyclesPerMessage`: fewer for what is over in a second.
  MonitorLog(const Simulation& simulation, const std::string& path, int cyclesPerMessage = 10);
  /// Call once after every cycle.
  void cycle();
  /// Ends the file; nothing is written after that. The destructor does the same, but cannot tell of an error.
  void close();

  /// A full disk must not end a match: after an error nothing more is written, and error() says why.
  bool failed() const { return !error_.empty(); }
  const std::string& error() const { return error_; }

 private:
  void write(std::string_view text);
  void flush();
  void noticeError();

  MonitorStream stream_;
  std::string path_;
  std::string error_;
  std::variant<std::ofstream, std::unique_ptr<protocol::CompressedFile>> file_;
  int cyclesPerMessage_ = 10;
  int cyclesToNext_ = 0;
  int messagesSinceFull_ = 0;
};

}  // namespace nonet::sim
