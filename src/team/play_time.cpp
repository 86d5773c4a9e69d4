#include "nonet/team/play_time.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nonet/math/direction.h"

namespace nonet::team {

namespace {

// Most repetitions until place and time of the meeting agree; the way to a ball that lies still needs two.
constexpr int kMeetings = 5;
constexpr double kSoonest = 0.3;  // s until who still lies is on its feet

double timeToPlace(const Runner& runner, const Vector2& p_FB, const Vector2& p_FTarget,
                   const PaceParameters& pace) {
  const Vector2 way = p_FB - runner.X_FP.translation;
  const Vector2 onward = p_FTarget - p_FB;
  const double bearing = directionOf(way);
  // Nothing to walk around for a runner behind the ball, most for one that comes from where it should go.
  const double wrongSide = 0.5 * (1.0 - std::cos(bearing - directionOf(onward)));
  const double turn =
      runner.headingKnown ? std::abs(angleDifference(bearing, runner.X_FP.rotation)) : 0.5 * kPi;
  return (way.norm() + wrongSide * pace.wayAround) / pace.walkSpeed + turn / pace.turnSpeed + runner.rises;
}

// Who has lain for longer than a rise takes tries again.
double risesIn(const world::PlayerState& player, double time, const PaceParameters& pace) {
  if (!player.fallen) return 0.0;
  if (player.fallenSince == world::kNever || pace.risingTime <= 0.0) return pace.risingTime;
  const double lain = std::fmod(std::max(time - player.fallenSince, 0.0), pace.risingTime);
  return std::max(pace.risingTime - lain, kSoonest);
}

}  // namespace

Runner runnerOf(const world::PlayerState& player, double time, const PaceParameters& pace) {
  return {player.X_FP, player.headingKnown, risesIn(player, time, pace)};
}

double nearestOf(std::span<const world::PlayerState> players, const Vector2& p_F) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const world::PlayerState& player : players) {
    if (player.known && !player.fallen) nearest = std::min(nearest, (player.X_FP.translation - p_F).norm());
  }
  return nearest;
}

BallForecast::BallForecast(const world::WorldState& world, const PaceParameters& pace)
    : free_({world.ball.p_FB, world.ball.v_FB}), longestRoll_(pace.longestRoll) {
  const Vector2 ball = world.ball.p_FB.head<2>();
  // Nobody carries a ball that one of us has nearer.
  double nearest = std::min(pace.carryDistance, nearestOf(world.teammates, ball));
  for (const world::PlayerState& opponent : world.opponents) {
    if (!opponent.known || opponent.fallen) continue;
    const Vector2 offset = ball - opponent.X_FP.translation;
    const double speed = opponent.v_FP.norm();
    // It dribbles if it walks after the ball; a ball that rolls away faster than that is lost to it.
    const bool follows = offset.dot(opponent.v_FP) > pace.carryAlong * offset.norm() * speed;
    if (offset.norm() > nearest || speed < pace.carrySpeed || !follows) continue;
    nearest = offset.norm();
    carriedWith_ = opponent.v_FP;
  }
}

Vector2 BallForecast::at(double seconds) const {
  const double time = std::min(seconds, longestRoll_);
  return carriedWith_ ? Vector2(free_.at(0.0) + time * *carriedWith_) : free_.at(time);
}

double timeToBall(const Runner& runner, const BallForecast& ball, const Vector2& p_FTarget,
                  const PaceParameters& pace) {
  double time = 0.0;
  for (int i = 0; i < kMeetings; ++i) {
    const double later = timeToPlace(runner, ball.at(time), p_FTarget, pace);
    if (later == time) break;
    time = later;
  }
  return time;
}

}  // namespace nonet::team
