#include <algorithm>
#include <cmath>

#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/math/straight_way.h"
#include "nonet/team/ball_choice.h"
#include "nonet/team/behaviors.h"

#include "team/behaviors/kick_action.h"

namespace nonet::team {

namespace {

constexpr int kTurns = 3;  // to either side of how the robot stands
constexpr double kStep = toRadians(15.0);
constexpr double kSameWay = 0.3;  // rad

// An opponent at the ball bars its way to the goal, and that is far.
bool isHeldUp(const Situation& s) {
  const AsideParameters& p = s.parameters.aside;
  const Vector2 toGoal = s.world.field.theirGoal() - s.ball();
  return s.nearestOpponent <= p.opponent && toGoal.norm() >= p.fromGoal &&
         barred(s.world, s.parameters.target, directionOf(toGoal)) >= p.barred;
}

bool isFree(const Situation& s, const Vector2& to) {
  const AsideParameters& p = s.parameters.aside;
  const StraightWay way(s.ball(), to);
  return std::none_of(s.world.opponents.begin(), s.world.opponents.end(),
                      [&](const world::PlayerState& opponent) {
                        if (!opponent.known) return false;
                        const auto [ahead, aside] = way.placeOf(opponent.X_FP.translation);
                        if (ahead < 0.0 || ahead > way.length()) return false;
                        return std::abs(aside) < p.lane + p.laneGrowth * ahead;
                      });
}

// Nobody is in its way, it stays in the field, and one of us is there first.
bool comesOff(const Situation& s, double direction, double length) {
  const Vector2 end = s.ball() + length * unitVector(direction);
  return s.world.field.holds(end + s.parameters.aside.margin * unitVector(direction)) && isFree(s, end) &&
         teammatesTime(s, end) <= opponentsTime(s, end);
}

// How well the kick serves from where the robot stands: 1 when it goes straight to the ball's target.
double worthOfKick(const Situation& s, const motion::KickHead& kick, double direction, double turn) {
  const AsideParameters& p = s.parameters.aside;
  const double wanted = directionOf(s.p_FTarget - s.ball());
  const Vector2 place = s.play->ball - Pose2(Vector2::Zero(), turn).rotate(kick.p_RBall);
  double worth = std::cos(direction - wanted) - p.turnCost * std::abs(turn) - p.wayCost * place.norm();
  const std::optional<double> present = presentKick(s);
  if (present && std::abs(angleDifference(direction, *present)) < kSameWay) worth += p.keep;
  return worth;
}

}  // namespace

// The forward kick cannot pass who stands in front of the ball, and both push it nowhere.
std::optional<Action> kickAside(const Situation& s) {
  const AsideParameters& p = s.parameters.aside;
  if (!p.use || !s.play || !world::isOpenPlay(s.phase()) || s.role == Role::Goalie) return std::nullopt;
  if (s.play->ball.norm() > p.near || s.world.ball.v_FB.head<2>().norm() > p.rolling) return std::nullopt;
  if (!isHeldUp(s)) return std::nullopt;
  const motion::KickOption* best = nullptr;
  double bestDirection = 0.0;
  double most = p.least;
  for (const motion::KickOption& kick : s.motion.kicks) {
    if (kick.head.isStraight() || !kick.head.hasRoom(s.nearestOpponent)) continue;
    for (int i = -kTurns; i <= kTurns; ++i) {
      const double turn = i * kStep;
      const double direction = wrapAngle(s.world.self.X_FR.rotation + kick.head.direction + turn);
      const double worth = worthOfKick(s, kick.head, direction, turn);
      if (worth <= most || !comesOff(s, direction, p.length * kick.head.longest)) continue;
      best = &kick;
      bestDirection = direction;
      most = worth;
    }
  }
  if (best == nullptr) return std::nullopt;
  const Vector2 target = s.ball() + p.length * best->head.longest * unitVector(bestDirection);
  BallPlay play = playTowards(s, target, KickUse::Clear);
  play.kick = best->name;
  play.candidates = s.play->candidates;
  return kickAction(s, play, s.motion.kickInPlace() ? "in place" : "line up");
}

}  // namespace nonet::team
