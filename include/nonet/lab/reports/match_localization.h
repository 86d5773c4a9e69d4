// How well all players of an in-process match know their place, the ball and each other: what they believe
// after each vision message against the simulation's truth of the moment it shows, none left out. The truth
// goes into this report and nowhere else.
#pragma once

#include <array>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "nonet/lab/match/match.h"
#include "nonet/lab/reports/localization_report.h"
#include "nonet/lab/reports/match_measure.h"
#include "nonet/sim/simulation.h"

namespace nonet::lab {

class MatchLocalization final : public MatchMeasure {
 public:
  void afterCycle(const sim::Simulation& simulation) override;
  void afterThought(const Thought& thought) override;

  /// What a robot was doing, by the truth: it counts as fallen from a tilt of 60 degrees until it has stood
  /// (tilt below 25 degrees) for 0.5 s, as walking while it got along faster than 0.05 m/s for half a second.
  enum class Activity : std::uint8_t { Standing, Walking, Fallen };
  const LocalizationReport& report(Activity activity) const {
    return byActivity_[static_cast<std::size_t>(activity)];
  }
  const LocalizationReport& all() const { return all_; }

  /// 0.5 s after it stood up again the robot says that it knows its place, and is wrong by less than 0.1 m.
  struct Rises {
    int count = 0;
    int good = 0;
  };
  const Rises& rises() const { return rises_; }

  /// What is believed of the opponents, seen or told, wherever they are: one question per vision message,
  /// player and opponent.
  struct Opponents {
    long asked = 0;
    long known = 0;
    long good = 0;               // known, and wrong by less than 0.5 m
    std::vector<double> errors;  // m, of those known
  };
  const Opponents& opponents() const { return opponents_; }

  nlohmann::ordered_json toJson() const override;
  std::string toText() const override;

 private:
  struct RobotTruth {
    Pose2 X_WR;  // torso on the ground, world axes
    Vector3 p_WC = Vector3::Zero();
    double cameraHeading = 0.0;
    double up = 1.0;  // z of the torso's up axis
    bool fromRight = false;
    bool rightTeam = false;  // by name, stays at half time
    int unum = 0;
  };
  struct Moment {
    double time = 0.0;  // server time, s
    Vector3 p_WB = Vector3::Zero();
    std::map<sim::AgentHandle, RobotTruth> robots;
  };
  struct Follow {
    std::deque<Vector2> track;  // one per cycle, of the last half second
    bool fallen = false;
    double uprightSince = 0.0;  // s
    bool mustProve = false;     // has risen, the next vision message after 0.5 s counts
  };

  const Moment* momentOf(double time) const;
  Activity follow(const RobotTruth& truth, double time, Follow& robot) const;
  void compareOthers(const Moment& moment, const Thought& thought);
  void askOfOpponent(const world::PlayerState& opponent, const Vector2& p_FP);

  std::deque<Moment> moments_;
  std::map<sim::AgentHandle, Follow> robots_;
  std::map<std::pair<bool, int>, LocalizationReport> byPlayer_;  // right team, number
  std::array<LocalizationReport, 3> byActivity_;
  LocalizationReport all_;
  Rises rises_;
  Opponents opponents_;
  std::string firstTeam_;
  std::vector<double> ballErrors_;    // m, ball in sight within 5 m
  std::vector<double> playerErrors_;  // m, player in sight within 5 m
};

}  // namespace nonet::lab
