// The ball at the feet: one robot with all its senses and noise, its own team stage and motion, on the
// complete simulation with the referee. What it is to do with the ball is told by an intent
// (team/ball_play.h); where the ball is it must see by itself.
//
// The same arguments always give the same trial.
#pragma once

#include <cstdint>

#include "nonet/agent/agent.h"
#include "nonet/lab/trial/ball_track.h"
#include "nonet/sim/settings/settings.h"

namespace nonet::lab {

/// Beside what was measured: falls, fouls that a skill makes by itself.
struct TrialCost {
  bool fell = false;
  int selfCollisions = 0;
  double simulated = 0.0;  // s, of the trial itself
};

struct Approach : TrialCost {
  bool arrived = false;  // in its place for the kick, facing it within ten degrees
  double time = 0.0;     // s [the longest]
};
/// From 1.5 m, the ball between robot and target in any direction, rolling up to 1 m/s in any direction;
/// among pushes of up to `push` m/s, a second apart on average.
Approach approachOnce(const agent::AgentSettings& agent, const sim::Settings& settings, std::uint64_t seed,
                      double push = 0.0);

struct Dribble : TrialCost, DribbleResult {
  BallPath path;
  BallTrack track;
};
/// 10 m straight ahead.
Dribble dribbleOnce(const agent::AgentSettings& agent, const sim::Settings& settings, std::uint64_t seed);
/// Six turns of 60 degrees, 2 m apart; every other trial begins to the other side.
Dribble slalomOnce(const agent::AgentSettings& agent, const sim::Settings& settings, std::uint64_t seed);

struct Drive : TrialCost {
  double gained = 0.0;  // m nearer to the goal; a goal: the whole way times time allowed / time taken
  bool goal = false;
};
/// Alone, with everything that its team stage does, for 15 s from anywhere [MacAlpine 2012a, section 4.3].
Drive driveOnce(const agent::AgentSettings& agent, const sim::Settings& settings, std::uint64_t seed);

struct Duel : TrialCost {
  double won =
      0.5;  // 1: the ball came 2 m towards the other goal first; 0: towards the own one; 0.5: neither
};
/// The ball 0.5 m from both; the opponent is a whole agent too.
Duel duelOnce(const agent::AgentSettings& agent, const agent::AgentSettings& opponent,
              const sim::Settings& settings, std::uint64_t seed);

struct Attack : TrialCost {
  bool goal = false;
  bool out = false;      // the ball left the field, beside the goal or over a touch line
  bool lost = false;     // the ball was driven 5 m away from the goal line where it began, or farther
  bool charged = false;  // the attacker was taken off for running into somebody
  double worth() const;  // 1: a goal; 0.3: nothing of these yet
};
/// Who plays against the one that attacks.
struct Defence {
  agent::AgentSettings goalie;
  agent::AgentSettings back;
};
/// One with the ball 2.5 to 6 m before the goal, against a goalie and two backs that stand nearer to it, 25
/// s.
Attack attackOnce(const agent::AgentSettings& agent, const Defence& defence, const sim::Settings& settings,
                  std::uint64_t seed);

struct Reception : TrialCost, ReceiveResult {
  double speed = 0.0;  // m/s of the pass a metre before the robot
  double aside = 0.0;  // m, by how much it would pass the robot
};
/// A pass from 3 m, 1 to 3 m/s fast a metre before the robot, up to 0.4 m beside it. Told to keep the ball at
/// its feet, or else to run on with it to the goal, by which it is often farther ahead than counts as held.
Reception receiveOnce(const agent::AgentSettings& agent, const sim::Settings& settings, std::uint64_t seed,
                      bool keeps);

struct Run : TrialCost {
  double speed = 0.0;     // m/s, mean of 3 s beyond 3 m of way
  double stopTime = 0.0;  // s, from the order to a stand
};
Run runOnce(const agent::AgentSettings& agent, const sim::Settings& settings, std::uint64_t seed);

}  // namespace nonet::lab
