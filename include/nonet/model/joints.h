// The joints and bodies of the Nao, by name. The order is that of the server's messages; toes exist on type 4
// only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace nonet::model {

enum class JointId : std::uint8_t {
  Head1,
  Head2,  // yaw, pitch
  RArm1,
  RArm2,
  RArm3,
  RArm4,  // shoulder pitch, shoulder yaw, upper arm roll, elbow
  LArm1,
  LArm2,
  LArm3,
  LArm4,
  RLeg1,
  RLeg2,
  RLeg3,
  RLeg4,
  RLeg5,
  RLeg6,
  RLeg7,  // hip yaw-pitch, hip roll, hip pitch, knee, ankle pitch, ankle roll, toe
  LLeg1,
  LLeg2,
  LLeg3,
  LLeg4,
  LLeg5,
  LLeg6,
  LLeg7,
};
inline constexpr std::size_t kJointCount = 24;

/// One value per joint (rad, rad/s, ...), indexed by JointId. Entries of toes that a type lacks stay 0.
using JointArray = std::array<double, kJointCount>;

constexpr std::size_t index(JointId id) {
  return static_cast<std::size_t>(id);
}
constexpr JointId jointAt(std::size_t i) {
  return static_cast<JointId>(i);
}

/// "hj1" ... "llj7": the names of the joint perceptors.
std::string_view perceptorName(JointId id);
/// "he1" ... "lle7": the names of the effectors.
std::string_view effectorName(JointId id);
std::optional<JointId> jointFromPerceptorName(std::string_view name);
std::optional<JointId> jointFromEffectorName(std::string_view name);
/// The same joint on the other side; head joints map to themselves.
JointId mirrored(JointId id);

enum class BodyId : std::uint8_t {
  Torso,
  Neck,
  Head,
  RShoulder,
  RUpperArm,
  RElbow,
  RLowerArm,
  LShoulder,
  LUpperArm,
  LElbow,
  LLowerArm,
  RHip1,
  RHip2,
  RThigh,
  RShank,
  RAnkle,
  RFoot,
  RToe,
  LHip1,
  LHip2,
  LThigh,
  LShank,
  LAnkle,
  LFoot,
  LToe,
};
inline constexpr std::size_t kBodyCount = 25;
constexpr std::size_t index(BodyId id) {
  return static_cast<std::size_t>(id);
}
constexpr BodyId bodyAt(std::size_t i) {
  return static_cast<BodyId>(i);
}

/// "torso", "neck", "head", "rshoulder", ... "lfoot", "ltoe" (names of the golden recordings).
std::string_view bodyName(BodyId id);

enum class Side : std::uint8_t { Left, Right };
constexpr Side other(Side side) {
  return side == Side::Left ? Side::Right : Side::Left;
}

}  // namespace nonet::model
