// The monitor stream, read back by a reader that knows only server facts 5.1 to 5.3, against the simulation.
#include "nonet/sim/server/monitor.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "nonet/math/random.h"

#include "sim/scenario.h"

namespace nonet::sim::test {
namespace {

struct Node {
  std::vector<std::string> atoms;
  std::vector<Node> lists;

  const Node* find(const std::string& name) const {
    for (const Node& list : lists) {
      if (!list.atoms.empty() && list.atoms[0] == name) return &list;
    }
    return nullptr;
  }
};

// All top-level lists of a message. Strict: brackets must balance.
std::vector<Node> parse(const std::string& text) {
  std::vector<Node> stack(1);
  std::string atom;
  const auto endAtom = [&] {
    if (!atom.empty()) stack.back().atoms.push_back(std::move(atom));
    atom.clear();
  };
  for (const char c : text) {
    if (c == '(') {
      endAtom();
      stack.emplace_back();
    } else if (c == ')') {
      endAtom();
      if (stack.size() < 2) throw std::runtime_error("too many closing brackets");
      Node done = std::move(stack.back());
      stack.pop_back();
      stack.back().lists.push_back(std::move(done));
    } else if (c == ' ') {
      endAtom();
    } else {
      atom += c;
    }
  }
  if (stack.size() != 1) throw std::runtime_error("brackets do not balance");
  return stack[0].lists;
}

using Matrix = std::array<double, 16>;

// Follows a stream as RoboViz does: a full message builds the tree, a difference is matched by position.
class Viewer {
 public:
  struct Part {
    std::optional<Matrix> matrix;
    std::string file;
    std::vector<std::string> materials;
    std::vector<Part> children;
  };

  void feed(const std::string& text) {
    const auto lists = parse(text);
    ASSERT_EQ(lists.size(), 3U);
    for (const Node& predicate : lists[0].lists) environment[predicate.atoms.at(0)] = predicate.atoms;
    ASSERT_EQ(lists[1].atoms.size(), 3U);
    full = lists[1].atoms[0] == "RSG";
    if (full) {
      scene.clear();
      for (const Node& node : lists[2].lists) scene.push_back(build(node));
    } else {
      ASSERT_EQ(lists[1].atoms[0], "RDS");
      ASSERT_EQ(lists[2].lists.size(), scene.size())
          << "the tree of a difference is that of the last full message";
      for (std::size_t i = 0; i < scene.size(); ++i) update(scene[i], lists[2].lists[i]);
    }
  }

  // The top-level node of a robot is found by its first mesh with matNum<n> and the team's material.
  const Part* robot(const std::string& number, const std::string& team) const {
    for (const Part& part : scene) {
      if (hasMesh(part, "naobody", {number, team})) return &part;
    }
    return nullptr;
  }
  const Part* ball() const {
    for (const Part& part : scene) {
      if (hasMesh(part, "soccerball.obj", {})) return &part;
    }
    return nullptr;
  }

  std::map<std::string, std::vector<std::string>> environment;
  std::vector<Part> scene;
  bool full = false;

 private:
  static Part build(const Node& node) {
    Part part;
    EXPECT_EQ(node.atoms.at(0), "nd");
    if (node.atoms.at(1) == "TRF") {
      EXPECT_EQ(node.lists.at(0).atoms.at(0), "SLT") << "the first child of a transform";
    }
    take(part, node);
    for (const Node& child : node.lists) {
      if (!child.atoms.empty() && child.atoms[0] == "nd") part.children.push_back(build(child));
    }
    return part;
  }
  static void update(Part& part, const Node& node) {
    ASSERT_EQ(node.atoms.at(0), "nd");
    take(part, node);
    std::size_t i = 0;
    for (const Node& child : node.lists) {
      if (child.atoms.empty() || child.atoms[0] != "nd") continue;
      ASSERT_LT(i, part.children.size());
      update(part.children[i++], child);
    }
    EXPECT_EQ(i, part.children.size());
  }
  static void take(Part& part, const Node& node) {
    if (const Node* slt = node.find("SLT")) {
      Matrix matrix{};
      ASSERT_EQ(slt->atoms.size(), 17U);
      for (std::size_t k = 0; k < 16; ++k) matrix[k] = std::stod(slt->atoms[k + 1]);
      part.matrix = matrix;
    }
    if (const Node* load = node.find("load")) part.file = load->atoms.at(1);
    for (const char* name : {"resetMaterials", "sMat"}) {
      if (const Node* materials = node.find(name)) part.materials = materials->atoms;
    }
  }
  static bool hasMesh(const Part& part, const std::string& file, const std::vector<std::string>& materials) {
    bool all = part.file.find(file) != std::string::npos;
    for (const std::string& wanted : materials) {
      all = all && std::find(part.materials.begin(), part.materials.end(), wanted) != part.materials.end();
    }
    if (all) return true;
    for (const Part& child : part.children) {
      if (hasMesh(child, file, materials)) return true;
    }
    return false;
  }
};

void expectPose(const Viewer::Part& part, const ScenePose& pose, double tolerance, const std::string& what) {
  ASSERT_TRUE(part.matrix) << what;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      EXPECT_NEAR((*part.matrix)[4 * column + row], pose.rotation(row, column), tolerance) << what;
    }
  }
  for (int row = 0; row < 3; ++row)
    EXPECT_NEAR((*part.matrix)[12 + row], pose.position[row], tolerance) << what;
}

void expectScene(const Viewer& viewer, const Simulation& simulation, double tolerance) {
  ASSERT_NE(viewer.ball(), nullptr);
  expectPose(*viewer.ball(), simulation.world().ballPose(), tolerance, "ball");
  for (const AgentInfo& info : simulation.agents()) {
    const auto* robot = viewer.robot("matNum" + std::to_string(info.unum),
                                     info.side == TeamSide::Left ? "matLeft" : "matRight");
    ASSERT_NE(robot, nullptr) << info.unum;
    const auto bodies = model::robotModel(info.robotType).bodies();
    ASSERT_EQ(robot->children.size(), bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      expectPose(robot->children[i], simulation.world().bodyPose(info.robot, bodies[i].id), tolerance,
                 std::string(model::bodyName(bodies[i].id)));
    }
  }
}

// Robots of three types whose joints move at random.
struct Moving : Scenario {
  Moving() : Scenario(Settings{}) {
    agents = {add(TeamSide::Left, 1, 0), add(TeamSide::Left, 7, 4), add(TeamSide::Right, 3, 2)};
  }
  void move() {
    for (const AgentHandle agent : agents) {
      protocol::Effectors effectors;
      for (std::size_t j = 0; j < model::kJointCount; ++j) {
        effectors.setSpeed(model::jointAt(j), random.uniform(-3.0, 3.0));
      }
      sim.act(agent, effectors);
    }
    step(2);
  }
  std::vector<AgentHandle> agents;
  Random random{3};
};

TEST(MonitorStream, FullAndDifferenceMessagesGiveThePosesOfTheSimulation) {
  Moving match;
  MonitorStream stream(match.sim);
  Viewer viewer;
  for (int i = 0; i < 60; ++i) {
    match.move();
    viewer.feed(stream.next());
    EXPECT_EQ(viewer.full, i == 0);
    // Six digits in a full message; a difference may leave out changes up to 0.005.
    expectScene(viewer, match.sim, i == 0 ? 1e-4 : 0.00501);
  }
}

TEST(MonitorStream, AFullMessageForANewcomerIsExactAndLeavesTheStreamAlone) {
  Moving match;
  MonitorStream stream(match.sim);
  MonitorStream undisturbed(match.sim);
  for (int i = 0; i < 20; ++i) {
    match.move();
    if (i == 10) {
      Viewer newcomer;
      newcomer.feed(stream.full());
      EXPECT_TRUE(newcomer.full);
      expectScene(newcomer, match.sim, 1e-4);
    }
    EXPECT_EQ(stream.next(), undisturbed.next());
  }
}

TEST(MonitorStream, ANewcomerFollowsTheDifferencesOfTheOthers) {
  Moving match;
  MonitorStream stream(match.sim);
  for (int i = 0; i < 10; ++i) {
    match.move();
    stream.next();
  }
  Viewer newcomer;
  newcomer.feed(stream.full());
  for (int i = 0; i < 30; ++i) {
    match.move();
    newcomer.feed(stream.next());
    expectScene(newcomer, match.sim, 0.00501);
  }
}

TEST(MonitorStream, ChangesOfTheSceneBringAFullMessage) {
  Moving match;
  MonitorStream stream(match.sim);
  const auto full = [&] {
    const bool first = stream.next().find("(RSG 0 1)") != std::string::npos;
    EXPECT_NE(stream.next().find("(RDS 0 1)"), std::string::npos) << "only once";
    return first;
  };
  EXPECT_TRUE(full());
  EXPECT_FALSE(full());
  const AgentHandle late = match.add(TeamSide::Right, 9);
  EXPECT_TRUE(full()) << "a robot came";
  match.sim.disconnect(late);
  match.step();
  EXPECT_TRUE(full()) << "a robot left";
  match.command("(reqfullstate)");
  EXPECT_TRUE(full());
  const AgentHandle nobody = match.sim.connect();
  match.step();
  EXPECT_TRUE(full()) << "an agent without robot is an empty node";
  protocol::Effectors scene;
  scene.scene = protocol::SceneEffector{};
  match.sim.act(nobody, scene);
  match.step();
  const std::string text = stream.next();
  EXPECT_THAT(text, ::testing::HasSubstr("matNum matTeam matType0 naowhite")) << "before init";
  EXPECT_THAT(text, ::testing::HasSubstr("(resetMaterials matNum7 matLeft naowhite)"))
      << "type 4 has no material";
  EXPECT_THAT(text, ::testing::HasSubstr("(resetMaterials matNum3 matRight matType2 naowhite)"));
}

// The stream saw the scene with one robot more under a version that the restored one would have had, too.
TEST(MonitorStream, ARestoredSceneComesInFull) {
  Scenario s;
  s.add(TeamSide::Left, 1);
  const std::vector<std::uint8_t> state = s.sim.save();
  MonitorStream stream(s.sim);
  Viewer viewer;
  s.sim.connect();
  viewer.feed(stream.next());
  viewer.feed(stream.next());
  ASSERT_FALSE(viewer.full);
  s.sim.restore(state);
  viewer.feed(stream.next());
  EXPECT_TRUE(viewer.full);
  expectScene(viewer, s.sim, 1e-4);
}

TEST(MonitorStream, EnvironmentAndGameStateAsTheFactsSay) {
  Scenario s;
  MonitorStream stream(s.sim);
  EXPECT_THAT(
      stream.next(),
      ::testing::StartsWith(
          "((FieldLength 30)(FieldWidth 20)(FieldHeight 40)(GoalWidth 2.1)(GoalDepth 0.6)(GoalHeight "
          "0.8)(BorderSize "
          "0)(FreeKickDistance 2)(WaitBeforeKickOff 30)(AgentRadius 0.4)(BallRadius 0.042)(BallMass "
          "0.026)(RuleGoalPauseTime 3)(RuleKickInPauseTime 1)(RuleHalfTime 300)(PassModeMinOppBallDist "
          "1)(PassModeDuration 4)(play_modes BeforeKickOff KickOff_Left KickOff_Right PlayOn KickIn_Left "
          "KickIn_Right "
          "corner_kick_left corner_kick_right goal_kick_left goal_kick_right offside_left offside_right "
          "GameOver "
          "Goal_Left Goal_Right free_kick_left free_kick_right direct_free_kick_left direct_free_kick_right "
          "pass_left "
          "pass_right)(time 0)(half 1)(score_left 0)(score_right 0)(play_mode 0))(RSG 0 1)("));
  s.step();
  EXPECT_THAT(stream.next(), ::testing::StartsWith("((time 0))(RDS 0 1)("));
  s.command("(playMode PlayOn)(time 7.29999)(score (left 1)(right 0))");
  EXPECT_THAT(stream.next(), ::testing::StartsWith("((time 7.29999)(score_left 1)(play_mode 3))(RDS 0 1)("));
}

TEST(MonitorStream, FoulsAreSentOnceToEverybody) {
  Settings settings = quietSettings();
  settings.groundMaxTime = 0.1;
  Scenario s(settings);
  const AgentHandle player = s.add(TeamSide::Left, 5);
  s.setMode(PlayMode::PlayOn);
  s.placeBall(0.0, 8.0);
  MonitorStream stream(s.sim);
  stream.next();
  for (int i = 0; i < 40 && s.sim.fouls().empty(); ++i) {
    s.sink(player, 0.1);
    s.step();
  }
  ASSERT_FALSE(s.sim.fouls().empty());
  EXPECT_EQ(stream.full().find("(foul 1 "), std::string::npos) << "the stream brings it to the newcomer too";
  EXPECT_THAT(stream.next(), ::testing::HasSubstr("(foul 1 4 1 5)"));
  EXPECT_EQ(stream.next().find("(foul 1 "), std::string::npos);
}

TEST(MonitorStream, TheSelectionShows) {
  Scenario s;
  s.add(TeamSide::Left, 5);
  MonitorStream stream(s.sim);
  stream.next();
  stream.next();
  s.command("(select (team Left)(unum 5))");
  EXPECT_THAT(stream.next(), ::testing::HasSubstr("(nd SMN (setVisible 1))"));
  EXPECT_EQ(stream.next().find("setVisible"), std::string::npos);
}

TEST(MonitorLog, OneMessagePerLineEveryFifthOfASecondAndFullEveryThree) {
  const std::string path = ::testing::TempDir() + "nonet_monitor_test_" + std::to_string(::getpid()) + ".log";
  {
    Moving match;
    MonitorLog log(match.sim, path);
    for (int i = 0; i < 400; ++i) {
      match.step();
      log.cycle();
    }
  }
  std::ifstream file(path);
  std::string line;
  Viewer viewer;
  int count = 0;
  int sinceFull = 0;
  while (std::getline(file, line)) {
    viewer.feed(line);
    if (count == 0) {
      EXPECT_TRUE(viewer.full);
    }
    sinceFull = viewer.full ? 0 : sinceFull + 1;
    EXPECT_LT(sinceFull, 15);
    ++count;
  }
  EXPECT_EQ(count, 40);
  std::remove(path.c_str());
  const Simulation simulation{Settings{}};
  EXPECT_THROW(MonitorLog(simulation, "/no/such/folder/x.log"), std::runtime_error);
}

TEST(MonitorLog, SaysThatTheDiskIsFull) {
  const std::string plain =
      ::testing::TempDir() + "nonet_full_monitor_" + std::to_string(::getpid()) + ".log";
  std::filesystem::create_symlink("/dev/full", plain);
  for (const std::string& path : {std::string("/dev/full"), plain}) {
    Moving match;
    MonitorLog log(match.sim, path);
    EXPECT_FALSE(log.failed());
    for (int i = 0; i < 20; ++i) {
      match.step();
      log.cycle();
    }
    EXPECT_TRUE(log.failed());
    EXPECT_THAT(log.error(),
                ::testing::HasSubstr(path + ": recording stops, it cannot be written: No space"));
    log.close();
  }
  std::filesystem::remove(plain);
}

}  // namespace
}  // namespace nonet::sim::test
