#include <algorithm>
#include <cmath>

#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/math/straight_way.h"
#include "nonet/team/ball_play.h"
#include "nonet/world/ball_law.h"

namespace nonet::team {

namespace {

// Grids of what is compared: fine enough beside the width of the ball's way.
constexpr int kPlacesAside = 3;  // in the goal, on either side of the middle
constexpr int kTurns = 4;        // around an opponent, to either side
constexpr double kTurnStep = toRadians(15);

constexpr double kRobotHeight = 0.62;  // m, of the Nao and the ball over it
constexpr double kSurelyOver = 0.7;    // probability with which a ball must fly over a robot

// Where the ball should end up if nobody were on the field.
Vector2 goalTarget(const world::WorldState& world, const BallTargetParameters& p) {
  const double goalX = world.field.goalLine();
  const Vector2 ball = world.ball.p_FB.head<2>();
  // Near the opponent's goal line but beside the goal, first bring the ball to the middle.
  if (ball.x() > goalX - p.cornerDepth && std::abs(ball.y()) > world.field.post() + p.cornerAside)
    return {goalX - p.cornerBack, 0.0};
  // From afar at the middle, so that a push aside on the way does not end beside the goal.
  const double inside = goalX - ball.x() > p.afar ? p.middle : world.field.post() - p.insidePost;
  return {goalX + p.behindLine, std::clamp(ball.y(), -inside, inside)};
}

// The place between the posts that the opponents leave most open, as long as turning there is worth it.
Vector2 openGoal(const world::WorldState& world, const BallTargetParameters& p, Candidates* record) {
  const double goalX = world.field.goalLine();
  const Vector2 ball = world.ball.p_FB.head<2>();
  const double side = world.field.post() - p.openPostMargin;
  Vector2 best(goalX + p.behindLine, 0.0);
  double bestScore = -1e9;
  for (int i = -kPlacesAside; i <= kPlacesAside; ++i) {
    const Vector2 place(goalX + p.behindLine, side * i / kPlacesAside);
    const double turn = std::abs(angleDifference(directionOf(place - ball), world.self.X_FR.rotation));
    const double hits = hitsGoal(world, directionOf(place - ball), p.aimSpread);
    const double score = hits * laneWidth(world, ball, place, p.laneWidth) - p.openTurnCost * turn -
                         p.openMiddle * std::abs(place.y());
    if (record != nullptr) record->add(place, score);
    if (score <= bestScore) continue;
    bestScore = score;
    best = place;
  }
  return best;
}

// The direction nearest to the straight one that no opponent bars. Who has begun to go around one goes on.
Vector2 aroundOpponents(const world::WorldState& world, const BallTargetParameters& p, const Vector2& target,
                        const std::optional<double>& present, Candidates* record) {
  const Vector2 ball = world.ball.p_FB.head<2>();
  const double straight = directionOf(target - ball);
  double best = straight;
  double bestScore = -1e9;
  for (int i = -kTurns; i <= kTurns; ++i) {
    const double turn = i * kTurnStep;
    const Vector2 end = ball + unitVector(straight + turn);
    const bool out = rollsOut(world, p, straight + turn);
    const double facing = angleDifference(straight + turn, world.self.X_FR.rotation);
    const bool kept = present && std::abs(angleDifference(straight + turn, *present)) < kTurnStep;
    const double score = std::cos(turn) - p.barCost * barred(world, p, straight + turn) -
                         p.facingCost * facing * facing - (out ? 1.0 : 0.0) + (kept ? p.keep : 0.0);
    if (record != nullptr) record->add(end, score);
    if (score <= bestScore) continue;
    bestScore = score;
    best = straight + turn;
  }
  if (best == straight) return target;
  // Beyond where a rolling ball comes to rest, so that it never lies behind the ball.
  const double rolls = world.ball.v_FB.head<2>().norm() / world::kRollDecay;
  return ball + (p.around + rolls) * unitVector(best);
}

}  // namespace

double hitsGoal(const world::WorldState& world, double direction, double spread) {
  const Vector2 ball = world.ball.p_FB.head<2>();
  const double ahead = world.field.goalLine() - ball.x();
  if (ahead <= 0.0) return 0.0;
  const double left = std::atan2(world.field.post() - ball.y(), ahead);
  const double right = std::atan2(-world.field.post() - ball.y(), ahead);
  const auto below = [&](double angle) {
    return 0.5 * std::erfc((direction - angle) / (std::sqrt(2.0) * spread));
  };
  return std::max(0.0, below(left) - below(right));
}

bool rollsOut(const world::WorldState& world, const BallTargetParameters& p, double direction) {
  if (p.rollsOn == 0.0) return false;
  const Vector2 ball = world.ball.p_FB.head<2>();
  const Vector2 way = p.rollsOn * unitVector(direction);
  const Vector2 end = ball + way;
  const double goalLine = world.field.goalLine();
  if (end.x() < -goalLine) return true;
  if (end.x() > goalLine) {
    const double crossing = ball.y() + (goalLine - ball.x()) / way.x() * way.y();
    return std::abs(crossing) > world.field.post() - p.postMargin;
  }
  return std::abs(end.y()) > world.field.touchLine() - p.touchLineMargin;
}

double barred(const world::WorldState& world, const BallTargetParameters& p, double direction) {
  double most = 0.0;
  for (const world::PlayerState& player : world.opponents) {
    if (!player.known) continue;
    const Vector2 offset = player.X_FP.translation - world.ball.p_FB.head<2>();
    const double distance = offset.norm();
    if (distance > p.barReach) continue;
    const double angle = std::abs(angleDifference(directionOf(offset), direction));
    const double nearness = 1.0 - distance / p.barReach;
    most = std::max(most, nearness * std::clamp(2.0 - angle / p.barWidth, 0.0, 1.0));
  }
  return most;
}

double laneWidth(const world::WorldState& world, const Vector2& from, const Vector2& to, double widest,
                 const motion::KickHead& kick) {
  const StraightWay way(from, to);
  double width = widest;
  for (const world::PlayerState& player : world.opponents) {
    if (!player.known) continue;
    const Vector2& p_F = player.X_FP.translation;
    if (1.0 - kick.fliesBelow(kRobotHeight, way.nearestTo(p_F)) > kSurelyOver) continue;
    width = std::min(width, way.distanceTo(p_F));
  }
  return width;
}

bool atOwnGoal(const world::WorldState& world) {
  constexpr double kBefore = 1.0;  // m
  constexpr double kBeside = 0.25;
  const Vector2 ball = world.ball.p_FB.head<2>();
  return ball.x() < -world.field.goalLine() + kBefore && std::abs(ball.y()) < world.field.post() + kBeside;
}

bool mateBars(const world::WorldState& world, const Vector2& from, const Vector2& to) {
  constexpr double kAhead = 1.5;  // m
  constexpr double kAside = 0.25;
  const StraightWay way(from, to);
  for (int unum = 1; unum <= world::kTeamSize; ++unum) {
    const world::PlayerState& mate = world.teammates[static_cast<std::size_t>(unum)];
    if (!mate.known || unum == world.game.unum) continue;
    const auto [ahead, aside] = way.placeOf(mate.X_FP.translation);
    if (ahead > 0.0 && ahead < std::min(kAhead, way.length()) && std::abs(aside) < kAside) return true;
  }
  return false;
}

Vector2 ballTarget(const world::WorldState& world, const BallTargetParameters& p,
                   const std::optional<double>& present, Candidates* record) {
  const Vector2 ball = world.ball.p_FB.head<2>();
  const Vector2 toGoal = world.field.theirGoal() - ball;
  const bool inFront = std::abs(toGoal.y()) < toGoal.x() + world.field.post() - p.atGoalInside;
  if (toGoal.norm() < p.atGoal && inFront) return openGoal(world, p, record);
  Vector2 target = goalTarget(world, p);
  if (barred(world, p, directionOf(target - ball)) == 0.0) return target;
  return aroundOpponents(world, p, target, present, record);
}

}  // namespace nonet::team
