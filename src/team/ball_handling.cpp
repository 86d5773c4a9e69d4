#include "nonet/team/ball_handling.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "nonet/team/navigation.h"
#include "nonet/team/play_time.h"

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
  return motion::WalkTo{target, stop};
}

// Where the ball should end up if nobody were on the field.
Vector2 goalTarget(const world::WorldState& world) {
  const double goalX = 0.5 * world.field.length;
  const Vector2 ball = world.ball.p_FB.head<2>();
  // Near the opponent's goal line but beside the goal, first bring the ball to the middle.
  if (ball.x() > goalX - 1.0 && std::abs(ball.y()) > 0.5 * world.field.goalWidth + 0.3)
    return {goalX - 1.5, 0.0};
  // From afar at the middle, so that a push aside on the way does not end beside the goal.
  constexpr double kAfar = 3.0;  // m
  const double inside = goalX - ball.x() > kAfar ? 0.2 : 0.5 * world.field.goalWidth - 0.4;
  return {goalX + 0.2, std::clamp(ball.y(), -inside, inside)};
}

// How much of the way is free of opponents: the distance of the nearest one from it, at most kLane.
double laneWidth(const world::WorldState& world, const Vector2& from, const Vector2& to) {
  constexpr double kLane = 0.7;  // m, wider is not better
  const Vector2 way = to - from;
  const double squared = std::max(way.squaredNorm(), 1e-9);
  double width = kLane;
  for (const world::PlayerState& player : world.opponents) {
    if (!player.known) continue;
    const Vector2 offset = player.X_FP.translation - from;
    const double along = std::clamp(offset.dot(way) / squared, 0.0, 1.0);
    width = std::min(width, (offset - along * way).norm());
  }
  return width;
}

// The place between the posts that the opponents leave most open, as long as turning there is worth it.
Vector2 openGoal(const world::WorldState& world) {
  constexpr int kPlaces = 3;          // on either side of the middle
  constexpr double kFromPost = 0.25;  // m
  constexpr double kTurnCost = 0.15;  // m per rad
  const double goalX = 0.5 * world.field.length;
  const Vector2 ball = world.ball.p_FB.head<2>();
  const double side = 0.5 * world.field.goalWidth - kFromPost;
  Vector2 best(goalX + 0.2, 0.0);
  double bestScore = -1e9;
  for (int i = -kPlaces; i <= kPlaces; ++i) {
    const Vector2 place(goalX + 0.2, side * i / kPlaces);
    const Vector2 way = place - ball;
    const double turn = std::abs(angleDifference(std::atan2(way.y(), way.x()), world.self.X_FR.rotation));
    const double score = laneWidth(world, ball, place) - kTurnCost * turn - 0.05 * std::abs(place.y());
    if (score <= bestScore) continue;
    bestScore = score;
    best = place;
  }
  return best;
}

// Of an opponent near the ball, how much it bars this direction, 0 .. 1.
double barred(const world::WorldState& world, double direction) {
  constexpr double kReach = 1.5;  // m
  constexpr double kWidth = 0.6;  // rad to either side at full strength
  double most = 0.0;
  for (const world::PlayerState& player : world.opponents) {
    if (!player.known) continue;
    const Vector2 offset = player.X_FP.translation - world.ball.p_FB.head<2>();
    const double distance = offset.norm();
    if (distance > kReach) continue;
    const double angle = std::abs(angleDifference(std::atan2(offset.y(), offset.x()), direction));
    const double nearness = 1.0 - distance / kReach;
    most = std::max(most, nearness * std::clamp(2.0 - angle / kWidth, 0.0, 1.0));
  }
  return most;
}

// A place behind the ball as it will lie when we come there.
Pose2 approachPose(const world::WorldState& world, const Vector2& p_FTarget, const TeamParameters& parameters,
                   double behind) {
  const BallForecast forecast(world);
  const Vector2 ball =
      forecast.at(timeToBall({world.self.X_FR, true, false}, forecast, p_FTarget, parameters.pace));
  const Vector2 way = p_FTarget - ball;
  return {ball - behind * way.normalized(), std::atan2(way.y(), way.x())};
}

}  // namespace

Vector2 ballTarget(const world::WorldState& world) {
  constexpr double kAtGoal = 3.5;  // m, from where a ball pushed aside would only end beside the goal
  const Vector2 ball = world.ball.p_FB.head<2>();
  const Vector2 toGoal = Vector2(0.5 * world.field.length, 0.0) - ball;
  const bool inFront = std::abs(toGoal.y()) < toGoal.x() + 0.5 * world.field.goalWidth - 0.3;
  if (toGoal.norm() < kAtGoal && inFront) return openGoal(world);
  Vector2 target = goalTarget(world);
  const Vector2 way = target - ball;
  const double straight = std::atan2(way.y(), way.x());
  if (barred(world, straight) == 0.0) return target;
  double best = straight;
  double bestScore = -1e9;
  for (int i = -4; i <= 4; ++i) {
    const double turn = i * toRadians(15);
    const Vector2 end = ball + Vector2(std::cos(straight + turn), std::sin(straight + turn));
    const bool out = std::abs(end.y()) > 0.5 * world.field.width - 0.2;
    const double facing = angleDifference(straight + turn, world.self.X_FR.rotation);
    const double score =
        std::cos(turn) - 0.8 * barred(world, straight + turn) - 0.05 * facing * facing - (out ? 1.0 : 0.0);
    if (score <= bestScore) continue;
    bestScore = score;
    best = straight + turn;
  }
  if (best != straight) target = ball + 2.0 * Vector2(std::cos(best), std::sin(best));
  return target;
}

MotionRequest waitAtBall(const world::WorldState& world, const Vector2& p_FTarget,
                         const TeamParameters& parameters) {
  Caution caution;
  caution.robots = parameters.avoidDistance;
  caution.ball = 0.25;
  return walkTo(world, approachPose(world, p_FTarget, parameters, parameters.ball.waitBehind), caution);
}

MotionRequest playBall(const world::WorldState& world, const Vector2& p_FTarget,
                       const TeamParameters& parameters, KickUse use, bool kicking) {
  if (world.ball.p_RB.norm() < parameters.ball.handleDistance)
    return handleBall(world, p_FTarget, parameters.ball, use, kicking);
  Caution caution;
  caution.robots = parameters.avoidDistance;
  caution.duel = true;
  MotionRequest request =
      walkTo(world, approachPose(world, p_FTarget, parameters, parameters.ball.behindBall), caution);
  if (auto* way = std::get_if<motion::WalkTo>(&request)) way->stopAtTarget = false;
  return request;
}

namespace {

// The ball as seen by a robot that should bring it somewhere, robot frame.
struct Task {
  Vector2 ball;
  Vector2 target;
  double direction = 0.0;  // in which the ball should go, rad
  Vector2 along;
  Vector2 aside;         // to the left of it
  double behind = 0.0;   // how far the robot is behind the ball, m
  double besides = 0.0;  // the ball to the left of the line through the robot, m
};

Task taskFor(const world::WorldState& world, const Vector2& p_FTarget) {
  Task task;
  task.ball = world.ball.p_RB;
  task.target = world.self.X_FR.inverse() * p_FTarget;
  const Vector2 way = task.target - task.ball;
  task.direction = std::atan2(way.y(), way.x());
  task.along = Vector2(std::cos(task.direction), std::sin(task.direction));
  task.aside = Vector2(-task.along.y(), task.along.x());
  task.behind = task.ball.dot(task.along);
  task.besides = task.ball.dot(task.aside);
  return task;
}

// While the robot comes to its stand for the kick it may drift a little.
bool inPlace(const Task& task, const BallHandlingParameters& p, bool kicking) {
  const double share = kicking ? 1.5 : 1.0;
  return std::abs(task.ball.x() - p.kickAhead) < share * p.kickAheadTolerance &&
         std::abs(std::abs(task.ball.y()) - p.kickAside) < share * p.kickAsideTolerance &&
         std::abs(task.direction) < share * p.kickAngle;
}

bool mayKick(const world::WorldState& world, const Vector2& p_FTarget, const BallHandlingParameters& p,
             KickUse use, bool there, bool kicking) {
  constexpr double kLaneLength = 3.0;  // m
  constexpr double kRolling = 0.3;     // m/s, a faster ball is not where it was when the foot comes
  if (!p.kick || use == KickUse::Never || world.ball.v_FB.head<2>().norm() > kRolling) return false;
  if (opponentNear(world, (there ? 0.4 : 1.0) * p.kickOpponentDistance)) return false;
  const Vector2 from = world.ball.p_FB.head<2>();
  const Vector2 way = p_FTarget - from;
  const Vector2 end = from + std::min(1.0, kLaneLength / std::max(way.norm(), 1e-6)) * way;
  return use == KickUse::Clear || (there && kicking) || laneWidth(world, from, end) > p.kickLane;
}

MotionRequest kick(const Task& task) {
  return motion::KickTo{task.ball, task.target, task.ball.y() > 0.0 ? model::Side::Left : model::Side::Right};
}

// The last steps before a kick: to where the ball lies in front of the nearer foot, slowing down.
MotionRequest lineUp(const Task& task, const BallHandlingParameters& p) {
  constexpr double kMost = 0.8;   // m/s
  constexpr double kNear = 0.01;  // m, from here on the least speed fades
  const double foot = task.besides >= 0.0 ? 1.0 : -1.0;
  const Vector2 place = task.ball - p.kickAhead * task.along - foot * p.kickAside * task.aside;
  motion::WalkVelocity request;
  // Small steps may lead nowhere: the least speed keeps a robot from stopping short of its place for ever.
  const Vector2 speed = (p.kickGain + p.kickLeastSpeed / std::max(place.norm(), kNear)) * place;
  request.velocity.translation = speed * std::min(1.0, kMost / std::max(speed.norm(), 1e-9));
  request.velocity.rotation = p.kickGain * task.direction;
  return request;
}

}  // namespace

MotionRequest handleBall(const world::WorldState& world, const Vector2& p_FTarget,
                         const BallHandlingParameters& parameters, KickUse use, bool kicking) {
  const Task task = taskFor(world, p_FTarget);
  const bool there = inPlace(task, parameters, kicking);
  if (mayKick(world, p_FTarget, parameters, use, there, kicking)) {
    if (there) return kick(task);
    const bool behind = task.behind > 0.5 * parameters.kickAhead &&
                        std::abs(task.direction) < parameters.kickApproach &&
                        std::abs(task.besides) < task.behind + parameters.kickAside;
    if (behind) return lineUp(task, parameters);
  }
  const bool aligned = task.behind > 0.05 && std::abs(task.direction) < parameters.alignedAngle &&
                       std::abs(task.besides) < parameters.alignedAside;
  if (aligned) return walk(Pose2(task.ball + parameters.dribbleThrough * task.along, task.direction), false);

  // Not behind the ball yet: go around it, on the side on which the robot already is. `behind` of the
  // approach point itself is behindBall, so half of it tells the two cases apart without flicker.
  Vector2 next = task.ball - parameters.behindBall * task.along;
  if (task.behind < 0.5 * parameters.behindBall) {
    const double side = task.besides > 0.0 ? -1.0 : 1.0;
    next += side * parameters.circleRadius * task.aside;
  }
  const bool far = next.norm() > 1.0;
  return walk(Pose2(next, far ? std::atan2(next.y(), next.x()) : task.direction), false);
}

}  // namespace nonet::team
