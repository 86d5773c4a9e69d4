#include "nonet/world/world_model.h"

#include "nonet/world/body_tracker.h"
#include "nonet/world/game_tracker.h"

namespace nonet::world {

struct WorldModel::Stages {
  Stages(const model::RobotModel& model, const WorldParameters& parameters, const protocol::TeamName& team)
      : body(model, parameters), game(team) {}

  BodyTracker body;
  GameTracker game;
  WorldState state;
};

namespace {

/// Rotation from the torso's axes to level axes with the torso's heading.
Matrix3 levelRotation(const BodyState& body) {
  return Eigen::AngleAxisd(-body.yaw, Vector3::UnitZ()).toRotationMatrix() * body.R_GR;
}

void followBall(const protocol::Percept& percept, const BodyState& body, BallState& ball) {
  const Pose2 back = body.odometryStep.inverse();
  ball.p_RB = back * ball.p_RB;
  if (percept.vision && percept.vision->ball) {
    const Vector3 p_RB = model::cameraPose(body.bodies) * percept.vision->ball->cartesian();
    ball.p_RB = (levelRotation(body) * p_RB).head<2>();
    ball.lastSeen = percept.time;
  }
  ball.known = percept.time - ball.lastSeen < 3.0;
}

}  // namespace

WorldModel::WorldModel(const model::RobotModel& model, const WorldParameters& parameters,
                       const protocol::TeamName& team, std::uint64_t /*seed*/)
    : stages_(std::make_unique<Stages>(model, parameters, team)) {}

WorldModel::~WorldModel() = default;

const WorldState& WorldModel::update(const protocol::Percept& percept) {
  WorldState& state = stages_->state;
  if (!stages_->body.update(percept, state.body)) return state;
  state.time = percept.time;
  stages_->game.update(percept, state.game);
  followBall(percept, state.body, state.ball);
  state.self.X_FR = state.body.odometry;
  state.self.height = state.body.torsoHeight;
  return state;
}

void WorldModel::expectBeam(const Pose2& /*X_FR*/) {}

}  // namespace nonet::world
