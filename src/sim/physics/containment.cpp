#include "sim/physics/containment.h"

#include <algorithm>
#include <cmath>

#include "sim/physics/world_implementation.h"

namespace nonet::sim {

namespace {

constexpr dReal kFastest = 50.0;        // m/s
constexpr dReal kFastestTurning = 1e3;  // rad/s
constexpr dReal kFarthest = 1e4;        // m from the centre of the field

// Comparisons that are false for what is no number.
bool slowerThan(const dReal* vector, dReal limit) {
  return vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2] <= limit * limit;
}

bool isFinite(dBodyID body) {
  const dReal* q = dBodyGetQuaternion(body);
  const bool turned = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] <= 2.0;
  return turned && slowerThan(dBodyGetPosition(body), kFarthest) &&
         std::isfinite(dBodyGetLinearVel(body)[0]) && std::isfinite(dBodyGetLinearVel(body)[1]) &&
         std::isfinite(dBodyGetLinearVel(body)[2]) && std::isfinite(dBodyGetAngularVel(body)[0]) &&
         std::isfinite(dBodyGetAngularVel(body)[1]) && std::isfinite(dBodyGetAngularVel(body)[2]);
}

bool isTame(dBodyID body) {
  return slowerThan(dBodyGetLinearVel(body), kFastest) &&
         slowerThan(dBodyGetAngularVel(body), kFastestTurning);
}

}  // namespace

void rememberPoses(Island& island) {
  island.posesBefore.clear();
  for (const Multibody* member : island.members) {
    for (const dBodyID body : member->mechanism.bodies) {
      Island::Pose& pose = island.posesBefore.emplace_back();
      std::copy_n(dBodyGetPosition(body), 3, pose.position.begin());
      std::copy_n(dBodyGetQuaternion(body), 4, pose.quaternion.begin());
    }
  }
}

void contain(Island& island) {
  auto before = island.posesBefore.begin();
  for (Multibody* member : island.members) {
    const std::vector<dBodyID>& bodies = member->mechanism.bodies;
    const auto first = before;
    before += static_cast<std::ptrdiff_t>(bodies.size());
    const bool finite = std::all_of(bodies.begin(), bodies.end(), isFinite);
    if (finite && std::all_of(bodies.begin(), bodies.end(), isTame)) continue;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      dBodySetLinearVel(bodies[i], 0.0, 0.0, 0.0);
      dBodySetAngularVel(bodies[i], 0.0, 0.0, 0.0);
      if (finite) continue;
      const Island::Pose& pose = first[static_cast<std::ptrdiff_t>(i)];
      dBodySetPosition(bodies[i], pose.position[0], pose.position[1], pose.position[2]);
      dBodySetQuaternion(bodies[i], pose.quaternion.data());
    }
    if (!finite) member->mechanism.turned();
  }
}

}  // namespace nonet::sim
