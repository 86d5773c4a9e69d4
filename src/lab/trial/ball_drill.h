// What the trials with a ball share: a robot that plays the ball by an intent, and the record of its trial.
#pragma once

#include <functional>
#include <memory>

#include "nonet/lab/trial/ball_trial.h"
#include "nonet/lab/trial/game_trial.h"
#include "nonet/math/random.h"
#include "nonet/team/behavior.h"

namespace nonet::lab {

/// What is drawn for a trial: where the robot and the ball begin, and where the ball is to go.
struct BallScene {
  GameSituation situation;  // without players
  Pose2 start;              // of the robot
  Vector2 target = Vector2::Zero();
  BallPath path;       // dribbling
  double speed = 0.0;  // of a pass a metre before the robot, m/s
  double aside = 0.0;  // by which it would pass the robot, m
};
BallScene dribbleScene(Random& random);
BallScene slalomScene(Random& random);
BallScene passScene(Random& random);

/// Where the ball is to go as the robot believes it to lie.
using Intention = std::function<team::BallIntent(const world::WorldState&)>;

/// The whole team stage with an intent in place of the game's. Copies share it.
Mind drilled(const team::TeamParameters& parameters, Intention intention);
Mind drilled(const team::TeamParameters& parameters, const Vector2& p_FTarget, team::KickUse use);

/// After the ball's place along the path, a little ahead of it; turns when the ball is at a corner. Kept at
/// the feet.
Intention along(const BallPath& path);

/// A field player at that place.
GamePlayer fieldPlayer(const agent::AgentSettings& agent, const Pose2& X_WR, Mind mind,
                       bool rightTeam = false);

/// The right team's goalie, number 1, 0.6 m before the middle of its line.
GamePlayer rightGoalie(const agent::AgentSettings& agent, const Vector2& goal);

/// A trial with its track, which is judged by the truth.
class RecordedTrial {
 public:
  RecordedTrial(const sim::Settings& settings, const GameSituation& situation, std::uint64_t seed);

  void step();
  /// Goes on while this holds, at most so long.
  void run(
      double seconds, const std::function<bool()>& goesOn = [] { return true; });

  GameTrial& game() { return game_; }
  const BallTrack& track() const { return track_; }
  bool playsOn() const;
  /// Falls and fouls of the first player until now.
  void charge(TrialCost& cost) const;

 private:
  void record();

  GameTrial game_;
  BallTrack track_;
  bool fell_ = false;
};

}  // namespace nonet::lab
