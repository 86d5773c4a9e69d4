#include "nonet/world/game_tracker.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nonet::world {

namespace {

using protocol::PlayMode;

constexpr double kDropBallTime = 15.0;  // s, RuleDropBallTime (server facts 4.1)
constexpr double kDropBallSlack = 0.5;  // s; a set piece that lasted this much less may have been dropped
constexpr double kSideMargin = 0.2;     // m beyond the halfway line that prove on which side one plays
constexpr double kCircleMargin = 2.3;   // m, the same at the kick-off: the centre circle is open to the taker

/// The phase for a mode of the left team, seen by that team, and its counterpart.
Phase phaseOf(PlayMode mode, bool fromRight) {
  const auto pick = [&](bool leftTakes, Phase own, Phase opponent) {
    return leftTakes != fromRight ? own : opponent;
  };
  switch (mode) {
    case PlayMode::BeforeKickOff:
      return Phase::BeforeKickOff;
    case PlayMode::PlayOn:
      return Phase::PlayOn;
    case PlayMode::GameOver:
      return Phase::GameOver;
    case PlayMode::KickOffLeft:
      return pick(true, Phase::OwnKickOff, Phase::OpponentKickOff);
    case PlayMode::KickOffRight:
      return pick(false, Phase::OwnKickOff, Phase::OpponentKickOff);
    case PlayMode::KickInLeft:
      return pick(true, Phase::OwnKickIn, Phase::OpponentKickIn);
    case PlayMode::KickInRight:
      return pick(false, Phase::OwnKickIn, Phase::OpponentKickIn);
    case PlayMode::CornerKickLeft:
      return pick(true, Phase::OwnCorner, Phase::OpponentCorner);
    case PlayMode::CornerKickRight:
      return pick(false, Phase::OwnCorner, Phase::OpponentCorner);
    case PlayMode::GoalKickLeft:
      return pick(true, Phase::OwnGoalKick, Phase::OpponentGoalKick);
    case PlayMode::GoalKickRight:
      return pick(false, Phase::OwnGoalKick, Phase::OpponentGoalKick);
    case PlayMode::GoalLeft:
      return pick(true, Phase::OwnGoal, Phase::OpponentGoal);
    case PlayMode::GoalRight:
      return pick(false, Phase::OwnGoal, Phase::OpponentGoal);
    case PlayMode::FreeKickLeft:
      return pick(true, Phase::OwnFreeKick, Phase::OpponentFreeKick);
    case PlayMode::FreeKickRight:
      return pick(false, Phase::OwnFreeKick, Phase::OpponentFreeKick);
    case PlayMode::DirectFreeKickLeft:
      return pick(true, Phase::OwnDirectFreeKick, Phase::OpponentDirectFreeKick);
    case PlayMode::DirectFreeKickRight:
      return pick(false, Phase::OwnDirectFreeKick, Phase::OpponentDirectFreeKick);
    case PlayMode::PassLeft:
      return pick(true, Phase::OwnPass, Phase::OpponentPass);
    case PlayMode::PassRight:
      return pick(false, Phase::OwnPass, Phase::OpponentPass);
    default:
      return Phase::Other;
  }
}

}  // namespace

GameTracker::GameTracker(const protocol::TeamName& team) : team_(team) {}

void GameTracker::update(const protocol::Percept& percept, GameState& state) {
  const protocol::GameStatus& game = percept.game;
  state.team = team_;
  if (game.unum) state.unum = *game.unum;
  if (game.side) {
    state.side = *game.side;
    state.sidesSwapped = false;
    sideKnown_ = true;
  }
  state.time = game.time;

  if (game.playMode == PlayMode::BeforeKickOff) {
    if (played_) {  // half time; also straight after a goal, since the clock runs in that mode
      state.half = 2;
      sideKnown_ = false;
      halfSince_ = percept.time;
    }
    played_ = false;
  } else if (game.playMode != PlayMode::Unknown && game.playMode != PlayMode::GameOver) {
    played_ = true;
  }
  // The score goes with the team: if it changes places at half time, the sides did.
  if (!sideKnown_ && game.scoreLeft && game.scoreRight && *game.scoreLeft != *game.scoreRight &&
      *game.scoreLeft == scoreRight_ && *game.scoreRight == scoreLeft_) {
    state.sidesSwapped = !state.sidesSwapped;
    sideKnown_ = true;
  }
  scoreLeft_ = game.scoreLeft.value_or(scoreLeft_);
  scoreRight_ = game.scoreRight.value_or(scoreRight_);
  const bool fromRight = playsFromRight(state);
  state.ownScore = fromRight ? scoreRight_ : scoreLeft_;
  state.opponentScore = fromRight ? scoreLeft_ : scoreRight_;
  state.playMode = game.playMode;
  setPhase(phaseOf(game.playMode, fromRight), percept.time, state);
  started_ = true;
}

void GameTracker::setPhase(Phase phase, double time, GameState& state) const {
  if (phase != state.phase || !started_) {
    const bool setPiece = isOwnSetPiece(state.phase) || isOpponentSetPiece(state.phase);
    state.ballDropped = setPiece && time - state.phaseSince >= kDropBallTime - kDropBallSlack;
    state.phase = phase;
    state.phaseSince = time;
  }
}

void GameTracker::noticePlace(double x_W, double time, GameState& state) {
  if (sideKnown_ || time <= halfSince_) return;
  double margin = 0.0;
  if (state.playMode == PlayMode::BeforeKickOff) {
    margin = kSideMargin;
  } else if (state.playMode == PlayMode::KickOffLeft || state.playMode == PlayMode::KickOffRight) {
    margin = kCircleMargin;
  } else {
    return;
  }
  const double ahead = playsFromRight(state) ? -x_W : x_W;
  if (std::abs(ahead) < margin) return;
  sideKnown_ = true;
  if (ahead < 0.0) return;
  state.sidesSwapped = !state.sidesSwapped;
  std::swap(state.ownScore, state.opponentScore);
  setPhase(phaseOf(state.playMode, playsFromRight(state)), time, state);
}

}  // namespace nonet::world
