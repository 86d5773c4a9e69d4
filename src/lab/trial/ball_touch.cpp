#include "lab/trial/ball_touch.h"

namespace nonet::lab {

BallTouches ballTouches(const sim::World& world, sim::RobotHandle robot) {
  using Kind = sim::ContactParty::Kind;
  BallTouches touches;
  for (const sim::ContactPair& pair : world.contacts()) {
    const bool ballFirst = pair.first.kind == Kind::Ball;
    if (!ballFirst && pair.second.kind != Kind::Ball) continue;
    const sim::ContactParty& party = ballFirst ? pair.second : pair.first;
    if (party.kind != Kind::Robot) continue;
    (party.robot == robot ? touches.robot : touches.other) = true;
  }
  return touches;
}

}  // namespace nonet::lab
