#include "sim/physics/quick_stepper.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>
#include <Eigen/Geometry>

#include "sim/physics/world_implementation.h"

namespace nonet::sim {

namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kBlockRounds = 12;  // rounds in which all wrong states are changed at once
constexpr int kMaxRounds = 200;   // then one by one

/// One contact: its normal and two friction directions.
struct ContactRows {
  struct Side {
    Multibody* multibody = nullptr;  // null: fixed
    std::size_t body = 0;            // in the multibody
    std::size_t touch = 0;           // in the multibody's list of touched bodies
    std::array<Vector6, 3> rows;     // unit impulses on the body's centre
  };
  std::array<Side, 2> sides;
  std::array<Vector3d, 3> directions;
  std::array<double, 3> targetSpeed{};  // m/s
  std::array<double, 3> compliance{};   // m/s per N s
  PendingContact* pending = nullptr;
};

// A ball in the air is attached to nothing: ODE lets it be, whatever its countdown says.
bool putIdleToSleep(Island& island) {
  bool awake = false;
  const bool attached = !island.contacts.empty() || island.members.front()->nodes.size() > 1;
  for (Multibody* member : island.members) {
    for (BodyNode* node : member->nodes) {
      if (dBodyIsEnabled(node->body) == 0) continue;
      if (!attached || node->stepsUntilSleep > 0) {
        awake = true;
        continue;
      }
      dBodySetLinearVel(node->body, 0.0, 0.0, 0.0);
      dBodySetAngularVel(node->body, 0.0, 0.0, 0.0);
      dBodyDisable(node->body);
    }
  }
  return awake;
}

ContactRows::Side sideOf(const Collider* collider, const Vector3d& point,
                         const std::array<Vector3d, 3>& directions, double sign) {
  ContactRows::Side side;
  if (collider->node == nullptr) return side;
  side.multibody = collider->multibody;
  side.body = collider->node->place;
  std::vector<std::size_t>& touched = side.multibody->quick->touched;
  side.touch =
      static_cast<std::size_t>(std::find(touched.begin(), touched.end(), side.body) - touched.begin());
  if (side.touch == touched.size()) touched.push_back(side.body);
  const Vector3d arm = point - vectorOf(dBodyGetPosition(collider->node->body));
  for (std::size_t i = 0; i < 3; ++i) side.rows[i] = sign * unitImpulse(arm, directions[i]);
  return side;
}

double speedAlong(const ContactRows::Side& side) {
  if (side.multibody == nullptr) return 0.0;
  const dBodyID body = side.multibody->nodes[side.body]->body;
  return side.rows[0].head<3>().dot(vectorOf(dBodyGetLinearVel(body))) +
         side.rows[0].tail<3>().dot(vectorOf(dBodyGetAngularVel(body)));
}

// As ODE's contact joint has it (server facts 3.2): push-out by depth and ERP, or bounce; slip for friction.
ContactRows rowsFor(PendingContact& pending, double seconds) {
  ContactRows rows;
  rows.pending = &pending;
  const dContact& contact = pending.contact;
  const dSurfaceParameters& surface = contact.surface;
  dVector3 first;
  dVector3 second;
  dPlaneSpace(contact.geom.normal, first, second);
  rows.directions = {vectorOf(contact.geom.normal), vectorOf(first), vectorOf(second)};
  const Vector3d point = vectorOf(contact.geom.pos);
  rows.sides = {sideOf(pending.first, point, rows.directions, 1.0),
                sideOf(pending.second, point, rows.directions, -1.0)};
  const double erp = (surface.mode & dContactSoftERP) != 0 ? surface.soft_erp : kWorldErp;
  double speed = erp / seconds * std::max(0.0, contact.geom.depth - kSurfaceLayer);
  if ((surface.mode & dContactBounce) != 0) {
    const double incoming = -(speedAlong(rows.sides[0]) + speedAlong(rows.sides[1]));
    if (incoming > surface.bounce_vel) speed = std::max(speed, surface.bounce * incoming);
  }
  rows.targetSpeed[0] = speed;
  const double cfm = (surface.mode & dContactSoftCFM) != 0 ? surface.soft_cfm : kWorldCfm;
  const double slip = (surface.mode & dContactSlip1) != 0 ? surface.slip1 : kWorldCfm;
  rows.compliance = {cfm / seconds, slip / seconds, slip / seconds};
  return rows;
}

/// The contacts of an island. Wanted are the impulses x and the speeds w left over the target speeds, with
///     W x - b = w,
/// x >= 0, w >= 0 and x w = 0 for normals, w = 0 for friction (which is unlimited here, so that it does not
/// depend on the normal force). W is the Delassus matrix: what a unit impulse along one row does to the
/// speeds of all rows. b is the target speeds less the speeds without contacts.
class ContactProblem {
 public:
  ContactProblem(Island& island, double seconds) {
    for (PendingContact* pending : island.contacts) contacts_.push_back(rowsFor(*pending, seconds));
    const auto size = static_cast<Eigen::Index>(3 * contacts_.size());
    delassus_.resize(size, size);
    right_.resize(size);
    impulses_.resize(size);
    active_.assign(contacts_.size(), true);
  }

  bool empty() const { return contacts_.empty(); }

  /// For the present inertias and the solution without contacts.
  void solve() {
    assemble();
    std::fill(active_.begin(), active_.end(), true);
    for (int round = 0; round < kMaxRounds; ++round) {
      solveActive();
      if (correctNormals(round >= kBlockRounds) == 0) break;
    }
  }

  /// Adds the contact impulses to the multibodies' lists.
  void addImpulses() const {
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      for (const ContactRows::Side& side : contacts_[c].sides) {
        if (side.multibody == nullptr) continue;
        for (std::size_t i = 0; i < 3; ++i) {
          side.multibody->quick->impulses[side.body] += side.rows[i] * impulse(c, i);
        }
      }
    }
  }

  void reportForces(double seconds) const {
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      dJointFeedback* feedback = contacts_[c].pending->feedback;
      if (feedback == nullptr) continue;
      Vector3d force = Vector3d::Zero();
      for (std::size_t i = 0; i < 3; ++i) force += contacts_[c].directions[i] * (impulse(c, i) / seconds);
      for (int k = 0; k < 3; ++k) feedback->f1[k] = force[k];
    }
  }

 private:
  static Eigen::Index rowIndex(std::size_t contact, std::size_t i) {
    return static_cast<Eigen::Index>(3 * contact + i);
  }
  double impulse(std::size_t contact, std::size_t i) const { return impulses_[rowIndex(contact, i)]; }

  void assemble() {
    for (std::size_t q = 0; q < contacts_.size(); ++q) {
      for (std::size_t j = 0; j < 3; ++j) {
        const Eigen::Index column = rowIndex(q, j);
        delassus_.col(column).setZero();
        for (const ContactRows::Side& side : contacts_[q].sides) {
          if (side.multibody != nullptr) addColumn(side, j, column);
        }
        delassus_(column, column) += contacts_[q].compliance[j];
        right_[column] = contacts_[q].targetSpeed[j];
        for (const ContactRows::Side& side : contacts_[q].sides) {
          if (side.multibody == nullptr) continue;
          right_[column] -= side.rows[j].dot(side.multibody->quick->solver.velocity(side.body));
        }
      }
    }
  }

  /// What a unit impulse of this row does to all rows.
  void addColumn(const ContactRows::Side& pushed, std::size_t j, Eigen::Index column) {
    const QuickState& quick = *pushed.multibody->quick;
    const std::size_t count = quick.touched.size();
    velocities_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      velocities_[i] = quick.responses[i * count + pushed.touch] * pushed.rows[j];
    }
    for (std::size_t p = 0; p < contacts_.size(); ++p) {
      for (const ContactRows::Side& side : contacts_[p].sides) {
        if (side.multibody != pushed.multibody) continue;
        for (std::size_t i = 0; i < 3; ++i) {
          delassus_(rowIndex(p, i), column) += side.rows[i].dot(velocities_[side.touch]);
        }
      }
    }
  }

  void solveActive() {
    used_.clear();
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      for (std::size_t i = 0; i < 3; ++i) {
        if (i > 0 || active_[c]) used_.push_back(rowIndex(c, i));
      }
    }
    const auto size = static_cast<Eigen::Index>(used_.size());
    reduced_.resize(size, size);
    reducedRight_.resize(size);
    for (Eigen::Index i = 0; i < size; ++i) {
      const Eigen::Index row = used_[static_cast<std::size_t>(i)];
      reducedRight_[i] = right_[row];
      for (Eigen::Index j = 0; j <= i; ++j)
        reduced_(i, j) = delassus_(row, used_[static_cast<std::size_t>(j)]);
    }
    factor_.compute(reduced_);
    factor_.solveInPlace(reducedRight_);
    impulses_.setZero();
    for (Eigen::Index i = 0; i < size; ++i) impulses_[used_[static_cast<std::size_t>(i)]] = reducedRight_[i];
  }

  /// Changes the state of normals that pull, and of open ones that would close further. Returns how many.
  int correctNormals(bool onlyFirst) {
    int wrong = 0;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      const Eigen::Index row = rowIndex(c, 0);
      const bool right =
          active_[c] ? impulses_[row] >= 0.0 : delassus_.row(row).dot(impulses_) >= right_[row];
      if (right) continue;
      ++wrong;
      if (!onlyFirst || wrong == 1) active_[c] = !active_[c];
    }
    return wrong;
  }

  std::vector<ContactRows> contacts_;
  std::vector<bool> active_;  // per contact: the normal presses
  MatrixXd delassus_;
  VectorXd right_;
  VectorXd impulses_;
  // Scratch.
  std::vector<Vector6> velocities_;
  std::vector<Eigen::Index> used_;
  MatrixXd reduced_;
  VectorXd reducedRight_;
  Eigen::LLT<MatrixXd> factor_;
};

void prepareResponses(QuickState& quick) {
  quick.solver.computeInertias();
  quick.solver.solve({});
  const std::size_t count = quick.touched.size();
  quick.responses.resize(count * count);
  std::vector<Matrix6> column(count);
  for (std::size_t j = 0; j < count; ++j) {
    quick.solver.respond(quick.touched[j], quick.touched, column);
    for (std::size_t i = 0; i < count; ++i) quick.responses[i * count + j] = column[i];
  }
}

void integrate(Multibody& multibody, double seconds) {
  for (std::size_t i = 0; i < multibody.nodes.size(); ++i) {
    const dBodyID body = multibody.nodes[i]->body;
    const Vector6& velocity = multibody.quick->solver.velocity(i);
    dBodySetLinearVel(body, velocity[0], velocity[1], velocity[2]);
    dBodySetAngularVel(body, velocity[3], velocity[4], velocity[5]);
    const dReal* p = dBodyGetPosition(body);
    dBodySetPosition(body, p[0] + seconds * velocity[0], p[1] + seconds * velocity[1],
                     p[2] + seconds * velocity[2]);
    const dReal* q = dBodyGetQuaternion(body);
    const Eigen::Quaterniond now(q[0], q[1], q[2], q[3]);
    const Eigen::Quaterniond change = Eigen::Quaterniond(0.0, velocity[3], velocity[4], velocity[5]) * now;
    const Eigen::Vector4d next =
        Eigen::Vector4d(q[0], q[1], q[2], q[3]) +
        0.5 * seconds * Eigen::Vector4d(change.w(), change.x(), change.y(), change.z());
    const dQuaternion turned = {next[0], next[1], next[2], next[3]};
    dBodySetQuaternion(body, turned);  // normalises
    dBodySetForce(body, 0.0, 0.0, 0.0);
    dBodySetTorque(body, 0.0, 0.0, 0.0);
    dBodyEnable(body);
  }
}

}  // namespace

void stepQuickly(Island& island, dReal seconds) {
  if (!putIdleToSleep(island)) return;
  orderAsOde(island);
  for (Multibody* member : island.members) {
    if (member->quick == nullptr) member->quick = std::make_unique<QuickState>(member->robotType);
    member->quick->touched.clear();
    member->quick->solver.setUp(member->mechanism, seconds);
  }
  ContactProblem problem(island, seconds);
  for (int round = 0; round < kMaxRounds; ++round) {
    for (Multibody* member : island.members) prepareResponses(*member->quick);
    if (!problem.empty()) {
      problem.solve();
      for (Multibody* member : island.members) {
        member->quick->impulses.assign(member->nodes.size(), Vector6::Zero());
      }
      problem.addImpulses();
      for (Multibody* member : island.members) member->quick->solver.solve(member->quick->impulses);
    }
    int wrong = 0;
    for (Multibody* member : island.members)
      wrong += member->quick->solver.correctMotors(round >= kBlockRounds);
    if (wrong == 0) break;
  }
  problem.reportForces(seconds);
  for (Multibody* member : island.members) integrate(*member, seconds);
}

}  // namespace nonet::sim
