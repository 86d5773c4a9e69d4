// The referee (server facts, section 4): clock and halves, ball state, set pieces, goals, pass mode, fouls.
// One update per cycle after the physics step, in the server's order.
#pragma once

#include "nonet/sim/referee/context.h"
#include "nonet/sim/referee/fouls.h"
#include "nonet/sim/referee/placing.h"

namespace nonet::sim {

class Referee {
 public:
  /// `players` belongs to the caller, who keeps it in connection order; all references must outlive the
  /// referee.
  Referee(const Settings& settings, World& world, std::vector<Player>& players, std::uint64_t seed);
  Referee(const Referee&) = delete;
  Referee& operator=(const Referee&) = delete;

  /// Clock, ball state, rules. `clientCount`: connected agents, with or without robot.
  void update(int clientCount);

  GameState& game() { return c_.game; }
  const GameState& game() const { return c_.game; }
  const BallState& ball() const { return c_.ball; }
  std::span<const FoulRecord> fouls() const { return c_.fouls; }
  Placing& placing() { return placing_; }
  /// A number for a new robot's touch group.
  int newTouchGroup() { return c_.nextTouchGroup++; }

  /// This player gets another number or side: its contacts are forgotten, its joints are free.
  void changeNumber(const Player& player);
  /// This player leaves: its contacts are forgotten.
  void forget(const Player& player) { fouls_.forgetContacts(player); }

  /// An agent's `(pass)`: switches to pass mode if all conditions of server facts 4.9 hold.
  bool requestPassMode(const Player& player);
  /// Drop ball (server facts 4.7) where the ball is.
  void dropBall();
  void kickOff(TeamSide side) { c_.game.kickOff(side, c_.settings, c_.random); }

  void save(std::vector<std::uint8_t>& out) const;
  /// Reads what save() wrote and removes it from the front of `in`. Throws std::runtime_error if `in` is too
  /// short.
  void restore(std::span<const std::uint8_t>& in);

 private:
  void updateBall();
  void updateClock();
  void updateKickOffScoring();
  void updateMode(int clientCount);
  void updateKeepaway();
  void updateShootout();
  void swapSides();
  void moveBall(const Vector3f& position);
  void dropBallAt(Vector3f position);

  void beforeKickOff(int clientCount);
  void kickOffMode(TeamSide side, int clientCount);
  /// What set pieces share; false while the pause lasts or when the ball was dropped.
  bool setPieceRuns(TeamSide side);
  bool setPieceTouched() const;
  void holdBall(TeamSide side);
  void kickInMode(TeamSide side);
  void freeKickMode(TeamSide side, bool indirect);
  void cornerKickMode(TeamSide side);
  void goalKickMode(TeamSide side);
  void passMode(TeamSide side, int clientCount);
  void goalMode(TeamSide scorer);
  void playOn(int clientCount);

  void watchPassMode();
  bool punishDoubleTouch();
  bool checkGoal(int clientCount);
  /// The goal (Left or Right) that the ball went into; None if none.
  TeamSide goalSide() const;
  bool checkBallOut();
  void awardGoalKick(TeamSide side);
  void awardCornerKick(TeamSide side);
  void awardKickIn(TeamSide side);
  void awardFreeKick(TeamSide side);
  void punishIndirectGoal(TeamSide kicker, TeamSide goal);
  void resetKickChecks();
  void kickTaken(bool indirect);
  bool lastKickWasSetPiece() const;
  /// The toucher with the side that this agent has now.
  Toucher present(const Toucher& toucher) const;

  // Everything about set pieces that outlives a cycle.
  struct SetPieces {
    Vector3f position = Vector3f::Zero();  // where the ball is (to be) placed
    bool repelKickers = false;             // in the first cycle after the pause
    bool watchDoubleTouch = false;
    Toucher taker;
    float kickTime = 0.0F;
    bool indirect = false;
    Toucher kickOffTaker;
    bool kickOffTeamMayScore = true;
    float autoKickOffOrigin = 1e6F;
    std::array<Vector3f, 3> passBallPosition{Vector3f::Zero(), Vector3f::Zero(), Vector3f::Zero()};
    std::array<int, 3> passToucher{-1, -1, -1};  // number of the first player who touched the ball since
    std::array<bool, 3> passSeveralTouched{};
    std::array<bool, 3> passBallLeft{};
    bool shootout = false;
  };

  RefereeContext c_;
  Placing placing_;
  Fouls fouls_;
  SetPieces p_;
};

}  // namespace nonet::sim
