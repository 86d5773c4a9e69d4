#include "nonet/sim/referee/geometry.h"

#include <array>

namespace nonet::sim {

namespace {

using model::BodyId;

// Extent of what the server draws for a body, in the body's axes (measured from its meshes, times their
// scale).
struct DrawnExtent {
  BodyId body;
  Vector3f low;
  Vector3f high;
};

DrawnExtent symmetric(BodyId body, float x, float y, float z) {
  return {body, Vector3f(-x, -y, -z), Vector3f(x, y, z)};
}

// The right limb's extent; the left one is its mirror image.
void addPair(std::vector<DrawnExtent>& extents, BodyId right, BodyId left, const Vector3f& low,
             const Vector3f& high) {
  extents.push_back({right, low, high});
  extents.push_back({left, Vector3f(-high.x(), low.y(), low.z()), Vector3f(-low.x(), high.y(), high.z())});
}

std::vector<DrawnExtent> drawnExtents(bool toes) {
  std::vector<DrawnExtent> e;
  e.push_back(
      {BodyId::Torso, Vector3f(-0.07738F, -0.05522F, -0.11862F), Vector3f(0.07599F, 0.05822F, 0.11279F)});
  e.push_back(symmetric(BodyId::Torso, 0.2F, 0.2F, 0.01F));  // the selection disc
  e.push_back(symmetric(BodyId::Neck, 0.015F, 0.015F, 0.055F));
  e.push_back(
      {BodyId::Head, Vector3f(-0.06602F, -0.05755F, -0.05122F), Vector3f(0.06602F, 0.05444F, 0.04878F)});
  for (const BodyId body :
       {BodyId::RShoulder, BodyId::LShoulder, BodyId::RElbow, BodyId::LElbow, BodyId::RHip1, BodyId::LHip1,
        BodyId::RHip2, BodyId::LHip2, BodyId::RAnkle, BodyId::LAnkle}) {
    e.push_back(symmetric(body, 0.01F, 0.01F, 0.01F));
  }
  addPair(e, BodyId::RUpperArm, BodyId::LUpperArm, 0.07F * Vector3f(-0.5407F, -1.0244F, -0.5915F),
          0.07F * Vector3f(0.6677F, 0.9623F, 0.5915F));
  addPair(e, BodyId::RLowerArm, BodyId::LLowerArm, 0.05F * Vector3f(-0.6158F, -1.32F, -0.5922F),
          0.05F * Vector3f(0.6158F, 1.4339F, 0.7281F));
  addPair(e, BodyId::RThigh, BodyId::LThigh, 0.07F * Vector3f(-0.6997F, -0.7353F, -1.178F),
          0.07F * Vector3f(0.8158F, 0.7445F, 1.3923F));
  addPair(e, BodyId::RShank, BodyId::LShank, 0.08F * Vector3f(-0.6072F, -0.6568F, -1.0763F),
          0.08F * Vector3f(0.759F, 0.6878F, 1.0221F));
  const Vector3f footLow(-0.55F, -1.1F, -0.25F);
  const Vector3f footHigh(0.55F, 1.1F, 0.5392F);
  const Vector3f footScale(0.08F, toes ? 0.0622412F : 0.08F, 0.08F);
  addPair(e, BodyId::RFoot, BodyId::LFoot, footLow.cwiseProduct(footScale), footHigh.cwiseProduct(footScale));
  if (toes) {
    const Vector3f toeScale(0.08F, 0.0228258F, 0.04F);
    addPair(e, BodyId::RToe, BodyId::LToe, footLow.cwiseProduct(toeScale), footHigh.cwiseProduct(toeScale));
  }
  return e;
}

// What moves of this cycle have added to the scene's poses.
Vector3f movedBy(const World& world, RobotHandle robot) {
  return world.bodyPosition(robot, BodyId::Torso) - world.bodyPose(robot, BodyId::Torso).position;
}

}  // namespace

bool sphereMeetsBox(const Vector3f& center, float radius, const Box3& box) {
  const Vector3f nearest = center.cwiseMax(box.low).cwiseMin(box.high);
  return (center - nearest).squaredNorm() <= radius * radius;
}

FieldAreas::FieldAreas(const Settings& settings) {
  constexpr float kBeyond = 10.0F;
  const float halfLength = static_cast<float>(settings.fieldLength) / 2.0F;
  const float halfWidth = static_cast<float>(settings.fieldWidth) / 2.0F;
  const float depth = static_cast<float>(settings.penaltyLength);
  const float halfArea =
      (static_cast<float>(settings.penaltyWidth) + static_cast<float>(settings.goalWidth)) / 2.0F;
  leftHalf = {Vector2f(-halfLength - kBeyond, -halfWidth - kBeyond), Vector2f(0.0F, halfWidth + kBeyond)};
  rightHalf = {Vector2f(0.0F, -halfWidth - kBeyond), Vector2f(halfLength + kBeyond, halfWidth + kBeyond)};
  leftPenaltyArea = {Vector2f(-halfLength, -halfArea), Vector2f(-halfLength + depth, halfArea)};
  rightPenaltyArea = {Vector2f(halfLength - depth, -halfArea), Vector2f(halfLength, halfArea)};
}

void FieldAreas::moveOutOfPenaltyArea(Vector3f& position) const {
  for (const bool left : {true, false}) {
    const Box2& area = penaltyArea(left);
    if (!area.contains(position.head<2>())) continue;
    position.x() = left ? area.high.x() : area.low.x();
    position.y() = position.y() < 0.0F ? area.low.y() : area.high.y();
    return;
  }
}

Box3 drawnBox(const World& world, RobotHandle robot) {
  static const std::vector<DrawnExtent> kWithoutToes = drawnExtents(false);
  static const std::vector<DrawnExtent> kWithToes = drawnExtents(true);
  const bool toes = model::robotModel(world.robotType(robot)).hasToes();
  Box3 box;
  for (const DrawnExtent& extent : toes ? kWithToes : kWithoutToes) {
    const ScenePose& pose = world.bodyPose(robot, extent.body);
    // The box around a turned box: its centre, and the half extents projected on each axis.
    const Vector3f center = pose.position + pose.rotation * (0.5F * (extent.low + extent.high));
    const Vector3f half = pose.rotation.cwiseAbs() * (0.5F * (extent.high - extent.low));
    box.include(center - half);
    box.include(center + half);
    box.include(pose.position);
  }
  box.move(movedBy(world, robot));
  return box;
}

Box2 colliderRectangle(const World& world, RobotHandle robot) {
  Box2 rectangle;
  for (const model::BodySpec& body : model::robotModel(world.robotType(robot)).bodies()) {
    if (body.collider) rectangle.include(world.bodyPose(robot, body.id).position.head<2>());
  }
  rectangle.move(movedBy(world, robot).head<2>());
  return rectangle;
}

}  // namespace nonet::sim
