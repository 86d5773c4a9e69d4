// What agents may send and how the simulation takes it: types, names, words, numbers (server facts 1.3, 1.7).
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/scenario.h"

namespace nonet::sim::test {
namespace {

protocol::Effectors effectorsOf(std::string_view text) {
  protocol::Effectors effectors;
  protocol::parseEffectors(text, effectors);
  return effectors;
}

// As the lobby lets a player in.
AgentInfo enterAs(Scenario& s, std::string_view scene, int unum, std::string_view team) {
  protocol::InitEffector init;
  init.unum = unum;
  init.team.assign(team);
  const AgentHandle agent = s.sim.enter(*effectorsOf(scene).scene, init);
  s.step();
  return s.info(agent);
}

TEST(RobotTypes, NaoIsTypeZeroWhateverFollows) {
  EXPECT_EQ(typeOf(*effectorsOf("(scene rsg/agent/nao/nao.rsg 100000000)").scene), 0);
  EXPECT_EQ(typeOf(*effectorsOf("(scene rsg/agent/nao/nao.rsg 3)").scene), 0);
  EXPECT_EQ(typeOf(*effectorsOf("(scene rsg/agent/nao/nao_hetero.rsg 4)").scene), 4);
  EXPECT_FALSE(typeOf(*effectorsOf("(scene rsg/agent/nao/nao_hetero.rsg 5)").scene));
  EXPECT_FALSE(typeOf(*effectorsOf("(scene rsg/agent/nao/nao_hetero.rsg -1)").scene));
  EXPECT_FALSE(typeOf(*effectorsOf("(scene rsg/agent/other.rsg 1)").scene));
}

TEST(RobotTypes, WhoEntersWithAWildTypeHarmsNobody) {
  Scenario s;
  EXPECT_EQ(enterAs(s, "(scene rsg/agent/nao/nao.rsg 100000000)", 1, "A").unum, 1);
  for (const char* wild : {"(scene rsg/agent/nao/nao_hetero.rsg 100000000)",
                           "(scene rsg/agent/nao/nao_hetero.rsg -7)", "(scene rsg/agent/other.rsg 1)"}) {
    const AgentInfo info = enterAs(s, wild, 2, "B");
    EXPECT_EQ(info.robot, kNoRobot) << wild;
    EXPECT_EQ(info.unum, 0) << wild;
  }
  EXPECT_TRUE(s.sim.match().teamRight.empty()) << "the name of who was refused takes no side";
}

// Server facts 1.4: seven robots of one type are the most.
TEST(RobotTypes, NaoCountsAsTypeZeroWhateverFollows) {
  Scenario s;
  for (int unum = 1; unum <= 7; ++unum) {
    const std::string scene = fmt::format("(scene rsg/agent/nao/nao.rsg {})", unum % 5);
    EXPECT_EQ(enterAs(s, scene, unum, "A").unum, unum);
  }
  EXPECT_EQ(enterAs(s, "(scene rsg/agent/nao/nao.rsg 3)", 8, "A").unum, 0);
}

TEST(RobotTypes, TheRefereeRefusesWhatItHasNoPlaceFor) {
  const Settings settings = quietSettings();
  GameState game(settings);
  for (const int type : {-1, 5, 100000000}) {
    TeamSide side = TeamSide::None;
    int unum = 0;
    EXPECT_EQ(game.registerPlayer("A", type, side, unum, settings), GameState::Refusal::TypeRule) << type;
    EXPECT_EQ(side, TeamSide::None);
  }
}

// The name stands as it is in what everybody hears and monitors see.
TEST(TeamNames, ThatWouldBreakMessagesAreRefused) {
  Scenario s;
  for (const char* name : {"A B", "A(B", "A)", "A\"B", "A'B", "A\nB", "\x7f"}) {
    const AgentInfo info = enterAs(s, "(scene rsg/agent/nao/nao.rsg)", 1, name);
    EXPECT_EQ(info.unum, 0) << name;
    s.sim.disconnect(info.handle);  // all who are refused fall from the same place
    s.step();
  }
  EXPECT_TRUE(s.sim.match().teamLeft.empty());
  EXPECT_EQ(enterAs(s, "(scene rsg/agent/nao/nao.rsg)", 1, "A-B_c!").side, TeamSide::Left);
}

// Server facts 1.7: others hear the first of a cycle, who speaks hears the last.
TEST(Hear, SeveralInOneMessageAreAsInSeveralMessages) {
  const std::vector<std::vector<const char*>> framings = {
      {"(say a)(say b)(say c)"}, {"(say a)", "(say b)", "(say c)"}, {"(say a)(say b)", "(say c)"}};
  for (const auto& framing : framings) {
    Scenario s;
    const AgentHandle speaker = s.add(TeamSide::Left, 1);
    const AgentHandle mate = s.add(TeamSide::Left, 2);
    const AgentHandle opponent = s.add(TeamSide::Right, 1);
    s.step(3);
    for (const char* message : framing) s.sim.actAsReceived(speaker, effectorsOf(message));
    s.step(2);
    const auto heard = [&](AgentHandle agent) {
      const auto& all = s.sim.sense(agent)->heard;
      return all.size() == 1 ? std::string(all[0].message.view()) : std::to_string(all.size());
    };
    EXPECT_EQ(heard(speaker), "c") << framing.size();
    EXPECT_EQ(heard(mate), "a") << framing.size();
    EXPECT_EQ(heard(opponent), "a") << framing.size();
  }
}

// The referee's records go by number: under a new one it would never release what it has frozen.
TEST(NewNumber, ReleasesFrozenJoints) {
  for (const bool paused : {false, true}) {
    Field f;
    const AgentHandle player = f.add(TeamSide::Left, 2);
    f.play();
    f.sim.world().freezeJoint(f.info(player).robot, model::JointId::Head1, true);
    if (paused) f.setMode(PlayMode::GoalLeft);
    f.sim.actAsReceived(player, effectorsOf("(init (unum 3)(teamname L))"));
    f.step();
    ASSERT_EQ(f.info(player).unum, 3);
    EXPECT_FALSE(f.sim.world().isFrozen(f.info(player).robot, model::JointId::Head1)) << paused;
  }
}

TEST(Pause, ReleasesEveryFrozenJoint) {
  Field f;
  const AgentHandle player = f.add(TeamSide::Left, 2);
  f.play();
  f.sim.world().freezeJoint(f.info(player).robot, model::JointId::Head1, true);
  f.step();
  ASSERT_TRUE(f.sim.world().isFrozen(f.info(player).robot, model::JointId::Head1));
  f.setMode(PlayMode::GoalLeft);
  f.step();
  EXPECT_FALSE(f.sim.world().isFrozen(f.info(player).robot, model::JointId::Head1));
}

// Monitors know a scene by its version: none that they have seen may come again with other robots.
TEST(State, RestoringGivesTheSceneAVersionOfItsOwn) {
  Scenario s;
  s.add(TeamSide::Left, 1);
  const std::vector<std::uint8_t> state = s.sim.save();
  for (int i = 0; i < 3; ++i) {
    const std::uint64_t saved = s.sim.sceneVersion();
    s.sim.trainer("(reqfullstate)");
    const std::uint64_t seen = s.sim.sceneVersion();
    EXPECT_GT(seen, saved);
    s.sim.restore(state);
    EXPECT_GT(s.sim.sceneVersion(), seen);
  }
}

}  // namespace
}  // namespace nonet::sim::test
