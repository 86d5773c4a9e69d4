// What a run is worth to the tasks that learn it, and where they begin.
#pragma once

#include <algorithm>

#include "nonet/agent/agent.h"
#include "nonet/lab/trial/run_trial.h"

#include "lab/tasks/tasks.h"

namespace nonet::lab {

/// In m/s of the mean speed. A fall costs the less the later it comes, which gives the search a slope.
inline double worth(const RunOutcome& run) {
  constexpr double kFall = 1.0;
  constexpr double kLateFall = 0.4;
  constexpr double kFallAfter = 0.5;
  constexpr double kStopTime = 0.7;       // s, free
  constexpr double kStopCost = 0.4;       // per s beyond
  constexpr double kUnsteadiness = 0.08;  // per s
  double value = run.speed - kUnsteadiness * run.unsteadiness;
  if (run.fell) value -= kFall + (kLateFall - kFall) * run.fellAt;
  if (run.fellAfter) value -= kFallAfter;
  return value - kStopCost * std::max(0.0, run.stopTime - kStopTime);
}

/// The search begins at the walk set, unless a sprint set was learned before.
inline void beginRun(agent::AgentParameters& parameters) {
  parameters.motion.selection.useSprint = true;
  startAt(parameters.motion.sets.goToTarget, parameters.motion.sets.sprint);
}

}  // namespace nonet::lab
