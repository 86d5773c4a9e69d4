#include "nonet/sim/referee/game_state.h"

#include <algorithm>

#include <spdlog/spdlog.h>

#include "nonet/protocol/effectors.h"

namespace nonet::sim {

GameState::GameState(const Settings& settings) {
  if (!settings.coinTossForKickOff) nextHalfKickOff_ = TeamSide::Left;
  teams_[0].name.assign(settings.leftTeam);
  teams_[1].name.assign(settings.rightTeam);
  const float radius = static_cast<float>(settings.agentRadius);
  const float x = static_cast<float>(settings.fieldLength) / 2.0F - radius * 2.0F;
  const float y = static_cast<float>(settings.fieldWidth) / 2.0F - radius * 2.0F;
  nextLeftStart_ = Vector3f(-x, y, radius);
  nextRightStart_ = Vector3f(x, y, radius);
}

void GameState::advance(float seconds) {
  switch (playMode_) {
    case PlayMode::BeforeKickOff:
      beforeKickOffTime_ += seconds;
      break;
    case PlayMode::GameOver:
      gameOverTime_ += seconds;
      break;
    default:
      time_ += seconds;
  }
}

void GameState::setPlayMode(PlayMode mode) {
  if (mode == playMode_) return;
  spdlog::debug("play mode {} at t={:.2f}", protocol::playModeName(mode), time_);
  playMode_ = mode;
  lastModeChange_ = time_;
  beforeKickOffTime_ = 0.0F;
  gameOverTime_ = 0.0F;
}

float GameState::modeTime() const {
  switch (playMode_) {
    case PlayMode::BeforeKickOff:
      return beforeKickOffTime_;
    case PlayMode::GameOver:
      return gameOverTime_;
    default:
      return time_ - lastModeChange_;
  }
}

void GameState::kickOff(TeamSide side, const Settings& settings, Random& random) {
  if (side == TeamSide::None) {
    side = random.uniform() <= 0.5 ? TeamSide::Left : TeamSide::Right;
    if (half_ != lastKickOffHalf_) {
      if (nextHalfKickOff_ != TeamSide::None) side = nextHalfKickOff_;
      nextHalfKickOff_ = settings.changeSidesInSecondHalf ? side : opponentOf(side);
    }
  }
  setPlayMode(side == TeamSide::Left ? PlayMode::KickOffLeft : PlayMode::KickOffRight);
  lastKickOffHalf_ = half_;
}

TeamSide GameState::sideOfTeam(std::string_view name) {
  const auto sideOfSlot = [this](int slot) { return slot == leftSlot_ ? TeamSide::Left : TeamSide::Right; };
  for (int slot = 0; slot < 2; ++slot) {
    if (teams_[slot].name == name) return sideOfSlot(slot);
  }
  for (int slot = 0; slot < 2; ++slot) {
    if (teams_[slot].name.empty()) {
      teams_[slot].name.assign(name);
      return sideOfSlot(slot);
    }
  }
  return TeamSide::None;
}

// Server facts 1.4.
bool GameState::typeAllowed(const Team& team, int type, const Settings& settings) const {
  int robots = 0;
  int types = 0;
  int largestSum = 0;
  for (int other = 0; other < kTypes; ++other) {
    robots += team.typeCount[other];
    types += team.typeCount[other] > 0 ? 1 : 0;
    const int sum = team.typeCount[type] + 1 + (other == type ? 0 : team.typeCount[other]);
    largestSum = std::max(largestSum, sum);
  }
  if (team.typeCount[type] >= settings.maxRobotTypeCount) return false;
  if (largestSum > settings.maxSumTwoRobotTypes) return false;
  const bool newTypeNeeded = kMaxUnum - robots <= settings.minRobotTypesCount - types;
  return !newTypeNeeded || team.typeCount[type] == 0;
}

GameState::Refusal GameState::registerPlayer(std::string_view name, int robotType, TeamSide& side, int& unum,
                                             const Settings& settings) {
  // A name that is refused must not take a side. The type is an index below.
  if (!protocol::isTeamName(name)) return Refusal::TeamName;
  if (robotType < 0 || robotType >= kTypes) return Refusal::TypeRule;
  const TeamSide wanted = sideOfTeam(name);
  if (wanted == TeamSide::None) return Refusal::ThirdTeam;
  Team& team = this->team(wanted);
  int number = unum;
  if (number == 0) {
    number = 1;
    while (number <= kMaxUnum && team.numberUsed[number]) ++number;
    if (number > kMaxUnum) return Refusal::NumberTaken;
  }
  // The server does not check the range and writes beyond its tables (server facts 1.3); here it is a
  // refusal.
  if (number < 1 || number > kMaxUnum) return Refusal::NumberRange;
  if (team.numberUsed[number]) return Refusal::NumberTaken;
  if (!typeAllowed(team, robotType, settings)) return Refusal::TypeRule;
  team.numberUsed[number] = true;
  ++team.typeCount[robotType];
  side = wanted;
  unum = number;
  return Refusal::None;
}

void GameState::releasePlayer(TeamSide side, int unum, int robotType) {
  if (side == TeamSide::None) return;
  Team& team = this->team(side);
  team.numberUsed[unum] = false;
  team.typeCount[robotType] = std::max(0, team.typeCount[robotType] - 1);
}

// Both sides walk down their column and step to larger x when it is full (server facts 1.3).
Vector3f GameState::nextStartPosition(TeamSide side, const Settings& settings) {
  if (side == TeamSide::None) return Vector3f(0.0F, 0.0F, 10.0F);
  const float radius = static_cast<float>(settings.agentRadius);
  const float halfWidth = static_cast<float>(settings.fieldWidth) / 2.0F;
  Vector3f& next = side == TeamSide::Left ? nextLeftStart_ : nextRightStart_;
  Vector3f position = next;
  next.y() -= radius * 3.0F;
  if (next.y() < -halfWidth) {
    next.y() = halfWidth - radius * 2.0F;
    next.x() += radius * 2.0F;
  }
  return position;
}

float GameState::startYaw(TeamSide side) {
  return side == TeamSide::Left ? -90.0F : side == TeamSide::Right ? 90.0F : 0.0F;
}

TeamName GameState::teamName(TeamSide side) const {
  return side == TeamSide::None ? TeamName{} : team(side).name;
}

int GameState::score(TeamSide side) const {
  return side == TeamSide::None ? 0 : team(side).score;
}

void GameState::scoreGoal(TeamSide side) {
  if (side != TeamSide::None) ++team(side).score;
}

// The trainer's command sets the slots, not the sides: after a change of sides "left" is the team that began
// left.
void GameState::setScores(int left, int right) {
  teams_[0].score = left;
  teams_[1].score = right;
}

void GameState::swapSides() {
  leftSlot_ = 1 - leftSlot_;
}

float GameState::lastPassModeTime(TeamSide side) const {
  return side == TeamSide::None ? 0.0F : team(side).lastPassModeTime;
}

void GameState::setLastPassModeTime(TeamSide side, float time) {
  if (side != TeamSide::None) team(side).lastPassModeTime = time;
}

bool GameState::passModeClearedToScore(TeamSide side) const {
  return side != TeamSide::None && team(side).clearedToScore;
}

void GameState::setPassModeClearedToScore(TeamSide side, bool cleared) {
  if (side != TeamSide::None) team(side).clearedToScore = cleared;
}

float GameState::passModeScoreWait(TeamSide side, const Settings& settings) const {
  const float passed = time_ - lastPassModeTime(side);
  const float wait = static_cast<float>(settings.passModeScoreWaitTime);
  return passed < wait && !passModeClearedToScore(side) ? wait - passed : 0.0F;
}

}  // namespace nonet::sim
