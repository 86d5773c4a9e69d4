// One robot alone on the field, in process: an agent's body (agent/robot.h) on the physics, driven by motion
// requests instead of a team. What walking, rising and kicking are measured and trained with.
//
// Its senses are those of sim::Simulation, from the same code, but without vision and referee, which makes it
// fast: commands act two messages later (server facts 1.2, 1.5). Everything that the legs depend on is there.
// What needs eyes, a referee or other players is a GameTrial (game_trial.h).
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "nonet/agent/agent.h"
#include "nonet/sim/physics/world.h"

namespace nonet::lab {

struct TrialSettings : agent::RobotSettings {
  sim::WorldSettings physics;
};

/// The body and mind of that agent, on the exact physics.
TrialSettings trialSettings(const agent::AgentSettings& settings);

/// With goals and ball out of reach: to walk into one is another matter than walking.
TrialSettings onOpenGround(TrialSettings setup);

class RobotTrial {
 public:
  explicit RobotTrial(const TrialSettings& setup);
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
  /// Torso below 0.55 of the standing height: it lies or kneels.
  bool down() const;
  double time() const;  // s since construction
  sim::World& physics();
  sim::RobotHandle robot() const;

  // -- belief
  const world::WorldState& belief() const;
  const motion::Motion& motion() const;
  /// The message of the last cycle.
  const protocol::Percept& percept() const;
  const model::RobotModel& model() const;

  /// The physics as World::save wrote them; the robot's mind starts afresh.
  void restorePhysics(std::span<const std::uint8_t> state);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace nonet::lab
