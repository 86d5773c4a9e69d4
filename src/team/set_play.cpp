#include "nonet/team/set_play.h"

#include <algorithm>
#include <cmath>

#include "nonet/math/angle.h"
#include "nonet/math/direction.h"

namespace nonet::team {

namespace {

// Into the field rather than along its edge.
double direction(world::Phase phase, const Vector2& p_FB, const world::FieldGeometry& field,
                 const SetPlayParameters& parameters) {
  constexpr double kMiddle = 0.3;  // m; in the middle always to the same side
  const double inwards = p_FB.y() > -kMiddle ? -1.0 : 1.0;
  switch (phase) {
    case world::Phase::OwnKickOff:
      return parameters.kickOffAngle;
    case world::Phase::OwnKickIn: {
      // Near the corner more across the field: the ball must not roll over the goal line.
      constexpr double kFromLine = 1.0;  // m
      const double room = field.goalLine() - kFromLine - p_FB.x();
      const double sharpest = std::acos(std::clamp(room / parameters.passLength, -1.0, 1.0));
      return inwards * std::max(parameters.kickInAngle, sharpest);
    }
    case world::Phase::OwnCorner: {
      const Vector2 place(field.goalLine() - parameters.cornerBack, -inwards * parameters.cornerAside);
      const Vector2 way = place - p_FB;
      return directionOf(way);
    }
    case world::Phase::OwnGoalKick:  // the ball lies in the middle: always to the same side
      return parameters.goalKickAngle;
    default: {
      // Past whoever stands between the ball and the goal; near it back, or the ball is out.
      const Vector2 way = field.theirGoal() - p_FB;
      const bool near = way.norm() < 2.0 * parameters.passLength;
      const double angle = near ? kPi - parameters.freeKickAngle : parameters.freeKickAngle;
      return wrapAngle(directionOf(way) + inwards * angle);
    }
  }
}

}  // namespace

SetPlay setPlayFor(world::Phase phase, const Vector2& p_FB, const world::FieldGeometry& field,
                   const SetPlayParameters& parameters) {
  const double angle = direction(phase, p_FB, field, parameters);
  const Vector2 along = unitVector(angle);
  SetPlay play;
  const double length = phase == world::Phase::OwnCorner ? parameters.cornerLength : parameters.passLength;
  play.p_FTarget = p_FB + length * along;
  play.p_FReceiver = p_FB + length * along - Vector2(parameters.behindPass, 0.0);
  const double edge = field.touchLine() - parameters.receiverMargin;
  play.p_FReceiver.y() = std::clamp(play.p_FReceiver.y(), -edge, edge);
  return play;
}

bool ballNotPut(const world::WorldState& world) {
  constexpr double kPutAfter = 1.05;  // s
  const world::Phase phase = world.game.phase;
  return world::isOwnSetPiece(phase) && phase != world::Phase::OwnKickOff &&
         world.time - world.game.phaseSince < kPutAfter;
}

}  // namespace nonet::team
