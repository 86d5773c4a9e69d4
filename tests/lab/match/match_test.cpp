#include "nonet/lab/match/match.h"

#include <map>
#include <set>

#include <gtest/gtest.h>

#include "nonet/lab/reports/match_localization.h"
#include "nonet/math/angle.h"

namespace nonet::lab {
namespace {

MatchSettings shortMatch(std::uint64_t seed) {
  MatchSettings match;
  match.left.players = 2;
  match.right.players = 2;
  match.seed = seed;
  match.minutes = 2.0 / 60.0;  // two halves of one second
  match.kickOffWait = 0.5;
  return match;
}

TEST(Match, SeedsOfAgentsDiffer) {
  std::set<std::uint64_t> seeds;
  for (const std::uint64_t seed : {1U, 2U}) {
    for (int unum = 1; unum <= 11; ++unum) {
      seeds.insert(agent::agentSeed(seed, false, unum));
      seeds.insert(agent::agentSeed(seed, true, unum));
    }
  }
  EXPECT_EQ(seeds.size(), 44U);
}

// Server facts 1.4, written down a second time.
TEST(Match, UsualTypesPassTheServersRules) {
  std::map<int, int> count;
  for (int unum = 1; unum <= 11; ++unum) {
    const int type = agent::usualRobotType(unum);
    const int others = unum - 1;
    EXPECT_LT(count[type], 7);
    for (const auto& [other, number] : count) {
      if (other != type) {
        EXPECT_LE(count[type] + 1 + number, 9);
      }
    }
    int kinds = 0;
    for (const auto& [other, number] : count) kinds += number > 0 ? 1 : 0;
    EXPECT_FALSE(11 - others <= 3 - kinds && count[type] > 0);
    ++count[type];
  }
}

TEST(Match, TypesOfATeamAreThoseThatWereGiven) {
  MatchSettings match;
  match.right.robotTypes = {1, 3, 3, 3, 3, 3, 3, 3, 4};
  EXPECT_EQ(agentChoice(match, true, 1).robotType, 1);
  EXPECT_EQ(agentChoice(match, true, 9).robotType, 4);
  EXPECT_EQ(agentChoice(match, false, 2).robotType, agent::usualRobotType(2));
  const MatchWatcher watcher(match);
  EXPECT_EQ(watcher.result().players.back().robotType, 4);
}

TEST(Match, TypesThatTheServerWouldRefuseAreRefused) {
  EXPECT_NO_THROW(checkRobotTypes({}, 9));
  EXPECT_NO_THROW(checkRobotTypes({0, 2, 2, 2, 2, 2, 2, 2, 4}, 9));
  EXPECT_NO_THROW(checkRobotTypes({4, 4, 0, 0, 0, 0, 0, 0, 0}, 9));
  EXPECT_THROW(checkRobotTypes({0, 2, 2}, 9), std::runtime_error);                    // too few
  EXPECT_THROW(checkRobotTypes({0, 2, 5}, 3), std::runtime_error);                    // no such type
  EXPECT_THROW(checkRobotTypes({2, 2, 2, 2, 2, 2, 2, 2, 4}, 9), std::runtime_error);  // eight of one
  EXPECT_THROW(checkRobotTypes({4, 4, 4, 4, 4, 2, 2, 2, 2, 2}, 10), std::runtime_error);
}

TEST(Match, IsPlayedToTheEnd) {
  MatchSettings match = shortMatch(1);
  match.check = true;
  const MatchResult result = playInProcess(match, NONET_SOURCE_DIR, 1);
  EXPECT_EQ(result.violations, 0U) << result.invariants;
  EXPECT_TRUE(result.finished);
  EXPECT_NEAR(result.gameTime, 2.0, 0.05);
  ASSERT_EQ(result.players.size(), 4U);
  for (const PlayerRecord& player : result.players) {
    EXPECT_TRUE(player.connected);
    EXPECT_FALSE(player.gone);
  }
  EXPECT_EQ(result.toJson()["players"].size(), 4U);
  EXPECT_NE(result.toText().find("Guests"), std::string::npos);
}

// The score belongs to a team, not to a side.
TEST(Match, GoalsStayWithTheirTeamWhenSidesChange) {
  MatchSettings settings;
  sim::Settings server;
  server.changeSidesInSecondHalf = true;
  server.ruleHalfTime = 1.0;
  sim::Simulation simulation(server, 1);
  for (const TeamSettings* team : {&settings.left, &settings.right}) {
    protocol::InitEffector init;
    init.unum = 1;
    init.team.assign(team->name);
    simulation.enter({}, init);
    simulation.step();
  }
  simulation.trainer("(score (left 2)(right 1))");
  MatchWatcher watcher(settings);
  simulation.trainer("(playMode PlayOn)");
  for (int i = 0; i < 100; ++i) {
    simulation.step();
    watcher.update(simulation);
    EXPECT_EQ(watcher.result().scoreLeft, 2) << i;
    EXPECT_EQ(watcher.result().scoreRight, 1) << i;
  }
  EXPECT_EQ(std::string_view(simulation.match().teamLeft), settings.right.name) << "they have changed sides";
}

TEST(Match, SameSeedSameMatchOnAnyNumberOfThreads) {
  const MatchResult first = playInProcess(shortMatch(5), NONET_SOURCE_DIR, 1);
  const MatchResult second = playInProcess(shortMatch(5), NONET_SOURCE_DIR, 2);
  const MatchResult other = playInProcess(shortMatch(6), NONET_SOURCE_DIR, 1);
  EXPECT_EQ(first.signature, second.signature);
  EXPECT_EQ(first.cycles, second.cycles);
  EXPECT_NE(first.signature, other.signature);
}

// The whole line, from the eyes to the feet: nine robots that nobody hinders stay on their feet and score,
// from every seed (here the first half of a minute and a half: 45 s).
TEST(Match, NineAloneStandAndScore) {
  int falls = 0;
  int goals = 0;
  constexpr int kMatches = 3;
  for (std::uint64_t seed = 1; seed <= kMatches; ++seed) {
    MatchSettings match;
    match.right.players = 0;
    match.seed = seed;
    match.minutes = 1.5;
    MatchObservers observers;
    observers.afterCycle = [](const sim::Simulation&, const MatchWatcher& watcher) {
      return watcher.result().gameTime < 45.0;
    };
    const MatchResult result = playInProcess(match, NONET_SOURCE_DIR, 2, observers);
    falls += result.falls(false);
    goals += result.scoreLeft;
    EXPECT_EQ(result.scoreRight, 0);
  }
  EXPECT_GE(goals, kMatches - 1);
  EXPECT_LE(falls, 2) << "of 27 robots";
}

// The goalie and ten others: nobody is refused, and by radio they come to as many different roles.
TEST(Match, ElevenAgreeOnElevenRoles) {
  MatchSettings match;
  match.left.players = 11;
  match.right.players = 0;
  match.minutes = 1.0;
  match.kickOffWait = 2.0;
  std::map<sim::AgentHandle, team::Role> roles;
  int agreed = 0;
  int cycles = 0;
  MatchObservers observers;
  observers.afterThought = [&](const Thought& thought) { roles[thought.handle] = thought.agent.role(); };
  observers.afterCycle = [&](const sim::Simulation&, const MatchWatcher& watcher) {
    if (watcher.result().gameTime < 1.0) return true;
    std::set<team::Role> different;
    for (const auto& [handle, role] : roles) different.insert(role);
    agreed += different.size() == 11U ? 1 : 0;
    return ++cycles < 100;
  };
  const MatchResult result = playInProcess(match, NONET_SOURCE_DIR, 2, observers);
  EXPECT_EQ(roles.size(), 11U);
  for (const PlayerRecord& player : result.players) EXPECT_TRUE(player.connected) << player.unum;
  EXPECT_GT(agreed, 80) << "of 100 cycles";
}

TEST(Match, CanBeStopped) {
  int cycles = 0;
  MatchObservers observers;
  observers.afterCycle = [&](const sim::Simulation&, const MatchWatcher&) { return ++cycles < 10; };
  const MatchResult result = playInProcess(shortMatch(1), NONET_SOURCE_DIR, 1, observers);
  EXPECT_EQ(result.cycles, 10);
  EXPECT_FALSE(result.finished);
  EXPECT_FALSE(result.flawless());
}

TEST(Match, LocalizationOfAllPlayersIsMeasuredAgainstTheSimulation) {
  MatchLocalization localization;
  long visions = 0;
  MatchObservers observers;
  observers.afterCycle = [&](const sim::Simulation& simulation, const MatchWatcher&) {
    localization.afterCycle(simulation);
    return true;
  };
  observers.afterThought = [&](const Thought& thought) {
    localization.afterThought(thought);
    visions += thought.percept.vision ? 1 : 0;
  };
  const MatchResult watched = playInProcess(shortMatch(5), NONET_SOURCE_DIR, 1, observers);
  EXPECT_EQ(watched.signature, playInProcess(shortMatch(5), NONET_SOURCE_DIR, 1).signature)
      << "watching changes nothing";

  // None left out but what is seen before the first cycle has ended.
  const LocalizationReport::Summary all = localization.all().summary();
  EXPECT_GE(static_cast<long>(all.frames), visions - 4);
  EXPECT_GT(all.frames, 100U);
  EXPECT_LT(all.position.median, 0.02);
  EXPECT_LT(all.heading.median, toRadians(0.15));
  const nlohmann::ordered_json json = localization.toJson();
  EXPECT_EQ(json["players"].size(), 4U);
  std::size_t sum = 0;
  for (const char* activity : {"standing", "walking", "fallen"})
    sum += json[activity]["frames"].get<std::size_t>();
  EXPECT_EQ(sum, all.frames);
}

TEST(Match, EverybodyKnowsTheOwnSideAtOnceAfterHalfTime) {
  // Vision comes in every third message, so half time is moved through all three places between two of them.
  for (int phase = 0; phase < 3; ++phase) {
    MatchSettings match = shortMatch(3);
    match.minutes = (3.0 + 2.0 * phase * kCycleTime) / 60.0;
    match.settings.changeSidesInSecondHalf = true;
    // Torsos in the frames of their teams: after the last cycle, and one cycle before, which is what a
    // message shows when it is read.
    std::map<sim::AgentHandle, Vector2> now;
    std::map<sim::AgentHandle, Vector2> shown;
    double halfTime = 0.0;
    MatchObservers observers;
    observers.afterCycle = [&](const sim::Simulation& simulation, const MatchWatcher&) {
      shown = now;
      const double time = static_cast<double>(simulation.match().serverTime);
      if (simulation.match().half == 2 && halfTime == 0.0) halfTime = time;
      for (const sim::AgentInfo& agent : simulation.agents()) {
        const auto p_W = simulation.world().bodyPose(agent.robot, model::BodyId::Torso).position;
        const double sign = agent.side == protocol::TeamSide::Right ? -1.0 : 1.0;
        now[agent.handle] = sign * p_W.head<2>().cast<double>();
      }
      return true;
    };
    int checked = 0;
    observers.afterThought = [&](const Thought& thought) {
      // Two vision messages, the first of which may still show everybody in the old place.
      if (halfTime == 0.0 || thought.percept.time < halfTime + 0.1) return;
      const world::WorldState& world = thought.agent.world();
      ++checked;
      EXPECT_TRUE(world.game.sidesSwapped);
      EXPECT_LT((world.self.X_FR.translation - shown.at(thought.handle)).norm(), 0.2)
          << "phase " << phase << ", agent " << thought.handle << ", " << thought.percept.time - halfTime
          << " s after half time";
    };
    playInProcess(match, NONET_SOURCE_DIR, 1, observers);
    EXPECT_GT(checked, 300);
  }
}

// A robot that throws its legs forward falls, once, and is counted once however long it lies.
TEST(MatchWatcher, CountsAFallOnce) {
  MatchSettings match = shortMatch(1);
  match.left.players = match.right.players = 1;
  match.minutes = 1.0;
  sim::Simulation simulation(simulationSettings(match), 1);
  MatchWatcher watcher(match);
  protocol::SceneEffector scene;
  protocol::InitEffector init;
  init.unum = 1;
  init.team.assign(match.left.name);
  const sim::AgentHandle faller = simulation.enter(scene, init);
  init.team.assign(match.right.name);
  simulation.enter(scene, init);
  for (int cycle = 0; cycle < 250; ++cycle) {
    protocol::Effectors effectors;
    if (cycle > 60) {
      effectors.setSpeed(model::JointId::RLeg3, 3.0);
      effectors.setSpeed(model::JointId::LLeg3, 3.0);
    }
    simulation.act(faller, effectors);
    simulation.step();
    watcher.update(simulation);
  }
  EXPECT_EQ(watcher.result().falls(false), 1);
  EXPECT_EQ(watcher.result().falls(true), 0) << "the other one just stands";
  EXPECT_LT(watcher.result().players[0].standingAfterKickOff,
            watcher.result().players[1].standingAfterKickOff);
  EXPECT_NE(watcher.progress(simulation).find("falls 1 : 0"), std::string::npos);
}

}  // namespace
}  // namespace nonet::lab
