#include "nonet/team/strategy.h"

#include <array>

#include "nonet/team/behaviors.h"

namespace nonet::team {

namespace {

constexpr std::array kStrategy = {
    StrategyEntry{"before kick-off", beforeKickOff},
    StrategyEntry{"rest", rest},
    StrategyEntry{"search ball", searchBall},
    StrategyEntry{"find oneself", findOneself},
    StrategyEntry{"dive", dive},
    // One's turn at the ball (Situation::play).
    StrategyEntry{"wait at ball", waitAtBall},
    StrategyEntry{"await ball", awaitBall},
    StrategyEntry{"receive", receive},
    StrategyEntry{"go to ball", goToBall},
    StrategyEntry{"shoot", shoot},
    StrategyEntry{"pass", pass},
    StrategyEntry{"kick", kick},
    StrategyEntry{"kick aside", kickAside},
    StrategyEntry{"dribble", dribble},
    StrategyEntry{"go behind ball", goBehindBall},
    // Somebody else's.
    StrategyEntry{"guard goal", guardGoal},
    StrategyEntry{"opponent set piece", opponentSetPiece},
    StrategyEntry{"own set piece", ownSetPiece},
    StrategyEntry{"run to pass", runToPass},
    StrategyEntry{"support", support},
};

}  // namespace

std::span<const StrategyEntry> strategy() {
  return kStrategy;
}

Action decide(const Situation& situation) {
  for (const StrategyEntry& entry : kStrategy) {
    std::optional<Action> action = entry.behavior(situation);
    if (!action) continue;
    action->reason.behavior = entry.name;
    return *action;
  }
  return {};
}

}  // namespace nonet::team
