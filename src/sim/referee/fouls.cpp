#include "nonet/sim/referee/fouls.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <spdlog/spdlog.h>

namespace nonet::sim {

namespace {

constexpr float kGroundHeight = 0.15F;    // torso lower than this: on the ground
constexpr float kStandingHeight = 0.25F;  // higher: standing, or trying to

}  // namespace

void Fouls::countFoul(PlayerRecord& record, FoulType foul) {
  ++record.foulTime;
  record.lastFoul = foul;
}

void Fouls::resetPlayer(PlayerRecord& record) const {
  record.ground = 0;
  record.notStanding = 0;
  record.standing = 250;
  record.insideOwnAreaBefore = false;
  record.insideOwnArea = false;
  record.foulTime = 0;
  record.sinceBallTouch = static_cast<int>(cycles(c_.settings.chargingImmunityTime));
  record.chargingTime = static_cast<int>(cycles(c_.settings.chargingCollisionMinTime));
  record.lastFoul = FoulType::None;
}

void Fouls::reset() {
  for (int unum = 1; unum <= kMaxUnum; ++unum) {
    resetPlayer(c_.records.of(TeamSide::Left, unum));
    resetPlayer(c_.records.of(TeamSide::Right, unum));
  }
  for (const Player& player : c_.players) thaw(player);
}

void Fouls::update() {
  measure(TeamSide::Left);
  measure(TeamSide::Right);
  for (const Toucher& toucher : c_.ball.touchers) {
    c_.records.of(toucher.side, toucher.unum).sinceBallTouch = 0;
  }
  judgeCharging();
  judgeSelfCollisions(TeamSide::Left);
  judgeSelfCollisions(TeamSide::Right);
  judgePositions(TeamSide::Left);
  judgePositions(TeamSide::Right);
  c_.bothSidesInRandomOrder([this](TeamSide side) { judgeTouching(side); });
  c_.bothSidesInRandomOrder([this](TeamSide side) { punish(side); });
  renewTouchGroups();
  thawJoints();
}

void Fouls::sampleVelocities() {
  for (const Player& player : c_.players) {
    auto& samples = c_.records.of(player).velocities;
    std::rotate(samples.begin(), samples.end() - 1, samples.end());
    samples[0] = c_.world.bodyVelocity(player.robot, model::BodyId::Torso);
  }
}

// Server facts 4.10, "Incapable": what counts is the height of the torso, while |y| is inside the touch
// lines.
void Fouls::countPosture(const Player& player, float height, float y) {
  PlayerRecord& record = c_.records.of(player);
  const bool onField = std::abs(y) < static_cast<double>(c_.halfWidth()) + 0.1;
  if (height < kStandingHeight && onField) {
    ++record.notStanding;
    record.standing = 0;
  }
  if (height < kGroundHeight && onField) ++record.ground;
  if (height >= kStandingHeight) {
    ++record.standing;
    record.ground = 0;
  }
  constexpr int kStandingAgain = 25;  // cycles
  if (record.standing > kStandingAgain) record.notStanding = 0;
  ++record.sinceBallTouch;
  ++record.chargingTime;
  ++record.sinceMoved;
}

void Fouls::measure(TeamSide side) {
  SideRecord& team = c_.records.of(side);
  team = {.closestToBall = kFar};
  for (int unum = 1; unum <= kMaxUnum; ++unum) {
    PlayerRecord& record = c_.records.of(side, unum);
    record.ballDistance = kFar;
    record.goalDistance = kFar;
    record.ballRank = 1;
    record.goalRank = 1;
  }
  const Vector3f ball = c_.world.ballPosition();
  const Vector3f ownGoal(side == TeamSide::Left ? -c_.halfLength() : c_.halfLength(), 0.0F, 0.0F);
  const std::vector<Player*> players = c_.team(side);
  for (const Player* player : players) {
    PlayerRecord& record = c_.records.of(*player);
    const Vector3f torso = c_.sceneTorso(*player);
    record.ballDistance = horizontalDistance(torso, ball);
    team.closestToBall = std::min(team.closestToBall, record.ballDistance);
    record.insideOwnAreaBefore = record.insideOwnArea;
    record.insideOwnArea = c_.ownArea(side).contains(torso.head<2>()) && !c_.hasFoul(*player);
    if (record.insideOwnArea) {
      ++team.insideCount;
      // The goalkeeper is never the one to go; who has just entered is not ranked.
      if (player->unum == 1) {
        record.goalDistance = 0.0F;
      } else if (record.insideOwnAreaBefore) {
        record.goalDistance = horizontalDistance(torso, ownGoal);
      }
    }
    countPosture(*player, torso.z(), torso.y());
  }
  rank(players, &PlayerRecord::ballDistance, &PlayerRecord::ballRank);
  rank(players, &PlayerRecord::goalDistance, &PlayerRecord::goalRank);
}

// Rank 1 is the nearest. Of two equal ones the smaller number counts as farther.
void Fouls::rank(const std::vector<Player*>& players, float PlayerRecord::*distance,
                 int PlayerRecord::*rank) {
  for (const Player* player : players) {
    PlayerRecord& first = c_.records.of(*player);
    if (c_.hasFoul(*player)) {
      first.*rank = -1;
      continue;
    }
    for (const Player* other : players) {
      if (other->unum <= player->unum || c_.hasFoul(*other)) continue;
      PlayerRecord& second = c_.records.of(*other);
      ++((first.*distance >= second.*distance ? first : second).*rank);
    }
  }
}

bool Fouls::isCrowding(TeamSide side, int unum) const {
  const PlayMode mode = c_.game.playMode();
  const bool ownKickOff = (mode == PlayMode::KickOffLeft && side == TeamSide::Left) ||
                          (mode == PlayMode::KickOffRight && side == TeamSide::Right);
  if (ownKickOff || unum == 1 ||
      c_.records.of(opponentOf(side)).closestToBall >= c_.settings.minOppDistance) {
    return false;
  }
  const PlayerRecord& record = c_.records.of(side, unum);
  return (record.ballRank == 3 && record.ballDistance <= c_.settings.min3PlDistance + 0.01) ||
         (record.ballRank == 2 && record.ballDistance <= c_.settings.min2PlDistance + 0.01);
}

bool Fouls::isIllegalDefence(TeamSide side, int unum) const {
  const PlayerRecord& record = c_.records.of(side, unum);
  const PlayerRecord& goalie = c_.records.of(side, 1);
  const int allowed = c_.settings.maxPlayersInsideOwnArea;
  if (c_.records.of(side).insideCount <= allowed || unum == 1 || !record.insideOwnArea) return false;
  const bool justEntered = !record.insideOwnAreaBefore;
  const bool goalieEntered = !goalie.insideOwnAreaBefore && goalie.insideOwnArea;
  return justEntered || (goalieEntered && record.goalRank == allowed + 1);
}

bool Fouls::isIncapable(TeamSide side, int unum) const {
  const bool goalie = unum == 1;
  const double ground = goalie ? c_.settings.goalieGroundMaxTime : c_.settings.groundMaxTime;
  const double notStanding = goalie ? c_.settings.goalieNotStandingMaxTime : c_.settings.notStandingMaxTime;
  const PlayerRecord& record = c_.records.of(side, unum);
  return record.ground > cycles(ground) || record.notStanding > cycles(notStanding);
}

void Fouls::judgePositions(TeamSide side) {
  std::array<int, kMaxUnum> unums{};
  std::iota(unums.begin(), unums.end(), 1);
  c_.shuffle(unums);
  for (const int unum : unums) {
    if (c_.hasFoul(side, unum)) continue;
    PlayerRecord& record = c_.records.of(side, unum);
    if (isCrowding(side, unum)) {
      countFoul(record, FoulType::Crowding);
    } else if (isIllegalDefence(side, unum)) {
      punishIllegalDefence(side, unum);
    } else if (isIncapable(side, unum)) {
      countFoul(record, FoulType::Incapable);
    } else {
      record.foulTime = 0;
      record.lastFoul = FoulType::None;
    }
  }
}

void Fouls::punishIllegalDefence(TeamSide side, int unum) {
  countFoul(c_.records.of(side, unum), FoulType::IllegalDefence);
  --c_.records.of(side).insideCount;
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
  for (const Player* player : c_.shuffledTeam(side)) {
    if (!c_.hasFoul(*player)) continue;
    PlayerRecord& record = c_.records.of(*player);
    const FoulType foul = record.lastFoul;
    c_.recordFoul(foul, *player);
    const bool alreadyMoved = (foul == FoulType::IllegalDefence && !c_.settings.illegalDefenseBeamPenalty) ||
                              (foul == FoulType::Touching && !c_.settings.touchingFoulBeamPenalty);
    if (alreadyMoved) {
      resetPlayer(record);
    } else if (record.foulTime <= cycles(c_.settings.foulHoldTime)) {
      ++record.foulTime;
      Vector3f place = c_.torso(*player);
      place.z() = static_cast<float>(1.0 + record.foulTime * 0.01);
      placing_.move(*player, place, Placing::Where::Exactly);
    } else {
      spdlog::info("referee: player {} ({}) is put outside the field (foul {})", player->unum, sideName(side),
                   static_cast<int>(foul));
      Vector3f place = placing_.outsidePosition(*player);
      if (c_.settings.foulHoldTime > 0.0) place.z() = c_.agentRadius();
      placing_.move(*player, place);
      resetPlayer(record);
    }
  }
}

}  // namespace nonet::sim
