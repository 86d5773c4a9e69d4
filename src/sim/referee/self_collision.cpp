// Self-collision (server facts 4.10): box colliders of one robot that overlap freeze the joints of their
// limbs.
#include "nonet/sim/referee/self_collision.h"

#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "nonet/sim/referee/fouls.h"

#include "sim/physics/scene.h"

namespace nonet::sim {

namespace {

using model::BodyId;
using model::JointId;

// True if `axis` separates the boxes. The server does not normalise cross products, so that a nearly parallel
// pair of edges always separates (server facts 7.1, quirk 12).
bool separates(const Vector3f& axis, const Vector3f& between, const ScenePose& a, const Vector3f& halfA,
               const ScenePose& b, const Vector3f& halfB, float tolerance) {
  float reach = 0.0F;
  for (int i = 0; i < 3; ++i) {
    reach += std::abs((a.rotation.col(i) * halfA[i]).dot(axis)) +
             std::abs((b.rotation.col(i) * halfB[i]).dot(axis));
  }
  return std::abs(between.dot(axis)) + tolerance > reach;
}

bool boxesOverlap(const ScenePose& a, const Vector3f& sizeA, const ScenePose& b, const Vector3f& sizeB,
                  float tolerance) {
  const Vector3f between = b.position - a.position;
  const Vector3f halfA = sizeA * 0.5F;
  const Vector3f halfB = sizeB * 0.5F;
  const auto separated = [&](const Vector3f& axis) {
    return separates(axis, between, a, halfA, b, halfB, tolerance);
  };
  for (int i = 0; i < 3; ++i) {
    if (separated(a.rotation.col(i)) || separated(b.rotation.col(i))) return false;
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (separated(a.rotation.col(i).cross(b.rotation.col(j)))) return false;
    }
  }
  return true;
}

enum class Limb { Torso, RArm, LArm, RLeg, LLeg };

Limb limbOf(BodyId body) {
  switch (body) {
    case BodyId::RUpperArm:
    case BodyId::RLowerArm:
      return Limb::RArm;
    case BodyId::LUpperArm:
    case BodyId::LLowerArm:
      return Limb::LArm;
    case BodyId::RThigh:
    case BodyId::RShank:
    case BodyId::RFoot:
    case BodyId::RToe:
      return Limb::RLeg;
    case BodyId::LThigh:
    case BodyId::LShank:
    case BodyId::LFoot:
    case BodyId::LToe:
      return Limb::LLeg;
    default:
      return Limb::Torso;
  }
}

void appendJoints(Limb limb, std::vector<JointId>& joints) {
  const auto range = [&joints](JointId first, JointId last) {
    for (std::size_t i = model::index(first); i <= model::index(last); ++i)
      joints.push_back(model::jointAt(i));
  };
  switch (limb) {
    case Limb::RArm:
      return range(JointId::RArm1, JointId::RArm4);
    case Limb::LArm:
      return range(JointId::LArm1, JointId::LArm4);
    case Limb::RLeg:
      return range(JointId::RLeg1, JointId::RLeg7);
    case Limb::LLeg:
      return range(JointId::LLeg1, JointId::LLeg7);
    case Limb::Torso:
      return;
  }
}

// Neighbours that the referee does not look at.
bool excluded(BodyId a, BodyId b) {
  const auto pair = [a, b](BodyId x, BodyId y) { return (a == x && b == y) || (a == y && b == x); };
  return pair(BodyId::Torso, BodyId::RThigh) || pair(BodyId::Torso, BodyId::LThigh) ||
         pair(BodyId::RThigh, BodyId::RShank) || pair(BodyId::LThigh, BodyId::LShank) ||
         pair(BodyId::RShank, BodyId::RFoot) || pair(BodyId::LShank, BodyId::LFoot) ||
         pair(BodyId::RFoot, BodyId::RToe) || pair(BodyId::LFoot, BodyId::LToe);
}

// A box that the referee looks at, and the sphere about it.
struct Box {
  BodyId body;
  Vector3f size;
  float radius;
};

std::vector<Box> boxesOf(int robotType) {
  std::vector<Box> boxes;
  for (const model::BodySpec& body : model::robotModel(robotType).bodies()) {
    if (!body.collider || body.shape.kind != model::ShapeKind::Box) continue;
    const Vector3f size = scene::extentsInServerAxes(body.shape.size).cast<float>();
    boxes.push_back({body.id, size, 0.5F * size.norm()});
  }
  return boxes;
}

// Of each robot type, found once.
const std::vector<Box>& boxes(int robotType) {
  static const auto all = [] {
    std::array<std::vector<Box>, model::kRobotTypeCount> found;
    for (std::size_t i = 0; i < found.size(); ++i) found[i] = boxesOf(static_cast<int>(i));
    return found;
  }();
  return all.at(static_cast<std::size_t>(robotType));
}

// Boxes whose spheres are apart by this are apart whatever rounding does.
constexpr float kSurelyApart = 0.01F;  // m

bool farApart(const Vector3f& between, const Box& a, const Box& b) {
  const float reach = a.radius + b.radius + kSurelyApart;
  return between.squaredNorm() > reach * reach;
}

}  // namespace

void findSelfCollisions(const World& world, RobotHandle robot, float tolerance,
                        const std::function<void(BodyId, BodyId)>& found) {
  const std::vector<Box>& all = boxes(world.robotType(robot));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const ScenePose& a = world.bodyPose(robot, all[i].body);
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      const ScenePose& b = world.bodyPose(robot, all[j].body);
      if (farApart(b.position - a.position, all[i], all[j]) || excluded(all[i].body, all[j].body)) continue;
      if (boxesOverlap(a, all[i].size, b, all[j].size, tolerance)) found(all[i].body, all[j].body);
    }
  }
}

bool selfCollides(const World& world, RobotHandle robot) {
  static const auto tolerance = static_cast<float>(Settings().selfCollisionsTolerance);
  bool any = false;
  findSelfCollisions(world, robot, tolerance, [&any](BodyId, BodyId) { any = true; });
  return any;
}

void Fouls::judgeSelfCollisions(TeamSide side) {
  const float tolerance = static_cast<float>(c_.settings.selfCollisionsTolerance);
  for (const Player* player : c_.team(side)) {
    findSelfCollisions(c_.world, player->robot, tolerance, [this, player](BodyId first, BodyId second) {
      selfCollision(*player, first, second);
    });
  }
}

void Fouls::selfCollision(const Player& player, BodyId first, BodyId second) {
  const Settings& s = c_.settings;
  const float now = c_.game.time();
  const auto who = [&] {
    return fmt::format("Team {} Pl {}", std::string_view(c_.game.teamName(player.side)), player.unum);
  };
  if (s.printSelfCollisions) {
    spdlog::debug("self-collision at {:.2f}: {} {} {}", now, who(), model::bodyName(first),
                  model::bodyName(second));
  }
  if (s.writeSelfCollisionsToFile) {
    writeSelfCollision(fmt::format("Collision GTime {} {} {} {}", now, who(), model::bodyName(first),
                                   model::bodyName(second)));
  }
  const auto writeFoul = [&] {
    if (s.writeSelfCollisionsToFile) writeSelfCollision(fmt::format("Foul {} GTime {}", who(), now));
  };
  if (!s.foulOnSelfCollisions) return;

  if (s.selfCollisionBeamPenalty) {
    PlayerRecord& record = c_.records.of(player);
    if (now - record.lastSelfCollision <= s.selfCollisionBeamCooldownTime) return;
    record.lastSelfCollision = now;
    countFoul(record, FoulType::SelfCollision);
    writeFoul();
    return;
  }
  std::vector<JointId> joints;
  appendJoints(limbOf(first), joints);
  appendJoints(limbOf(second), joints);
  auto& frozenAt = c_.records.of(player).jointFrozenAt;
  const float rest = static_cast<float>(s.selfCollisionJointFrozenTime + s.selfCollisionJointThawTime);
  const model::RobotModel& robot = model::robotModel(player.robotType);
  bool foul = false;
  for (const JointId joint : joints) {
    float& last = frozenAt[model::index(joint)];
    if (!robot.has(joint) || (last != kNeverFrozen && now - last <= rest)) continue;
    foul = true;
    last = now;
    c_.world.freezeJoint(player.robot, joint, true);
  }
  if (!foul) return;
  c_.recordFoul(FoulType::SelfCollision, player);
  writeFoul();
}

void Fouls::writeSelfCollision(const std::string& line) {
  if (!selfCollisionFile_.is_open()) {
    selfCollisionFile_.open(c_.settings.selfCollisionRecordFilename, std::ios::app);
  }
  selfCollisionFile_ << line << std::endl;
}

void Fouls::thaw(const Player& player) {
  c_.records.of(player).jointFrozenAt.fill(kNeverFrozen);
  for (std::size_t i = 0; i < model::kJointCount; ++i) {
    c_.world.freezeJoint(player.robot, model::jointAt(i), false);
  }
}

void Fouls::thawJoints() {
  const Settings& s = c_.settings;
  if (!s.foulOnSelfCollisions || s.selfCollisionBeamPenalty) return;
  const float frozen = static_cast<float>(s.selfCollisionJointFrozenTime);
  const float rest = static_cast<float>(s.selfCollisionJointFrozenTime + s.selfCollisionJointThawTime);
  for (const Player& player : c_.players) {
    auto& frozenAt = c_.records.of(player).jointFrozenAt;
    for (std::size_t i = 0; i < frozenAt.size(); ++i) {
      if (frozenAt[i] < 0.0F) continue;
      const float passed = c_.game.time() - frozenAt[i];
      if (passed >= frozen) c_.world.freezeJoint(player.robot, model::jointAt(i), false);
      if (passed >= rest) frozenAt[i] = kNeverFrozen;
    }
  }
}

}  // namespace nonet::sim
