#include "team/play_value.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nonet/math/direction.h"
#include "nonet/math/straight_way.h"
#include "nonet/team/ball_choice.h"

namespace nonet::team {

namespace {

// Who waits until the ball lies exactly in its place has to come there first: about as long again.
constexpr double kExact = 2.0;
constexpr double kAtBall = 0.15;  // m

double logistic(double x) {
  return 1.0 / (1.0 + std::exp(-x));
}

}  // namespace

double valueAt(const Situation& s, const Vector2& p_F, double ours) {
  const auto& field = s.world.field;
  const ChoiceParameters& p = s.parameters.choice;
  return ours * worthOf(p_F, field, p) - (1.0 - ours) * worthOf(-p_F, field, p);
}

double arrival(const world::PlayerState& player, const Vector2& p_F, double pace, double risingTime) {
  if (!player.known) return std::numeric_limits<double>::infinity();
  return (player.X_FP.translation - p_F).norm() / pace + (player.fallen ? risingTime : 0.0);
}

double probabilityFirst(double ours, double theirs, double spread) {
  return std::isinf(theirs) ? 1.0 : logistic((theirs - ours) / spread);
}

Block blockOf(const Situation& s, const Vector2& end) {
  const ChoiceParameters& p = s.parameters.choice;
  const StraightWay way(s.ball(), end);
  Block block;
  double passes = 1.0;
  for (const world::PlayerState& opponent : s.world.opponents) {
    if (!opponent.known) continue;
    const auto [ahead, aside] = way.placeOf(opponent.X_FP.translation);
    if (ahead < 0.0 || ahead > way.length()) continue;
    // Who lies steps nowhere.
    const double growth = p.spread + (opponent.fallen ? 0.0 : p.blockGrowth);
    const double reach = p.blockWidth + growth * ahead;
    const double stops = std::clamp(1.5 - std::abs(aside) / std::max(reach, 1e-6), 0.0, 1.0);
    passes *= 1.0 - stops;
    if (stops <= block.probability) continue;
    block.probability = stops;
    block.p_F = opponent.X_FP.translation;
  }
  block.probability = 1.0 - passes;
  return block;
}

double valueUnlessStopped(const Situation& s, const Block& block, double free) {
  return (1.0 - block.probability) * free + block.probability * valueAt(s, block.p_F, kStopped);
}

double timeToContact(const Situation& s, const motion::KickHead& kick, double direction) {
  const ChoiceParameters& p = s.parameters.choice;
  const Pose2& X_FR = s.world.self.X_FR;
  const Vector2 way = s.ball() - X_FR.translation;
  // Near the ball, where it lies from the torso says nothing.
  const double besides = way.norm() > kAtBall ? 1.0 - std::cos(directionOf(way) - direction) : 0.0;
  const double turned = 1.0 - std::cos(X_FR.rotation - direction);
  return way.norm() / p.kickPace + p.kickAround * std::max(besides, turned) + kExact * kick.steady +
         kick.contact + (kick.fromWalk ? p.setupWalk : p.setupStand);
}

double timeLeftAtBall(const Situation& s) {
  const ChoiceParameters& p = s.parameters.choice;
  return std::max(0.0, opponentsTime(s, s.ball()) - p.opponentReach / p.opponentPace);
}

double dribbleValue(const Situation& s) {
  const ChoiceParameters& p = s.parameters.choice;
  const Vector2 way = s.p_FTarget - s.ball();
  const double direction = directionOf(way);
  const Vector2 end = s.ball() + std::min(p.dribbleAhead, way.norm()) * unitVector(direction);
  // Robots at the ball bar the way, and those farther on will.
  const double near = barred(s.world, s.parameters.target, direction);
  const double lost = p.dribbleLoss * std::max(near, blockOf(s, end).probability);
  return valueAt(s, end, 1.0 - lost);
}

double worthOf(const Vector2& p_F, const world::FieldGeometry& field, const ChoiceParameters& p) {
  const Vector2 goal = field.theirGoal();
  return p.worthMost * std::exp(-(goal - p_F).norm() / p.worthScale);
}

}  // namespace nonet::team
