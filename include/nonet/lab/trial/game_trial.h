// A piece of a game: whole agents, or robots that do what a function tells them, on the complete simulation
// with vision and its noise, the ball, hearing and the referee. For what walking alone does not show: going
// to a ball, kicking it as it is seen, dribbling, passing, duels.
//
// A trial begins with the players at their places, upright, and the ball at its place with its velocity, in
// the wanted play mode. They get there as in a match: before the kick-off they ask to be beamed, stand, and
// look about for a moment, so that each has found its place and the ball's by its own eyes when the trial
// begins.
//
// World axes are the field frame of the left team, units m, s, rad. The same situation, settings and seed
// always give the same trial.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "nonet/agent/agent.h"
#include "nonet/sim/settings/settings.h"
#include "nonet/sim/simulation.h"
#include "nonet/team/action.h"

namespace nonet {
class Random;
}

namespace nonet::lab {

/// What a robot is to do, from what it believes and what its body is doing. Called once a cycle.
using Mind = std::function<team::Action(const world::WorldState&, const motion::MotionState&)>;

struct GamePlayer {
  /// Body, number and parameters. Number 0 gets the next free one; name of the team, seed and start pose are
  /// the trial's.
  agent::AgentSettings agent;
  bool rightTeam = false;
  Pose2 X_WR;  // where it begins
  Mind mind;   // empty: the agent's own team stage
};

struct GameSituation {
  std::vector<GamePlayer> players;
  Vector2 ball = Vector2::Zero();          // world
  Vector2 ballVelocity = Vector2::Zero();  // world, m/s
  protocol::PlayMode playMode = protocol::PlayMode::PlayOn;
};

class GameTrial {
 public:
  /// Rules and noise are those of `settings` but for the places of beams, which are exact. Throws
  /// std::runtime_error when the server refuses a player (numbers, robot types).
  GameTrial(const sim::Settings& settings, const GameSituation& situation, std::uint64_t seed);
  ~GameTrial();

  /// One cycle of 20 ms.
  void step();
  void run(double seconds);
  /// Puts the ball there (world, m) with this velocity and without spin, as a trainer can.
  void throwBall(const Vector3& place, const Vector3& velocity);
  /// Somebody bumps into it (push.h): up to `most` m/s in any direction.
  void push(std::size_t player, double most, Random& random);
  /// The referee changes to this mode at once.
  void setPlayMode(protocol::PlayMode playMode);

  // -- truth; players by their place in the situation
  double time() const;                    // s since the trial began
  Pose2 pose(std::size_t player) const;   // torso on the ground, heading; world
  double tilt(std::size_t player) const;  // rad between torso and upright
  /// Torso below 0.55 of the standing height: it lies or kneels.
  bool down(std::size_t player) const;
  Vector3 ball() const;
  Vector3 ballVelocity() const;  // m/s
  /// Fouls of this kind that the referee has given against a player since the trial began.
  int fouls(std::size_t player, sim::FoulType type) const;
  const sim::Simulation& simulation() const;

  // -- belief, in the own field frame of the player
  const world::WorldState& belief(std::size_t player) const;
  /// What a player without a mind of the trial's decided in the last step.
  const team::Action& action(std::size_t player) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace nonet::lab
