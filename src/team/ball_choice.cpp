#include "nonet/team/ball_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "nonet/math/angle.h"
#include "nonet/math/direction.h"

#include "team/play_value.h"

namespace nonet::team {

namespace {

constexpr int kDirections = 12;  // to either side of straight ahead
constexpr double kStep = toRadians(10.0);
constexpr int kAllDirections = 36;       // of that step, all around
constexpr double kSlowRoll = 3.0;        // s until a kicked ball is slow enough to be taken
constexpr double kSameKick = 0.2;        // rad
constexpr double kGoalLineMargin = 0.1;  // m beyond the line that a shot must reach

// s until the first of them is there; infinite without any.
double soonest(std::span<const world::PlayerState> players, const Vector2& p_F, double pace,
               double risingTime) {
  double least = std::numeric_limits<double>::infinity();
  for (const world::PlayerState& player : players)
    least = std::min(least, arrival(player, p_F, pace, risingTime));
  return least;
}

// The probability that one of us is first at a ball that comes to rest there; nobody takes it before it is
// slow. The goalie stays at home.
double oursAt(const Situation& s, const Vector2& p_F) {
  const ChoiceParameters& p = s.parameters.choice;
  const double own = std::max(teammatesTime(s, p_F), kSlowRoll) + p.late;
  const double theirs = std::max(opponentsTime(s, p_F), kSlowRoll);
  return probabilityFirst(own, theirs, p.arrivalSpread);
}

// Of ending at p_F, which may be out of the field.
double endValue(const Situation& s, const Vector2& p_F) {
  const auto& field = s.world.field;
  if (field.holds(p_F)) return valueAt(s, p_F, oursAt(s, p_F));
  const Vector2 inside = field.nearestInside(p_F);
  const ChoiceParameters& p = s.parameters.choice;
  return -worthOf(-inside, field, p) - p.out * worthOf(inside, field, p);
}

struct Fan {
  double middle = 0.0;  // rad, own field frame
  int from = 0;         // steps from there to the first direction
  int to = 0;           // and to the last one
};

// A direction that is worth more, because it was chosen before; rad, own field frame.
struct Present {
  std::optional<double> direction;
  double worth = 0.0;
};

// `best` becomes the most valuable kick in these directions if one is worth more than it.
template <class Value>
void weighKicks(const Situation& s, const Fan& fan, const Present& present, Candidates* record,
                BallChoice& best, const Value& valueOf) {
  const ChoiceParameters& p = s.parameters.choice;
  for (const motion::KickOption& kick : s.motion.kicks) {
    const motion::KickHead& head = kick.head;
    if (kick.foot != model::Side::Left || !head.isStraight() || head.scales || head.isChip()) continue;
    if (!head.hasRoom(s.nearestOpponent, s.motion.kick.name == kick.name)) continue;
    const double length = p.length * head.longest;
    for (int i = fan.from; i <= fan.to; ++i) {
      const double direction = wrapAngle(fan.middle + kStep * i);
      const Vector2 target = s.ball() + length * unitVector(direction);
      double value = valueOf(head, direction, length);
      if (isSameKick(present.direction, direction)) value += present.worth;
      if (record != nullptr) record->add(target, value);
      if (value <= best.value) continue;
      best = {true, target, value, kick.name};
    }
  }
}

}  // namespace

std::optional<double> presentKick(const Situation& s) {
  const auto* kick = std::get_if<motion::KickTo>(&s.motion.request);
  if (kick == nullptr) return std::nullopt;
  return directionOf(s.world.self.X_FR.rotate(kick->target - kick->ball));
}

bool isSameKick(const std::optional<double>& present, double direction) {
  return present && std::abs(angleDifference(direction, *present)) < kSameKick;
}

double opponentsTime(const Situation& s, const Vector2& p_F) {
  return soonest(s.world.opponents, p_F, s.parameters.choice.opponentPace, s.parameters.pace.risingTime);
}

double teammatesTime(const Situation& s, const Vector2& p_F) {
  double least = std::numeric_limits<double>::infinity();
  for (int unum = 2; unum <= world::kTeamSize; ++unum) {
    if (s.setPlay && unum == s.world.game.unum) continue;  // who takes it must leave it to the others
    if (s.hasGone(unum)) continue;
    const world::PlayerState& mate = s.world.teammates[static_cast<std::size_t>(unum)];
    least = std::min(least, arrival(mate, p_F, s.parameters.choice.ownPace, s.parameters.pace.risingTime));
  }
  return least;
}

double kickValue(const Situation& s, double direction, double length, bool mayScore) {
  const ChoiceParameters& p = s.parameters.choice;
  const double toLine =
      (s.world.field.goalLine() + kGoalLineMargin - s.ball().x()) / std::max(std::cos(direction), 1e-3);
  const bool reaches = mayScore && std::cos(direction) > 0.1 && toLine < p.shotLength / p.length * length;
  const double scores = reaches ? hitsGoal(s.world, direction, p.spread) : 0.0;
  const double flown = scores > 0.0 ? std::min(toLine, length) : length;
  const Block block = blockOf(s, s.ball() + flown * unitVector(direction));
  const double free = scores + (1.0 - scores) * endValue(s, s.ball() + length * unitVector(direction));
  return valueUnlessStopped(s, block, free);
}

BallChoice chooseSetPiece(const Situation& s, Candidates* record) {
  const Vector2& p_FReceiver = s.setPlay->p_FReceiver;
  const ChoiceParameters& p = s.parameters.choice;
  const double first =
      probabilityFirst(teammatesTime(s, p_FReceiver), opponentsTime(s, p_FReceiver), p.arrivalSpread);
  const double value =
      valueUnlessStopped(s, blockOf(s, s.setPlay->p_FTarget), valueAt(s, p_FReceiver, p.shortPass * first));
  BallChoice best{false, s.setPlay->p_FTarget, value, {}};
  const Present planned{s.planned, p.keepPlan};
  if (isSameKick(planned.direction, directionOf(best.p_FTarget - s.ball()))) best.value += planned.worth;
  if (record != nullptr) record->clear();
  if (record != nullptr) record->add(s.setPlay->p_FReceiver, best.value);
  weighKicks(s, {0.0, 0, kAllDirections - 1}, planned, record, best,
             [&](const motion::KickHead& /*kick*/, double direction, double length) {
               return kickValue(s, direction, length, false);
             });
  return best;
}

BallChoice chooseAction(const Situation& s, Candidates* record) {
  const ChoiceParameters& p = s.parameters.choice;
  BallChoice best{false, s.p_FTarget, dribbleValue(s), {}};
  if (record != nullptr) record->clear();
  if (record != nullptr) record->add(s.p_FTarget, best.value);
  const double left = timeLeftAtBall(s);
  const double contested = valueAt(s, s.ball(), kContested);
  const Vector2 toGoal = s.world.field.theirGoal() - s.ball();
  weighKicks(s, {directionOf(toGoal), -kDirections, kDirections}, {presentKick(s), p.keep}, record, best,
             [&](const motion::KickHead& kick, double direction, double length) {
               const double comesOff =
                   probabilityFirst(timeToContact(s, kick, direction), left, p.setupSpread);
               return comesOff * kickValue(s, direction, length) + (1.0 - comesOff) * contested;
             });
  return best;
}

}  // namespace nonet::team
