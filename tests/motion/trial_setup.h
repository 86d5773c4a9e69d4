// A robot set up as an agent of its type would be: with its parameter file.
#pragma once

#include "nonet/agent/agent_setup.h"
#include "nonet/lab/trial/robot_trial.h"

namespace nonet::lab {

inline agent::AgentConfig agentOfType(int type) {
  agent::AgentChoice choice;
  choice.robotType = type;
  return agent::makeAgentConfig(choice, NONET_SOURCE_DIR);
}

inline TrialSetup agentTrialSetup(int type) {
  return trialSetup(agentOfType(type));
}

}  // namespace nonet::lab
