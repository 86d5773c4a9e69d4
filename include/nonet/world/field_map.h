// Where the landmarks and lines are, in the server's world frame W: x from the goal named L to the goal named
// R, z up, origin at the centre spot. W is the field frame of a team that defends the goal L.
#pragma once

#include <array>
#include <span>

#include "nonet/math/types.h"
#include "nonet/protocol/percept.h"
#include "nonet/world/world_state.h"

namespace nonet::world {

struct FieldLine {
  Vector3 begin = Vector3::Zero();       // m
  Vector3 end = Vector3::Zero();         // m
  Vector3 direction = Vector3::UnitX();  // unit, from begin to end
  double length = 0.0;                   // m
};
/// Middle, goal lines, touch lines, penalty areas and the circle as ten segments (server facts 1.6), in the
/// order in which the server sends them.
inline constexpr std::size_t kFieldLineCount = 21;

/// The two field sizes of the league.
FieldGeometry largeField();  // 30 x 20 m
FieldGeometry smallField();  // 21 x 14 m

class FieldMap {
 public:
  explicit FieldMap(const FieldGeometry& geometry);

  const FieldGeometry& geometry() const { return geometry_; }
  const Vector3& landmark(protocol::Landmark id) const { return landmarks_[static_cast<std::size_t>(id)]; }
  std::span<const FieldLine, kFieldLineCount> lines() const { return lines_; }

 private:
  FieldGeometry geometry_;
  std::array<Vector3, protocol::kLandmarkCount> landmarks_;
  std::array<FieldLine, kFieldLineCount> lines_;
};

}  // namespace nonet::world
