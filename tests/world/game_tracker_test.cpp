// The game as the messages tell it: play modes from the own side, changes of sides, set pieces taken.
#include "nonet/world/game_tracker.h"

#include <gtest/gtest.h>

namespace nonet::world {
namespace {

using protocol::PlayMode;
using protocol::TeamSide;

protocol::Percept gameMessage(double time, PlayMode mode, double gameTime = 0.0) {
  protocol::Percept percept;
  percept.time = time;
  percept.game.playMode = mode;
  percept.game.time = gameTime;
  percept.game.scoreLeft = 1;
  percept.game.scoreRight = 0;
  return percept;
}

// A game from the first message on, which tells the side.
struct Game {
  explicit Game(TeamSide side, int scoreLeft = 1) {
    protocol::Percept first = gameMessage(1.0, PlayMode::BeforeKickOff);
    first.game.side = side;
    first.game.scoreLeft = scoreLeft;
    tracker.update(first, state);
  }
  void hear(double time, PlayMode mode, double gameTime = 0.0) {
    tracker.update(gameMessage(time, mode, gameTime), state);
  }
  void reachHalfTime(PlayMode last = PlayMode::PlayOn) {
    hear(2.0, last, 299.0);
    hear(3.0, PlayMode::BeforeKickOff, 300.0);
  }

  GameTracker tracker{protocol::TeamName("Us")};
  GameState state;
};

// The referee gives the ball free after 15 s (server facts 4.1); before that somebody has touched it.
TEST(GameTracker, KnowsWhetherTheSetPieceWasTaken) {
  for (const double lasted : {3.0, 14.0, 15.0, 15.04}) {
    GameTracker tracker(protocol::TeamName("Us"));
    GameState state;
    tracker.update(gameMessage(1.0, PlayMode::PlayOn), state);
    tracker.update(gameMessage(2.0, PlayMode::KickInLeft), state);
    tracker.update(gameMessage(2.0 + lasted, PlayMode::PlayOn), state);
    EXPECT_EQ(state.ballDropped, lasted >= 15.0) << lasted;
    tracker.update(gameMessage(30.0, PlayMode::PlayOn), state);
    EXPECT_EQ(state.ballDropped, lasted >= 15.0) << "as long as the phase lasts";
    tracker.update(gameMessage(31.0, PlayMode::KickInLeft), state);
    EXPECT_FALSE(state.ballDropped);
  }
}

TEST(GameTracker, SeesPlayModesFromTheOwnSide) {
  for (const TeamSide side : {TeamSide::Left, TeamSide::Right}) {
    GameTracker tracker(protocol::TeamName("Us"));
    GameState state;
    protocol::Percept percept = gameMessage(1.0, PlayMode::BeforeKickOff);
    percept.game.side = side;
    percept.game.unum = 5;
    tracker.update(percept, state);
    EXPECT_EQ(state.unum, 5);
    EXPECT_EQ(state.ownScore, side == TeamSide::Left ? 1 : 0);
    tracker.update(gameMessage(2.0, PlayMode::KickOffLeft), state);
    EXPECT_EQ(state.phase, side == TeamSide::Left ? Phase::OwnKickOff : Phase::OpponentKickOff);
    EXPECT_DOUBLE_EQ(state.phaseSince, 2.0);
    tracker.update(gameMessage(5.0, PlayMode::KickOffLeft), state);
    EXPECT_DOUBLE_EQ(state.phaseSince, 2.0);
    tracker.update(gameMessage(6.0, PlayMode::CornerKickRight), state);
    EXPECT_EQ(state.phase, side == TeamSide::Right ? Phase::OwnCorner : Phase::OpponentCorner);
    tracker.update(gameMessage(7.0, PlayMode::GoalLeft), state);
    EXPECT_EQ(state.phase, side == TeamSide::Left ? Phase::OwnGoal : Phase::OpponentGoal);
  }
}

TEST(GameTracker, ScoresThatChangePlacesTellTheChangeOfSides) {
  Game game(TeamSide::Left);
  auto& [tracker, state] = game;
  game.hear(2.0, PlayMode::PlayOn, 299.0);
  protocol::Percept second = gameMessage(3.0, PlayMode::BeforeKickOff, 300.0);
  second.game.scoreLeft = 0;
  second.game.scoreRight = 1;
  tracker.update(second, state);
  EXPECT_EQ(state.half, 2);
  EXPECT_TRUE(state.sidesSwapped);
  EXPECT_EQ(state.ownScore, 1);
  EXPECT_EQ(state.opponentScore, 0);
}

TEST(GameTracker, StaysWhenTheServerDoesNotChangeSides) {
  Game game(TeamSide::Right);
  auto& [tracker, state] = game;
  tracker.noticePlace(-3.0, 1.5, state);  // only after half time
  EXPECT_FALSE(state.sidesSwapped);
  game.reachHalfTime();
  EXPECT_FALSE(tracker.sideKnown());
  tracker.noticePlace(6.0, 3.06, state);  // own half of the right team
  EXPECT_TRUE(tracker.sideKnown());
  tracker.noticePlace(-6.0, 3.12, state);
  EXPECT_FALSE(state.sidesSwapped);
}

TEST(GameTracker, TheFirstMessageOfHalfTimeProvesNothing) {
  // The server has changed the sides and moved the robots, but its first message still shows them where they
  // stood: in the half that was theirs, or attacking in the other one.
  for (const bool changed : {false, true}) {
    for (const double before : {-8.0, 8.0}) {
      for (const PlayMode last : {PlayMode::PlayOn, PlayMode::GoalRight}) {
        Game game(TeamSide::Left, 0);  // the score does not help
        auto& [tracker, state] = game;
        game.reachHalfTime(last);
        tracker.noticePlace(before, 3.0, state);
        EXPECT_FALSE(tracker.sideKnown());
        EXPECT_FALSE(state.sidesSwapped);
        tracker.noticePlace(changed ? 2.5 : -2.5, 3.02, state);
        EXPECT_TRUE(tracker.sideKnown());
        EXPECT_EQ(state.sidesSwapped, changed);
      }
    }
  }
}

TEST(GameTracker, WhoCouldNotLookAroundFindsOutAtTheKickOff) {
  Game game(TeamSide::Left);
  auto& [tracker, state] = game;
  game.reachHalfTime();
  game.hear(8.0, PlayMode::KickOffLeft, 300.0);
  EXPECT_EQ(state.phase, Phase::OwnKickOff);
  tracker.noticePlace(1.0, 8.0, state);  // the taker of the kick-off may stand there
  EXPECT_FALSE(tracker.sideKnown());
  tracker.noticePlace(4.0, 8.06, state);
  EXPECT_TRUE(state.sidesSwapped);
  EXPECT_EQ(state.phase, Phase::OpponentKickOff);
}

}  // namespace
}  // namespace nonet::world
