// A robot set up as an agent of its type would be: with its parameter file.
#pragma once

#include "nonet/lab/agent_setup.h"
#include "nonet/lab/robot_trial.h"

namespace nonet::lab {

inline TrialSetup agentTrialSetup(int type) {
  AgentChoice choice;
  choice.robotType = type;
  return trialSetup(makeAgentConfig(choice, NONET_SOURCE_DIR));
}

}  // namespace nonet::lab
