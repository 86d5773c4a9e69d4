#include "nonet/sim/simulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nonet/math/angle.h"
#include "nonet/protocol/rounding.h"
#include "nonet/sim/server/lobby.h"

#include "sim/handshake.h"
#include "sim/scenario.h"

namespace nonet::sim::test {
namespace {

using protocol::Effectors;
using protocol::Percept;

// Server facts 1.2: he1 6.0 in answer to message 0 shows in message 2, 6.87 degrees.
TEST(Cycle, ACommandIsSeenTwoMessagesLater) {
  Simulation simulation(quietSettings());
  const AgentHandle agent = introduce(simulation, 0, 1, "A");
  simulation.step();
  const auto head = [&] {
    return toDegrees(simulation.sense(agent)->joints[model::index(model::JointId::Head1)]);
  };
  const double before = head();
  Effectors turn;
  turn.setSpeed(model::JointId::Head1, 6.0);
  simulation.act(agent, turn);
  simulation.step();
  EXPECT_NEAR(head(), before, 0.011);
  simulation.step();
  EXPECT_NEAR(head(), before + 6.87, 0.02);
}

TEST(Cycle, TheTwoHalvesAreTheWhole) {
  Simulation whole(quietSettings(), 3);
  Simulation halves(quietSettings(), 3);
  introduce(whole, 0, 1, "A");
  introduce(halves, 0, 1, "A");
  for (int i = 0; i < 20; ++i) {
    whole.step();
    halves.beginCycle();
    halves.finishCycle();
  }
  EXPECT_EQ(whole.signature(), halves.signature());
}

TEST(Cycle, ServerTimeIsAFloatSum) {
  Simulation simulation(quietSettings());
  float sum = 0.0F;
  for (int i = 0; i < 1000; ++i) {
    simulation.step();
    sum += 0.02F;
  }
  EXPECT_EQ(simulation.match().serverTime, sum);
  EXPECT_EQ(simulation.match().time, 0.0F) << "the game has not begun";
}

TEST(Cycle, VisionComesInEveryThirdMessage) {
  Simulation simulation(quietSettings());
  const AgentHandle agent = introduce(simulation, 0, 1, "A");
  int last = -1;
  int seen = 0;
  for (int i = 0; i < 30; ++i) {
    simulation.step();
    if (!simulation.sense(agent)->vision) continue;
    if (last >= 0) {
      EXPECT_EQ(i - last, 3);
    }
    last = i;
    ++seen;
  }
  EXPECT_EQ(seen, 10);
}

// Server facts 1.5: each connection counts its own messages.
TEST(Cycle, PlayersOfAMatchDoNotAllSeeAtOnce) {
  Simulation simulation(quietSettings());
  std::array<AgentHandle, 3> agents{};
  for (int i = 0; i < 3; ++i) {
    protocol::SceneEffector scene;
    protocol::InitEffector init;
    init.unum = i + 2;
    init.team.assign("A");
    agents[static_cast<std::size_t>(i)] = simulation.enter(scene, init);
  }
  for (int i = 0; i < 6; ++i) simulation.step();
  for (int i = 0; i < 9; ++i) {
    simulation.step();
    EXPECT_EQ(std::count_if(agents.begin(), agents.end(),
                            [&](AgentHandle agent) { return simulation.sense(agent)->vision.has_value(); }),
              1);
  }
}

TEST(Cycle, SpeedsThatAreNotNumbersAreIgnored) {
  Simulation simulation(quietSettings());
  const AgentHandle agent = introduce(simulation, 0, 1, "A");
  Effectors bad;
  bad.setSpeed(model::JointId::Head1, std::nan(""));
  bad.beam = Pose2(-3.0, 0.0, std::nan(""));
  simulation.act(agent, bad);
  for (int i = 0; i < 5; ++i) simulation.step();
  const Vector3f torso =
      simulation.world().bodyPosition(simulation.agents().at(0).robot, model::BodyId::Torso);
  EXPECT_TRUE(torso.allFinite());
  EXPECT_NEAR(torso.x(), -14.2, 0.01) << "not beamed";
}

TEST(Hear, EveryoneHearsAndTheBearingIsInTheListenersField) {
  Scenario scenario;
  const AgentHandle left1 = scenario.add(TeamSide::Left, 1);
  const AgentHandle left2 = scenario.add(TeamSide::Left, 2);
  const AgentHandle right1 = scenario.add(TeamSide::Right, 1);
  scenario.place(left1, -3.0, 0.0);
  scenario.place(left2, -5.0, 2.0);
  scenario.place(right1, 4.0, 1.0);
  scenario.step(2);
  Effectors say;
  say.say = InlineString<64>("hello");
  scenario.sim.act(left1, say);
  scenario.step(2);
  const auto heard = [&](AgentHandle agent) { return scenario.sim.sense(agent)->heard; };
  ASSERT_EQ(heard(left1).size(), 1U);
  EXPECT_TRUE(heard(left1)[0].self);
  EXPECT_EQ(heard(left1)[0].message, "hello");
  EXPECT_EQ(heard(left1)[0].team, "L");
  ASSERT_EQ(heard(left2).size(), 1U);
  EXPECT_FALSE(heard(left2)[0].self);
  EXPECT_NEAR(toDegrees(heard(left2)[0].direction), -45.0, 0.3);
  ASSERT_EQ(heard(right1).size(), 1U);
  EXPECT_EQ(heard(right1)[0].team, "L");
  EXPECT_NEAR(toDegrees(heard(right1)[0].direction), toDegrees(std::atan2(1.0, 7.0)), 0.3)
      << "the right team's field is turned by half a turn";
}

// Each listener misses its own share, the sender none; the seed decides which.
TEST(Hear, MissesTheShareThatIsSet) {
  std::vector<std::string> patterns;
  for (const std::uint64_t seed : {1U, 1U, 2U}) {
    Settings settings = quietSettings();
    settings.sayLossShare = 0.2;
    Scenario scenario(settings, seed);
    const AgentHandle speaker = scenario.add(TeamSide::Left, 1);
    const std::array<AgentHandle, 2> listeners = {scenario.add(TeamSide::Left, 2),
                                                  scenario.add(TeamSide::Left, 3)};
    scenario.step(3);
    std::string pattern;
    std::array<int, 2> heard{};
    int self = 0;
    constexpr int kSaid = 600;
    for (int i = 0; i < kSaid; ++i) {
      Effectors say;
      say.say = InlineString<64>("m");
      scenario.sim.act(speaker, say);
      scenario.step(2);
      for (std::size_t k = 0; k < listeners.size(); ++k) {
        const bool arrived = !scenario.sim.sense(listeners[k])->heard.empty();
        heard[k] += arrived ? 1 : 0;
        pattern += arrived ? '1' : '0';
      }
      self += scenario.sim.sense(speaker)->heard.empty() ? 0 : 1;
    }
    EXPECT_EQ(self, kSaid);
    for (const int count : heard) EXPECT_NEAR(count, 0.8 * kSaid, 40);  // four standard deviations
    patterns.push_back(pattern);
  }
  EXPECT_EQ(patterns[0], patterns[1]);
  EXPECT_NE(patterns[0], patterns[2]);
  std::string first;
  std::string second;
  for (std::size_t i = 0; i < patterns[0].size(); i += 2) {
    first += patterns[0][i];
    second += patterns[0][i + 1];
  }
  EXPECT_NE(first, second);
}

// Server facts 1.7: four messages in four consecutive cycles: the first and the third arrive.
TEST(Hear, OneMessageOfEachTeamEveryTwoCycles) {
  Scenario scenario;
  const AgentHandle left1 = scenario.add(TeamSide::Left, 1);
  const AgentHandle left2 = scenario.add(TeamSide::Left, 2);
  const AgentHandle left3 = scenario.add(TeamSide::Left, 3);
  const AgentHandle right1 = scenario.add(TeamSide::Right, 1);
  scenario.step(2);
  std::vector<std::string> atMate;
  std::vector<std::string> atOpponent;
  int self = 0;
  for (int i = 0; i < 6; ++i) {
    Effectors say;
    say.say = InlineString<64>("m" + std::to_string(i));
    if (i < 4) scenario.sim.act(left1, say);
    say.say = InlineString<64>("other" + std::to_string(i));
    if (i < 4) scenario.sim.act(left3, say);
    scenario.step();
    for (const protocol::Heard& heard : scenario.sim.sense(left2)->heard)
      atMate.emplace_back(heard.message.view());
    for (const protocol::Heard& heard : scenario.sim.sense(right1)->heard) {
      atOpponent.emplace_back(heard.message.view());
    }
    for (const protocol::Heard& heard : scenario.sim.sense(left1)->heard) self += heard.self ? 1 : 0;
  }
  EXPECT_THAT(atMate, ::testing::ElementsAre("m0", "m2")) << "the first speaker of a cycle wins";
  EXPECT_THAT(atOpponent, ::testing::ElementsAre("m0", "m2"));
  EXPECT_EQ(self, 4) << "the own message takes no capacity";
}

TEST(Hear, MessagesThatAreTooLongOrHoldWrongCharactersAreDropped) {
  Scenario scenario;
  const AgentHandle agent = scenario.add(TeamSide::Left, 1);
  for (const char* text : {"123456789012345678901", "a b", "a(b", "", "\x7f"}) {
    Effectors say;
    say.say = InlineString<64>(text);
    scenario.sim.act(agent, say);
    scenario.step(2);
    EXPECT_TRUE(scenario.sim.sense(agent)->heard.empty()) << text;
  }
  Effectors say;
  say.say = InlineString<64>("12345678901234567890");
  scenario.sim.act(agent, say);
  scenario.step(2);
  EXPECT_EQ(scenario.sim.sense(agent)->heard.size(), 1U);
}

TEST(Hear, LabelsAndScoresCanBeSwitchedOff) {
  Settings settings = quietSettings();
  settings.labelMessages = false;
  settings.reportScore = false;
  Scenario scenario(settings);
  const AgentHandle agent = scenario.add(TeamSide::Left, 1);
  Effectors say;
  say.say = InlineString<64>("x");
  scenario.sim.act(agent, say);
  scenario.step(2);
  const std::string text = textOf(scenario.sim, agent);
  EXPECT_NE(text.find("(hear 0.00 self x)"), std::string::npos) << text;
  EXPECT_EQ(text.find("(sl "), std::string::npos) << text;
}

// A pseudo-random agent, so that robots move and fall.
Effectors flail(Random& random) {
  Effectors effectors;
  for (std::size_t j = 0; j < model::kJointCount; ++j) {
    effectors.setSpeed(model::jointAt(j), random.uniform(-3.0, 3.0));
  }
  return effectors;
}

TEST(Text, CarriesEveryBitOfTheValues) {
  Simulation simulation(Settings{}, 11);
  const AgentHandle agent = introduce(simulation, 4, 1, "A");
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    simulation.act(agent, flail(random));
    simulation.step();
    const Percept& direct = *simulation.sense(agent);
    std::string text;
    protocol::writePercept(direct, text);
    Percept read;
    protocol::parsePercept(text, read);
    EXPECT_EQ(read.unknownTokens, 0);
    ASSERT_EQ(read.time, direct.time);
    ASSERT_EQ(read.joints, direct.joints);
    ASSERT_EQ(read.gyro, direct.gyro);
    ASSERT_EQ(read.accelerometer, direct.accelerometer);
    ASSERT_EQ(read.vision.has_value(), direct.vision.has_value());
    if (direct.vision) {
      ASSERT_EQ(read.vision->lines.size(), direct.vision->lines.size());
      for (std::size_t k = 0; k < direct.vision->lines.size(); ++k) {
        ASSERT_EQ(read.vision->lines[k].begin.azimuth, direct.vision->lines[k].begin.azimuth);
      }
    }
    std::string again;
    protocol::writePercept(read, again);
    ASSERT_EQ(again, text);
  }
}

TEST(State, RestoringContinuesBitExactly) {
  Settings settings;
  settings.sayLossShare = 0.5;
  Simulation original(settings, 21);
  const AgentHandle a = introduce(original, 0, 1, "A");
  const AgentHandle b = introduce(original, 2, 1, "B");
  Random random(3);
  for (int i = 0; i < 60; ++i) {
    original.act(a, flail(random));
    original.step();
  }
  original.act(b, flail(random));  // a message that waits is part of the state
  const std::vector<std::uint8_t> state = original.save();
  Simulation copy(settings, 99);
  copy.restore(state);
  Random randomCopy = random;
  for (int i = 0; i < 60; ++i) {
    original.act(a, flail(random));
    copy.act(a, flail(randomCopy));
    original.step();
    copy.step();
    ASSERT_EQ(original.signature(), copy.signature()) << i;
    ASSERT_EQ(textOf(original, a), textOf(copy, a)) << i;
    ASSERT_EQ(textOf(original, b), textOf(copy, b)) << i;
  }
  EXPECT_THROW(copy.restore(std::span(state).first(state.size() / 2)), std::runtime_error);
  EXPECT_THROW(copy.restore({}), std::runtime_error);
  std::vector<std::uint8_t> longer = state;
  longer.push_back(0);
  EXPECT_THROW(copy.restore(longer), std::runtime_error);
}

// Plays a few seconds with whole teams that arrive in the given order, and returns everything they sense.
std::string matchOf(const std::vector<std::size_t>& arrival) {
  struct Who {
    int type;
    int unum;
    const char* team;
  };
  const std::vector<Who> whos = {{0, 1, "B"}, {1, 2, "B"}, {2, 1, "A"}, {4, 2, "A"}};
  const Settings settings;
  std::vector<std::unique_ptr<Lobby>> lobbies;
  std::vector<protocol::InitEffector> inits;
  std::string log;
  for (const std::size_t i : arrival) {
    lobbies.push_back(std::make_unique<Lobby>(settings, 5));
    const Percept* answer = lobbies.back()->receive(sceneMessage(whos[i].type));
    EXPECT_NE(answer, nullptr);
    EXPECT_EQ(lobbies.back()->receive(initMessage(whos[i].unum, whos[i].team)), nullptr);
    EXPECT_TRUE(lobbies.back()->ready());
    inits.push_back(*lobbies.back()->init());
  }
  Simulation simulation(settings, 5);
  std::vector<AgentHandle> agents;
  for (const std::size_t i : entryOrder(settings, inits)) {
    agents.push_back(simulation.enter(*lobbies[i]->scene(), *lobbies[i]->init()));
  }
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    for (const AgentHandle agent : agents) {
      Effectors effectors = flail(random);
      if (i == 3) effectors.beam = Pose2(-2.0 - agent, 1.0, 0.0);
      simulation.act(agent, effectors);
    }
    simulation.step();
    for (const AgentHandle agent : agents) log += textOf(simulation, agent) + "\n";
  }
  return log;
}

TEST(State, MatchesDependOnTheSeedAndNotOnTheOrderOfArrival) {
  const std::string first = matchOf({0, 1, 2, 3});
  EXPECT_EQ(first, matchOf({0, 1, 2, 3}));
  EXPECT_EQ(first, matchOf({3, 1, 0, 2}));
}

TEST(State, TwoSimulationsInOneProcessDoNotDisturbEachOther) {
  Simulation alone(Settings{}, 8);
  const AgentHandle agent = introduce(alone, 0, 1, "A");
  Random random(4);
  for (int i = 0; i < 40; ++i) {
    alone.act(agent, flail(random));
    alone.step();
  }
  Simulation first(Settings{}, 8);
  Simulation second(Settings{}, 9);
  const AgentHandle inFirst = introduce(first, 0, 1, "A");
  const AgentHandle inSecond = introduce(second, 3, 1, "A");
  Random again(4);
  Random other(6);
  for (int i = 0; i < 40; ++i) {
    second.act(inSecond, flail(other));
    second.step();
    first.act(inFirst, flail(again));
    first.step();
  }
  EXPECT_EQ(alone.signature(), first.signature());
  EXPECT_EQ(textOf(alone, agent), textOf(first, inFirst));
}

}  // namespace
}  // namespace nonet::sim::test
