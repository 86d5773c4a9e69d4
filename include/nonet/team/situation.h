// All that a decision needs, reckoned once a cycle: where the ball goes and should go, who is when at it, who
// plays which role, whose turn it is. Behaviours read it and reckon none of it again.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "nonet/motion/motion_state.h"
#include "nonet/team/action.h"
#include "nonet/team/ball_play.h"
#include "nonet/team/formation.h"
#include "nonet/team/parameters.h"
#include "nonet/team/play_time.h"
#include "nonet/team/set_play.h"
#include "nonet/world/world_state.h"

namespace nonet::team {

struct Situation {
  const world::WorldState& world;
  const TeamParameters& parameters;
  const motion::MotionState& motion;  // what the body was asked for in the last cycle, and what it does

  // The ball. All in the own field frame, m.
  BallForecast forecast;
  Vector2 p_FTarget = Vector2::Zero();   // where a dribbled ball should go
  std::span<const Candidate> targets{};  // among which that was chosen; empty unless recorded
  double nearestOpponent = 0.0;          // from the ball, of those on their feet, m; infinite: none
  // Time until each team mate (by number; also oneself) can push the ball towards p_FTarget, s. Infinite:
  // nobody knows where it is.
  std::array<double, world::kTeamSize + 1> timeToBall{};

  // The team.
  Formation formation{};      // places of the field players' roles
  Role role = Role::Stopper;  // one's own
  int onBall = 0;             // number of the field player on the ball as agreed, 0 before any vote
  int banned = 0;             // number of the team mate that may not touch the ball, 0: none
  bool mayTouch = true;       // false after a set piece that one has taken, until another touched the ball
  bool mayScore = true;       // false in the own pass mode and after one's kick in it, until a mate touched
  double undisturbed = 0.0;   // s that the referee keeps opponents off the ball (pass_mode.h)
  bool goalieClaims = false;  // the goalie has said that it goes to the ball
  bool claims = false;        // one is the goalie and goes to the ball
  std::optional<SetPlay> setPlay{};  // plan of the own set piece that runs
  std::optional<double> planned{};   // direction that the robot has chosen for it, rad, own field frame
  std::optional<BallPlay> play{};    // it is one's turn to play the ball

  double lastBeam = world::kNever;  // server time at which one asked to be beamed, s

  Vector2 ball() const { return world.ball.p_FB.head<2>(); }
  /// m/s, robot frame.
  Vector2 ballVelocity() const { return world.self.X_FR.inverse().rotate(world.ball.v_FB.head<2>()); }
  world::Phase phase() const { return world.game.phase; }
  bool waitsForKickOff() const;
  /// A team mate that has spoken before and has fallen silent: its agent may have ended.
  bool hasGone(int unum) const;
  /// m from the ball that everybody keeps while the opponents have it to themselves.
  double clearOfOpponentKick() const;
  /// The clock runs and the body is free to do something.
  bool free() const;
  /// Free, and it is known where one is and where the ball is.
  bool acts() const { return free() && world.ball.known && world.self.localized; }
};

/// The part that follows from the world alone, and from where the ball was to go until now (rad, own field
/// frame). Candidates are written to `record` unless it is null; both it and the arguments must outlive the
/// situation.
Situation assess(const world::WorldState& world, const TeamParameters& parameters,
                 const motion::MotionState& motion, const std::optional<double>& present = {},
                 Candidates* record = nullptr);

/// The ball is to be played from where it lies towards p_FTarget.
BallPlay playTowards(const Situation& situation, const Vector2& p_FTarget, KickUse use, bool wait = false);

/// The ball to play when it is one's turn; needs everything above `play`. What was weighed is written to
/// `record` unless that is null.
std::optional<BallPlay> ownTurn(const Situation& situation, Candidates* record = nullptr);

/// Whether the goalie goes to the ball; `claims`: it does so already.
bool goalieWantsBall(const Situation& situation, bool claims);
/// Whether the ball is (own goal kick) or will soon be so near to the goal that the goalie may go to it.
bool goalieReaches(const Situation& situation, bool claims);

}  // namespace nonet::team
