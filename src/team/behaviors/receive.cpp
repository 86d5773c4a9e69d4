#include <algorithm>
#include <cmath>
#include <limits>

#include "nonet/team/behaviors.h"
#include "nonet/world/ball_law.h"

namespace nonet::team {

namespace {

// Where the robot meets the ball, robot frame.
struct Meeting {
  Vector2 place = Vector2::Zero();  // m
  double time = 0.0;                // s until the ball is there
};

// Seconds until a rolling ball has gone so far; infinite if it never does.
double timeToRoll(double distance, double speed) {
  const double share = world::kRollDecay * distance / speed;
  if (share >= 1.0) return std::numeric_limits<double>::infinity();
  return -std::log(1.0 - share) / world::kRollDecay;
}

// The place on the ball's way that is nearest to the robot, if it can be there in time, or the first one
// farther on; nothing for a ball that rests before or cannot be had.
std::optional<Meeting> meetingOf(const Vector2& ball, const Vector2& velocity, const ReceiveParameters& p) {
  const double speed = velocity.norm();
  const Vector2 way = velocity / speed;
  const double nearest = -ball.dot(way);
  if (nearest <= 0.0) return std::nullopt;
  for (double time = timeToRoll(nearest, speed); time < p.within; time += p.step) {
    const double rolled = speed / world::kRollDecay * (1.0 - std::exp(-world::kRollDecay * time));
    const Vector2 place = ball + rolled * way;
    if (place.norm() < p.reach || place.norm() / p.pace + p.reaction < time) return Meeting{place, time};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Action> receive(const Situation& s) {
  const ReceiveParameters& p = s.parameters.receive;
  if (!p.use || !s.play || s.play->wait || !world::isOpenPlay(s.phase())) return std::nullopt;
  const Vector2 velocity = s.world.self.X_FR.inverse().rotate(s.world.ball.v_FB.head<2>());
  const Vector2& ball = s.play->ball;
  const double comes = -velocity.dot(ball) / std::max(ball.norm(), 1e-6);
  if (comes < p.speed) return std::nullopt;
  const std::optional<Meeting> meeting = meetingOf(ball, velocity, p);
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
