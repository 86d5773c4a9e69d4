// A robot set up as an agent of its type would be: with its parameter file.
#pragma once

#include "nonet/agent/agent_setup.h"
#include "nonet/lab/trial/robot_trial.h"

namespace nonet::lab {

inline agent::AgentSettings agentOfType(int type) {
  agent::AgentChoice choice;
  choice.robotType = type;
  return agent::makeAgentSettings(choice, NONET_SOURCE_DIR);
}

inline TrialSettings agentTrialSettings(int type) {
  return trialSettings(agentOfType(type));
}

}  // namespace nonet::lab
