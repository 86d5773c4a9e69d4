// An agent that shows a skill: on the embedded simulation, and after the header of its log.
#include "nonet/agent/skill_show.h"

#include <cstdio>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/math/angle.h"
#include "nonet/motion/skill_language.h"
#include "nonet/sim/simulation.h"

namespace nonet::agent {
namespace {

class Show : public testing::Test {
 protected:
  Show() {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "lift.skl")
        << "skill lift { move over 0.4s { right.shoulderPitch 50deg } wait 0.4s }\n";
  }
  ~Show() override { std::filesystem::remove_all(folder_); }

  AgentSettings agentSettings() const {
    AgentChoice choice;
    choice.unum = 3;
    AgentSettings shown = makeAgentSettings(choice, NONET_SOURCE_DIR);
    shown.skillFolder = folder_.string();
    shown.parameters.motion.skills = {};
    shown.skill = motion::PlaySkill{std::string_view("lift"), model::Side::Right};
    return shown;
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("nonet_show_" + std::to_string(::getpid()));
};

// Mirrored it is the left arm; between two shows the arm is back in the stand.
TEST_F(Show, PlaysTheSkillAgainAndAgain) {
  sim::Settings settings;
  settings.leftTeam = "Nonet";
  sim::Simulation simulation(settings, 1);
  Agent agent(agentSettings());
  protocol::InitEffector init;
  init.unum = 3;
  init.team.assign("Nonet");
  const sim::AgentHandle handle = simulation.enter(*agent.hello().scene, init);
  int shows = 0;
  bool up = false;
  for (int i = 0; i < 600; ++i) {
    if (const protocol::Percept* percept = simulation.sense(handle)) {
      protocol::Effectors answer = agent.step(*percept);
      answer.init.reset();
      simulation.act(handle, answer);
    }
    simulation.step();
    const double angle =
        toDegrees(simulation.world().jointAngle(simulation.agents().front().robot, model::JointId::LArm1));
    if (!up && std::abs(angle - 50.0) < 1.0) ++shows;
    up = std::abs(angle - 50.0) < 1.0 || (up && angle > -45.0);
  }
  EXPECT_GE(shows, 2);
  EXPECT_LE(shows, 4);  // 12 s: 0.8 s of skill and 2 s of pause, at least
}

TEST_F(Show, StandsFirst) {
  SkillShow show(motion::PlaySkill{std::string_view("lift"), model::Side::Left});
  world::WorldState world;
  world.body.cycleTime = 0.02;
  motion::MotionState motion;
  int cycles = 0;
  while (!std::holds_alternative<motion::PlaySkill>(show.update(world, motion)) && cycles < 1000) ++cycles;
  EXPECT_NEAR(cycles * 0.02, SkillShow::kPause, 0.03);
  motion.rising = true;
  EXPECT_TRUE(std::holds_alternative<motion::Stand>(show.update(world, motion)));
}

TEST(ShownSkill, StandsInTheHeaderOfTheLog) {
  AgentChoice choice;
  choice.skill = "kick_power";
  choice.mirrorSkill = true;
  const AgentSettings agentSettings = makeAgentSettings(choice, NONET_SOURCE_DIR);
  ASSERT_TRUE(agentSettings.skill);
  EXPECT_EQ(agentFromLog(logHeader(agentSettings, "test"), NONET_SOURCE_DIR, "log").skill,
            agentSettings.skill);
  choice.skill = "nosuch";
  EXPECT_THROW(makeAgentSettings(choice, NONET_SOURCE_DIR), motion::SkillError);
}

}  // namespace
}  // namespace nonet::agent
