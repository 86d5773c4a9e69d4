// What can be measured in an in-process match beside its result.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "nonet/lab/match/match.h"
#include "nonet/sim/simulation.h"

namespace nonet::lab {

class MatchMeasure {
 public:
  virtual ~MatchMeasure() = default;

  /// After each cycle of the simulation: its thoughts are complete.
  virtual void afterCycle(const sim::Simulation& simulation) = 0;
  /// After each message of each agent.
  virtual void afterThought(const Thought& thought) = 0;

  virtual nlohmann::ordered_json toJson() const = 0;
  virtual std::string toText() const = 0;
};

}  // namespace nonet::lab
