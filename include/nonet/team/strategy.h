// The order of the behaviours: the first that answers acts.
#pragma once

#include <span>
#include <string_view>

#include "nonet/team/action.h"
#include "nonet/team/situation.h"

namespace nonet::team {

struct StrategyEntry {
  std::string_view name;
  std::optional<Action> (*behavior)(const Situation&);
};

std::span<const StrategyEntry> strategy();

/// The action of the first behaviour that answers, with its name as the reason.
Action decide(const Situation& situation);

}  // namespace nonet::team
