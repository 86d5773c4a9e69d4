#include "nonet/sim/referee/referee.h"

#include <algorithm>
#include <cmath>

#include <spdlog/spdlog.h>

#include "sim/physics/state_bytes.h"

namespace nonet::sim {

Referee::Referee(const Settings& settings, World& world, std::vector<Player>& players, std::uint64_t seed)
    : c_(settings, world, players, seed), placing_(c_), fouls_(c_, placing_) {
  p_.position = Vector3f(0.0F, 0.0F, c_.ballRadius());
  p_.shootout = settings.penaltyShootout;
  resetKickChecks();
  fouls_.reset();
}

// The order within a cycle: server facts 1.2 (phase 6) and section 4.
void Referee::update(int clientCount) {
  fouls_.collectContacts();
  c_.game.advance(kServerCycleTime);
  updateBall();
  updateClock();
  updateKickOffScoring();
  updateMode(clientCount);
  fouls_.sampleVelocities();
  updateKeepaway();
  if (p_.shootout && c_.game.playMode() == PlayMode::GoalLeft) p_.shootout = false;
  if (c_.game.paused()) {
    fouls_.reset();
  } else {
    fouls_.update();
    updateShootout();
  }
}

void Referee::changeNumber(const Player& player) {
  fouls_.thaw(player);
  fouls_.forgetContacts(player);
}

Toucher Referee::present(const Toucher& toucher) const {
  for (const Player& player : c_.players) {
    if (player.agent == toucher.agent) return {player.agent, player.side, player.unum};
  }
  return toucher;
}

void Referee::updateBall() {
  BallState& ball = c_.ball;
  ball.touchers.clear();
  const auto touches = [this](const Player& player) {
    const auto contacts = c_.world.contacts();
    return std::any_of(contacts.begin(), contacts.end(), [&player](const ContactPair& pair) {
      const bool ballFirst = pair.first.kind == ContactParty::Kind::Ball;
      const ContactParty& ballParty = ballFirst ? pair.first : pair.second;
      const ContactParty& other = ballFirst ? pair.second : pair.first;
      return ballParty.kind == ContactParty::Kind::Ball && other.kind == ContactParty::Kind::Robot &&
             other.robot == player.robot;
    });
  };
  for (const Player& player : c_.players) {
    if (touches(player)) ball.touchers.push_back({player.agent, player.side, player.unum});
  }
  // Of several in one cycle the server takes the one with the lowest address in memory. That is most often
  // the robot that was built first, and so it is always here.
  if (!ball.touchers.empty()) {
    ball.lastToucher = ball.touchers.front();
    ball.lastTouchTime = c_.game.time();
  }
  const Vector3f position = c_.world.ballPose().position;
  const double margin = static_cast<double>(c_.ballRadius()) + 0.001;
  ball.onField =
      std::abs(position.x()) < c_.halfLength() + margin && std::abs(position.y()) < c_.halfWidth() + margin;
  if (ball.onField) ball.lastValidPosition = position;
  ball.goal = c_.world.ballInGoal();
}

// Server facts 4.2.
void Referee::updateClock() {
  GameState& game = c_.game;
  const float halfTime = static_cast<float>(c_.settings.ruleHalfTime);
  if (game.half() == 1 && game.time() >= halfTime) {
    if (c_.settings.singleHalfTime) {
      game.setPlayMode(PlayMode::GameOver);
    } else {
      game.setPlayMode(PlayMode::BeforeKickOff);
      game.setHalf(2);
      if (c_.settings.changeSidesInSecondHalf) swapSides();
    }
  } else if (game.half() == 2 && game.time() >= 2.0F * halfTime) {
    game.setPlayMode(PlayMode::GameOver);
  }
}

void Referee::swapSides() {
  fouls_.reset();  // while the records still belong to the same robots
  c_.game.swapSides();
  for (Player& player : c_.players) player.side = opponentOf(player.side);
  const auto swapToucher = [](Toucher& toucher) { toucher.side = opponentOf(toucher.side); };
  swapToucher(c_.ball.lastToucher);
  swapToucher(p_.taker);
  swapToucher(p_.kickOffTaker);
  for (Toucher& toucher : c_.ball.touchers) swapToucher(toucher);
  fouls_.forgetContacts();
}

// Server facts 4.3: when the team that kicked off may score.
void Referee::updateKickOffScoring() {
  if (p_.kickOffTeamMayScore) return;
  const TeamSide side = present(p_.kickOffTaker).side;
  const Vector2f ball = c_.world.ballPosition().head<2>();
  p_.kickOffTeamMayScore =
      c_.ball.touchedBy(opponentOf(side)) ||
      (c_.ball.touchedBy(side) && ball.norm() > static_cast<float>(c_.settings.freeKickDistance));
}

void Referee::updateMode(int clientCount) {
  const TeamSide left = TeamSide::Left;
  const TeamSide right = TeamSide::Right;
  switch (c_.game.playMode()) {
    case PlayMode::BeforeKickOff:
      return beforeKickOff(clientCount);
    case PlayMode::PlayOn:
      return playOn(clientCount);
    case PlayMode::KickOffLeft:
      return kickOffMode(left, clientCount);
    case PlayMode::KickOffRight:
      return kickOffMode(right, clientCount);
    case PlayMode::FreeKickLeft:
      return freeKickMode(left, true);
    case PlayMode::FreeKickRight:
      return freeKickMode(right, true);
    case PlayMode::DirectFreeKickLeft:
      return freeKickMode(left, false);
    case PlayMode::DirectFreeKickRight:
      return freeKickMode(right, false);
    case PlayMode::KickInLeft:
      return kickInMode(left);
    case PlayMode::KickInRight:
      return kickInMode(right);
    case PlayMode::GoalKickLeft:
      return goalKickMode(left);
    case PlayMode::GoalKickRight:
      return goalKickMode(right);
    case PlayMode::CornerKickLeft:
      return cornerKickMode(left);
    case PlayMode::CornerKickRight:
      return cornerKickMode(right);
    case PlayMode::PassLeft:
      return passMode(left, clientCount);
    case PlayMode::PassRight:
      return passMode(right, clientCount);
    case PlayMode::GoalLeft:
      return goalMode(left);
    case PlayMode::GoalRight:
      return goalMode(right);
    case PlayMode::GameOver:
      // AutomaticQuit sets a flag in the server that nothing reads (server facts 4.2): no effect here either.
      c_.game.setPaused(false);
      return;
    case PlayMode::OffsideLeft:
    case PlayMode::OffsideRight:
    case PlayMode::Unknown:
      return;  // dead ends, as in the server (server facts 4.7)
  }
}

// Server facts 4.11.
void Referee::updateKeepaway() {
  const Settings& s = c_.settings;
  if (!s.keepaway || c_.game.time() <= 0.0F) return;
  const double minutes = c_.game.time() / 60.0;
  const double halfLength = s.keepawayLength / 2.0 - s.keepawayLengthReductionRate / 2.0 * minutes;
  const double halfWidth = s.keepawayWidth / 2.0 - s.keepawayWidthReductionRate / 2.0 * minutes;
  const Vector3f ball = c_.world.ballPosition();
  const bool outside = ball.x() < s.keepawayCenterX - halfLength ||
                       ball.x() > s.keepawayCenterX + halfLength ||
                       ball.y() < s.keepawayCenterY - halfWidth || ball.y() > s.keepawayCenterY + halfWidth;
  if (outside || c_.ball.touchedBy(TeamSide::Right)) c_.game.setPlayMode(PlayMode::GameOver);
}

// Server facts 4.11: a goalkeeper that leaves its area scores for the left team.
void Referee::updateShootout() {
  if (!p_.shootout) return;
  const Box2& area = c_.areas.rightPenaltyArea;
  for (const Player* player : c_.team(TeamSide::Right)) {
    const Vector3f torso = c_.sceneTorso(*player);
    if (torso.x() >= area.low.x() && torso.y() >= area.low.y() && torso.y() <= area.high.y()) continue;
    p_.shootout = false;
    c_.game.scoreGoal(TeamSide::Left);
    c_.game.setPlayMode(PlayMode::GoalLeft);
  }
}

void Referee::moveBall(const Vector3f& position) {
  c_.world.setBallPosition(position);
  c_.world.setBallVelocity(Vector3f::Zero());
  p_.position = Vector3f(position.x(), position.y(), c_.ballRadius());
}

void Referee::dropBall() {
  dropBallAt(c_.world.ballPosition());
}

void Referee::dropBallAt(Vector3f position) {
  c_.areas.moveOutOfPenaltyArea(position);
  const float halfWidth = c_.halfWidth();
  if (position.y() <= -halfWidth) {
    position.y() = -halfWidth + c_.ballRadius();
  } else if (position.y() >= halfWidth) {
    position.y() = halfWidth - c_.ballRadius();
  }
  moveBall(position);
  c_.bothSidesInRandomOrder([&](TeamSide side) {
    placing_.clearCircle(position, static_cast<float>(c_.settings.freeKickDistance),
                         static_cast<float>(c_.settings.freeKickMoveDist), side);
  });
  resetKickChecks();
  c_.game.setPlayMode(PlayMode::PlayOn);
}

void Referee::resetKickChecks() {
  p_.watchDoubleTouch = false;
  p_.indirect = false;
  c_.game.setLastPassModeTime(TeamSide::Left, -1000.0F);
  c_.game.setLastPassModeTime(TeamSide::Right, -1000.0F);
}

void Referee::kickTaken(bool indirect) {
  p_.watchDoubleTouch = true;
  p_.kickTime = c_.ball.lastTouchTime;
  p_.taker = c_.ball.lastToucher;
  p_.indirect = indirect;
}

// Server facts 4.9.
bool Referee::requestPassMode(const Player& player) {
  const Settings& s = c_.settings;
  GameState& game = c_.game;
  const TeamSide opponent = opponentOf(player.side);
  const Vector3f ball = c_.world.ballPosition();
  if (player.side == TeamSide::None || game.playMode() != PlayMode::PlayOn) return false;
  if (game.time() - game.lastPassModeTime(player.side) < s.passModeRetryWaitTime) return false;
  if (c_.ball.touchedBy(player.side)) return false;
  if (c_.world.ballVelocity().norm() > s.passModeMaxBallSpeed) return false;
  if (c_.records.of(player).ballDistance > s.passModeMaxBallDist) return false;
  if (horizontalDistance(c_.torso(player), ball) > s.passModeMaxBallDist) return false;
  for (int unum = 1; unum <= kMaxUnum; ++unum) {
    if (c_.records.of(opponent, unum).ballDistance < s.passModeMinOppBallDist) return false;
  }
  for (const Player* other : c_.team(opponent)) {
    if (horizontalDistance(c_.torso(*other), ball) < s.passModeMinOppBallDist) return false;
  }
  p_.passBallPosition[index(player.side)] = ball;
  game.setPlayMode(player.side == TeamSide::Left ? PlayMode::PassLeft : PlayMode::PassRight);
  return true;
}

void Referee::save(std::vector<std::uint8_t>& out) const {
  put(out, c_.game);
  put(out, c_.ball.onField);
  put(out, c_.ball.lastValidPosition);
  put(out, c_.ball.goal);
  put(out, c_.ball.lastToucher);
  put(out, c_.ball.lastTouchTime);
  putAll(out, c_.ball.touchers);
  put(out, c_.records);
  put(out, c_.random.state());
  putAll(out, c_.fouls);
  put(out, c_.nextTouchGroup);
  putAll(out, fouls_.opponentContacts);
  put(out, p_);
}

void Referee::restore(std::span<const std::uint8_t>& in) {
  take(in, c_.game);
  take(in, c_.ball.onField);
  take(in, c_.ball.lastValidPosition);
  take(in, c_.ball.goal);
  take(in, c_.ball.lastToucher);
  take(in, c_.ball.lastTouchTime);
  takeAll(in, c_.ball.touchers);
  take(in, c_.records);
  Random::State random{};
  take(in, random);
  c_.random.setState(random);
  takeAll(in, c_.fouls);
  take(in, c_.nextTouchGroup);
  takeAll(in, fouls_.opponentContacts);
  take(in, p_);
}

}  // namespace nonet::sim
