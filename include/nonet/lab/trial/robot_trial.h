// One robot alone on the field, in process: the real world model, motion and joint control on the exact
// physics, driven by motion requests instead of a team. What walking, rising and kicking are measured and
// trained with.
//
// It talks to the physics directly: senses are rounded as on the wire, commands act two messages later
// (server facts 1.2, 1.5), there is no vision and no referee. Everything the robot's legs depend on is there;
// what needs eyes belongs into a match.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "nonet/agent/agent.h"
#include "nonet/math/random.h"
#include "nonet/motion/joint_control.h"
#include "nonet/motion/motion.h"
#include "nonet/motion/parameters.h"
#include "nonet/sim/physics/world.h"
#include "nonet/world/world_model.h"

namespace nonet::lab {

struct TrialSetup {
  int robotType = 0;
  motion::MotionParameters motion;
  world::WorldParameters world;
  std::string skillFolder;
  std::uint64_t seed = 1;
  sim::WorldSettings physics;
};

/// The body and mind of that agent.
TrialSetup trialSetup(const agent::AgentConfig& config);

class RobotTrial {
 public:
  explicit RobotTrial(const TrialSetup& setup);
  ~RobotTrial();

  /// Puts the robot there, upright, at rest, a little above the ground, joints as they are (field = world
  /// frame of the left team).
  void place(const Pose2& X_FR);
  /// Stands until the robot is quiet; then moves it rigidly so that its torso is at X_FR.
  void settle(const Pose2& X_FR);

  /// One cycle with this wish.
  void step(const motion::MotionRequest& request, const motion::HeadRequest& head = {});
  /// The same, as often as fits into `seconds`.
  void run(const motion::MotionRequest& request, double seconds);
  /// One cycle with these joint targets instead of motion's.
  void stepJoints(const motion::JointTargets& targets);
  /// One cycle with these joint speeds, without any control.
  void stepSpeeds(const model::JointArray& speeds);

  // -- truth
  Pose2 pose() const;             // torso on the ground, heading
  Vector3 torsoPosition() const;  // m
  double tilt() const;            // rad between torso and upright
  /// Torso below half of the standing height: it lies or kneels.
  bool down() const;
  double time() const;  // s since construction
  sim::World& physics();
  sim::RobotHandle robot() const;

  // -- belief
  const world::WorldState& belief() const;
  motion::Motion& motion();
  const model::RobotModel& model() const;
  Random& random();

  // -- snapshots: the physics; the robot's mind starts afresh
  std::vector<std::uint8_t> savePhysics() const;
  void restorePhysics(std::span<const std::uint8_t> state);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace nonet::lab
