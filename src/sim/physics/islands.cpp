#include "sim/physics/islands.h"

#include <algorithm>

#include "sim/physics/world_implementation.h"

namespace nonet::sim {

namespace {

constexpr std::size_t kCommonWorldsKept = 12;

void onMoved(dBodyID body) {
  auto* node = static_cast<BodyNode*>(dBodyGetData(body));
  node->collider.cell->cluster->moved.push_back(node);
}

void watch(dBodyID body, BodyNode& node) {
  dBodySetData(body, &node);
  dBodySetMovedCallback(body, &onMoved);
}

bool anyAwake(const Cluster& cluster) {
  for (const Cell* cell : cluster.cells) {
    for (const dBodyID body : cell->mechanism.bodies) {
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

void stepAlone(Cluster& cluster, dReal seconds) {
  Cell& cell = *cluster.cells.front();
  const auto bodyOf = [](const Collider* collider) {
    return collider->node == nullptr ? nullptr : collider->node->body;
  };
  for (PendingContact* pending : cluster.contacts) {
    createContact(cell.world, *pending, bodyOf(pending->first), bodyOf(pending->second));
  }
  dWorldStep(cell.world.id(), seconds);
  dJointGroupEmpty(cell.world.contactJoints());
}

void stepTogether(Cluster& cluster, dReal seconds) {
  CommonWorld& common = *cluster.common;
  for (std::size_t i = 0; i < cluster.cells.size(); ++i) {
    const Cell& cell = *cluster.cells[i];
    const Mechanism& replica = common.replicas[i];
    copyState(cell.mechanism, replica);
    for (std::size_t k = 0; k < cell.nodes.size(); ++k) {
      BodyNode& node = *cell.nodes[k];
      watch(replica.bodies[k], node);
      setAwake(replica.bodies[k], dBodyIsEnabled(node.body) != 0, node.stepsBefore);
    }
  }
  const auto bodyOf = [&common](const Collider* collider) -> dBodyID {
    if (collider->node == nullptr) return nullptr;
    return common.replicas[collider->cell->place].bodies[collider->node->place];
  };
  for (PendingContact* pending : cluster.contacts) {
    createContact(common.world, *pending, bodyOf(pending->first), bodyOf(pending->second));
  }
  dWorldStep(common.world.id(), seconds);
  dJointGroupEmpty(common.world.contactJoints());
  for (std::size_t i = 0; i < cluster.cells.size(); ++i) {
    const Cell& cell = *cluster.cells[i];
    for (std::size_t k = 0; k < cell.nodes.size(); ++k) {
      const dBodyID replica = common.replicas[i].bodies[k];
      copyBody(replica, cell.nodes[k]->body);
      setAwake(cell.nodes[k]->body, dBodyIsEnabled(replica) != 0, cell.nodes[k]->stepsUntilSleep);
    }
  }
}

}  // namespace

Cell::Cell() = default;
Cell::~Cell() = default;

CommonWorld::CommonWorld(std::span<Cell* const> cells, const WorldSettings& settings) {
  for (const Cell* cell : cells) {
    members.push_back(cell->handle);
    replicas.push_back(cell->handle == kNoRobot
                           ? buildBall(world.id(), static_cast<float>(settings.ballRadius),
                                       static_cast<float>(settings.ballMass))
                           : buildMechanism(world.id(), robotPlan(cell->robotType)));
  }
}

CommonWorld& CommonWorlds::forCells(std::span<Cell* const> cells, const WorldSettings& settings,
                                    std::uint64_t cycle) {
  const auto same = [&cells](const std::unique_ptr<CommonWorld>& common) {
    return std::equal(cells.begin(), cells.end(), common->members.begin(), common->members.end(),
                      [](const Cell* cell, RobotHandle member) { return cell->handle == member; });
  };
  auto found = std::find_if(worlds_.begin(), worlds_.end(), same);
  if (found == worlds_.end()) {
    if (worlds_.size() >= kCommonWorldsKept) {
      const auto oldest = std::min_element(worlds_.begin(), worlds_.end(), [](const auto& a, const auto& b) {
        return a->lastUse < b->lastUse;
      });
      if ((*oldest)->lastUse < cycle) worlds_.erase(oldest);
    }
    worlds_.push_back(std::make_unique<CommonWorld>(cells, settings));
    found = worlds_.end() - 1;
  }
  (*found)->lastUse = cycle;
  return **found;
}

void CommonWorlds::forget(RobotHandle member) {
  std::erase_if(worlds_, [member](const auto& common) {
    return std::find(common->members.begin(), common->members.end(), member) != common->members.end();
  });
}

void watchBody(BodyNode& node) {
  watch(node.body, node);
}

void orderAsOde(Cluster& cluster) {
  BodyNode* start = nullptr;
  for (Cell* cell : cluster.cells) {
    for (BodyNode* node : cell->nodes) {
      node->visited = false;
      if (dBodyIsEnabled(node->body) != 0) start = node;
    }
  }
  if (start == nullptr) return;
  std::vector<BodyNode*>& stack = cluster.stack;
  const auto push = [&stack](BodyNode* node) {
    if (node == nullptr || node->visited) return;
    node->visited = true;
    stack.push_back(node);
  };
  push(start);
  while (!stack.empty()) {
    BodyNode* node = stack.back();
    stack.pop_back();
    cluster.moved.push_back(node);
    for (auto contact = cluster.contacts.rbegin(); contact != cluster.contacts.rend(); ++contact) {
      if ((*contact)->first->node == node) push((*contact)->second->node);
      if ((*contact)->second->node == node) push((*contact)->first->node);
    }
    for (auto joint = node->neighbours.rbegin(); joint != node->neighbours.rend(); ++joint) push(*joint);
  }
}

void stepExactly(Cluster& cluster, dReal seconds) {
  if (!anyAwake(cluster)) return;
  if (cluster.cells.size() == 1) {
    stepAlone(cluster, seconds);
  } else {
    stepTogether(cluster, seconds);
  }
}

}  // namespace nonet::sim
