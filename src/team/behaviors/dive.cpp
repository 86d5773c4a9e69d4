#include <algorithm>
#include <cmath>
#include <string_view>

#include "nonet/team/behaviors.h"
#include "nonet/team/goalie.h"

namespace nonet::team {

namespace {

// The body falls through all angles from upright to the ground: a ball half as far aside as it is high is met
// sooner than one that rolls.
double timeToMeet(const ComingShot& shot, const GoalieParameters& p) {
  const double angle = std::atan2(std::abs(shot.aside), shot.height) / (0.5 * kPi);
  // At 45 degrees highDiveTime, on the ground diveTime, upright nothing.
  return angle < 0.5 ? 2.0 * angle * p.highDiveTime
                     : p.highDiveTime + (2.0 * angle - 1.0) * (p.diveTime - p.highDiveTime);
}

}  // namespace

// A dive costs the time of rising: only for a ball that goes into the goal, and too far aside to step there.
std::optional<Action> dive(const Situation& s) {
  const GoalieParameters& p = s.parameters.goalie;
  const bool open = s.role == Role::Goalie && world::isOpenPlay(s.phase());
  if (!p.dive || !open || s.world.time - s.world.ball.lastSeen > p.oldestSight) return std::nullopt;
  const std::optional<ComingShot> shot = comingShot(s);
  if (!shot) return std::nullopt;
  const double aside = std::abs(shot->aside);
  const double stepped = p.diveReach + p.sideStepSpeed * std::max(0.0, shot->time - p.stepDelay);
  if (aside < stepped || aside > p.diveFarthest) return std::nullopt;
  const bool rough = s.world.time - s.world.ball.lastKick < p.secondLook;
  if (rough && shot->time > p.urgent) return std::nullopt;
  const bool block = aside < p.blockReach && shot->height < p.blockHeight;
  if (shot->time > (block ? p.blockTime : timeToMeet(*shot, p))) return std::nullopt;
  const bool left = shot->aside > 0.0;
  return Action(motion::PlaySkill{std::string_view(block ? "block" : "dive"),
                                  left ? model::Side::Left : model::Side::Right},
                block  ? "block"
                : left ? "left"
                       : "right");
}

}  // namespace nonet::team
