// Play modes (server facts 4.3, 4.5, 4.7, 4.9): what the referee does in each.
#include <cmath>

#include <spdlog/spdlog.h>

#include "nonet/sim/referee/referee.h"

namespace nonet::sim {

void Referee::beforeKickOff(int clientCount) {
  if (clientCount == 0) return;
  moveBall(Vector3f(0.0F, 0.0F, c_.ballRadius()));
  c_.game.setPaused(true);
  if (!c_.settings.startAnyFieldPosition) {
    const float distance = static_cast<float>(c_.settings.freeKickMoveDist);
    c_.bothSidesInRandomOrder([&](TeamSide side) {
      placing_.clearBox(side == TeamSide::Left ? c_.areas.rightHalf : c_.areas.leftHalf, distance, side);
    });
  }
  float waited = 0.0F;
  if (p_.autoKickOffOrigin > c_.game.modeTime()) {
    p_.autoKickOffOrigin = c_.game.modeTime();
  } else {
    waited = c_.game.modeTime() - p_.autoKickOffOrigin;
  }
  if (c_.settings.automaticKickOff && waited > c_.settings.waitBeforeKickOff) kickOff(TeamSide::None);
}

void Referee::kickOffMode(TeamSide side, int clientCount) {
  c_.game.setPaused(false);
  resetKickChecks();
  p_.kickOffTeamMayScore = true;
  placing_.clearForKickOff(side);
  if (c_.settings.ruleDropBallTime > 0.0 && c_.game.modeTime() > c_.settings.ruleDropBallTime) {
    dropBall();
    return;
  }
  if (c_.ball.lastToucher.agent == kNoAgent || c_.ball.lastTouchTime <= c_.game.lastModeChange()) return;
  if (clientCount > 2 && !p_.shootout) {
    kickTaken(true);
    p_.kickOffTaker = c_.ball.lastToucher;
    p_.kickOffTeamMayScore = false;
  }
  c_.game.setPlayMode(PlayMode::PlayOn);
}

// Steps 1, 2 and 4 of server facts 4.7; clearing is the caller's.
bool Referee::setPieceRuns(TeamSide side) {
  c_.game.setPaused(false);
  if (c_.game.modeTime() < static_cast<float>(c_.settings.ruleKickInPauseTime)) {
    p_.repelKickers = true;
    return false;
  }
  resetKickChecks();
  const float distance = static_cast<float>(c_.settings.freeKickMoveDist);
  const PlayMode mode = c_.game.playMode();
  if (mode == PlayMode::GoalKickLeft || mode == PlayMode::GoalKickRight) {
    placing_.clearBox(c_.ownArea(side), distance, opponentOf(side));
  } else {
    placing_.clearCircle(p_.position, static_cast<float>(c_.settings.freeKickDistance), distance,
                         opponentOf(side));
  }
  if (c_.settings.ruleDropBallTime > 0.0 && c_.game.modeTime() > c_.settings.ruleDropBallTime) {
    dropBallAt(p_.position);
    return false;
  }
  return true;
}

// Step 3: touched by anybody, later than the pause.
bool Referee::setPieceTouched() const {
  const double from = c_.game.lastModeChange() + static_cast<float>(c_.settings.ruleKickInPauseTime) + 0.03;
  return c_.ball.lastToucher.agent != kNoAgent && c_.ball.lastTouchTime > from && !p_.repelKickers;
}

void Referee::holdBall(TeamSide side) {
  if (p_.repelKickers) {
    placing_.repel(p_.position, static_cast<float>(c_.settings.kickRepelDist), side, 0.0F);
    p_.repelKickers = false;
  }
  moveBall(p_.position);
}

void Referee::kickInMode(TeamSide side) {
  if (!setPieceRuns(side)) return;
  if (setPieceTouched()) {
    kickTaken(true);
    c_.game.setPlayMode(PlayMode::PlayOn);
  } else {
    holdBall(side);
  }
}

void Referee::freeKickMode(TeamSide side, bool indirect) {
  if (c_.game.modeTime() >= static_cast<float>(c_.settings.ruleKickInPauseTime)) {
    c_.areas.moveOutOfPenaltyArea(p_.position);
  }
  if (!setPieceRuns(side)) return;
  if (setPieceTouched()) {
    kickTaken(indirect);
    c_.game.setPlayMode(PlayMode::PlayOn);
  } else {
    holdBall(side);
  }
}

void Referee::cornerKickMode(TeamSide side) {
  if (!setPieceRuns(side)) return;
  // While nobody has ever touched the ball the server leaves it alone here.
  if (c_.ball.lastToucher.agent == kNoAgent) return;
  if (setPieceTouched()) {
    kickTaken(false);
    c_.game.setPlayMode(PlayMode::PlayOn);
  } else {
    holdBall(side);
  }
}

void Referee::goalKickMode(TeamSide side) {
  if (!setPieceRuns(side)) return;
  if (c_.ball.lastToucher.agent == kNoAgent) return;
  if (!setPieceTouched()) {
    holdBall(side);
    return;
  }
  const Vector2f ball = c_.world.ballPosition().head<2>();
  const Box2& area = c_.ownArea(side);
  if (area.contains(ball)) return;
  const bool beyondFront = side == TeamSide::Right ? ball.x() < area.low.x() : ball.x() > area.high.x();
  // Not while the ball lies on the goal line, outside the area but still on the field.
  if (!c_.ball.onField || beyondFront || ball.y() < area.low.y() || ball.y() > area.high.y()) {
    kickTaken(false);
    c_.game.setPlayMode(PlayMode::PlayOn);
  }
}

void Referee::passMode(TeamSide side, int clientCount) {
  GameState& game = c_.game;
  const std::size_t s = index(side);
  const PlayMode mode = game.playMode();
  game.setPaused(false);
  game.setLastPassModeTime(side, game.time());
  p_.passToucher[s] = -1;
  p_.passSeveralTouched[s] = false;
  p_.passBallLeft[s] = false;
  game.setPassModeClearedToScore(side, false);
  game.setLastPassModeTime(opponentOf(side), -1000.0F);

  const bool touched =
      c_.ball.lastToucher.agent != kNoAgent && c_.ball.lastTouchTime >= game.lastModeChange();
  if (game.modeTime() >= c_.settings.passModeDuration || touched) game.setPlayMode(PlayMode::PlayOn);
  playOn(clientCount);
  if (game.playMode() == mode) {
    const Vector3f ball = c_.world.ballPosition();
    p_.passBallPosition[s] = ball;
    placing_.repel(ball, static_cast<float>(c_.settings.passModeMinOppBallDist), opponentOf(side), 0.1F);
  }
}

void Referee::goalMode(TeamSide scorer) {
  const TeamSide kicking = opponentOf(scorer);
  placing_.clearForKickOff(kicking);
  c_.game.setPaused(true);
  if (c_.game.modeTime() < static_cast<float>(c_.settings.ruleGoalPauseTime)) return;
  moveBall(Vector3f(0.0F, 0.0F, c_.ballRadius()));
  kickOff(kicking);
}

void Referee::playOn(int clientCount) {
  c_.game.setPaused(false);
  watchPassMode();
  if (punishDoubleTouch()) return;
  if (checkGoal(clientCount)) return;
  checkBallOut();
}

// Server facts 4.9: two players must have touched the ball, and it must have left its circle, before the team
// may score.
void Referee::watchPassMode() {
  GameState& game = c_.game;
  TeamSide side = TeamSide::None;
  if (game.passModeScoreWait(TeamSide::Left, c_.settings) > 0.0F) {
    side = TeamSide::Left;
  } else if (game.passModeScoreWait(TeamSide::Right, c_.settings) > 0.0F) {
    side = TeamSide::Right;
  } else {
    return;
  }
  const std::size_t s = index(side);
  if (horizontalDistance(c_.world.ballPosition(), p_.passBallPosition[s]) >=
      c_.settings.passModeMinOppBallDist) {
    p_.passBallLeft[s] = true;
  }
  for (const Toucher& toucher : c_.ball.touchers) {
    if (toucher.side != side) continue;
    if (p_.passToucher[s] > 0 && (p_.passToucher[s] != toucher.unum || p_.passSeveralTouched[s])) {
      p_.passSeveralTouched[s] = true;
      if (p_.passBallLeft[s]) game.setPassModeClearedToScore(side, true);
      return;
    }
    p_.passToucher[s] = toucher.unum;
  }
}

bool Referee::lastKickWasSetPiece() const {
  if (p_.taker.agent == kNoAgent || c_.ball.lastToucher.agent == kNoAgent) return false;
  constexpr double kKickDuration = 0.1;  // s
  return c_.ball.lastTouchTime - p_.kickTime < kKickDuration &&
         present(c_.ball.lastToucher).samePlayer(present(p_.taker));
}

bool Referee::punishDoubleTouch() {
  if (!p_.watchDoubleTouch || p_.taker.agent == kNoAgent || lastKickWasSetPiece()) return false;
  p_.watchDoubleTouch = false;
  p_.indirect = false;
  const Toucher taker = present(p_.taker);
  if (!present(c_.ball.lastToucher).samePlayer(taker)) return false;
  spdlog::info("referee: double touch by player {}", taker.unum);
  awardFreeKick(opponentOf(taker.side));
  return true;
}

// Server facts 4.5, "Goal": by the trigger box, or else from the ball's position and velocity.
TeamSide Referee::goalSide() const {
  if (c_.ball.goal != World::Goal::None) {
    return c_.ball.goal == World::Goal::Left ? TeamSide::Left : TeamSide::Right;
  }
  const Vector3f ball = c_.world.ballPosition();
  const float goalLine = c_.halfLength() + c_.ballRadius();
  const float beyond = std::abs(ball.x()) - goalLine;
  if (beyond < 0.0F) return TeamSide::None;
  const Vector3f velocity = c_.world.ballVelocity();
  if (std::abs(ball.x() - velocity.x()) > goalLine) return TeamSide::None;
  const float speed = velocity.norm();
  const Vector3f direction = speed > 0.0F ? Vector3f(velocity / speed) : velocity;
  // The sign is wrong for the left goal, as in the server: there the line is followed forwards.
  const Vector3f crossing = ball - direction * (beyond / direction.x());
  const bool through = std::abs(crossing.y()) < static_cast<float>(c_.settings.goalWidth) / 2.0F &&
                       crossing.z() < static_cast<float>(c_.settings.goalHeight);
  if (!through) return TeamSide::None;
  return ball.x() < 0.0F ? TeamSide::Left : TeamSide::Right;
}

bool Referee::checkGoal(int clientCount) {
  const TeamSide goal = goalSide();
  if (goal == TeamSide::None) return false;
  const TeamSide scorer = opponentOf(goal);
  const TeamSide kickOffTeam = present(p_.kickOffTaker).side;
  if (!p_.kickOffTeamMayScore && goal != kickOffTeam) {
    punishIndirectGoal(kickOffTeam, goal);
    return true;
  }
  if (lastKickWasSetPiece() && clientCount > 2 && !p_.shootout) {
    const TeamSide kicker = present(c_.ball.lastToucher).side;
    if (p_.indirect || kicker == goal) {
      punishIndirectGoal(kicker, goal);
      return true;
    }
  }
  if (c_.game.passModeScoreWait(scorer, c_.settings) > 0.0F) {
    awardGoalKick(goal);
    return true;
  }
  c_.game.scoreGoal(scorer);
  c_.game.setPlayMode(scorer == TeamSide::Left ? PlayMode::GoalLeft : PlayMode::GoalRight);
  spdlog::info("referee: goal for {} at {:.2f}, {} : {}", std::string_view(c_.game.teamName(scorer)),
               c_.game.time(), c_.game.score(TeamSide::Left), c_.game.score(TeamSide::Right));
  return true;
}

void Referee::punishIndirectGoal(TeamSide kicker, TeamSide goal) {
  p_.indirect = false;
  if (kicker == goal) {
    awardCornerKick(opponentOf(kicker));
  } else {
    awardGoalKick(goal);
  }
}

// Server facts 4.5, "Ball out".
bool Referee::checkBallOut() {
  if (c_.ball.onField) {
    p_.position = c_.ball.lastValidPosition;
    p_.position.z() = c_.ballRadius();
    return false;
  }
  if (c_.ball.lastToucher.agent == kNoAgent) return true;
  const Toucher last = present(c_.ball.lastToucher);
  const Vector3f ball = c_.world.ballPosition();
  if (std::abs(ball.x()) >= c_.halfLength()) {
    const TeamSide end = ball.x() < 0.0F ? TeamSide::Left : TeamSide::Right;
    // A toucher without team counts as right here.
    const TeamSide toucher = last.side == TeamSide::Left ? TeamSide::Left : TeamSide::Right;
    if (toucher != end) {
      awardGoalKick(end);
    } else {
      awardCornerKick(opponentOf(toucher));
    }
  } else if (std::abs(ball.y()) >= c_.halfWidth()) {
    awardKickIn(opponentOf(last.side));
  } else {
    moveBall(c_.ball.lastValidPosition);
    return false;
  }
  return true;
}

void Referee::awardGoalKick(TeamSide side) {
  const float x = c_.halfLength() - static_cast<float>(c_.settings.goalKickDist);
  p_.position = Vector3f(side == TeamSide::Left ? -x : x, 0.0F, c_.ballRadius());
  p_.repelKickers = true;
  c_.game.setPlayMode(side == TeamSide::Left ? PlayMode::GoalKickLeft : PlayMode::GoalKickRight);
}

// Half way between the goal post and the corner, not at the corner.
void Referee::awardCornerKick(TeamSide side) {
  const float x = c_.halfLength() - c_.ballRadius();
  const float y =
      (2.0F * c_.halfWidth() + static_cast<float>(c_.settings.goalWidth)) / 4.0F - c_.ballRadius();
  p_.position =
      Vector3f(side == TeamSide::Left ? x : -x, c_.world.ballPosition().y() > 0.0F ? y : -y, c_.ballRadius());
  p_.repelKickers = true;
  c_.game.setPlayMode(side == TeamSide::Left ? PlayMode::CornerKickLeft : PlayMode::CornerKickRight);
}

void Referee::awardKickIn(TeamSide side) {
  if (side == TeamSide::None)
    return;  // the last toucher has no team: the ball stays outside, as in the server
  const float y = c_.halfWidth() - c_.ballRadius();
  p_.position = c_.ball.lastValidPosition;
  p_.position.y() = p_.position.y() > 0.0F ? y : -y;
  p_.position.z() = c_.ballRadius();
  p_.repelKickers = true;
  c_.game.setPlayMode(side == TeamSide::Left ? PlayMode::KickInLeft : PlayMode::KickInRight);
}

void Referee::awardFreeKick(TeamSide side) {
  if (side == TeamSide::None) return;
  p_.repelKickers = true;
  c_.game.setPlayMode(side == TeamSide::Left ? PlayMode::FreeKickLeft : PlayMode::FreeKickRight);
}

}  // namespace nonet::sim
