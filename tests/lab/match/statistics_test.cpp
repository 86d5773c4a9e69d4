#include "nonet/lab/match/statistics.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "nonet/lab/match/frame_sources.h"
#include "nonet/lab/match/match.h"
#include "nonet/sim/server/monitor.h"

namespace nonet::lab {
namespace {

using protocol::PlayMode;

// A match made by hand: a ball that rolls by the measured law, robots that stand where they are put.
class Script {
 public:
  explicit Script(double rate) : step_(1.0 / rate) {
    frame.mode = PlayMode::PlayOn;
    frame.p_WBall.z() = 0.042;
  }

  FrameRobot& robot(TeamIndex team, int unum, double x, double y) {
    for (FrameRobot& known : frame.robots) {
      if (known.team == team && known.unum == unum) {
        known.p_W = Vector3(x, y, 0.38);
        return known;
      }
    }
    FrameRobot fresh;
    fresh.team = team;
    fresh.unum = unum;
    fresh.p_W = Vector3(x, y, 0.38);
    frame.robots.push_back(fresh);
    return frame.robots.back();
  }
  void ballAt(double x, double y) {
    frame.p_WBall.head<2>() = Vector2(x, y);
    velocity = Vector2::Zero();
  }
  void run(double seconds) {
    const auto count = std::lround(seconds / step_);
    for (long i = 0; i < count; ++i) {
      frame.time += step_;
      frame.p_WBall.head<2>() += velocity * step_;
      velocity *= std::exp(-1.06 * step_);
      for (FrameRobot& robot : frame.robots) robot.p_W.head<2>() += walk * step_;
      statistics.add(frame);
      frame.fouls.clear();
    }
  }
  void mode(PlayMode mode) { frame.mode = mode; }

  Frame frame;
  Vector2 velocity = Vector2::Zero();  // of the ball
  Vector2 walk = Vector2::Zero();      // of all robots
  MatchStatistics statistics;

 private:
  double step_;
};

// Rates at which streams come: our log, the real server's stream, a simulation.
class Statistics : public testing::TestWithParam<double> {
 protected:
  Script s{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Rates, Statistics, testing::Values(5.0, 25.0, 50.0));

TEST_P(Statistics, AFallIsCountedOnceAndTimed) {
  FrameRobot& robot = s.robot(0, 3, 0.0, 0.0);
  s.ballAt(5.0, 5.0);
  s.run(2.0);
  robot.up = 0.2;
  s.run(3.0);
  robot.up = 0.7;  // neither up nor down: still down
  s.run(1.0);
  robot.up = 0.3;
  s.run(1.0);
  robot.up = 0.99;
  s.run(2.0);
  const PlayerStatistics& player = s.statistics.team(0).players.at(3);
  EXPECT_EQ(player.falls, 1);
  EXPECT_NEAR(player.secondsDown, 5.0, 0.21);
}

TEST_P(Statistics, WalkedWayAndBestSpeeds) {
  s.robot(1, 4, -6.0, 1.0);
  s.ballAt(8.0, 8.0);
  s.run(1.0);
  s.walk = Vector2(0.6, 0.0);
  s.run(6.0);
  s.walk = Vector2(0.0, 0.9);
  s.run(1.2);
  s.walk = Vector2::Zero();
  s.run(1.0);
  s.robot(1, 4, 12.0, -8.0);  // the referee carries it away
  s.run(4.0);
  const PlayerStatistics& player = s.statistics.team(1).players.at(4);
  EXPECT_NEAR(player.walked, 0.6 * 6.0 + 0.9 * 1.2, 0.3);
  EXPECT_NEAR(player.bestSpeed1, 0.9, 0.02);
  EXPECT_LT(player.bestSpeed3, 0.7);
  EXPECT_GT(player.bestSpeed3, 0.58);
}

// A kick of 4 m/s at (0, 0) along x, after a second of rest; stopped by `receiver` 3 m away.
void kickTo(Script& s, TeamIndex receiver, int unum) {
  s.robot(0, 5, -0.2, 0.0);
  s.robot(receiver, unum, 3.2, 0.0);
  s.robot(1, 9, -10.0, 8.0);
  s.ballAt(0.0, 0.0);
  s.run(1.0);
  s.velocity = Vector2(4.0, 0.0);
  while (s.frame.p_WBall.x() < 3.0) s.run(0.2);
  s.velocity = Vector2(0.0, 0.0);
  s.run(0.6);
  s.velocity = Vector2(0.0, -0.6);  // and rolls on from its foot
  s.run(1.0);
}

TEST_P(Statistics, APassToAMate) {
  kickTo(s, 0, 6);
  const TeamStatistics& team = s.statistics.team(0);
  EXPECT_EQ(team.passesTried, 1);
  EXPECT_EQ(team.passesCompleted, 1);
  ASSERT_EQ(team.kicks.size(), 1U);
  EXPECT_EQ(team.kicks[0].outcome, "mate");
  EXPECT_EQ(team.kicks[0].unum, 5);
  EXPECT_NEAR(team.kicks[0].speed, 4.0, 0.5);
  EXPECT_NEAR(team.kicks[0].distance(), 3.2, 0.5);
  EXPECT_FALSE(team.kicks[0].shot) << "15 m before the goal";
  EXPECT_EQ(team.players.at(5).kicks, 1);
  EXPECT_EQ(s.statistics.team(1).passesTried, 0);
}

// The ball leaves the foot between two pictures, so it is still getting faster when it comes past a mate.
TEST_P(Statistics, AKickPastAMateIsOneTouch) {
  s.robot(0, 5, -0.2, 0.0);
  s.robot(0, 6, 0.5, 0.3);
  s.robot(1, 3, 3.0, 0.0);
  s.ballAt(-0.06, 0.0);
  s.run(1.0);
  s.velocity = Vector2(0.2, 0.0);  // pushed first
  s.run(0.4);
  s.velocity = Vector2(2.0, 0.0);
  s.run(1.0 / GetParam());
  s.velocity = Vector2(4.0, 0.0);
  s.run(1.2);
  s.velocity = Vector2(0.0, -0.6);  // from the opponent's foot
  s.run(1.0);
  const TeamStatistics& team = s.statistics.team(0);
  ASSERT_EQ(team.kicks.size(), 1U);
  EXPECT_EQ(team.kicks[0].unum, 5);
  EXPECT_EQ(team.kicks[0].outcome, "opponent");
  EXPECT_NEAR(team.kicks[0].speed, 4.0, 0.5);
  EXPECT_EQ(team.players.at(6).touches, 0);
}

TEST_P(Statistics, KicksAreCountedByName) {
  kickTo(s, 0, 6);
  s.robot(0, 5, -0.2, 0.0).kick = "kick_power";
  kickTo(s, 0, 6);
  s.robot(0, 6, -8.0, -8.0);
  kickTo(s, 1, 6);
  const auto kinds = s.statistics.team(0).kicksByName();
  ASSERT_TRUE(kinds.contains("kick_power"));
  const KickKind& named = kinds.at("kick_power");
  EXPECT_EQ(named.count, 2);
  EXPECT_NEAR(named.distance / 2.0, 3.2, 0.5);
  EXPECT_EQ(named.outcomes.at("mate"), 1);
  EXPECT_EQ(named.outcomes.at("opponent"), 1);
  EXPECT_EQ(kinds.at("").count, 1) << "the first one, without a name";
}

TEST_P(Statistics, APassToTheOpponentIsLost) {
  kickTo(s, 1, 6);
  EXPECT_EQ(s.statistics.team(0).passesTried, 1);
  EXPECT_EQ(s.statistics.team(0).passesCompleted, 0);
  EXPECT_EQ(s.statistics.team(0).kicks.at(0).outcome, "opponent");
  EXPECT_GT(s.statistics.team(1).possession, 0.5);
}

TEST_P(Statistics, RunningAfterTheOwnBallIsNoPass) {
  s.robot(0, 5, -0.2, 0.0);
  s.robot(1, 9, -10.0, 8.0);
  s.ballAt(0.0, 0.0);
  s.run(1.0);
  s.velocity = Vector2(4.0, 0.0);
  s.run(0.6);
  s.robot(0, 5, 3.2, 0.0);
  while (s.frame.p_WBall.x() < 3.0) s.run(0.2);
  s.velocity = Vector2(0.0, -0.6);
  s.run(1.6);
  EXPECT_EQ(s.statistics.team(0).kicks.size(), 1U);
  EXPECT_EQ(s.statistics.team(0).passesTried, 0);
}

TEST_P(Statistics, WhatComesFromASetPieceIsNoPass) {
  s.mode(PlayMode::KickInLeft);
  s.robot(0, 5, -0.2, 0.0);
  s.robot(0, 6, 3.2, 0.0);
  s.ballAt(0.0, 0.0);
  s.run(4.0);
  s.mode(PlayMode::PlayOn);
  s.velocity = Vector2(4.0, 0.0);
  while (s.frame.p_WBall.x() < 3.0) s.run(0.2);
  s.velocity = Vector2(0.0, -0.6);
  s.run(1.0);
  EXPECT_EQ(s.statistics.team(0).passesTried, 0);
  const SetPieceStatistics& piece = s.statistics.team(0).setPieces.at("kick_in");
  EXPECT_EQ(piece.count, 1);
  EXPECT_NEAR(piece.seconds, 4.0, 0.25);
  EXPECT_EQ(s.statistics.team(1).setPieces.size(), 0U);
}

// From 4 m before the right goal; `y` where the ball would cross the line.
void shoot(Script& s, TeamIndex team, double speed, double y) {
  s.robot(team, 9, 10.8, 0.0);
  s.robot(1 - team, 1, 14.7, y);
  s.ballAt(11.0, 0.0);
  s.run(1.0);
  s.velocity = Vector2(4.0, y).normalized() * speed;
}

TEST_P(Statistics, AGoalIsAShotOnTarget) {
  shoot(s, 0, 6.0, 0.5);
  s.robot(1, 1, 14.5, -3.0);
  s.run(1.0);
  s.frame.score = {1, 0};
  s.mode(PlayMode::GoalLeft);
  s.run(2.0);
  EXPECT_EQ(s.statistics.team(0).shots, 1);
  EXPECT_EQ(s.statistics.team(0).shotsOnTarget, 1);
  ASSERT_EQ(s.statistics.goals().size(), 1U);
  EXPECT_EQ(s.statistics.goals()[0].scorer, 9);
  EXPECT_FALSE(s.statistics.goals()[0].own);
  EXPECT_EQ(s.statistics.team(0).kicks.at(0).outcome, "goal");
  EXPECT_EQ(s.statistics.team(0).players.at(9).goals, 1);
}

TEST_P(Statistics, AGoalIsTimedFromTheKickOff) {
  s.robot(0, 9, 0.0, 0.0);
  s.mode(PlayMode::KickOffLeft);
  s.run(15.0);
  s.mode(PlayMode::PlayOn);
  s.run(6.0);
  s.mode(PlayMode::KickInLeft);  // no new beginning
  s.run(2.0);
  s.mode(PlayMode::PlayOn);
  s.run(1.0);
  s.frame.score = {1, 0};
  s.mode(PlayMode::GoalLeft);
  s.run(3.0);
  ASSERT_TRUE(s.statistics.goals().at(0).afterKickOff);
  EXPECT_NEAR(*s.statistics.goals()[0].afterKickOff, 9.0, 0.25);
  EXPECT_NEAR(s.statistics.toJson()["teams"][0]["kick_off_to_goal_s"].get<double>(), 9.0, 0.25);
  EXPECT_FALSE(s.statistics.toJson()["teams"][1].contains("kick_off_to_goal_s"));

  Script late(GetParam());  // the log begins in the middle of a half
  late.robot(0, 9, 0.0, 0.0);
  late.run(5.0);
  late.frame.score = {1, 0};
  late.mode(PlayMode::GoalLeft);
  late.run(1.0);
  EXPECT_FALSE(late.statistics.goals().at(0).afterKickOff);
}

TEST_P(Statistics, ASave) {
  shoot(s, 0, 6.0, 0.4);
  while (s.frame.p_WBall.x() < 14.4) s.run(0.2);
  s.velocity = Vector2(-1.0, 0.5);
  s.run(1.0);
  EXPECT_EQ(s.statistics.team(0).shotsOnTarget, 1);
  EXPECT_EQ(s.statistics.team(1).saves, 1);
  EXPECT_EQ(s.statistics.team(0).kicks.at(0).outcome, "saved");
}

TEST_P(Statistics, BesideTheGoalAndTooWeak) {
  shoot(s, 0, 6.0, 1.6);  // the goal ends at 1.05
  s.robot(1, 1, 14.5, -3.0);
  s.run(1.0);
  s.mode(PlayMode::GoalKickRight);
  s.run(1.0);
  EXPECT_EQ(s.statistics.team(0).shots, 1);
  EXPECT_EQ(s.statistics.team(0).shotsOnTarget, 0);
  EXPECT_EQ(s.statistics.team(0).kicks.at(0).outcome, "out");

  Script weak(GetParam());
  shoot(weak, 0, 2.5, 0.0);  // rolls 2.4 m of the 4 m
  weak.run(5.0);
  weak.robot(1, 1, weak.frame.p_WBall.x() + 0.15, 0.0);
  weak.velocity = Vector2(-1.0, 0.0);
  weak.run(1.0);
  EXPECT_EQ(weak.statistics.team(0).shots, 0);
  EXPECT_EQ(weak.statistics.team(0).passesTried, 1) << "a ball that went 2.4 m, to the opponent";
}

TEST_P(Statistics, TheOtherWayAfterSidesWereChanged) {
  s.frame.swapped = true;  // team 1 plays to the right now
  shoot(s, 1, 6.0, 0.5);
  s.robot(0, 1, 14.5, -3.0);
  s.run(1.0);
  s.frame.score = {0, 1};
  s.mode(PlayMode::GoalLeft);
  s.run(1.0);
  EXPECT_EQ(s.statistics.team(1).shotsOnTarget, 1);
  EXPECT_EQ(s.statistics.goals().at(0).team, 1);
  EXPECT_GT(s.statistics.team(1).kicks.at(0).to.x(), 14.0) << "towards +x, its own way";
  EXPECT_GT(s.statistics.thirds()[0], 0.0) << "the ball was in team 0's own third";
  EXPECT_EQ(s.statistics.thirds()[2], 0.0);
}

// Rolls against the goalkeeper at x = 14.2 and on with 1.5 m/s into the goal, or not.
void deflect(Script& s) {
  shoot(s, 0, 6.0, 0.4);
  while (s.frame.p_WBall.x() < 14.2) s.run(0.2);
  s.robot(1, 1, s.frame.p_WBall.x(), s.frame.p_WBall.y() + 0.1);
  s.velocity = Vector2(1.5, 0.5);
  s.run(0.6);
}

TEST_P(Statistics, AShotThatTheGoalkeeperDeflectsIntoTheGoalIsTheShootersGoal) {
  deflect(s);
  s.frame.score = {1, 0};
  s.mode(PlayMode::GoalLeft);
  s.run(1.0);
  ASSERT_EQ(s.statistics.goals().size(), 1U);
  EXPECT_FALSE(s.statistics.goals()[0].own);
  EXPECT_EQ(s.statistics.goals()[0].scorer, 9);
  EXPECT_EQ(s.statistics.team(0).players.at(9).goals, 1);
  EXPECT_EQ(s.statistics.team(0).kicks.at(0).outcome, "goal");
  EXPECT_EQ(s.statistics.team(1).saves, 0);
}

TEST_P(Statistics, ABallThatIsPushedIntoTheOwnGoalLongAfterAShotIsAnOwnGoal) {
  deflect(s);
  s.velocity = Vector2::Zero();
  s.run(4.0);
  s.velocity = Vector2(0.8, 0.0);
  s.run(0.4);
  s.frame.score = {1, 0};
  s.mode(PlayMode::GoalLeft);
  s.run(1.0);
  EXPECT_TRUE(s.statistics.goals().at(0).own);
  EXPECT_EQ(s.statistics.team(1).saves, 1);
}

TEST_P(Statistics, AnOwnGoal) {
  shoot(s, 1, 6.0, 0.0);  // team 1 defends the right goal
  s.robot(0, 1, -14.5, 0.0);
  s.run(1.0);
  s.frame.score = {1, 0};
  s.mode(PlayMode::GoalLeft);
  s.run(1.0);
  EXPECT_TRUE(s.statistics.goals().at(0).own);
  EXPECT_EQ(s.statistics.team(1).players.at(9).goals, 0);
}

TEST_P(Statistics, ADuelIsWonByWhoStaysAtTheBall) {
  s.robot(0, 5, -0.3, 0.0);
  s.robot(1, 6, 0.4, 0.0);
  s.ballAt(0.0, 0.0);
  s.run(2.0);
  s.robot(1, 6, 1.4, 0.0);
  s.run(1.0);
  s.robot(1, 6, 0.4, 0.0);
  s.run(GetParam() > 5.0 ? 0.3 : 0.2);  // too short to be one
  s.robot(1, 6, 1.4, 0.0);
  s.run(1.0);
  EXPECT_EQ(s.statistics.duels(), 1);
  EXPECT_EQ(s.statistics.team(0).duelsWon, 1);
  EXPECT_EQ(s.statistics.team(1).duelsWon, 0);
}

TEST_P(Statistics, FoulsByKind) {
  s.frame.fouls = {{6, 1, 4}, {6, 1, 5}, {1, 0, 3}};
  s.run(0.6);
  EXPECT_EQ(s.statistics.team(1).fouls.at("charging"), 2);
  EXPECT_EQ(s.statistics.team(0).fouls.at("touching"), 1);
  // Carried away for half a second: a record in every cycle is the same foul; one after two seconds is not.
  for (int i = 1; i <= 25; ++i) {
    s.frame.time += 0.02;
    s.frame.fouls = {{6, 1, 4}};
    s.statistics.add(s.frame);
  }
  EXPECT_EQ(s.statistics.team(1).fouls.at("charging"), 2);
  s.frame.time += 2.0;
  s.statistics.add(s.frame);
  EXPECT_EQ(s.statistics.team(1).fouls.at("charging"), 3);
}

// Nobody is near: rolling, bouncing off a post and being placed are nobody's touches.
TEST_P(Statistics, TheBallAloneIsNotTouched) {
  s.robot(0, 5, -8.0, 0.0);
  s.ballAt(0.0, 0.0);
  s.run(1.0);
  s.velocity = Vector2(3.0, 1.0);
  s.run(1.0);
  s.velocity = Vector2(-2.0, 1.0);
  s.run(1.0);
  s.ballAt(-7.0, 9.0);
  s.run(1.0);
  EXPECT_EQ(s.statistics.team(0).players.at(5).touches, 0);
  EXPECT_NEAR(s.statistics.secondsInPlay(), 4.0, 0.8) << "but for the moment when the ball was placed";
}

bool clockRuns(PlayMode mode) {
  return mode != PlayMode::BeforeKickOff && mode != PlayMode::GameOver;
}

// The monitor stream of a match gives the same frames as the match itself: positions to the 5 mm that the
// stream leaves out, everything else exactly.
TEST(FrameSources, StreamAndSimulationAgree) {
  MatchSettings settings;
  settings.left.players = settings.right.players = 2;
  settings.minutes = 4.0 / 60.0;
  settings.kickOffWait = 0.5;
  settings.settings.changeSidesInSecondHalf = true;
  settings.monitorLog =
      (std::filesystem::temp_directory_path() / ("nonet_frames_" + std::to_string(::getpid()) + ".log"))
          .string();
  SimulationFrames source;
  std::map<double, Frame> truth;
  std::size_t fouls = 0;
  MatchObservers observers;
  observers.afterCycle = [&](const sim::Simulation& simulation, const MatchWatcher&) {
    if (const Frame* frame = source.cycle(simulation)) {
      fouls += frame->fouls.size();
      if (clockRuns(frame->mode)) truth[frame->time] = *frame;
    }
    return true;
  };
  playInProcess(settings, NONET_SOURCE_DIR, 1, observers);

  int compared = 0;
  bool swapped = false;
  readMonitorLog(settings.monitorLog, [&](const MonitorFrames& stream) {
    const Frame& seen = stream.frame();
    EXPECT_EQ(stream.field().length, 30.0);
    if (stream.teams()[0].empty() || !clockRuns(seen.mode)) return;
    EXPECT_EQ(stream.teams()[0], settings.left.name);
    const auto near = truth.lower_bound(seen.time - 1e-3);
    if (near == truth.end() || std::abs(near->first - seen.time) > 1e-3) return;
    const Frame& is = near->second;
    ++compared;
    swapped = swapped || seen.swapped;
    EXPECT_EQ(seen.mode, is.mode);
    EXPECT_EQ(seen.swapped, is.swapped);
    EXPECT_LT((seen.p_WBall - is.p_WBall).norm(), 0.01);
    ASSERT_EQ(seen.robots.size(), is.robots.size());
    for (std::size_t i = 0; i < seen.robots.size(); ++i) {
      EXPECT_EQ(seen.robots[i].team, is.robots[i].team);
      EXPECT_EQ(seen.robots[i].unum, is.robots[i].unum);
      EXPECT_EQ(seen.robots[i].robotType, is.robots[i].robotType);
      EXPECT_LT((seen.robots[i].p_W - is.robots[i].p_W).norm(), 0.01);
      EXPECT_NEAR(seen.robots[i].up, is.robots[i].up, 0.006);
    }
  });
  EXPECT_GT(compared, 10);
  EXPECT_TRUE(swapped);
  std::filesystem::remove(settings.monitorLog);
}

// An empty field for a second, compressed.
void writeMonitorLog(const std::string& path) {
  sim::Simulation simulation{sim::Settings{}};
  sim::MonitorLog log(simulation, path, 1);
  for (int i = 0; i < 50; ++i) {
    simulation.step();
    log.cycle();
  }
}

// A log is torn by a power cut, and damaged by a disk: what comes before is read, and the rest is told.
TEST(FrameSources, ALogThatEndsEarlyIsTold) {
  using End = protocol::LogReader::End;
  const std::string path =
      (std::filesystem::temp_directory_path() / ("nonet_ends_" + std::to_string(::getpid()) + ".mon"))
          .string();
  int frames = 0;
  const auto read = [&] {
    frames = 0;
    return readMonitorLog(path, [&](const MonitorFrames&) { ++frames; });
  };
  writeMonitorLog(path);
  EXPECT_EQ(read().end, End::Whole);
  EXPECT_EQ(read().problem, "");
  EXPECT_EQ(frames, 50);

  // The last bytes are the checksum.
  const auto size = static_cast<std::streamoff>(std::filesystem::file_size(path));
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  file.seekg(size - 1);
  const int last = file.get();
  file.seekp(size - 1);
  file.put(static_cast<char>(last ^ 1));
  file.close();
  EXPECT_EQ(read().end, End::Damaged);
  EXPECT_NE(read().problem.find(path + ": the compressed data are damaged"), std::string::npos);
  EXPECT_GT(frames, 40) << "only the last piece is lost";

  std::filesystem::resize_file(path, static_cast<std::uintmax_t>(size) - 8);
  EXPECT_EQ(read().end, End::Torn);
  EXPECT_NE(read().problem.find(path + ": the file was not closed"), std::string::npos);
  EXPECT_GT(frames, 0);
  EXPECT_LT(frames, 50);
  std::filesystem::remove(path);
}

TEST(FrameSources, GarbageIsRefusedWithAReason) {
  MonitorFrames frames;
  for (const char* text : {"", "hello", "((time 1)", "((time 1))(RDS 0 1)((nd))",
                           "((time 1))(RSG 0 1)((nd TRF (SLT 1 2", "((time))(RSG 0 1)()", ")))((("}) {
    EXPECT_FALSE(frames.message(text)) << text;
  }
  EXPECT_THROW(
      readMonitorLog(std::string(NONET_TEST_DATA) + "/../CMakeLists.txt", [](const MonitorFrames&) {}),
      std::runtime_error);
}

}  // namespace
}  // namespace nonet::lab
