#include <cmath>
#include <string_view>

#include "nonet/team/behaviors.h"
#include "nonet/world/ball_law.h"

namespace nonet::team {

// A dive costs the time of rising: only for a ball that goes into the goal, and too far aside to step there.
std::optional<Action> dive(const Situation& s) {
  const GoalieParameters& p = s.parameters.goalie;
  const world::FieldGeometry& field = s.world.field;
  const world::BallMotion ball{s.world.ball.p_FB, s.world.ball.v_FB};
  const bool open = s.role == Role::Goalie && s.phase() == world::Phase::PlayOn;
  if (!p.dive || !open || ball.v_FB.x() > -p.diveBallSpeed) return std::nullopt;
  const auto atGoal = world::crossingOfLine(ball, -0.5 * field.length);
  if (!atGoal || std::abs(atGoal->y) > 0.5 * field.goalWidth + p.postMargin ||
      atGoal->height > field.goalHeight)
    return std::nullopt;
  const Pose2& X_FR = s.world.self.X_FR;
  const auto atUs = world::crossingOfLine(ball, X_FR.translation.x());
  if (!atUs || atUs->time > p.diveTime) return std::nullopt;
  const double aside = (X_FR.inverse() * Vector2(X_FR.translation.x(), atUs->y)).y();
  const double stepped = p.diveReach + p.sideStepSpeed * atUs->time;
  if (std::abs(aside) < stepped || std::abs(aside) > p.diveFarthest) return std::nullopt;
  const bool left = aside > 0.0;
  return Action(motion::PlaySkill{std::string_view("dive"), left ? model::Side::Left : model::Side::Right},
                left ? "left" : "right");
}

}  // namespace nonet::team
