#include "sim/fidelity/replay_server.h"

#include <array>
#include <cstdio>

#include "nonet/model/ball.h"
#include "nonet/protocol/rounding.h"

namespace nonet::sim {

namespace {

const Vector3f kCentre{0.0F, 0.0F, static_cast<float>(model::kBallRadius)};

/// The numbers of the first list "(name ...)" in `text`; empty if there is none.
std::vector<float> numbersOf(std::string_view text, std::string_view name) {
  const std::string key = "(" + std::string(name) + " ";
  const auto at = text.find(key);
  std::vector<float> numbers;
  if (at == std::string_view::npos) return numbers;
  const std::string rest(text.substr(at + key.size()));
  const char* cursor = rest.c_str();
  float value = 0.0F;
  int used = 0;
  while (std::sscanf(cursor, "%f%n", &value, &used) == 1) {
    numbers.push_back(value);
    cursor += used;
  }
  return numbers;
}

Vector3f firstThree(const std::vector<float>& numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace

ReplayServer::ReplayServer(const WorldSettings& settings, int robotType, int robotCount)
    : world_(settings), robotType_(robotType), robotTotal_(robotCount) {}

void ReplayServer::ballToCentre() {
  world_.setBallPosition(kCentre);
  world_.setBallVelocity(Vector3f::Zero());
}

void ReplayServer::trainer(std::string_view command) {
  if (command.find("(playMode BeforeKickOff)") != std::string_view::npos) ballHeld_ = true;
  if (command.find("(playMode PlayOn)") != std::string_view::npos) ballHeld_ = false;
  const auto ball = command.find("(ball");
  const std::string_view agent = command.substr(0, ball);
  if (agent.find("(agent") != std::string_view::npos) {
    const bool right = agent.find("(team Right)") != std::string_view::npos;
    const RobotHandle robot = robots_.at(right ? 1 : 0);
    if (const auto move = numbersOf(agent, "move"); move.size() >= 4) {
      world_.placeRobot(robot, firstThree(move), move[3]);
    } else if (const auto pos = numbersOf(agent, "pos"); pos.size() >= 3) {
      world_.moveRobot(robot, firstThree(pos));
    }
  }
  if (ball == std::string_view::npos) return;
  const std::string_view rest = command.substr(ball);
  if (const auto pos = numbersOf(rest, "pos"); pos.size() >= 3) world_.setBallPosition(firstThree(pos));
  if (const auto vel = numbersOf(rest, "vel"); vel.size() >= 3) world_.setBallVelocity(firstThree(vel));
}

// The first robot plays for the left team: angle 0 looks along +x (server facts 4.6). No noise in recordings.
void ReplayServer::deferBeam(std::string_view effectors) {
  const auto beam = numbersOf(effectors, "beam");
  if (beam.size() < 3) return;
  world_.deferPlacement(robots_.at(0), World::DeferredBy::Beam, {beam[0], beam[1], 0.4F}, beam[2] - 90.0F);
}

void ReplayServer::cycle(const Answer& answer) {
  for (std::size_t i = 0; i < answer.speeds.size() && i < robots_.size(); ++i) {
    for (const auto& [joint, speed] : answer.speeds[i]) world_.setJointSpeed(robots_[i], joint, speed);
  }
  trainer(answer.trainer);
  deferBeam(answer.extra);
  world_.prePhysics();
  if (newRobot_) robots_.push_back(world_.addRobot(robotType_));
  newRobot_ = false;
  world_.stepPhysics();
  if (ballHeld_) ballToCentre();
}

void ReplayServer::step(const Answer& answer) {
  cycle(pending_);
  pending_ = answer;
}

void ReplayServer::plainCycles(int count) {
  for (int i = 0; i < count; ++i) cycle({});
}

void ReplayServer::birth() {
  newRobot_ = true;
  plainCycles(1);
}

void ReplayServer::addRobots() {
  for (int i = 0; i < robotTotal_; ++i) robots_.push_back(world_.addRobot(robotType_));
}

// The cycle counts are those seen in the real server with the agents that made the recordings: init acts in
// the third cycle of the first robot (the eighth of a second one, while the agents get in step); with two
// robots each is then beamed away in three cycles; PlayOn follows.
void ReplayServer::connectRobots() {
  constexpr int kBallSettles = 200;  // cycles in which the server runs alone
  plainCycles(kBallSettles);
  ballToCentre();
  ballHeld_ = true;
  for (int i = 0; i < robotTotal_; ++i) {
    birth();
    plainCycles(i == 0 ? 2 : 6);
    const float side = i == 0 ? -1.0F : 1.0F;
    const RobotHandle robot = robots_.back();
    world_.deferPlacement(robot, World::DeferredBy::Init, {side * 14.2F, 9.2F, 0.4F}, side * 90.0F);
    plainCycles(1);
    if (robotTotal_ == 1) break;
    for (int k = 0; k < 3; ++k) {
      const Vector3f place(i == 0 ? -2.0F : 3.0F, -6.0F, 0.4F);
      world_.deferPlacement(robot, World::DeferredBy::Beam, place, side * 90.0F);
      plainCycles(1);
    }
    if (i + 1 < robotTotal_) plainCycles(1);
  }
  plainCycles(8);
  ballHeld_ = false;
  plainCycles(5);
}

double ReplayServer::printedAngle(std::size_t robot, model::JointId joint) const {
  return protocol::roundToWire(world_.jointAngleDegrees(robots_[robot], joint));
}

}  // namespace nonet::sim
