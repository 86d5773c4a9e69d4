// What all parts of the referee share: who plays, where the ball is, what is known about every player. The
// parts are placing.h (moving robots), fouls.h and referee.h (clock and set pieces).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "nonet/math/random.h"
#include "nonet/sim/referee/game_state.h"
#include "nonet/sim/referee/geometry.h"
#include "nonet/sim/referee/player.h"

namespace nonet::sim {

/// Who touched the ball. Side and number are copies, so that a player who has left is still known.
struct Toucher {
  AgentHandle agent = kNoAgent;
  TeamSide side = TeamSide::None;
  int unum = 0;

  bool samePlayer(const Toucher& other) const { return side == other.side && unum == other.unum; }
};

/// Server facts 4.4, renewed in each cycle before the rules.
struct BallState {
  bool onField = false;
  Vector3f lastValidPosition = Vector3f::Zero();  // the last one on the field
  World::Goal goal = World::Goal::None;
  Toucher lastToucher;  // agent is kNoAgent while nobody has ever touched the ball
  float lastTouchTime = 0.0F;
  std::vector<Toucher> touchers;  // in this cycle, in connection order

  bool touchedBy(TeamSide side) const {
    for (const Toucher& toucher : touchers) {
      if (toucher.side == side) return true;
    }
    return false;
  }
};

inline constexpr int kVelocitySamples = 3;  // cycles over which charging averages velocities
inline constexpr float kCyclesPerSecond = 50.0F;
inline constexpr float kNeverFrozen = -1e30F;

/// Counters of the foul rules, in cycles where nothing else is said. Indexed by uniform number and side: a
/// number that changes hands keeps its counters, as in the server.
struct RuleTables {
  RuleTables();

  PlayerTable<int> ground{};       // torso below 0.15 m
  PlayerTable<int> notStanding{};  // torso below 0.25 m
  PlayerTable<int> standing{};
  PlayerTable<bool> insideOwnArea{};
  PlayerTable<bool> insideOwnAreaBefore{};
  PlayerTable<int> foulTime{};
  PlayerTable<FoulType> lastFoul{};
  PlayerTable<int> sinceBallTouch{};
  PlayerTable<int> chargingTime{};  // since the last contact that was nobody's charging
  PlayerTable<int> sinceMoved{};    // by the referee
  PlayerTable<std::array<Vector3f, kVelocitySamples>> velocities{};
  PlayerTable<float> lastSelfCollision{};                              // game time, s
  PlayerTable<std::array<float, model::kJointCount>> jointFrozenAt{};  // game time, s, or kNeverFrozen
  PlayerTable<float> ballDistance{};  // m, 1000 for numbers that are not there
  PlayerTable<int> ballRank{};
  PlayerTable<float> goalDistance{};  // to the own goal, of those inside the own area
  PlayerTable<int> goalRank{};
  std::array<float, 3> closestToBall{};  // per side, m
  std::array<int, 3> insideCount{};      // players of a side inside its own area
  std::array<int, 3> movedInside{};      // change of that by moves of this cycle
};

struct RefereeContext {
  RefereeContext(const Settings& s, World& w, std::vector<Player>& p, std::uint64_t seed)
      : settings(s), world(w), players(p), game(s), areas(s), random(seed) {}

  const Settings& settings;
  World& world;
  std::vector<Player>& players;  // robots in the order in which their agents connected
  GameState game;
  BallState ball;
  FieldAreas areas;
  RuleTables tables;
  Random random;
  std::vector<FoulRecord> fouls;
  int nextTouchGroup = 0;

  float ballRadius() const { return static_cast<float>(settings.ballRadius); }
  float agentRadius() const { return static_cast<float>(settings.agentRadius); }
  float halfLength() const { return static_cast<float>(settings.fieldLength) / 2.0F; }
  float halfWidth() const { return static_cast<float>(settings.fieldWidth) / 2.0F; }
  /// Where the torso is now, moves of this cycle included.
  Vector3f torso(const Player& player) const {
    return world.bodyPosition(player.robot, model::BodyId::Torso);
  }
  /// Where it was after the last step: most rules look at this.
  Vector3f sceneTorso(const Player& player) const {
    return world.bodyPose(player.robot, model::BodyId::Torso).position;
  }
  const Box2& ownArea(TeamSide side) const { return areas.penaltyArea(side == TeamSide::Left); }
  /// A foul that waits for its punishment: other rules ignore this player.
  bool hasFoul(int unum, TeamSide side) const;
  bool hasFoul(const Player& player) const { return hasFoul(player.unum, player.side); }
  void recordFoul(FoulType type, const Player& player);
  /// The players of a side (all robots for None), in connection order.
  std::vector<Player*> team(TeamSide side);
  /// The same in random order, as most rules go through them.
  std::vector<Player*> shuffledTeam(TeamSide side);
  Player* find(TeamSide side, int unum);
  template <class T>
  void shuffle(std::vector<T>& items) {
    for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random.below(i)]);
  }
  /// Calls rule(Left) and rule(Right), in random order.
  template <class Rule>
  void bothSidesInRandomOrder(Rule&& rule) {
    const bool leftFirst = random.below(2) == 0;
    rule(leftFirst ? TeamSide::Left : TeamSide::Right);
    rule(leftFirst ? TeamSide::Right : TeamSide::Left);
  }
};

inline float horizontalDistance(const Vector3f& a, const Vector3f& b) {
  return (a.head<2>() - b.head<2>()).norm();
}

}  // namespace nonet::sim
