#include <algorithm>
#include <cmath>

#include "nonet/team/behaviors.h"
#include "nonet/world/ball_law.h"

namespace nonet::team {

namespace {

// Where the robot meets the ball, robot frame.
struct Meeting {
  Vector2 place = Vector2::Zero();  // m
  double time = 0.0;                // s until the ball is there
};

// When the ball is low enough to be stopped, not before `time`: what flies over the head lands first. s.
double lowAfter(const Situation& s, double time) {
  constexpr double kHead = 0.5;  // m
  world::BallMotion ball{s.world.ball.p_FB, s.world.ball.v_FB};
  const double landing = world::landingTime(ball);
  if (time >= landing) return time;
  world::moveBall(ball, time);
  return ball.p_FB.z() > kHead ? landing : time;
}

// The place on the ball's way that is nearest to the robot, if it can be there in time, or the first one
// farther on; nothing for a ball that rests before or cannot be had. Robot frame, as is where the ball is
// now.
std::optional<Meeting> meetingOf(const Vector2& ball, const Vector2& way, const Situation& s) {
  const ReceiveParameters& p = s.parameters.receive;
  const world::FreeBall& free = s.forecast.free();
  const double nearest = -ball.dot(way);
  if (nearest <= 0.0) return std::nullopt;
  for (double time = lowAfter(s, free.goneAfter(nearest)); time < p.within; time += p.step) {
    const Vector2 place = ball + (free.at(time) - free.at(0.0)).norm() * way;
    if (place.norm() < p.reach || place.norm() / p.pace + p.reaction < time) return Meeting{place, time};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Action> receive(const Situation& s) {
  const ReceiveParameters& p = s.parameters.receive;
  if (!p.use || !s.play || s.play->wait || !world::isOpenPlay(s.phase())) return std::nullopt;
  const Vector2 velocity = s.ballVelocity();
  const Vector2& ball = s.play->ball;
  if (ball.norm() < p.nearest) return std::nullopt;
  const double comes = -velocity.dot(ball) / std::max(ball.norm(), 1e-6);
  if (comes < p.speed) return std::nullopt;
  const std::optional<Meeting> meeting = meetingOf(ball, velocity.normalized(), s);
  if (!meeting) return std::nullopt;
  // Facing the ball, whose line is known better than its distance.
  const double heading = std::atan2(-velocity.y(), -velocity.x());
  motion::WalkVelocity walk;
  walk.velocity = Pose2(p.gain * meeting->place, p.gain * heading);
  const bool soon = meeting->time < p.cushionTime;
  if (soon && p.cushion > 0.0) {
    walk.velocity.translation += p.cushion * velocity;
    return Action(walk, "give way");
  }
  if (meeting->place.norm() < p.ready && std::abs(heading) < s.parameters.navigation.facing)
    return Action(motion::Stand{}, "wait");
  return Action(walk, "onto the line");
}

}  // namespace nonet::team
