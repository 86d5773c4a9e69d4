#include "nonet/team/goalie.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "nonet/math/direction.h"
#include "nonet/team/ball_choice.h"
#include "nonet/team/own_area.h"
#include "nonet/world/ball_law.h"

namespace nonet::team {

namespace {

constexpr double kBeforeBall = 0.3;  // m that a goalie on guard keeps from the ball
constexpr double kShotSpeed = 2.0;   // m/s
constexpr double kBackStep = 0.05;   // m, of the places where it looks how high a lob comes down
constexpr double kBeforeLine = 0.1;  // m that it stays in front of the goal line

world::BallMotion inFrame(const Pose2& X_RF, const world::BallMotion& ball) {
  const Vector2 p = X_RF * Vector2(ball.p_FB.head<2>());
  const Vector2 v = Pose2(0.0, 0.0, X_RF.rotation) * Vector2(ball.v_FB.head<2>());
  return {{p.x(), p.y(), ball.p_FB.z()}, {v.x(), v.y(), ball.v_FB.z()}};
}

// m, when the goalie could be about there.
double ballToGoal(const Situation& s) {
  return (s.forecast.at(s.parameters.goalie.claimAhead) - s.world.field.ownGoal()).norm();
}

// Where a ball passes above whoever stands, and can be met by stepping back.
std::optional<ComingShot> metBehind(const Situation& s, const world::BallMotion& seen) {
  const GoalieParameters& p = s.parameters.goalie;
  const double toLine = s.world.self.X_FR.translation.x() + s.world.field.goalLine();
  const auto* walk = std::get_if<motion::WalkVelocity>(&s.motion.request);
  const bool stepsBack = walk != nullptr && walk->velocity.translation.x() < 0.0;
  const double delay = stepsBack ? 0.0 : p.stepDelay;
  for (double back = kBackStep; back < toLine - kBeforeLine; back += kBackStep) {
    const auto passing = world::crossingOfLine(seen, -back);
    if (!passing) return std::nullopt;
    if (passing->height > p.standHeight) continue;
    if (back > p.backSpeed * (passing->time - delay)) return std::nullopt;
    return ComingShot{passing->time, passing->y, passing->height, back};
  }
  return std::nullopt;
}

bool mayGoTo(const Vector2& p_F, const Situation& s) {
  const GoalieParameters& p = s.parameters.goalie;
  return !p.stayInArea || inOwnArea(s.world.field, p_F, -p.areaMargin);
}

}  // namespace

Pose2 guardPlace(const Vector2& p_FB, const world::FieldGeometry& field, const GoalieParameters& parameters,
                 double clear) {
  const Vector2 goal = field.ownGoal();
  const double distance = (p_FB - goal).norm();
  const double before = std::min(parameters.outShare * distance - kBeforeBall, distance - clear);
  const double out = std::min(parameters.outOfGoal, std::max(0.0, before));
  Vector2 place = goal + out * (p_FB - goal).normalized();
  place.x() = std::max(place.x(), goal.x() + parameters.inFrontOfLine);
  const Vector2 way = p_FB - place;
  return {place, directionOf(way)};
}

std::optional<ComingShot> comingShot(const Situation& s) {
  const GoalieParameters& p = s.parameters.goalie;
  const world::FieldGeometry& field = s.world.field;
  const world::BallMotion ball{s.world.ball.p_FB, s.world.ball.v_FB};
  if (ball.v_FB.x() > -p.diveBallSpeed) return std::nullopt;
  const auto atGoal = world::crossingOfLine(ball, -field.goalLine());
  if (!atGoal || std::abs(atGoal->y) > field.post() + p.postMargin || atGoal->height > p.highest)
    return std::nullopt;
  const world::BallMotion seen = inFrame(s.world.self.X_FR.inverse(), ball);
  if (seen.p_FB.x() < 0.0) return std::nullopt;  // past the robot
  const auto passing = world::crossingOfLine(seen, 0.0);
  if (!passing) return std::nullopt;
  if (passing->height > p.standHeight) {
    if (const auto behind = metBehind(s, seen)) return behind;
    if (passing->height > p.highest) return std::nullopt;
  }
  return ComingShot{passing->time, passing->y, passing->height};
}

Vector2 clearanceTarget(const Situation& s) {
  const GoalieParameters& p = s.parameters.goalie;
  double side = s.ball().y();
  if (s.setPlay) {
    side -= s.setPlay->p_FReceiver.y();  // past who waits for a pass
  } else if (std::abs(side) < p.clearanceSure) {
    // In the middle the ball's side is noise: what the goalie has turned to stays.
    side = std::sin(s.world.teammates[1].X_FP.rotation);
  }
  // What is lined up stays.
  const std::optional<double> present = presentKick(s);
  if (s.role == Role::Goalie && !s.setPlay && present) side = std::sin(*present);
  const Vector2 target(0.0, side >= 0.0 ? p.clearanceAside : -p.clearanceAside);
  const Vector2 other(target.x(), -target.y());
  const bool past = !s.setPlay && mateBars(s.world, s.ball(), target) && !mateBars(s.world, s.ball(), other);
  return past ? other : target;
}

bool goalieReaches(const Situation& s, bool claims) {
  if (s.phase() == world::Phase::OwnGoalKick) return true;
  const GoalieParameters& p = s.parameters.goalie;
  // A fast one that leaves the field may still be a shot.
  const bool fast = s.world.ball.v_FB.x() < -kShotSpeed;
  if (fast && !s.world.field.holds(s.forecast.at(p.claimAhead))) return false;
  const double reach = p.attackDistance * (claims ? p.keepClaim : 1.0);
  return world::isOpenPlay(s.phase()) && s.world.ball.known && ballToGoal(s) <= reach;
}

bool goalieWantsBall(const Situation& s, bool claims) {
  if (s.phase() == world::Phase::OwnGoalKick) return true;
  if (!goalieReaches(s, claims) || comingShot(s)) return false;
  const GoalieParameters& p = s.parameters.goalie;
  const Vector2 goal = s.world.field.ownGoal();
  const double distance = ballToGoal(s);
  if (!mayGoTo(s.forecast.at(p.claimAhead), s)) return false;
  // A field player that is sooner there and stands well keeps it.
  const Vector2 target = clearanceTarget(s);
  const PaceParameters& pace = s.parameters.pace;
  const double own = timeToBall({s.world.self.X_FR, true}, s.forecast, target, pace);
  const double margin = (claims ? -1.0 : p.claimMargin) * s.parameters.keepBallTime;
  const auto& mates = s.world.teammates;
  const bool mateSooner = std::any_of(mates.begin() + 2, mates.end(), [&](const world::PlayerState& mate) {
    const auto unum = static_cast<int>(&mate - mates.data());
    if (!mate.known || unum == s.banned || s.hasGone(unum)) return false;
    return timeToBall(runnerOf(mate, s.world.time, pace), s.forecast, target, pace) < own + margin;
  });
  if (mateSooner) return false;
  // Nor is it left alone in front of an opponent that shoots before it comes.
  if (distance < p.fightDistance * (claims ? p.keepClaim : 1.0)) return true;
  const auto& others = s.world.opponents;
  return std::none_of(others.begin(), others.end(), [&](const world::PlayerState& opponent) {
    if (!opponent.known) return false;
    const Runner runner = runnerOf(opponent, s.world.time, pace);
    return timeToBall(runner, s.forecast, goal, pace) < own + (claims ? 0.0 : p.foremost);
  });
}

}  // namespace nonet::team
