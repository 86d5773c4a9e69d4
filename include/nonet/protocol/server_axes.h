// The server's body axes (x right, y forward, z up) and ours (x forward, y left, z up). For positions,
// forces, accelerations and angular rates alike: the change is a proper rotation by 90 degrees about z.
#pragma once

#include "nonet/math/types.h"

namespace nonet::protocol {

inline Vector3 robotFromServerAxes(const Vector3& server) {
  return {server.y(), -server.x(), server.z()};
}

inline Vector3 serverFromRobotAxes(const Vector3& robot) {
  return {-robot.y(), robot.x(), robot.z()};
}

}  // namespace nonet::protocol
