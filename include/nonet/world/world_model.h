// The world stage: Percept -> WorldState. Needs the robot model and the parameters; gives one plain value.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "nonet/math/pose2.h"
#include "nonet/model/robot_model.h"
#include "nonet/protocol/percept.h"
#include "nonet/world/parameters.h"
#include "nonet/world/world_state.h"

namespace nonet::world {

class WorldModel {
 public:
  WorldModel(const model::RobotModel& model, const WorldParameters& parameters,
             const protocol::TeamName& team, std::uint64_t seed);
  ~WorldModel();

  /// Absorbs one message. `beam`: where the robot asked to be beamed in its last answer (own field frame).
  /// The reference stays valid until the next call.
  const WorldState& update(const protocol::Percept& percept, const std::optional<Pose2>& beam = {});

  const WorldState& state() const;

  /// Where the particle filter holds the robot possible (own field frame), for drawings.
  std::vector<Pose2> particles() const;

 private:
  struct Stages;
  std::unique_ptr<Stages> stages_;
};

}  // namespace nonet::world
