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
inline constexpr int kMovedRecently = 50;   // cycles, after which a move by the referee is forgotten
inline constexpr float kNeverFrozen = -1e30F;

inline constexpr float kFar = 1000.0F;  // m, the distance of players who are not there

/// What the foul rules remember of one player. Counters count cycles.
struct PlayerRecord {
  int ground = 0;       // torso below 0.15 m
  int notStanding = 0;  // torso below 0.25 m
  int standing = 0;
  bool insideOwnArea = false;
  bool insideOwnAreaBefore = false;
  int foulTime = 0;  // since the foul that waits for its punishment
  FoulType lastFoul = FoulType::None;
  int sinceBallTouch = 0;
  int chargingTime = 0;             // since the last contact that was nobody's charging
  int sinceMoved = kMovedRecently;  // by the referee
  std::array<Vector3f, kVelocitySamples> velocities{Vector3f::Zero(), Vector3f::Zero(), Vector3f::Zero()};
  float lastSelfCollision = -1e5F;                                      // game time, s
  std::array<float, model::kJointCount> jointFrozenAt = neverFrozen();  // game time, s, or kNeverFrozen
  float ballDistance = kFar;                                            // m
  int ballRank = 0;                                                     // 1: the nearest of its team
  float goalDistance = kFar;  // m, to the own goal, of those inside the own area
  int goalRank = 0;

 private:
  static constexpr std::array<float, model::kJointCount> neverFrozen() {
    std::array<float, model::kJointCount> times{};
    times.fill(kNeverFrozen);
    return times;
  }
};

/// And of one side.
struct SideRecord {
  float closestToBall = 0.0F;  // m
  int insideCount = 0;         // players inside their own area
  int movedInside = 0;         // change of that by moves of this cycle
};

/// The records go by uniform number and side: a number that changes hands keeps its record, as in the server.
/// Number 0 and side None are robots without team.
struct RuleRecords {
  std::array<std::array<PlayerRecord, 3>, kMaxUnum + 1> players;
  std::array<SideRecord, 3> sides;

  PlayerRecord& of(TeamSide side, int unum) { return players[unum][index(side)]; }
  const PlayerRecord& of(TeamSide side, int unum) const { return players[unum][index(side)]; }
  PlayerRecord& of(const Player& player) { return of(player.side, player.unum); }
  const PlayerRecord& of(const Player& player) const { return of(player.side, player.unum); }
  SideRecord& of(TeamSide side) { return sides[index(side)]; }
  const SideRecord& of(TeamSide side) const { return sides[index(side)]; }
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
  RuleRecords records;
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
  bool hasFoul(TeamSide side, int unum) const;
  bool hasFoul(const Player& player) const { return hasFoul(player.side, player.unum); }
  void recordFoul(FoulType type, const Player& player);
  /// The players of a side (all robots for None), in connection order.
  std::vector<Player*> team(TeamSide side);
  /// The same in random order, as most rules go through them.
  std::vector<Player*> shuffledTeam(TeamSide side);
  Player* find(TeamSide side, int unum);
  template <class Items>
  void shuffle(Items& items) {
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

/// Settings are seconds, counters count cycles. The server keeps seconds in 32 bits: 0.2 s are a little more
/// than 10 cycles there.
inline double cycles(double seconds) {
  return static_cast<double>(static_cast<float>(seconds)) / kCycleTime;
}

inline float horizontalDistance(const Vector3f& a, const Vector3f& b) {
  return (a.head<2>() - b.head<2>()).norm();
}

}  // namespace nonet::sim
