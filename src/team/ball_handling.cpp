#include "nonet/team/ball_handling.h"

#include <algorithm>
#include <cmath>

namespace nonet::team {

namespace {

using motion::MotionRequest;

bool opponentNear(const world::WorldState& world, double distance) {
  const Vector2 ball = world.ball.p_FB.head<2>();
  return std::any_of(world.opponents.begin(), world.opponents.end(), [&](const world::PlayerState& player) {
    return player.known && !player.fallen && (player.X_FP.translation - ball).norm() < distance;
  });
}

MotionRequest walk(const Pose2& target, bool stop) {
  MotionRequest request;
  request.kind = MotionRequest::Kind::WalkTo;
  request.target = target;
  request.stopAtTarget = stop;
  return request;
}

}  // namespace

Vector2 ballTarget(const world::WorldState& world) {
  const double goalX = 0.5 * world.field.length;
  const Vector2 ball = world.ball.p_FB.head<2>();
  // Near the opponent's goal line but beside the goal, first bring the ball to the middle.
  if (ball.x() > goalX - 1.0 && std::abs(ball.y()) > 0.5 * world.field.goalWidth + 0.3)
    return {goalX - 1.5, 0.0};
  const double inside = 0.5 * world.field.goalWidth - 0.4;
  return {goalX + 0.2, std::clamp(ball.y(), -inside, inside)};
}

MotionRequest handleBall(const world::WorldState& world, const Vector2& p_FTarget,
                         const BallHandlingParameters& parameters) {
  const Pose2& X_FR = world.self.X_FR;
  const Vector2 ball = world.ball.p_RB;               // robot frame
  const Vector2 target = X_FR.inverse() * p_FTarget;  // robot frame
  const Vector2 way = target - ball;
  const double direction = std::atan2(way.y(), way.x());  // in which the ball should go
  const Vector2 along(std::cos(direction), std::sin(direction));
  const Vector2 aside(-along.y(), along.x());
  const double behind = ball.dot(along);   // how far the robot is behind the ball
  const double besides = ball.dot(aside);  // the ball to the left of the line through the robot

  const bool aligned = behind > 0.05 && std::abs(direction) < parameters.alignedAngle &&
                       std::abs(besides) < parameters.alignedAside;
  if (aligned) {
    const double foot = std::abs(ball.y());
    const bool inPlace = ball.x() > parameters.kickForwardLow && ball.x() < parameters.kickForwardHigh &&
                         std::abs(foot - parameters.kickAside) < parameters.kickAsideTolerance;
    if (parameters.kick && inPlace && std::abs(direction) < parameters.kickAngle &&
        !opponentNear(world, parameters.kickOpponentDistance)) {
      MotionRequest request;
      request.kind = MotionRequest::Kind::Kick;
      request.ball = ball;
      request.target = Pose2(target, direction);
      request.side = ball.y() > 0.0 ? model::Side::Left : model::Side::Right;
      return request;
    }
    return walk(Pose2(ball + parameters.dribbleThrough * along, direction), false);
  }

  // Not behind the ball yet: go around it, on the side on which the robot already is. `behind` of the
  // approach point itself is behindBall, so half of it tells the two cases apart without flicker.
  Vector2 next = ball - parameters.behindBall * along;
  if (behind < 0.5 * parameters.behindBall) {
    const double side = besides > 0.0 ? -1.0 : 1.0;
    next = ball + side * parameters.circleRadius * aside - parameters.behindBall * along;
  }
  const bool far = next.norm() > 1.0;
  return walk(Pose2(next, far ? std::atan2(next.y(), next.x()) : direction), false);
}

}  // namespace nonet::team
