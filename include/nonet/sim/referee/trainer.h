// The commands that monitors and trainers send (server facts 5.5).
#pragma once

#include <string_view>
#include <vector>

#include "nonet/sim/referee/referee.h"

namespace nonet::sim {

class Trainer {
 public:
  Trainer(World& world, Referee& referee, std::vector<Player>& players)
      : world_(world), referee_(referee), players_(players) {}

  struct Outcome {
    bool endSimulation = false;       // (killsim)
    bool fullState = false;           // (reqfullstate)
    std::vector<AgentHandle> killed;  // whose robots are to be removed
  };
  /// Executes every command of one message at once; what is unknown or malformed is ignored, with a log line
  /// where the server has one.
  Outcome execute(std::string_view message);

 private:
  struct Command;
  void agentCommand(const Command& command);
  void ballCommand(const Command& command);
  void playModeCommand(const Command& command);
  void kickOffCommand(const Command& command);
  void selectCommand(const Command& command);
  void selectNext();
  void reposition(const Command& command);
  void timeCommand(const Command& command);
  void scoreCommand(const Command& command);
  /// The player that `(team T)(unum n)` names, or without both the selected one; nullptr if there is none.
  Player* named(const Command& command, bool& specified);

  World& world_;
  Referee& referee_;
  std::vector<Player>& players_;
};

}  // namespace nonet::sim
