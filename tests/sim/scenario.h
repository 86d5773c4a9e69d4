// A small match for tests of the rules: robots of both teams, placed by the trainer's commands, without
// noise.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "nonet/sim/referee/game_state.h"
#include "nonet/sim/simulation.h"

namespace nonet::sim::test {

using protocol::PlayMode;
using protocol::TeamSide;

inline Settings quietSettings() {
  Settings settings;
  settings.removeNoise();
  return settings;
}

inline Settings shortHalves(double seconds) {
  Settings settings = quietSettings();
  settings.ruleHalfTime = seconds;
  return settings;
}

/// The mode of this side, of two that follow each other: left's, right's.
constexpr PlayMode forSide(TeamSide side, PlayMode left) {
  return side == TeamSide::Left ? left : static_cast<PlayMode>(static_cast<int>(left) + 1);
}

class Scenario {
 public:
  explicit Scenario(const Settings& settings = quietSettings(), std::uint64_t seed = 1)
      : sim(settings, seed) {}

  /// A player who has entered; the left team is called L, the right one R.
  AgentHandle add(TeamSide side, int unum, int type = 0) {
    // The first name that is used becomes the left team.
    if (side == TeamSide::Right && sim.match().teamLeft.empty()) add(TeamSide::Left, 11, 0);
    protocol::SceneEffector scene;
    scene.robotType = type;
    protocol::InitEffector init;
    init.unum = unum;
    init.team.assign(side == TeamSide::Left ? "L" : "R");
    const AgentHandle agent = sim.enter(scene, init);
    sim.step();
    return agent;
  }

  AgentInfo info(AgentHandle agent) const {
    for (const AgentInfo& info : sim.agents()) {
      if (info.handle == agent) return info;
    }
    return {};
  }
  AgentHandle player(TeamSide side, int unum) const {
    for (const AgentInfo& info : sim.agents()) {
      if (info.side == side && info.unum == unum) return info.handle;
    }
    return kNoAgent;
  }
  Vector3f torso(AgentHandle agent) const {
    return sim.world().bodyPosition(info(agent).robot, model::BodyId::Torso);
  }
  Vector3f ball() const { return sim.world().ballPosition(); }
  PlayMode mode() const { return sim.match().playMode; }

  void command(const std::string& message) { sim.trainer(message); }
  void setMode(PlayMode mode) { command(fmt::format("(playMode {})", protocol::playModeName(mode))); }
  void placeBall(double x, double y, double z = 0.042, double vx = 0.0, double vy = 0.0, double vz = 0.0) {
    command(fmt::format("(ball (pos {} {} {})(vel {} {} {}))", x, y, z, vx, vy, vz));
  }
  /// Upright, facing `yaw` degrees (0 along +x).
  void place(AgentHandle agent, double x, double y, double yaw = 0.0, double z = 0.385) {
    const AgentInfo who = info(agent);
    command(fmt::format("(agent (team {})(unum {})(move {} {} {} {}))",
                        who.side == TeamSide::Left ? "Left" : "Right", who.unum, x, y, z, yaw - 90.0));
  }
  /// Lays the robot on the ground: its torso is put where that of a fallen robot is.
  void sink(AgentHandle agent, double z) {
    const Vector3f at = torso(agent);
    const AgentInfo who = info(agent);
    command(fmt::format("(agent (team {})(unum {})(pos {} {} {}))",
                        who.side == TeamSide::Left ? "Left" : "Right", who.unum, at.x(), at.y(), z));
  }
  /// Puts the ball into the robot's right shank, so that they touch in the next cycle.
  void touch(AgentHandle agent) {
    const Vector3f shank = sim.world().bodyPosition(info(agent).robot, model::BodyId::RShank);
    placeBall(shank.x(), shank.y(), shank.z());
  }

  void step(int cycles = 1) {
    for (int i = 0; i < cycles; ++i) sim.step();
  }
  void seconds(double time) { step(static_cast<int>(std::lround(time / 0.02))); }
  /// Steps until the mode is `wanted`; false after `limit` seconds.
  bool waitFor(PlayMode wanted, double limit) {
    for (int i = 0; i < limit / 0.02; ++i) {
      if (mode() == wanted) return true;
      sim.step();
    }
    return mode() == wanted;
  }
  int countFouls(FoulType type) const {
    int count = 0;
    for (const FoulRecord& foul : sim.fouls()) count += foul.type == static_cast<int>(type) ? 1 : 0;
    return count;
  }

  Simulation sim;
};

/// PlayOn with two players of each team, away from everything: left 2 and 3, right 2 and 3.
struct Match : Scenario {
  explicit Match(const Settings& settings = quietSettings()) : Scenario(settings) {
    left2 = add(TeamSide::Left, 2);
    left3 = add(TeamSide::Left, 3);
    right2 = add(TeamSide::Right, 2);
    right3 = add(TeamSide::Right, 3);
    setMode(PlayMode::PlayOn);
    place(left2, -8.0, 5.0);
    place(left3, -8.0, -5.0);
    place(right2, 8.0, 5.0, 180.0);
    place(right3, 8.0, -5.0, 180.0);
    placeBall(0.0, 0.0);
    step(2);
  }
  AgentHandle second(TeamSide side) const { return side == TeamSide::Left ? left2 : right2; }
  /// `by` touches the ball and it lies at (x, y) afterwards.
  void ballFrom(AgentHandle by, double x, double y) {
    touch(by);
    step();
    placeBall(x, y);
    step();
  }

  AgentHandle left2, left3, right2, right3;
};

/// PlayOn with players of the test's choice, the ball far from everybody.
struct Field : Scenario {
  explicit Field(const Settings& settings = quietSettings()) : Scenario(settings) {}
  void play(double ballX = 0.0, double ballY = 8.0) {
    setMode(PlayMode::PlayOn);
    placeBall(ballX, ballY);
    step(2);
  }
  /// Holds a robot with its torso at this height, as if it lay or knelt there.
  void holdAt(AgentHandle agent, double z, double time) {
    const Vector3f at = torso(agent);
    for (int i = 0; i < time / 0.02; ++i) {
      if (torso(agent).z() > 0.9F) return;  // the referee has taken it
      moveTo(agent, at.x(), at.y(), z);
      step();
    }
  }
  void moveTo(AgentHandle agent, double x, double y, double z) {
    const AgentInfo who = info(agent);
    command(fmt::format("(agent (team {})(unum {})(pos {} {} {}))",
                        who.side == TeamSide::Left ? "Left" : "Right", who.unum, x, y, z));
  }
};

}  // namespace nonet::sim::test
