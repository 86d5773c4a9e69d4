// Charging (server facts 4.10): who runs into an opponent instead of playing the ball.
#include <algorithm>
#include <array>
#include <cmath>

#include "nonet/sim/referee/fouls.h"

namespace nonet::sim {

namespace {

constexpr float kDegrees = static_cast<float>(180.0 / 3.14159265358979323846);
constexpr float kPiF = 3.14159265358979323846F;

// Unsigned angle between two directions of the plane, degrees. A zero vector points along x, as atan2 has it.
float angleBetween(const Vector2f& a, const Vector2f& b) {
  float angle = std::atan2(a.y(), a.x()) - std::atan2(b.y(), b.x());
  while (angle > kPiF) angle -= 2.0F * kPiF;
  while (angle < -kPiF) angle += 2.0F * kPiF;
  return std::abs(angle * kDegrees);
}

// One of the two players in contact.
struct Party {
  const Player* player = nullptr;
  Vector2f position = Vector2f::Zero();
  Vector2f velocity = Vector2f::Zero();  // mean of the last cycles
  float speed = 0.0F;
  float ballDistance = 0.0F;
  float angleToBall = 0.0F;      // between velocity and the direction to the ball, degrees
  float angleToOpponent = 0.0F;  // likewise
  bool goalieAtHome = false;
  bool charging = true;
};

bool atHome(const Player& player, const Vector2f& position, const FieldAreas& areas) {
  if (player.unum != 1) return false;
  const bool left = player.side == TeamSide::Left;
  const Box2& area = areas.penaltyArea(left);
  // The area reaches behind the goal line here.
  const bool deep = left ? position.x() <= area.high.x() : position.x() >= area.low.x();
  return deep && position.y() >= area.low.y() && position.y() <= area.high.y();
}

// Steps 1 and 2 of the rule: who is a candidate.
void findCandidates(std::array<Party, 2>& parties, const Vector3f& contact, const Settings& s) {
  const bool nearBall = parties[0].ballDistance < s.chargingMaxBallRulesDist ||
                        parties[1].ballDistance < s.chargingMaxBallRulesDist;
  if (nearBall) {
    for (Party& p : parties) {
      p.charging = p.angleToBall >= p.angleToOpponent && p.angleToBall >= s.chargingMinBallSpeedAngle &&
                   p.speed >= s.chargingMinSpeed;
    }
    const float distanceGap = std::abs(parties[0].ballDistance - parties[1].ballDistance);
    if (!parties[0].charging && !parties[1].charging && distanceGap > s.chargingMinDeltaDist) {
      // Both seem to go for the ball: the one who is farther away runs into the other.
      const float angleGap = std::abs(parties[0].angleToOpponent - parties[1].angleToOpponent);
      const std::size_t farther = parties[0].ballDistance > parties[1].ballDistance ? 0 : 1;
      parties[farther].charging =
          angleGap > s.chargingMinDeltaAng || parties[1 - farther].speed < s.chargingMinSpeed;
    }
  }
  for (std::size_t i = 0; i < 2; ++i) {
    Party& p = parties[i];
    const Vector2f normal = directionOf((contact.head<2>() + parties[1 - i].position) / 2.0F - p.position);
    p.charging =
        p.charging && p.speed >= s.chargingMinSpeed && p.velocity.dot(normal) >= s.chargingMinCollisionSpeed;
  }
}

}  // namespace

// Step 3: what the contact means for the counters of both, and whose foul it is.
void Fouls::judgeChargingPair(const Player& left, const Player& right, const Vector3f& contact,
                              RuleRecords& next) {
  const RuleRecords& now = c_.records;
  const Settings& s = c_.settings;
  const Vector2f ball = c_.world.ballPosition().head<2>();
  std::array<Party, 2> parties;
  parties[0].player = &left;
  parties[1].player = &right;
  for (Party& p : parties) {
    const PlayerRecord& record = now.of(*p.player);
    if (record.notStanding != 0 || record.sinceMoved < kMovedRecently || c_.hasFoul(*p.player)) return;
    p.position = c_.torso(*p.player).head<2>();
    for (const Vector3f& sample : record.velocities) p.velocity += sample.head<2>();
    p.velocity /= static_cast<float>(kVelocitySamples);
    p.speed = p.velocity.norm();
    p.ballDistance = (p.position - ball).norm();
    p.angleToBall = angleBetween(p.velocity, ball - p.position);
    p.goalieAtHome = atHome(*p.player, p.position, c_.areas);
  }
  parties[0].angleToOpponent = angleBetween(parties[0].velocity, parties[1].position - parties[0].position);
  parties[1].angleToOpponent = angleBetween(parties[1].velocity, parties[0].position - parties[1].position);
  // The server looks at one goalkeeper only: two of them at home in one contact cannot be.
  findCandidates(parties, contact, s);

  const double immunity = cycles(s.chargingImmunityTime);
  for (std::size_t i = 0; i < 2; ++i) {
    const Party& p = parties[i];
    if (!p.charging) continue;
    const PlayerRecord& own = now.of(*p.player);
    PlayerRecord& victim = next.of(*parties[1 - i].player);
    if (p.goalieAtHome) {
      victim.sinceBallTouch = 0;
    } else if (own.sinceBallTouch < immunity) {
      victim.sinceBallTouch = std::min(victim.sinceBallTouch, own.sinceBallTouch);
    }
    victim.chargingTime = std::min(victim.chargingTime, own.chargingTime);
  }
  const bool atBall = (contact.head<2>() - ball).norm() < s.chargingMinCollBallDist;
  if ((parties[0].charging && parties[1].charging) || atBall) {
    parties[0].charging = parties[1].charging = false;
  }
  for (const Party& p : parties) {
    if (s.keepaway && p.player->side == TeamSide::Right) continue;
    const PlayerRecord& own = now.of(*p.player);
    if (!p.charging || p.goalieAtHome || own.chargingTime < cycles(s.chargingCollisionMinTime) ||
        own.sinceBallTouch < immunity) {
      continue;
    }
    PlayerRecord& guilty = next.of(*p.player);
    guilty.foulTime = own.foulTime + 1;
    guilty.lastFoul = FoulType::Charging;
  }
  if (!parties[0].charging && !parties[1].charging) {
    next.of(left).chargingTime = 0;
    next.of(right).chargingTime = 0;
  }
}

void Fouls::judgeCharging() {
  if (!c_.settings.useCharging) return;
  // All pairs are judged by the records of before this cycle.
  RuleRecords next = c_.records;
  for (const Player* left : c_.team(TeamSide::Left)) {
    for (const OpponentContact& contact : opponentContacts) {
      if (contact.leftUnum != left->unum) continue;
      const Player* right = c_.find(TeamSide::Right, contact.rightUnum);
      if (right != nullptr) judgeChargingPair(*left, *right, contact.meanPosition, next);
    }
  }
  c_.records = next;
}

}  // namespace nonet::sim
