// The command line of one agent: `nonet play` of this program, or of another one, older perhaps, that does
// not know every option.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "nonet/agent/agent_setup.h"

namespace nonet::app {

class PlayProgram {
 public:
  /// This program.
  PlayProgram();
  /// Another executable: asked for its help (`play --help`) to learn what it understands. Throws
  /// std::runtime_error if it is none of Nonet.
  explicit PlayProgram(const std::string& executable);

  const std::string& executable() const { return executable_; }
  bool knows(const std::string& option) const;

 private:
  std::string executable_;
  std::string help_;  // empty: everything is known
};

struct PlayPlace {
  std::string host = "127.0.0.1";
  std::uint16_t port = 3100;
  bool lockStep = true;
  std::string dataFolder;  // empty: the program's own
  std::string report;      // file for what the agent counts; empty: none
};

/// What an executable does not know is left out, as long as the agent can play without; a parameter it does
/// not know is an error of its own, which ends the agent.
std::vector<std::string> playCommand(const PlayProgram& program, const agent::AgentChoice& agent,
                                     const PlayPlace& place);

}  // namespace nonet::app
