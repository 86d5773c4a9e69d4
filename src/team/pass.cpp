#include "nonet/team/pass.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "nonet/math/direction.h"
#include "nonet/team/ball_choice.h"

#include "team/play_value.h"

namespace nonet::team {

namespace {

constexpr double kInPlace = 0.15;  // s from there until a kick begins
constexpr int kRuns = 3;           // places for each receiver: where it stands, and ahead of that

bool canReceive(const Situation& s, int unum) {
  const world::PlayerState& mate = s.world.teammates[static_cast<std::size_t>(unum)];
  return unum != s.world.game.unum && mate.known && !mate.fallen && !s.hasGone(unum);
}

bool serves(const motion::KickOption& kick, double distance, const Situation& s) {
  if (!kick.head.hasRoom(s.nearestOpponent) || kick.head.isChip()) return false;
  // Who kicks straight does it with either foot: motion chooses.
  if (kick.head.isStraight() && kick.foot != model::Side::Left) return false;
  if (kick.head.scales) return distance >= kick.head.shortest && distance <= kick.head.longest;
  const double length = s.parameters.choice.length * kick.head.longest;
  return std::abs(distance - length) < s.parameters.pass.fit * length;
}

// The pass that motion was asked for last; own field frame.
struct PresentPass {
  Vector2 p_FTarget = Vector2::Zero();
  std::string_view kick;
};

std::optional<PresentPass> presentPass(const Situation& s) {
  const auto* kick = std::get_if<motion::KickTo>(&s.motion.request);
  if (kick == nullptr || !kick->stops) return std::nullopt;
  return PresentPass{s.world.self.X_FR * kick->target, kick->kick.view()};
}

bool isPresent(const Situation& s, const std::optional<PresentPass>& present, const Pass& pass) {
  return present && present->kick == pass.kick &&
         (present->p_FTarget - pass.p_FTarget).norm() < s.parameters.pass.same;
}

struct Demand {
  double least = 0.0;   // m
  double better = 0.0;  // goals more than running on
};

// Ahead, where the goal is far, a short pass for no gain will do before an opponent comes; back it gives
// ground away. `left`: s until an opponent plays the ball where it lies.
Demand demandOn(const Situation& s, const Vector2& p_FTarget, double left) {
  const PassParameters& p = s.parameters.pass;
  const Vector2 goal = s.world.field.theirGoal();
  const double toGoal = (goal - s.ball()).norm();
  const bool onward = left < p.farPressed && toGoal > p.far && (goal - p_FTarget).norm() < toGoal;
  return onward ? Demand{p.farLeast, p.farBetter} : Demand{p.least, p.better};
}

// What opponents can do against a pass to some place, whoever kicks it how.
struct Resistance {
  double arrival = 0.0;  // s until one of them is at the place
  Block block;           // of the ball on its way
};

Resistance resistanceTo(const Situation& s, const Vector2& p_FTarget) {
  return {opponentsTime(s, p_FTarget), blockOf(s, p_FTarget)};
}

// The receiver may be there before the ball and wait; opponents set off when they see the ball coming.
double receiverFirst(const Situation& s, const world::PlayerState& mate, const Pass& pass, double theirs) {
  const ChoiceParameters& p = s.parameters.choice;
  const double ours = arrival(mate, pass.p_FTarget, p.ownPace, s.parameters.pace.risingTime) - pass.untilKick;
  return probabilityFirst(std::max(ours, 0.0), theirs, p.arrivalSpread);
}

// Nothing if it will hardly arrive. `left`: s until an opponent plays the ball where it lies; `hold`: share
// of what it needs for that.
std::optional<double> valueOf(const Situation& s, const world::PlayerState& mate, const Pass& pass,
                              const Resistance& resistance, double left, double hold) {
  const PassParameters& p = s.parameters.pass;
  const Block& block = resistance.block;
  const double ours = receiverFirst(s, mate, pass, resistance.arrival);
  if (ours < hold * p.ours || 1.0 - block.probability < hold * (1.0 - p.lane)) return std::nullopt;
  const double comesOff = probabilityFirst(pass.untilKick, left, s.parameters.choice.setupSpread);
  const double played = valueUnlessStopped(s, block, valueAt(s, pass.p_FTarget, ours));
  return comesOff * played + (1.0 - comesOff) * valueAt(s, s.ball(), kContested);
}

}  // namespace

std::optional<Pass> bestPass(const Situation& s, Candidates* record) {
  const PassParameters& p = s.parameters.pass;
  const Vector2 goal = s.world.field.theirGoal();
  const double left = std::max(timeLeftAtBall(s), s.undisturbed);
  const std::optional<PresentPass> present = presentPass(s);
  std::optional<Pass> best;
  const double dribbled = dribbleValue(s);
  double most = -std::numeric_limits<double>::infinity();
  for (int unum = 2; unum <= world::kTeamSize; ++unum) {
    if (!canReceive(s, unum)) continue;
    const world::PlayerState& mate = s.world.teammates[static_cast<std::size_t>(unum)];
    const Vector2 onward = (goal - mate.X_FP.translation).normalized();
    for (int run = 0; run < kRuns; ++run) {
      const Vector2 target = mate.X_FP.translation + run * p.runStep * onward;
      const Vector2 way = target - s.ball();
      const double distance = way.norm();
      const Demand demand = demandOn(s, target, left);
      if (distance < demand.least || distance > p.most || !s.world.field.holds(target, p.margin)) continue;
      std::optional<Resistance> resistance;
      for (const motion::KickOption& kick : s.motion.kicks) {
        if (!serves(kick, distance, s)) continue;
        if (!resistance) resistance = resistanceTo(s, target);
        Pass pass{unum, target, kick.name};
        const bool kept = isPresent(s, present, pass);
        pass.untilKick = kept && s.motion.kickInPlace()
                             ? kick.head.contact + kInPlace
                             : timeToContact(s, kick.head, directionOf(way) - kick.head.direction);
        pass.untilThere = pass.untilKick + p.rollTime;
        const std::optional<double> value = valueOf(s, mate, pass, *resistance, left, kept ? p.hold : 1.0);
        if (!value) continue;
        pass.value = *value + (kept ? p.keep : 0.0);
        if (record != nullptr) record->add(target, pass.value);
        if (pass.value <= std::max(most, dribbled + demand.better)) continue;
        most = pass.value;
        best = pass;
      }
    }
  }
  return best;
}

}  // namespace nonet::team
