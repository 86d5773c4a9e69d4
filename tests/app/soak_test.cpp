#include <chrono>
#include <fstream>
#include <memory>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nonet/app/agent_processes.h"
#include "nonet/app/soak/false_clock.h"
#include "nonet/app/soak/match_soak.h"
#include "nonet/app/soak/memory_watch.h"
#include "nonet/app/soak/wake_watch.h"
#include "nonet/lab/common/folder_lock.h"

#include "app/program.h"

namespace nonet::app {
namespace {

using testing::HasSubstr;
using Json = nlohmann::ordered_json;

Json jsonIn(const std::string& path) {
  std::ifstream file(path);
  return Json::parse(file);
}

TEST(SoakCounts, ACrashAMissingAndALateOneAreToldApart) {
  const auto match = nlohmann::json::parse(R"({"finished": true, "cycles": 50, "timeouts": 2, "players": [
      {"connected": true, "ending": "", "passed_over": 3, "lost_cycles": 4, "messages": 48},
      {"connected": true, "ending": "killed by signal 11", "passed_over": 0, "lost_cycles": 0, "messages": 7},
      {"connected": false, "ending": "", "passed_over": 0, "lost_cycles": 0, "messages": 0}]})");
  const Json line = countFaults(match);
  EXPECT_EQ(line["unfinished"], 0);
  EXPECT_EQ(line["crashed"], 1);
  EXPECT_EQ(line["missing"], 1);
  EXPECT_EQ(line["late"], 5);
  EXPECT_EQ(line["lost_cycles"], 4);
  EXPECT_EQ(line["messages"], 55);
  EXPECT_EQ(countFaults(nlohmann::json())["unfinished"], 1) << "no result at all";
}

TEST(SoakCounts, WhatTheClockSaidIsTakenOver) {
  const auto match = nlohmann::json::parse(R"({"finished": true, "answers": {"count": 40, "longest_ms": 7.5,
      "longer_than_5_ms": 2}, "cycle_delays": {"count": 20, "longest_ms": 3.5, "longer_than_5_ms": 0}})");
  const Json sum = sumUp({countFaults(match), countFaults(match)});
  EXPECT_EQ(sum["answers_count"], 80);
  EXPECT_EQ(sum["answers_longer_than_5_ms"], 4);
  EXPECT_EQ(sum["most_answers_ms"], 7.5);
  EXPECT_EQ(sum["cycle_delays_count"], 40);
  EXPECT_EQ(sum["most_cycle_delays_ms"], 3.5);
}

TEST(SoakCounts, NumbersAreSummedAndTheLargestKept) {
  const Json sum =
      sumUp({{{"index", 0}, {"real_time", true}, {"players", 11}, {"late", 2}, {"most_agent_mb", 5.0}},
             {{"index", 1}, {"real_time", false}, {"players", 9}, {"late", 3}, {"most_agent_mb", 4.0}}});
  EXPECT_EQ(sum["matches"], 2);
  EXPECT_EQ(sum["real_time_matches"], 1);
  EXPECT_EQ(sum["matches_of_eleven"], 1);
  EXPECT_EQ(sum["late"], 5);
  EXPECT_EQ(sum["most_agent_mb"], 5.0);
}

TEST(SoakCounts, MatchesAreMixedAsToldAndTheSameAgain) {
  MatchSoakSettings settings;
  int realTime = 0;
  int eleven = 0;
  for (int index = 0; index < 400; ++index) {
    const SoakMatch match = soakMatch(settings, index);
    EXPECT_EQ(match.seed, soakMatch(settings, index).seed);
    realTime += match.realTime ? 1 : 0;
    eleven += match.players == 11 ? 1 : 0;
  }
  EXPECT_NEAR(realTime, 200, 40);
  EXPECT_NEAR(eleven, 100, 35);
}

TEST(SoakMemory, TheSlopeIsThatOfTheLine) {
  EXPECT_DOUBLE_EQ(slopeOf({0, 1, 2, 3}, {5, 7, 9, 11}), 2.0);
  EXPECT_NEAR(slopeOf({0, 1, 2, 3}, {1, -1, -1, 1}), 0.0, 1e-12);
  EXPECT_EQ(slopeOf({1, 1, 1}, {1, 2, 3}), 0.0);
  EXPECT_GT(residentMemory(::getpid()), 1.0);
  EXPECT_EQ(residentMemory(-1), 0.0);
  MemoryWatch watch;
  for (double time = 0.0; time < kShortestWatch; time += 10.0) watch.look(time, ::getpid());
  EXPECT_FALSE(watch.growth().perHour) << "too short";
  EXPECT_GT(watch.growth().megabytes, 1.0);
  std::vector<std::string> grown;
  for (double time = kShortestWatch; time <= 2.0 * kShortestWatch; time += 10.0) {
    grown.emplace_back(1 << 20, 'x');
    watch.look(time, ::getpid());
  }
  // A megabyte every ten seconds.
  EXPECT_NEAR(watch.growth().perHour.value_or(0.0), 360.0, 100.0);
}

TEST(SoakWakes, ASleeperIsWokenOnEveryProcessor) {
  const WakeWatch watch;
  const auto begin = std::chrono::steady_clock::now();
  while (watch.delays().count() < 50 && std::chrono::steady_clock::now() - begin < std::chrono::seconds(20))
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_GE(watch.delays().count(), 50);
  EXPECT_GT(watch.delays().longest(), 0.0);
}

TEST(Soak, ByTheClockTheMachineIsWatchedToo) {
  const TestFolder folder("nonet_soak_clock_match");
  Program program({"soak", "--matches", "1", "--minutes", "0.03", "--kick-off-wait", "0.3", "--players", "2",
                   "--eleven-share", "0", "--realtime-share", "1", "--out", folder.file("out")},
                  folder.file("soak.txt"));
  ASSERT_EQ(program.wait(), 0) << program.output();
  const Json sum = jsonIn(folder.file("out/result.json"));
  EXPECT_GT(sum["answers_count"], 400) << "four agents, 50 a second";
  EXPECT_LE(sum["answers_count"], sum["messages"]);
  EXPECT_GT(sum["cycle_delays_count"], 100);
  EXPECT_GT(sum["machine_wakes"], 500);
}

// The second call finds the first match and plays only the rest.
TEST(Soak, PlaysMatchesAndGoesOnWhereItWas) {
  const TestFolder folder("nonet_soak");
  for (const std::string matches : {"1", "2"}) {
    Program program({"soak", "--matches", matches, "--minutes", "0.03", "--kick-off-wait", "0.3", "--players",
                     "2", "--eleven-share", "0", "--realtime-share", "0", "--out", folder.file("out")},
                    folder.file("soak.txt"));
    ASSERT_EQ(program.wait(), 0) << program.output();
    const Json sum = jsonIn(folder.file("out/result.json"));
    EXPECT_EQ(sum["matches"].dump(), matches);
    for (const std::string fault :
         {"faults", "unfinished", "crashed", "missing", "late", "lost_cycles", "torn_logs"})
      EXPECT_EQ(sum[fault], 0) << fault;
    EXPECT_GT(sum["messages"], 100);
    EXPECT_EQ(program.output().find("resumed: 1 matches") != std::string::npos, matches == "2");
  }
}

TEST(Soak, OtherOptionsAreAnotherSoak) {
  const TestFolder folder("nonet_soak_options");
  const auto soak = [&](const std::string& minutes) {
    Program program({"soak", "--matches", "1", "--minutes", minutes, "--kick-off-wait", "0.3", "--players",
                     "2", "--eleven-share", "0", "--realtime-share", "0", "--out", folder.file("out")},
                    folder.file("soak.txt"));
    const int code = program.wait();
    return std::pair(code, program.output());
  };
  EXPECT_EQ(soak("0.02").first, 0);
  const auto [code, output] = soak("0.03");
  EXPECT_EQ(code, 1);
  EXPECT_NE(output.find("another soak"), std::string::npos) << output;
  std::ofstream(folder.file("out/soak.json")) << "";
  const auto [emptied, said] = soak("0.03");
  EXPECT_EQ(emptied, 1);
  EXPECT_NE(said.find(folder.file("out/soak.json") + " is damaged or gone"), std::string::npos) << said;
}

TEST(Soak, AFolderIsHeldByOneAtATime) {
  const TestFolder folder("nonet_soak_lock");
  const std::shared_ptr<void> held = lab::lockFolder(folder.file(""));
  for (const std::string kind : {"--matches=1", "--faults"}) {
    Program program({"soak", kind, "--players", "2", "--out", folder.file("")}, folder.file("soak.txt"));
    EXPECT_EQ(program.wait(), 1);
    EXPECT_THAT(program.output(), HasSubstr("another process works on"));
  }
}

TEST(Soak, WhoIsHarmedComesBack) {
  const TestFolder folder("nonet_soak_faults");
  Program program({"soak", "--faults", "--times", "1", "--players", "2", "--pause", "0.2", "--kinds",
                   "kill,cut,server", "--out", folder.file("out")},
                  folder.file("soak.txt"));
  EXPECT_EQ(program.wait(), 0) << program.output();
  const Json result = jsonIn(folder.file("out/faults.json"));
  EXPECT_TRUE(result["complete"]);
  for (const std::string kind : {"kill", "cut", "server"})
    EXPECT_EQ(result["faults"][kind]["survived"], 1) << kind;
}

// Whoever is just being harmed when the user has seen enough has not failed.
TEST(Soak, AFaultThatIsCutShortDoesNotCount) {
  const TestFolder folder("nonet_soak_stopped");
  Program program({"soak", "--faults", "--times", "1", "--players", "2", "--pause", "0.2", "--kinds", "stop",
                   "--out", folder.file("out")},
                  folder.file("soak.txt"));
  ASSERT_TRUE(program.says("stop 1: ", 90.0)) << program.output();
  ::kill(program.pid(), SIGINT);
  EXPECT_EQ(program.wait(), 1) << program.output();
  EXPECT_THAT(program.output(), HasSubstr("this one does not count"));
  const Json result = jsonIn(folder.file("out/faults.json"));
  EXPECT_FALSE(result["complete"]);
  EXPECT_EQ(result["faults"]["stop"]["times"], 0);
}

/// Seconds since 1970, as a program reads them that is started with these variables.
long wallClock(const TestFolder& folder, const std::vector<std::string>& variables) {
  AgentProcesses processes;
  processes.start({"/bin/date", "+%s"}, folder.file("date.txt"), variables);
  processes.stop(10.0);
  long time = 0;
  std::ifstream(folder.file("date.txt")) >> time;
  return time;
}

TEST(Soak, TheFalseClockJumps) {
  const TestFolder folder("nonet_soak_clock");
  const FalseClock clock(folder.file("clock"));
  EXPECT_NEAR(wallClock(folder, clock.variables()), wallClock(folder, {}), 5);
  clock.jump(3600);
  EXPECT_NEAR(wallClock(folder, clock.variables()), wallClock(folder, {}) + 3600, 5);
  clock.jump(-3600);
  EXPECT_NEAR(wallClock(folder, clock.variables()), wallClock(folder, {}) - 3600, 5);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they want to be loaded first
TEST(Soak, AJumpOfTheClockIsNotNoticed) {
  const TestFolder folder("nonet_soak_jump");
  Program program({"soak", "--faults", "--times", "1", "--players", "2", "--pause", "0.2", "--kinds", "clock",
                   "--out", folder.file("out")},
                  folder.file("soak.txt"));
  EXPECT_EQ(program.wait(), 0) << program.output();
  EXPECT_EQ(jsonIn(folder.file("out/faults.json"))["faults"]["clock"]["survived"], 1);
}
#endif

TEST(Soak, RandomCommandsAreWatched) {
  const TestFolder folder("nonet_soak_effectors");
  Program program("/bin/sh", {"-c", NONET_BINARY " soak --effectors 0.05 --players 2 --json 2>/dev/null"},
                  folder.file("soak.txt"));
  EXPECT_EQ(program.wait(), 0) << program.output();
  const Json result = Json::parse(program.output());  // nothing else is said
  EXPECT_EQ(result["cycles"], 150);
  EXPECT_EQ(result["violations"], 0);
}

}  // namespace
}  // namespace nonet::app
