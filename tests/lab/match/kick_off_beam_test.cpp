// A whole agent that lies on the ground when a goal falls: the beam to its place is the fastest way up, and
// at the kick-off, three seconds later, it must stand there.
#include <string>

#include <gtest/gtest.h>

#include "nonet/agent/agent.h"
#include "nonet/agent/agent_setup.h"
#include "nonet/sim/simulation.h"

namespace nonet::lab {
namespace {

class OneOnTheField {
 public:
  explicit OneOnTheField(std::uint64_t seed) : simulation_(sim::Settings{}, seed), agent_(settings(seed)) {
    handle_ = simulation_.connect();
    simulation_.act(handle_, agent_.hello());
    for (int i = 0; i < 100; ++i) cycle();
  }

  void cycle() {
    simulation_.step();
    const protocol::Percept* percept = simulation_.sense(handle_);
    if (percept != nullptr) simulation_.act(handle_, agent_.step(*percept));
  }
  double up() const { return simulation_.world().bodyPose(robot(), model::BodyId::Torso).rotation(2, 2); }
  Vector2 place() const {
    const sim::Vector3f p = simulation_.world().bodyPosition(robot(), model::BodyId::Torso);
    return {p.x(), p.y()};
  }
  void command(const std::string& text) { simulation_.trainer(text); }

 private:
  static agent::AgentSettings settings(std::uint64_t seed) {
    agent::AgentChoice choice;
    choice.unum = 5;
    choice.team = "Us";
    choice.robotType = agent::usualRobotType(5);
    choice.seed = seed;
    return agent::makeAgentSettings(choice, NONET_SOURCE_DIR);
  }
  sim::RobotHandle robot() const { return simulation_.agents()[0].robot; }

  sim::Simulation simulation_;
  agent::Agent agent_;
  sim::AgentHandle handle_{};
};

TEST(KickOffBeam, WhoLayWhenAGoalFellStandsAtTheKickOff) {
  int fell = 0;
  int stands = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    OneOnTheField field(seed);
    field.command("(playMode PlayOn)");
    field.command("(agent (team Left)(unum 5)(pos -4 1 1.3))");
    int cycles = 0;
    while (field.up() > 0.3 && ++cycles < 200) field.cycle();
    if (cycles == 200) continue;
    ++fell;
    // Some lie, some are about to rise, some are half way up.
    for (std::uint64_t i = 0; i < 10 * (seed % 6); ++i) field.cycle();
    const Vector2 before = field.place();
    field.command("(playMode Goal_Left)");
    for (int i = 0; i < 155; ++i) field.cycle();
    stands += field.up() > 0.9 && (field.place() - before).norm() > 0.3 ? 1 : 0;
  }
  RecordProperty("stands", stands);
  EXPECT_GE(fell, 8);
  EXPECT_GE(stands, fell - 1);
}

}  // namespace
}  // namespace nonet::lab
