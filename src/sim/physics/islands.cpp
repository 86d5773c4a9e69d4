#include "sim/physics/islands.h"

#include <algorithm>

#include "sim/physics/world_implementation.h"

namespace nonet::sim {

namespace {

constexpr std::size_t kCommonWorldsKept = 12;

void onMoved(dBodyID body) {
  auto* node = static_cast<BodyNode*>(dBodyGetData(body));
  node->collider.multibody->island->moved.push_back(node);
}

void watch(dBodyID body, BodyNode& node) {
  dBodySetData(body, &node);
  dBodySetMovedCallback(body, &onMoved);
}

bool anyAwake(const Island& island) {
  for (const Multibody* member : island.members) {
    for (const dBodyID body : member->mechanism.bodies) {
      if (dBodyIsEnabled(body) != 0) return true;
    }
  }
  return false;
}

void setAwake(dBodyID body, bool awake, int stepsUntilSleep) {
  setOdeCountdown(body, stepsUntilSleep);
  if (!awake) dBodyDisable(body);
}

void createContact(const OdeWorld& world, PendingContact& pending, dBodyID first, dBodyID second) {
  const dJointID joint = dJointCreateContact(world.id(), world.contactJoints(), &pending.contact);
  dJointAttach(joint, first, second);
  if (pending.feedback != nullptr) dJointSetFeedback(joint, pending.feedback);
}

void stepAlone(Island& island, dReal seconds) {
  Multibody& member = *island.members.front();
  const auto bodyOf = [](const Collider* collider) {
    return collider->node == nullptr ? nullptr : collider->node->body;
  };
  for (PendingContact* pending : island.contacts) {
    createContact(member.world, *pending, bodyOf(pending->first), bodyOf(pending->second));
  }
  dWorldStep(member.world.id(), seconds);
  dJointGroupEmpty(member.world.contactJoints());
}

void stepTogether(Island& island, dReal seconds) {
  CommonWorld& common = *island.common;
  for (std::size_t i = 0; i < island.members.size(); ++i) {
    const Multibody& member = *island.members[i];
    const Mechanism& replica = common.replicas[i];
    copyState(member.mechanism, replica);
    for (std::size_t k = 0; k < member.nodes.size(); ++k) {
      BodyNode& node = *member.nodes[k];
      watch(replica.bodies[k], node);
      setAwake(replica.bodies[k], dBodyIsEnabled(node.body) != 0, node.stepsBefore);
    }
  }
  const auto bodyOf = [&common](const Collider* collider) -> dBodyID {
    if (collider->node == nullptr) return nullptr;
    return common.replicas[collider->multibody->place].bodies[collider->node->place];
  };
  for (PendingContact* pending : island.contacts) {
    createContact(common.world, *pending, bodyOf(pending->first), bodyOf(pending->second));
  }
  dWorldStep(common.world.id(), seconds);
  dJointGroupEmpty(common.world.contactJoints());
  for (std::size_t i = 0; i < island.members.size(); ++i) {
    const Multibody& member = *island.members[i];
    for (std::size_t k = 0; k < member.nodes.size(); ++k) {
      const dBodyID replica = common.replicas[i].bodies[k];
      copyBody(replica, member.nodes[k]->body);
      setAwake(member.nodes[k]->body, dBodyIsEnabled(replica) != 0, member.nodes[k]->stepsUntilSleep);
    }
  }
}

}  // namespace

Multibody::Multibody() = default;
Multibody::~Multibody() = default;

CommonWorld::CommonWorld(std::span<Multibody* const> members, const WorldSettings& settings) {
  for (const Multibody* member : members) {
    handles.push_back(member->handle);
    replicas.push_back(member->handle == kNoRobot
                           ? buildBall(world.id(), static_cast<float>(settings.ballRadius),
                                       static_cast<float>(settings.ballMass))
                           : buildMechanism(world.id(), robotPlan(member->robotType)));
  }
}

CommonWorld& CommonWorlds::forMembers(std::span<Multibody* const> members, const WorldSettings& settings,
                                      std::uint64_t cycle) {
  const auto same = [&members](const std::unique_ptr<CommonWorld>& common) {
    return std::equal(members.begin(), members.end(), common->handles.begin(), common->handles.end(),
                      [](const Multibody* member, RobotHandle handle) { return member->handle == handle; });
  };
  auto found = std::find_if(worlds_.begin(), worlds_.end(), same);
  if (found == worlds_.end()) {
    if (worlds_.size() >= kCommonWorldsKept) {
      const auto oldest = std::min_element(worlds_.begin(), worlds_.end(), [](const auto& a, const auto& b) {
        return a->lastUse < b->lastUse;
      });
      if ((*oldest)->lastUse < cycle) worlds_.erase(oldest);
    }
    worlds_.push_back(std::make_unique<CommonWorld>(members, settings));
    found = worlds_.end() - 1;
  }
  (*found)->lastUse = cycle;
  return **found;
}

void CommonWorlds::forget(RobotHandle handle) {
  std::erase_if(worlds_, [handle](const auto& common) {
    return std::find(common->handles.begin(), common->handles.end(), handle) != common->handles.end();
  });
}

void watchBody(BodyNode& node) {
  watch(node.body, node);
}

void orderAsOde(Island& island) {
  BodyNode* start = nullptr;
  for (Multibody* member : island.members) {
    for (BodyNode* node : member->nodes) {
      node->visited = false;
      if (dBodyIsEnabled(node->body) != 0) start = node;
    }
  }
  if (start == nullptr) return;
  std::vector<BodyNode*>& stack = island.stack;
  const auto push = [&stack](BodyNode* node) {
    if (node == nullptr || node->visited) return;
    node->visited = true;
    stack.push_back(node);
  };
  push(start);
  while (!stack.empty()) {
    BodyNode* node = stack.back();
    stack.pop_back();
    island.moved.push_back(node);
    for (auto contact = island.contacts.rbegin(); contact != island.contacts.rend(); ++contact) {
      if ((*contact)->first->node == node) push((*contact)->second->node);
      if ((*contact)->second->node == node) push((*contact)->first->node);
    }
    for (auto joint = node->neighbours.rbegin(); joint != node->neighbours.rend(); ++joint) push(*joint);
  }
}

void stepExactly(Island& island, dReal seconds) {
  if (!anyAwake(island)) return;
  if (island.members.size() == 1) {
    stepAlone(island, seconds);
  } else {
    stepTogether(island, seconds);
  }
}

}  // namespace nonet::sim
