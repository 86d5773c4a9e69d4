// What becomes of the kicks in a match: for each kick that a player's motion began in an in-process match,
// how far it was meant to go, how far the ball went and how far off its way, by the simulation's truth.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "nonet/lab/match/match.h"
#include "nonet/lab/reports/match_measure.h"
#include "nonet/motion/request.h"
#include "nonet/sim/simulation.h"

namespace nonet::lab {

/// One kick. Distances are along the way to the target, m.
struct MatchKick {
  std::string team;
  int unum = 0;
  std::string name;        // of the skill
  double time = 0.0;       // of the game when it began, s
  double intended = 0.0;   // what was asked for, or what the kick serves where that is less
  bool contact = false;    // the kicker touched the ball in the kick
  double carried = 0.0;    // where the ball would have come to rest, as it went when it was last free
  double direction = 0.0;  // of the ball's way, to the left of that to the target, rad; 0 without contact
  double went = 0.0;  // until somebody touched it, it left the field or lay still; a goal went all the way

  double carriedShare() const { return carried / intended; }
  double wentShare() const { return went / intended; }
};

/// Over some kicks; medians over all, those that missed the ball with 0.
struct KickShares {
  int kicks = 0;
  double missed = 0.0;               // share without contact
  double intended = 0.0;             // median, m
  double carriedShare = 0.0;         // median
  double wentShare = 0.0;            // median
  double underHalf = 0.0;            // share that was carried less than half as far as intended
  double directionError = 0.0;       // of those with contact: median of |direction|, rad
  double directionErrorTenth = 0.0;  // and what a tenth of them exceeds
};
KickShares kickShares(const std::vector<MatchKick>& kicks);

class MatchKicks final : public MatchMeasure {
 public:
  void afterCycle(const sim::Simulation& simulation) override;
  void afterThought(const Thought& thought) override;

  /// Those that are over.
  const std::vector<MatchKick>& kicks() const { return kicks_; }

  nlohmann::ordered_json toJson() const override;
  std::string toText() const override;

 private:
  /// A kick whose ball is still on its way.
  struct Open {
    MatchKick kick;
    motion::KickTo request;
    bool runs = true;             // motion still carries it out
    std::optional<Pose2> X_WAim;  // the ball's place when it began, facing the target
    double began = 0.0;           // s of the server's time
    protocol::PlayMode mode = protocol::PlayMode::PlayOn;  // when it began
  };
  static bool isOver(const sim::Simulation& simulation, sim::RobotHandle robot, Open& open);

  std::map<sim::AgentHandle, Open> open_;
  std::vector<MatchKick> kicks_;
};

}  // namespace nonet::lab
