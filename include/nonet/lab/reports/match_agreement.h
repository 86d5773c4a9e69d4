// Whether the players of a team mean the same: in each cycle of an in-process match, each field player's
// whole assignment of roles beside those of its team mates. Cycles count while the game's clock runs and both
// halves of the question make sense: two or more field players there, before the end.
#pragma once

#include <array>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "nonet/lab/match/match.h"
#include "nonet/lab/reports/match_measure.h"
#include "nonet/protocol/say_codec.h"
#include "nonet/sim/simulation.h"

namespace nonet::lab {

/// What field players believe to be agreed, by number; without an entry: no vote known.
using AgreedRoles = std::map<int, std::optional<protocol::RoleVote>>;

/// How far the players of one team were one in one moment.
struct Unity {
  bool assignment = false;  // all know a vote, and these give every player that is there the same role
  bool onBall = false;      // all know a vote, and these have the same player on the ball
  bool distinct = false;    // what each takes for its own role nobody else does
};
Unity unityOf(const AgreedRoles& players);

class MatchAgreement final : public MatchMeasure {
 public:
  void afterCycle(const sim::Simulation& simulation) override;
  void afterThought(const Thought& thought) override;

  struct Count {
    long cycles = 0;  // one per team and cycle
    long assignment = 0;
    long onBall = 0;
    long distinct = 0;
    double share(long part) const {
      return cycles > 0 ? static_cast<double>(part) / static_cast<double>(cycles) : 0.0;
    }
  };
  /// By the team's name.
  const std::map<std::string, Count>& teams() const { return counts_; }
  Count all() const;

  nlohmann::ordered_json toJson() const override;
  std::string toText() const override;

 private:
  std::map<std::string, AgreedRoles> thoughts_;  // of this cycle
  std::map<std::string, Count> counts_;
};

}  // namespace nonet::lab
