#include "nonet/motion/watch.h"

#include <cmath>

#include "nonet/math/direction.h"

namespace nonet::motion {

HeadRequest Watch::update(const world::WorldState& world) {
  HeadRequest request;
  const double unseen = world.time - world.ball.lastSeen;
  const bool near = world.ball.known && unseen < parameters_.lostAfter + parameters_.nearSearch;
  if (!near) {
    request.kind = HeadRequest::Kind::Scan;
    return request;
  }
  const bool blind = world.time - world.self.lastCorrection > parameters_.glanceAfter;
  if (blind && world.time - lastGlance_ > parameters_.glanceAfter + parameters_.glanceTime) {
    lastGlance_ = world.time;
    glanceUntil_ = world.time + parameters_.glanceTime;
  }
  // Position of the ball a little later, seen from the robot, in the torso frame: the torso may lean.
  const Eigen::Rotation2Dd toRobot(-world.self.X_FR.rotation);
  const Vector2 ball = world.ball.p_RB + parameters_.lookAhead * (toRobot * world.ball.v_FB.head<2>());
  if (blind && world.time < glanceUntil_) {
    // Most landmarks stand at the ends of the field: raise the head, and look past the ball.
    request.kind = HeadRequest::Kind::Look;
    const double bearing = directionOf(ball);
    request.pan = bearing > 0.0 ? bearing - 1.0 : bearing + 1.0;
    request.tilt = 0.0;
    return request;
  }
  const Vector3 p_level(ball.x(), ball.y(), world.ball.p_FB.z() - world.self.height);
  const Matrix3 R_LR = (Eigen::AngleAxisd(world.body.pitch, Vector3::UnitY()) *
                        Eigen::AngleAxisd(world.body.roll, Vector3::UnitX()))
                           .toRotationMatrix();
  request.kind = HeadRequest::Kind::Point;
  request.p_RP = R_LR.transpose() * p_level;
  return request;
}

}  // namespace nonet::motion
