// A robot set up as an agent of its type would be: with its parameter file; and a server for trials.
#pragma once

#include "nonet/agent/agent_setup.h"
#include "nonet/lab/trial/robot_trial.h"
#include "nonet/sim/settings/settings.h"

namespace nonet::lab {

inline agent::AgentSettings agentOfType(int type) {
  agent::AgentChoice choice;
  choice.robotType = type;
  return agent::makeAgentSettings(choice, NONET_SOURCE_DIR);
}

/// It steps on the spot.
inline agent::AgentSettings lameAgent(int type) {
  agent::AgentSettings lame = agentOfType(type);
  lame.parameters.motion.sets.goToTarget.gait.maxStepX = 0.001;
  lame.parameters.motion.sets.positioning.gait.maxStepX = 0.001;
  return lame;
}

/// The quick stepper.
inline sim::Settings quick() {
  sim::Settings settings;
  settings.quickSolver = true;
  return settings;
}

inline TrialSettings agentTrialSettings(int type) {
  return trialSettings(agentOfType(type));
}

}  // namespace nonet::lab
