#include "nonet/sim/fidelity/fidelity.h"

#include <cmath>

#include <fmt/format.h>

#include "nonet/protocol/rounding.h"

#include "sim/fidelity/replay_server.h"
#include "sim/sensors/on_wire.h"

namespace nonet::sim {

namespace {

constexpr double kHistoryTolerance = 1e-3;  // m: how well a known history must meet the first cycle

double largest(const Eigen::Vector3d& v) {
  return v.cwiseAbs().maxCoeff();
}

void raise(double& worst, double value) {
  if (!(value <= worst)) worst = value;  // a NaN counts as worse than everything
}

void compareFeet(const World& world, RobotHandle robot, const RecordedRobot& truth, CycleError& error) {
  for (const model::BodyId foot :
       {model::BodyId::RFoot, model::BodyId::LFoot, model::BodyId::RToe, model::BodyId::LToe}) {
    const auto ours = world.footContact(robot, foot);
    const auto theirs = truth.feet.find(foot);
    const bool recorded = theirs != truth.feet.end();
    if (ours.has_value() != recorded) {
      ++error.footContacts;
    } else if (recorded) {
      raise(error.footForce, largest(onWire(ours->force) - theirs->second.force));
      raise(error.footCenter, largest(onWire(ours->center) - theirs->second.center));
    }
  }
}

void compareRobot(const World& world, RobotHandle robot, const RecordedRobot& truth, CycleError& error) {
  for (const auto& [body, part] : truth.parts) {
    const Eigen::Vector3d ours = world.bodyPose(robot, body).position.cast<double>();
    raise(error.bodies, (ours - part.position).norm());
  }
  for (const auto& [joint, angle] : truth.joints) {
    raise(error.joints, std::abs(protocol::roundToWire(world.jointAngleDegrees(robot, joint)) - angle));
  }
  if (truth.gyro) {
    raise(error.gyro, largest(onWire(inDegrees(world.gyro(robot))) - *truth.gyro));
  }
  if (truth.accelerometer) {
    raise(error.accelerometer, largest(onWire(world.accelerometer(robot)) - *truth.accelerometer));
  }
  compareFeet(world, robot, truth, error);
}

CycleError compare(ReplayServer& server, const RecordedCycle& truth) {
  CycleError error;
  for (std::size_t i = 0; i < truth.robots.size(); ++i) {
    compareRobot(server.world(), server.robot(i), truth.robots[i], error);
  }
  error.ball = (server.world().ballPose().position.cast<double>() - truth.ball).norm();
  return error;
}

ReplayServer::Answer answerOf(const RecordedCycle& cycle) {
  ReplayServer::Answer answer;
  for (const RecordedRobot& robot : cycle.robots) answer.speeds.push_back(robot.speeds);
  answer.trainer = cycle.trainer;
  answer.extra = cycle.extra;
  return answer;
}

/// World-frame angular velocity that turns `from` into `to` within one cycle.
Eigen::Vector3d angularVelocity(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to) {
  const Eigen::AngleAxisd turn{Eigen::Quaterniond(to * from.transpose()).normalized()};
  return turn.axis() * (turn.angle() / kCycleTime);
}

/// Without a known history: every body as recorded in the second cycle, with the velocity that brought it
/// there.
void startFromRecording(const Recording& recording, ReplayServer& server) {
  const RecordedCycle& before = recording.cycles[0];
  const RecordedCycle& now = recording.cycles[1];
  World& world = server.world();
  for (std::size_t i = 0; i < now.robots.size(); ++i) {
    bool still = true;
    for (const auto& [body, part] : now.robots[i].parts) {
      const auto last = before.robots[i].parts.find(body);
      if (last == before.robots[i].parts.end() || !part.rotation || !last->second.rotation) continue;
      World::BodyState state;
      state.position = part.position;
      state.orientation = Eigen::Quaterniond(*part.rotation).normalized();
      state.velocity = (part.position - last->second.position) / kCycleTime;
      state.angularVelocity = angularVelocity(*last->second.rotation, *part.rotation);
      still = still && state.velocity.norm() == 0.0 && state.angularVelocity.norm() < 1e-9;
      world.setBodyState(server.robot(i), body, state);
    }
    for (const auto& [joint, angle] : now.robots[i].joints) {
      const auto last = before.robots[i].joints.find(joint);
      if (last == before.robots[i].joints.end()) continue;
      const double rate = (angle - last->second) * M_PI / 180.0 / kCycleTime;
      world.setJointSpeed(server.robot(i), joint, static_cast<float>(rate));
    }
    if (still) world.setAsleep(server.robot(i), true);
  }
  World::BodyState ball;
  ball.position = now.ball;
  ball.velocity = (now.ball - before.ball) / kCycleTime;
  world.setBallState(ball);
  if (now.playMode == "BeforeKickOff") server.ballToCentre();
  server.setPending(answerOf(before));
}

bool isGoal(const std::string& mode) {
  return mode == "Goal_Left" || mode == "Goal_Right";
}
bool isKickOff(const std::string& mode) {
  return mode == "KickOff_Left" || mode == "KickOff_Right";
}

void add(FidelityResult& result, const CycleError& error) {
  const double time = static_cast<double>(result.cycles.size()) * kCycleTime;
  for (std::size_t i = 0; i < kFidelityLimits.size(); ++i) {
    if (!result.firstOver[i] && !(error.position() <= kFidelityLimits[i])) result.firstOver[i] = time;
  }
  CycleError& worst = result.worst;
  raise(worst.bodies, error.bodies);
  raise(worst.ball, error.ball);
  raise(worst.joints, error.joints);
  raise(worst.gyro, error.gyro);
  raise(worst.accelerometer, error.accelerometer);
  raise(worst.footForce, error.footForce);
  raise(worst.footCenter, error.footCenter);
  worst.footContacts += error.footContacts;
  result.cycles.push_back(error);
}

/// Compares and steps from cycle `first` on; the server's state is that of this cycle.
void replayFrom(std::size_t first, const Recording& recording, ReplayServer& server, FidelityResult& result) {
  for (std::size_t k = first; k < recording.cycles.size(); ++k) {
    const RecordedCycle& cycle = recording.cycles[k];
    add(result, compare(server, cycle));
    if (k + 1 == recording.cycles.size()) break;
    const RecordedCycle& next = recording.cycles[k + 1];
    server.holdBall(next.playMode == "BeforeKickOff");
    server.step(answerOf(cycle));
    // After a goal the referee puts the ball into the middle when it orders the kick-off (server facts 4.7).
    if (isGoal(cycle.playMode) && isKickOff(next.playMode)) server.ballToCentre();
  }
}

}  // namespace

double FidelityResult::worstPositionBefore(double seconds) const {
  double error = 0.0;
  for (std::size_t i = 0; i < cycles.size() && static_cast<double>(i) * kCycleTime < seconds; ++i) {
    raise(error, cycles[i].position());
  }
  return error;
}

FidelityResult replay(const Recording& recording, const WorldSettings& settings) {
  FidelityResult result;
  result.scenario = recording.scenario;
  const RecordedCycle& start = recording.cycles[0];
  const int robots = static_cast<int>(start.robots.size());
  // First what is known of the experiment by its name, then the usual start of standing somewhere at rest.
  for (const bool byName : {true, false}) {
    ReplayServer server(settings, recording.robotType, robots);
    const bool tried = byName ? replayHistory(recording.scenario, server) : replayStanding(start, server);
    if (!tried || compare(server, start).position() > kHistoryTolerance) continue;
    result.knownHistory = true;
    replayFrom(0, recording, server, result);
    return result;
  }
  ReplayServer unknown(settings, recording.robotType, robots);
  unknown.addRobots();
  startFromRecording(recording, unknown);
  add(result, CycleError{});
  replayFrom(1, recording, unknown, result);
  return result;
}

}  // namespace nonet::sim
