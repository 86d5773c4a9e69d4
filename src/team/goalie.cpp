#include "nonet/team/goalie.h"

#include <algorithm>
#include <cmath>

#include "nonet/team/ball_handling.h"
#include "nonet/team/navigation.h"
#include "nonet/team/play_time.h"
#include "nonet/world/ball_law.h"

namespace nonet::team {

namespace {

constexpr double kKeepClaim = 1.3;        // an own claim holds in a larger region
constexpr double kClearanceWidth = 12.0;  // m, where a clearance goes beside the middle

// Out of the way of the goal, to the side on which the ball is.
Vector2 clearanceTarget(const world::WorldState& world) {
  const double y = world.ball.p_FB.y();
  return {0.0, y >= 0.0 ? 0.5 * kClearanceWidth : -0.5 * kClearanceWidth};
}

}  // namespace

Goalie::Goalie(const TeamParameters& parameters) : parameters_(parameters) {}

bool Goalie::wantsBall(const world::WorldState& world) const {
  if (world.game.phase == world::Phase::OwnGoalKick) return true;
  if (world.game.phase != world::Phase::PlayOn) return false;
  const Vector2 goal(-0.5 * world.field.length, 0.0);
  const BallForecast forecast(world);
  const Vector2 ball = forecast.at(1.0);
  const double reach = parameters_.goalie.attackDistance * (claims_ ? kKeepClaim : 1.0);
  if ((ball - goal).norm() > reach) return false;
  // A field player that is sooner there and stands well keeps it.
  const Vector2 target = clearanceTarget(world);
  const double own = timeToBall({world.self.X_FR, true, false}, forecast, target, parameters_.pace);
  const double margin = claims_ ? -parameters_.keepBallTime : 0.5 * parameters_.keepBallTime;
  return std::none_of(world.teammates.begin() + 2, world.teammates.end(),
                      [&](const world::PlayerState& mate) {
                        return mate.known && timeToBall({mate.X_FP, mate.headingKnown, mate.fallen}, forecast,
                                                        target, parameters_.pace) < own + margin;
                      });
}

// A dive costs the time of rising: only for a ball that goes into the goal, and too far aside to step there.
bool Goalie::dives(const world::WorldState& world, motion::MotionRequest& request) const {
  const GoalieParameters& parameters = parameters_.goalie;
  const Vector2 self = world.self.X_FR.translation;
  const double goalX = -0.5 * world.field.length;
  const world::BallMotion ball{world.ball.p_FB, world.ball.v_FB};
  if (!parameters.dive || world.game.phase != world::Phase::PlayOn || ball.v_FB.x() > -0.5) return false;
  const auto atGoal = world::crossingOfLine(ball, goalX);
  if (!atGoal || std::abs(atGoal->y) > 0.5 * world.field.goalWidth + 0.05 ||
      atGoal->height > world.field.goalHeight)
    return false;
  const auto atUs = world::crossingOfLine(ball, self.x());
  if (!atUs || atUs->time > parameters.diveTime) return false;
  const double aside = (world.self.X_FR.inverse() * Vector2(self.x(), atUs->y)).y();
  const double stepped = parameters.diveReach + parameters.sideStepSpeed * atUs->time;
  if (std::abs(aside) < stepped || std::abs(aside) > parameters.diveFarthest) return false;
  request = motion::PlaySkill{std::string_view("dive"), aside > 0.0 ? model::Side::Left : model::Side::Right};
  return true;
}

motion::MotionRequest Goalie::update(const world::WorldState& world, bool mayTouch, bool kicking) {
  motion::MotionRequest request;
  claims_ = mayTouch && wantsBall(world);
  if (dives(world, request)) return request;
  if (claims_) return playBall(world, clearanceTarget(world), parameters_, KickUse::Clear, kicking);

  const Vector2 ball = world.ball.p_FB.head<2>();
  const Vector2 goal(-0.5 * world.field.length, 0.0);
  Vector2 place = goal + parameters_.goalie.outOfGoal * (ball - goal).normalized();
  place.x() = std::max(place.x(), goal.x() + 0.2);
  // A ball on its way to the goal is met where it will pass.
  const auto passing = world::crossingOfLine({world.ball.p_FB, world.ball.v_FB}, place.x());
  const double side = 0.5 * world.field.goalWidth;
  if (passing && world.ball.v_FB.x() < -0.2) place.y() = std::clamp(passing->y, -side, side);
  Caution caution;
  caution.robots = 0.4;
  caution.ball = mayTouch ? 0.0 : 0.4;
  return walkTo(world, Pose2(place, headingTo(world, ball)), caution);
}

}  // namespace nonet::team
