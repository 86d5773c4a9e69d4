// The server on the loopback: lock-step, reproducible matches, and clients that misbehave.
#include "nonet/sim/server/server.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <sstream>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nonet/math/random.h"
#include "nonet/protocol/percept_text.h"
#include "nonet/sim/server/lobby.h"

#include "sim/server/running_server.h"

namespace nonet::sim::test {
namespace {

TEST(ServerStart, ATakenPortIsNamed) {
  const Running first;
  ServerSettings serverSettings = lockStep();
  serverSettings.agentPort = first.server.agentPort();
  const std::string port = std::to_string(serverSettings.agentPort);
  try {
    const Server second(Settings{}, 1, serverSettings);
    FAIL() << "two servers on one port";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), ::testing::AllOf(::testing::HasSubstr(port), ::testing::HasSubstr("taken")));
  }
  serverSettings.agentPort = 0;
  serverSettings.monitorPort = first.server.monitorPort();
  EXPECT_THROW(Server(Settings{}, 1, serverSettings), std::runtime_error);
}

TEST(ServerStart, EndsAtOnceWhenStopped) {
  ServerSettings serverSettings = lockStep();
  serverSettings.answerTimeout = 60.0;
  Running running(serverSettings);
  Client client(running.server.agentPort());
  client.send(sceneText(0));
  ASSERT_TRUE(client.receive());  // now the server waits for our answer
  const auto begin = std::chrono::steady_clock::now();
  running.stop();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));  // hangs otherwise
  while (client.receive(2.0)) {
  }
  EXPECT_TRUE(client.ended()) << "the agent sees that the server is gone";
}

TEST(LockStep, OneAgentGetsEveryCycle) {
  const Running running;
  const std::string log = play(running.server.agentPort(), 0, 1, "A", 60);
  std::istringstream lines(log);
  std::string line;
  double last = -1.0;
  int count = 0;
  while (std::getline(lines, line)) {
    protocol::Percept percept;
    protocol::parsePercept(line, percept);
    EXPECT_EQ(percept.unknownTokens, 0) << line;
    if (last >= 0.0) {
      EXPECT_NEAR(percept.time - last, 0.02, 0.0101);
    }
    last = percept.time;
    ++count;
  }
  EXPECT_EQ(count, 61);
  EXPECT_THAT(log, ::testing::HasSubstr("(GS (unum 1) (team left)"));
}

TEST(LockStep, SilenceStopsTheClockUntilTheTimeOut) {
  ServerSettings serverSettings = lockStep();
  serverSettings.answerTimeout = 0.5;
  Running running(serverSettings);
  Client silent(running.server.agentPort());
  silent.send(sceneText(0));
  ASSERT_TRUE(silent.receive());
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_TRUE(silent.receive(5.0)) << "the server goes on by itself";
  const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - begin;
  EXPECT_GT(waited.count(), 0.3);
  // It takes part again as soon as it answers.
  silent.send("(syn)");
  for (int i = 0; i < 20; ++i) silent.receive(1.0);
  running.stop();
  EXPECT_GE(running.server.statistics().timeouts, 1);
}

TEST(LockStep, AgentsWithoutRobotHoldNobodyUp) {
  const Running running;
  const Client idle(running.server.agentPort());
  EXPECT_EQ(play(running.server.agentPort(), 0, 1, "A", 30).find("LOST"), std::string::npos);
}

TEST(LockStep, TwoAnswersInOneGoAndLateAnswersDoNotHangIt) {
  Running running;
  Client client(running.server.agentPort());
  client.send(sceneText(0) + "(syn)");
  for (int i = 0; i < 30; ++i) {
    ASSERT_TRUE(client.receive(5.0)) << i;
    client.send(i == 0 ? initText(1, "A") : "(he1 0.5)(syn)(syn)");
    if (i % 3 == 0) client.send("(syn)");
  }
}

// The same as the TCP match, in process: Lobby, entryOrder() and Simulation.
struct Who {
  int type;
  int unum;
  const char* team;
};
const std::vector<Who> kTeams = {{0, 1, "Blue"}, {1, 2, "Blue"}, {2, 3, "Blue"},
                                 {4, 1, "Red"},  {3, 2, "Red"},  {0, 3, "Red"}};

std::string answerOf(std::size_t who, int cycle) {
  Random random(100 * who + static_cast<std::size_t>(cycle));
  std::string text = cycle == 2 ? fmt::format("(beam {} {} 0)", -1.5 - static_cast<double>(who), 2.0) : "";
  for (const char* joint : {"he1", "lle3", "rle4", "rae1"}) {
    text += fmt::format("({} {:.3f})", joint, random.uniform(-3.0, 3.0));
  }
  if (cycle % 7 == static_cast<int>(who)) text += fmt::format("(say hi{})", cycle);
  return text;
}

std::vector<std::string> matchOverTcp(const std::vector<std::size_t>& arrival, int cycles) {
  ServerSettings serverSettings = lockStep();
  serverSettings.players = static_cast<int>(kTeams.size());
  const Running running(serverSettings, Settings{}, 7);
  std::vector<std::string> logs(kTeams.size());
  std::vector<std::thread> threads;
  for (const std::size_t i : arrival) {
    threads.emplace_back([&, i] {
      logs[i] = play(running.server.agentPort(), kTeams[i].type, kTeams[i].unum, kTeams[i].team, cycles,
                     [i](int cycle) { return answerOf(i, cycle); });
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  for (std::thread& thread : threads) thread.join();
  return logs;
}

std::vector<std::string> matchInProcess(int cycles) {
  const Settings settings;
  std::vector<std::string> logs(kTeams.size());
  std::vector<std::unique_ptr<Lobby>> lobbies;
  std::vector<protocol::InitEffector> inits;
  std::string text;
  for (std::size_t i = 0; i < kTeams.size(); ++i) {
    lobbies.push_back(std::make_unique<Lobby>(settings, 7));
    protocol::Effectors effectors;
    protocol::parseEffectors(sceneText(kTeams[i].type), effectors);
    const protocol::Percept* answer = lobbies.back()->receive(effectors);
    protocol::writePercept(*answer, text);
    logs[i] += text + "\n";
    protocol::parseEffectors(initText(kTeams[i].unum, kTeams[i].team), effectors);
    lobbies.back()->receive(effectors);
    inits.push_back(*lobbies.back()->init());
  }
  Simulation simulation(settings, 7);
  std::vector<AgentHandle> agents(kTeams.size());
  for (const std::size_t i : entryOrder(settings, inits)) {
    agents[i] = simulation.enter(*lobbies[i]->scene(), *lobbies[i]->init());
  }
  simulation.step();
  simulation.step();
  for (int cycle = 1; cycle <= cycles; ++cycle) {
    simulation.step();
    for (std::size_t i = 0; i < agents.size(); ++i) {
      protocol::writePercept(*simulation.sense(agents[i]), text);
      logs[i] += text + "\n";
      protocol::Effectors effectors;
      protocol::parseEffectors(answerOf(i, cycle), effectors);
      simulation.act(agents[i], effectors);
    }
  }
  return logs;
}

TEST(LockStep, AMatchIsTheSameWhateverTheOrderOfArrivalAndInProcess) {
  constexpr int kCycles = 60;
  const auto first = matchOverTcp({0, 1, 2, 3, 4, 5}, kCycles);
  const auto second = matchOverTcp({5, 2, 0, 4, 1, 3}, kCycles);
  const auto inProcess = matchInProcess(kCycles);
  for (std::size_t i = 0; i < kTeams.size(); ++i) {
    EXPECT_EQ(first[i].find("LOST"), std::string::npos);
    EXPECT_EQ(first[i], second[i]) << "agent " << i;
    EXPECT_EQ(first[i], inProcess[i]) << "agent " << i;
  }
  EXPECT_NE(first[0].find("(hear"), std::string::npos);
}

TEST(LockStep, EighteenAgentsAtOnce) {
  ServerSettings serverSettings = lockStep();
  serverSettings.players = 18;
  Running running(serverSettings);
  std::vector<std::thread> threads;
  std::atomic<int> fine{0};
  for (int i = 0; i < 18; ++i) {
    threads.emplace_back([&, i] {
      const std::string log =
          play(running.server.agentPort(), i % 9 / 2, i % 9 + 1, i < 9 ? "Blue" : "Red", 25);
      if (log.find("LOST") == std::string::npos && log.find("(team ") != std::string::npos) ++fine;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(fine, 18);
  running.stop();
  EXPECT_EQ(running.server.statistics().timeouts, 0);
}

TEST(LockStep, AnOrdinaryLateComerMayJoinAReproducibleMatch) {
  ServerSettings serverSettings = lockStep();
  serverSettings.players = 1;
  const Running running(serverSettings);
  std::thread first([&] { play(running.server.agentPort(), 0, 1, "A", 300); });
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const std::string log = play(running.server.agentPort(), 0, 2, "A", 20);
  EXPECT_EQ(log.find("LOST"), std::string::npos);
  EXPECT_THAT(log, ::testing::HasSubstr("(unum 2) (team left)"));
  first.join();
}

// Bad clients: whatever they do, a well-behaved agent plays on.
void othersPlayOn(Running& running) {
  EXPECT_FALSE(running.ended);
  EXPECT_EQ(play(running.server.agentPort(), 0, 0, "Good", 30).find("LOST"), std::string::npos);
}

TEST(BadClient, RandomBytes) {
  Running running;
  Random random(9);
  for (int i = 0; i < 20; ++i) {
    Client client(running.server.agentPort());
    Client monitor(running.server.monitorPort());
    std::string bytes;
    for (int k = 0; k < 2000; ++k) bytes += static_cast<char>(random.below(256));
    client.sendBytes(bytes);
    monitor.sendBytes(bytes);
  }
  othersPlayOn(running);
}

TEST(BadClient, RandomTextInCorrectFrames) {
  Running running;
  Client client(running.server.agentPort());
  client.send(sceneText(0));
  ASSERT_TRUE(client.receive());
  Random random(10);
  const std::string alphabet = "()abcehl123.-; \"'\n";
  for (int i = 0; i < 200; ++i) {
    std::string text;
    for (int k = 0; k < 60; ++k) text += alphabet[random.below(alphabet.size())];
    if (!client.send(text)) break;
  }
  client.send("(syn)");
  client.close();
  othersPlayOn(running);
  running.stop();
  EXPECT_GT(running.server.statistics().skippedExpressions, 0);
}

TEST(BadClient, AnOversizeLengthIsRefused) {
  Running running;
  Client client(running.server.agentPort());
  client.sendBytes(std::string("\x7f\xff\xff\xff", 4) + "abc");
  EXPECT_FALSE(client.receive(5.0));
  EXPECT_TRUE(client.ended()) << "the server closes the connection";
  othersPlayOn(running);
  running.stop();
  EXPECT_EQ(running.server.statistics().refused, 1);
}

TEST(BadClient, VanishesInTheMiddleOfAMessage) {
  Running running;
  {
    Client client(running.server.agentPort());
    client.send(sceneText(0));
    ASSERT_TRUE(client.receive());
    client.sendBytes(std::string("\0\0\0\x20", 4) + "(he1 1.");
  }
  othersPlayOn(running);
}

TEST(BadClient, StopsReadingAndAnswering) {
  ServerSettings serverSettings = lockStep();
  serverSettings.answerTimeout = 0.2;
  Running running(serverSettings);
  Client stopped(running.server.agentPort());
  stopped.send(sceneText(0));
  ASSERT_TRUE(stopped.receive());
  Client monitor(running.server.monitorPort());  // never reads
  othersPlayOn(running);
  othersPlayOn(running);
  running.stop();
  EXPECT_GE(running.server.statistics().timeouts, 1);
}

TEST(BadClient, ASlowReaderLosesWholeMessagesOnly) {
  ServerSettings serverSettings = lockStep();
  serverSettings.answerTimeout = 0.1;
  Running running(serverSettings);
  Client slow(running.server.agentPort());
  slow.send(sceneText(0));
  // A quick one drives the clock until the slow one's buffers are full.
  for (int round = 0; round < 3; ++round) play(running.server.agentPort(), 0, 0, "Quick", 3000);
  running.stop();  // what has been sent comes all the same
  int count = 0;
  double last = -1.0;
  while (const auto message = slow.receive(0.5)) {
    protocol::Percept percept;
    protocol::parsePercept(*message, percept);
    ASSERT_EQ(percept.unknownTokens, 0) << "a frame is damaged: " << *message;
    EXPECT_GT(percept.time, last - 1e-9);
    last = percept.time;
    ++count;
  }
  EXPECT_GT(count, 100);
  EXPECT_GT(running.server.statistics().droppedMessages, 0);
}

TEST(Disconnect, FreesTheNumber) {
  const Running running;
  EXPECT_THAT(play(running.server.agentPort(), 0, 5, "A", 10), ::testing::HasSubstr("(unum 5)"));
  EXPECT_THAT(play(running.server.agentPort(), 0, 5, "A", 10), ::testing::HasSubstr("(unum 5)"));
}

TEST(Monitor, ACommandCountsThoughItsSenderHasGone) {
  const Running running;
  Client watcher(running.server.monitorPort());
  ASSERT_TRUE(watcher.receive());
  for (int i = 0; i < 10; ++i) {
    const bool playOn = i % 2 == 0;
    Client trainer(running.server.monitorPort());
    trainer.send(playOn ? "(playMode PlayOn)" : "(playMode BeforeKickOff)");
    trainer.close();
    const std::string_view wanted = playOn ? "(play_mode 3)" : "(play_mode 0)";
    bool seen = false;
    for (int k = 0; k < 50 && !seen; ++k) {
      const auto message = watcher.receive(1.0);
      ASSERT_TRUE(message);
      seen = message->find(wanted) != std::string::npos;
    }
    EXPECT_TRUE(seen) << i;
  }
}

TEST(Monitor, GetsAFullSceneAtOnceAndDrivesTheGame) {
  Running running;
  Client monitor(running.server.monitorPort());
  const auto first = monitor.receive();
  ASSERT_TRUE(first);
  EXPECT_THAT(*first, ::testing::HasSubstr("(RSG 0 1)"));
  EXPECT_THAT(*first, ::testing::HasSubstr("(play_mode 0)"));
  monitor.send("(kickOff Left)");
  const std::string log = play(running.server.agentPort(), 0, 1, "A", 10);
  EXPECT_THAT(log, ::testing::HasSubstr("(pm KickOff_Left)"));
  bool robot = false;
  for (int i = 0; i < 100 && !robot; ++i) {
    const auto message = monitor.receive(1.0);
    if (!message) break;
    robot = message->find("naobody0.obj") != std::string::npos;
  }
  EXPECT_TRUE(robot);
}

TEST(Monitor, KillsimEndsTheServerAndKillRemovesARobot) {
  Running running;
  Client agent(running.server.agentPort());
  agent.send(sceneText(0));
  ASSERT_TRUE(agent.receive());
  agent.send(initText(1, "A"));
  ASSERT_TRUE(agent.receive());
  agent.send("(syn)");
  Client monitor(running.server.monitorPort());
  monitor.send("(kill (team Left)(unum 1))");
  for (int i = 0; i < 500 && !agent.ended(); ++i) {
    if (agent.receive(2.0)) agent.send("(syn)");
  }
  EXPECT_TRUE(agent.ended()) << "a killed agent is disconnected";
  monitor.send("(killsim)");
  for (int i = 0; i < 300 && !running.ended; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(running.ended);
}

TEST(RealTime, KeepsTheClock) {
  const Running running(inRealTime());
  Client client(running.server.agentPort());
  client.send(sceneText(0));
  ASSERT_TRUE(client.receive());
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(client.receive());
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_GT(took.count(), 0.9) << "never faster than 20 ms per cycle";
}

// All robots are built at the same place: without turns they would stand in each other, and a cycle take
// seconds.
TEST(RealTime, ManyThatComeAtOnceAreBornOneAfterTheOther) {
  const Running running(inRealTime());
  constexpr int kMany = 6;
  std::vector<std::unique_ptr<Client>> clients;
  for (int i = 0; i < kMany; ++i) {
    clients.push_back(std::make_unique<Client>(running.server.agentPort()));
    if (i % 2 == 0) clients.back()->send("(syn)");  // whatever comes first
    clients.back()->send(sceneText(0));
  }
  const auto begin = std::chrono::steady_clock::now();
  // Whose turn comes when is not known: each says init as soon as it hears something.
  std::vector<bool> asked(kMany, false);
  std::vector<bool> plays(kMany, false);
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  while (seconds() < 8.0 && std::count(plays.begin(), plays.end(), true) < kMany) {
    for (std::size_t i = 0; i < clients.size(); ++i) {
      const auto message = clients[i]->receive(0.005);
      if (!message) continue;
      if (!asked[i]) clients[i]->send(initText(static_cast<int>(i) + 1, "Reds"));
      asked[i] = true;
      plays[i] = plays[i] || message->find("(unum ") != std::string::npos;
    }
  }
  EXPECT_EQ(std::count(plays.begin(), plays.end(), true), kMany) << "after " << seconds() << " s";
}

TEST(Match, EndsTheServerWhenAsked) {
  ServerSettings serverSettings = lockStep();
  serverSettings.endWithMatch = true;
  serverSettings.players = 1;
  Settings settings;
  settings.ruleHalfTime = 0.2;
  settings.singleHalfTime = true;
  settings.automaticKickOff = true;
  settings.waitBeforeKickOff = 0.1;
  Running running(serverSettings, settings);
  const std::string log = play(running.server.agentPort(), 0, 1, "A", 400);
  EXPECT_THAT(log, ::testing::HasSubstr("(pm GameOver)"));
  EXPECT_THAT(log, ::testing::HasSubstr("LOST"));
  for (int i = 0; i < 100 && !running.ended; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(running.ended);
}

}  // namespace
}  // namespace nonet::sim::test
