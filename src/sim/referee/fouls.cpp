#include "nonet/sim/referee/fouls.h"

#include <algorithm>
#include <cmath>

#include <spdlog/spdlog.h>

namespace nonet::sim {

namespace {

constexpr float kGroundHeight = 0.15F;    // torso lower than this: on the ground
constexpr float kStandingHeight = 0.25F;  // higher: standing, or trying to
constexpr float kFar = 1000.0F;

// Thresholds of the rules are seconds; counters count cycles.
double cycles(double seconds) {
  return seconds / 0.02;
}

}  // namespace

void Fouls::resetPlayer(int unum, TeamSide side) {
  RuleTables& t = c_.tables;
  const std::size_t s = index(side);
  t.ground[unum][s] = 0;
  t.notStanding[unum][s] = 0;
  t.standing[unum][s] = 250;
  t.insideOwnAreaBefore[unum][s] = false;
  t.insideOwnArea[unum][s] = false;
  t.foulTime[unum][s] = 0;
  t.sinceBallTouch[unum][s] = static_cast<int>(cycles(c_.settings.chargingImmunityTime));
  t.chargingTime[unum][s] = static_cast<int>(cycles(c_.settings.chargingCollisionMinTime));
  t.lastFoul[unum][s] = FoulType::None;
}

void Fouls::reset() {
  for (int unum = 1; unum <= kMaxUnum; ++unum) {
    resetPlayer(unum, TeamSide::Left);
    resetPlayer(unum, TeamSide::Right);
  }
  thawJoints(true);
}

void Fouls::update() {
  measure(TeamSide::Left);
  measure(TeamSide::Right);
  for (const Toucher& toucher : c_.ball.touchers) {
    c_.tables.sinceBallTouch[toucher.unum][index(toucher.side)] = 0;
  }
  judgeCharging();
  judgeSelfCollisions(TeamSide::Left);
  judgeSelfCollisions(TeamSide::Right);
  judgePositions(TeamSide::Left);
  judgePositions(TeamSide::Right);
  c_.bothSidesInRandomOrder([this](TeamSide side) { judgeTouching(side); });
  c_.bothSidesInRandomOrder([this](TeamSide side) { punish(side); });
  renewTouchGroups();
  thawJoints(false);
}

void Fouls::sampleVelocities() {
  for (const Player& player : c_.players) {
    auto& samples = c_.tables.velocities[player.unum][index(player.side)];
    std::rotate(samples.begin(), samples.end() - 1, samples.end());
    samples[0] = c_.world.bodyVelocity(player.robot, model::BodyId::Torso);
  }
}

// Server facts 4.10, "Incapable": what counts is the height of the torso, while |y| is inside the touch
// lines.
void Fouls::countPosture(const Player& player, float height, float y) {
  RuleTables& t = c_.tables;
  const std::size_t s = index(player.side);
  const int unum = player.unum;
  const bool onField = std::abs(y) < static_cast<double>(c_.halfWidth()) + 0.1;
  if (height < kStandingHeight && onField) {
    ++t.notStanding[unum][s];
    t.standing[unum][s] = 0;
  }
  if (height < kGroundHeight && onField) ++t.ground[unum][s];
  if (height >= kStandingHeight) {
    ++t.standing[unum][s];
    t.ground[unum][s] = 0;
  }
  constexpr int kStandingAgain = 25;  // cycles
  if (t.standing[unum][s] > kStandingAgain) t.notStanding[unum][s] = 0;
  ++t.sinceBallTouch[unum][s];
  ++t.chargingTime[unum][s];
  ++t.sinceMoved[unum][s];
}

void Fouls::measure(TeamSide side) {
  RuleTables& t = c_.tables;
  const std::size_t s = index(side);
  t.insideCount[s] = 0;
  t.movedInside[s] = 0;
  t.closestToBall[s] = kFar;
  for (int unum = 1; unum <= kMaxUnum; ++unum) {
    t.ballDistance[unum][s] = kFar;
    t.goalDistance[unum][s] = kFar;
    t.ballRank[unum][s] = 1;
    t.goalRank[unum][s] = 1;
  }
  const Vector3f ball = c_.world.ballPosition();
  const Vector3f ownGoal(side == TeamSide::Left ? -c_.halfLength() : c_.halfLength(), 0.0F, 0.0F);
  for (const Player* player : c_.team(side)) {
    const int unum = player->unum;
    const Vector3f torso = c_.sceneTorso(*player);
    t.ballDistance[unum][s] = horizontalDistance(torso, ball);
    t.closestToBall[s] = std::min(t.closestToBall[s], t.ballDistance[unum][s]);
    t.insideOwnAreaBefore[unum][s] = t.insideOwnArea[unum][s];
    const bool inside = c_.ownArea(side).contains(torso.head<2>()) && !c_.hasFoul(*player);
    t.insideOwnArea[unum][s] = inside;
    if (inside) {
      ++t.insideCount[s];
      // The goalkeeper is never the one to go; who has just entered is not ranked.
      if (unum == 1) {
        t.goalDistance[unum][s] = 0.0F;
      } else if (t.insideOwnAreaBefore[unum][s]) {
        t.goalDistance[unum][s] = horizontalDistance(torso, ownGoal);
      }
    }
    countPosture(*player, torso.z(), torso.y());
  }
  rank(t.ballDistance, t.ballRank, side, c_);
  rank(t.goalDistance, t.goalRank, side, c_);
}

// Rank 1 is the nearest. Of two equal ones the smaller number counts as farther.
void Fouls::rank(const PlayerTable<float>& distances, PlayerTable<int>& ranks, TeamSide side,
                 const RefereeContext& context) {
  const std::size_t s = index(side);
  for (int a = 1; a <= kMaxUnum; ++a) {
    if (context.hasFoul(a, side)) {
      ranks[a][s] = -1;
      continue;
    }
    for (int b = a + 1; b <= kMaxUnum; ++b) {
      if (context.hasFoul(b, side)) continue;
      ++(distances[a][s] >= distances[b][s] ? ranks[a][s] : ranks[b][s]);
    }
  }
}

bool Fouls::isCrowding(int unum, TeamSide side) const {
  const PlayMode mode = c_.game.playMode();
  const bool ownKickOff = (mode == PlayMode::KickOffLeft && side == TeamSide::Left) ||
                          (mode == PlayMode::KickOffRight && side == TeamSide::Right);
  const std::size_t s = index(side);
  if (ownKickOff || unum == 1 ||
      c_.tables.closestToBall[index(opponentOf(side))] >= c_.settings.minOppDistance) {
    return false;
  }
  const float distance = c_.tables.ballDistance[unum][s];
  const int rank = c_.tables.ballRank[unum][s];
  return (rank == 3 && distance <= c_.settings.min3PlDistance + 0.01) ||
         (rank == 2 && distance <= c_.settings.min2PlDistance + 0.01);
}

bool Fouls::isIllegalDefence(int unum, TeamSide side) const {
  const RuleTables& t = c_.tables;
  const std::size_t s = index(side);
  const int allowed = c_.settings.maxPlayersInsideOwnArea;
  if (t.insideCount[s] <= allowed || unum == 1 || !t.insideOwnArea[unum][s]) return false;
  const bool justEntered = !t.insideOwnAreaBefore[unum][s];
  const bool goalieEntered = !t.insideOwnAreaBefore[1][s] && t.insideOwnArea[1][s];
  return justEntered || (goalieEntered && t.goalRank[unum][s] == allowed + 1);
}

bool Fouls::isIncapable(int unum, TeamSide side) const {
  const std::size_t s = index(side);
  const bool goalie = unum == 1;
  const double ground = goalie ? c_.settings.goalieGroundMaxTime : c_.settings.groundMaxTime;
  const double notStanding = goalie ? c_.settings.goalieNotStandingMaxTime : c_.settings.notStandingMaxTime;
  return c_.tables.ground[unum][s] > cycles(ground) || c_.tables.notStanding[unum][s] > cycles(notStanding);
}

void Fouls::judgePositions(TeamSide side) {
  std::array<int, kMaxUnum> unums{};
  for (int i = 0; i < kMaxUnum; ++i) unums[i] = i + 1;
  for (std::size_t i = unums.size(); i > 1; --i) std::swap(unums[i - 1], unums[c_.random.below(i)]);
  RuleTables& t = c_.tables;
  const std::size_t s = index(side);
  for (const int unum : unums) {
    if (c_.hasFoul(unum, side)) continue;
    if (isCrowding(unum, side)) {
      ++t.foulTime[unum][s];
      t.lastFoul[unum][s] = FoulType::Crowding;
    } else if (isIllegalDefence(unum, side)) {
      punishIllegalDefence(unum, side);
    } else if (isIncapable(unum, side)) {
      ++t.foulTime[unum][s];
      t.lastFoul[unum][s] = FoulType::Incapable;
    } else {
      t.foulTime[unum][s] = 0;
      t.lastFoul[unum][s] = FoulType::None;
    }
  }
}

void Fouls::punishIllegalDefence(int unum, TeamSide side) {
  const std::size_t s = index(side);
  ++c_.tables.foulTime[unum][s];
  c_.tables.lastFoul[unum][s] = FoulType::IllegalDefence;
  --c_.tables.insideCount[s];
  const Player* player = c_.find(side, unum);
  if (c_.settings.illegalDefenseBeamPenalty || player == nullptr) return;

  Vector3f place = c_.sceneTorso(*player);
  const Vector2f from = place.head<2>();
  const Box2& area = c_.ownArea(side);
  const float margin = c_.agentRadius();
  const auto outside = [margin](float low, float high, float at) {
    return std::abs(low - at) < std::abs(high - at) ? low - margin : high + margin;
  };
  const float x = outside(area.low.x(), area.high.x(), from.x());
  const float y = outside(area.low.y(), area.high.y(), from.y());
  if (std::abs(y - from.y()) < std::abs(x - from.x())) {
    place.y() = y;
  } else {
    place.x() = x;
  }
  const float besideGoal = static_cast<float>(c_.settings.goalWidth) / 2.0F + margin;
  if (std::abs(place.x()) > c_.halfLength() && std::abs(place.y()) < besideGoal) {
    place.y() = (besideGoal + 0.001F) * (place.y() < 0.0F ? -1.0F : 1.0F);
  }
  placing_.move(*player, place);
}

// Server facts 4.10, "Punishment by removal": held in the air, then put outside the field.
void Fouls::punish(TeamSide side) {
  RuleTables& t = c_.tables;
  const std::size_t s = index(side);
  for (const Player* player : c_.shuffledTeam(side)) {
    if (!c_.hasFoul(*player)) continue;
    const int unum = player->unum;
    const FoulType foul = t.lastFoul[unum][s];
    c_.recordFoul(foul, *player);
    const bool alreadyMoved = (foul == FoulType::IllegalDefence && !c_.settings.illegalDefenseBeamPenalty) ||
                              (foul == FoulType::Touching && !c_.settings.touchingFoulBeamPenalty);
    if (alreadyMoved) {
      resetPlayer(unum, side);
    } else if (t.foulTime[unum][s] <= cycles(c_.settings.foulHoldTime)) {
      ++t.foulTime[unum][s];
      Vector3f place = c_.torso(*player);
      place.z() = static_cast<float>(1.0 + t.foulTime[unum][s] * 0.01);
      placing_.move(*player, place, Placing::Where::Exactly);
    } else {
      spdlog::info("referee: player {} ({}) is put outside the field (foul {})", unum,
                   side == TeamSide::Left ? "left" : "right", static_cast<int>(foul));
      Vector3f place = placing_.outsidePosition(*player);
      if (c_.settings.foulHoldTime > 0.0) place.z() = c_.agentRadius();
      placing_.move(*player, place);
      resetPlayer(unum, side);
    }
  }
}

}  // namespace nonet::sim
