// One robot: world model, motion and joint control, wired once. The agent puts the team stage between sense()
// and act(); trials and measurements on a server put there what they want done.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "nonet/model/robot_model.h"
#include "nonet/motion/motion.h"
#include "nonet/protocol/effectors.h"
#include "nonet/protocol/percept.h"
#include "nonet/team/action.h"
#include "nonet/world/parameters.h"
#include "nonet/world/world_state.h"

namespace nonet::agent {

struct RobotSettings {
  int robotType = 0;  // 0..4
  std::string team = "Nonet";
  std::uint64_t seed = 1;
  world::WorldParameters world;
  motion::MotionParameters motion;
  std::string skillFolder;  // folder of the *.skl files
};

class Robot {
 public:
  /// Errors in skill files name file, line and column.
  explicit Robot(const RobotSettings& settings);
  ~Robot();

  /// Absorbs one message. What the motion did in the last cycle goes in with it. The reference stays valid
  /// until the next call.
  const world::WorldState& sense(const protocol::Percept& percept);

  /// Adds to `effectors` all that the action asks for: joint speeds, beam, say.
  void act(const team::Action& action, protocol::Effectors& effectors);
  /// The same with these joint targets instead of motion's.
  void follow(const motion::JointTargets& targets, protocol::Effectors& effectors);

  /// What it believes; nothing is known before the first message.
  const world::WorldState& world() const;
  /// Where it holds itself possible (own field frame), for drawings.
  std::vector<Pose2> particles() const;
  /// motion().state() is what the body is doing: it goes in at the front of the next decision.
  const motion::Motion& motion() const;
  const model::RobotModel& model() const;

 private:
  struct Stages;
  std::unique_ptr<Stages> stages_;
};

}  // namespace nonet::agent
