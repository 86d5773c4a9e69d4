#include <algorithm>
#include <array>
#include <cmath>

#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/math/straight_way.h"
#include "nonet/team/behaviors.h"
#include "nonet/team/detour.h"
#include "nonet/team/way_behind.h"
#include "nonet/world/others.h"

#include "team/behaviors/go_behind.h"
#include "team/behaviors/push.h"

namespace nonet::team {

namespace {

constexpr double kTurned = 0.5;  // rad

// Somebody stands on the straight way from here to this place (robot frame, m).
bool blocked(const Situation& s, const Vector2& place) {
  const Pose2 X_RF = s.world.self.X_FR.inverse();
  const StraightWay way(Vector2::Zero(), place);
  return world::anyOther(s.world, [&](const world::PlayerState& player) {
    const Vector2 p_RP = X_RF * player.X_FP.translation;
    return way.placeOf(p_RP).ahead > 0.0 && way.distanceTo(p_RP) < s.parameters.ball.circleRoom;
  });
}

// 1: with the ball on the right hand; -1: on the left. On the side where the robot is, unless somebody
// stands in that way and the other one is free, and hardly longer.
double sideAround(const Situation& s, const BallPlay& play, const Vector2& behind) {
  const BallHandlingParameters& p = s.parameters.ball;
  const double side = play.besides > 0.0 ? -1.0 : 1.0;
  const Vector2 way = p.circleRadius * play.aside;
  const bool either = std::abs(play.besides) < p.circleEither;
  return either && blocked(s, behind + side * way) && !blocked(s, behind - side * way) ? -side : side;
}

// Where the robot walks, until the turn to the ball's way takes as long as the rest of the way.
double headingOnTheWay(const Vector2& next, double direction, double turn) {
  const double off = wrapAngle(directionOf(next) - direction);
  return wrapAngle(direction + std::clamp(off, -turn, turn));
}

// What the robot will have done in so long whatever it is told now.
Pose2 coast(const world::BodyState& body, double seconds) {
  const double cycles = seconds / std::max(body.cycleTime, 1e-3);
  return {cycles * body.odometryStep.translation, cycles * body.odometryStep.rotation};
}

// Where the ball will be when the robot comes to it, but not long after: others play it.
Vector2 ballAhead(const Situation& s, const BallPlay& play) {
  const BallHandlingParameters& p = s.parameters.ball;
  const Vector2 velocity = s.ballVelocity();
  if (velocity.norm() < p.circleRolling) return play.ball;
  return play.ball + std::min(p.circleAhead, play.ball.norm() / s.parameters.pace.walkSpeed) * velocity;
}

// The curve outside of which the robot goes; wider while its feet point elsewhere.
BallCurve curveAround(const Situation& s, const BallPlay& play, double turned) {
  const BallHandlingParameters& p = s.parameters.ball;
  const bool careful = play.behind > 0.0 && pushRollsOut(s);
  const double share = std::min(std::abs(turned) / p.turnedAngle, 1.0);
  // A second touch of a set piece costs it.
  const bool turns = s.setPlay && std::abs(turned) > kTurned;
  const double behind = careful || turns ? p.standOff : p.behindBall + share * p.turnedRoom;
  return {behind, std::max(p.circleRadius, behind), p.circleOpen};
}

// Past who stands in the straight way to this place, if there is room beside the ball (both robot frame, m).
Vector2 pastOthers(const Situation& s, const Pose2& X_RThen, const Vector2& ball, const Vector2& place) {
  constexpr double kNear = 1.5;  // m
  const Pose2 X_ThenF = (s.world.self.X_FR * X_RThen).inverse();
  std::array<Disc, 2 * world::kTeamSize + 1> discs{};
  std::size_t count = 0;
  const auto add = [&](const world::PlayerState& player) {
    const Vector2 p = X_ThenF * player.X_FP.translation;
    if (player.known && p.norm() < kNear) discs[count++] = {p, s.parameters.ball.circleRoom};
  };
  for (int unum = 1; unum <= world::kTeamSize; ++unum) {
    const auto i = static_cast<std::size_t>(unum);
    if (unum != s.world.game.unum) add(s.world.teammates[i]);
    add(s.world.opponents[i]);
  }
  discs[count++] = {ball, s.parameters.ball.behindBall};
  const Detour way = detour(Vector2::Zero(), place, {discs.data(), count});
  return way.straight || way.blocked ? place : way.next;
}

}  // namespace

Action goBehind(const Situation& s, const BallPlay& play) {
  const BallHandlingParameters& p = s.parameters.ball;
  const Pose2 X_RThen = coast(s.world.body, p.circleLead);
  const Vector2 ball = X_RThen.inverse() * ballAhead(s, play);
  const double direction = wrapAngle(play.direction - X_RThen.rotation);
  const Pose2 X_RBall(ball, direction);
  const BallCurve curve = curveAround(s, play, direction);
  const double side = sideAround(s, play, play.ball - curve.behind * play.along);
  const WayBehind way = wayBehind(X_RBall.inverse().translation, curve, side);
  const Vector2 next = pastOthers(s, X_RThen, ball, X_RBall * way.next);
  const double turn = p.turnAlong * std::max(way.length - p.turnLast, 0.0);
  motion::WalkTo walk{Pose2(next, headingOnTheWay(next, direction, turn)), false};
  walk.turnAtOnce = true;
  Action action(walk, way.straight ? "straight" : "around");
  action.reason.candidates = play.candidates;
  return action;
}

std::optional<Action> goBehindBall(const Situation& s) {
  if (!s.play) return std::nullopt;
  return goBehind(s, *s.play);
}

}  // namespace nonet::team
