// What the ball tells: touches, kicks, shots, passes, saves, duels. Definitions: statistics.h.
#include <algorithm>
#include <cmath>

#include "nonet/lab/match/statistics.h"

namespace nonet::lab {
namespace {

using protocol::PlayMode;

// Rolling, the ball loses its speed as exp(-kDrag t) (server facts 3.5).
constexpr double kDrag = 1.06;           // 1/s
constexpr double kSameWay = 0.26;        // rad
constexpr double kReach = 0.5;           // m from torso to ball within which a robot can have touched it
constexpr double kContact = 0.22;        // m: so near that a moving ball is being pushed
constexpr double kPushed = 0.15;         // m/s
constexpr double kTurnedBy = 0.35;       // m/s: change of velocity that no rolling explains ...
constexpr double kTurnedByShare = 0.25;  // ... plus this share of the speed
constexpr double kSameTouch = 0.4;       // s: contacts of one robot that follow so soon are one touch
constexpr double kKickSpeed = 1.5;       // m/s
constexpr double kKickGain = 1.0;        // m/s
constexpr double kShotMargin = 1.0;      // m beside the goal
constexpr double kFlight = 0.5;          // m that a shot flies farther than it would roll
constexpr double kPassLength = 2.0;      // m
constexpr double kSetPieceTouch = 0.3;   // s: play goes on when the taker touches, which shows a little later
constexpr double kDuelNear = 0.7;        // m
constexpr double kDuelOver = 1.0;        // m
constexpr double kDuelTime = 0.5;        // s
constexpr double kOnFeet = 0.7;

const FrameRobot* nearest(const Frame& frame, const Vector2& p_W, double& distance) {
  const FrameRobot* found = nullptr;
  for (const FrameRobot& robot : frame.robots) {
    const double d = (robot.p_W.head<2>() - p_W).norm();
    if (found != nullptr && d >= distance) continue;
    found = &robot;
    distance = d;
  }
  return found;
}

// The mean speed over a time in which the ball rolled, times this, is its speed at the begin.
double begunFaster(double seconds) {
  return kDrag * seconds / (1.0 - std::exp(-kDrag * seconds));
}

}  // namespace

// A contact between two pictures shows in two steps of the ball: a part of its new way, then all of it.
bool MatchStatistics::sameContact(const Frame& frame, const FrameRobot& robot, const Vector2& velocity,
                                  double step) const {
  const bool another = touch_ && (touch_->team != robot.team || touch_->unum != robot.unum);
  if (!another || !velocity_ || frame.time - touch_->last > 1.5 * step) return false;
  const double before = velocity_->norm();
  const double after = velocity.norm();
  return after > before && velocity.dot(*velocity_) > std::cos(kSameWay) * after * before;
}

bool MatchStatistics::Touch::isKick() const {
  return speed >= kKickSpeed && speed - before >= kKickGain;
}

void MatchStatistics::sampleBall(const Frame& frame, double step) {
  const Vector2 p_W = frame.p_WBall.head<2>();
  const Vector2 velocity = begunFaster(step) * (p_W - p_WBall_) / step;
  const bool placed = velocity.norm() > 15.0;  // the referee has put it somewhere
  if (placed || frame.mode == PlayMode::BeforeKickOff || frame.mode == PlayMode::GameOver) {
    velocity_.reset();
    if (placed) return;
    touch_.reset();
    return;
  }
  const double before = velocity_ ? velocity_->norm() : 0.0;
  const Vector2 expected = velocity_.value_or(Vector2::Zero()) * std::exp(-kDrag * step);
  const bool turned = velocity_ && (velocity - expected).norm() > kTurnedBy + kTurnedByShare * before;
  // The contact was where the ball was before it changed its way, or is where it is now.
  double there = 0.0;
  double here = 0.0;
  const FrameRobot* robotThere = nearest(frame, p_WBall_, there);
  const FrameRobot* robotHere = nearest(frame, p_W, here);
  if (robotThere != nullptr) {
    const FrameRobot& robot = there <= here ? *robotThere : *robotHere;
    const double distance = std::min(there, here);
    const bool pushed = distance < kContact && velocity.norm() > kPushed;
    if (((turned && distance < kReach) || pushed) && !sameContact(frame, robot, velocity, step))
      touched(frame, robot, velocity, before);
    else
      refreshTouch(frame, velocity);
  }
  velocity_ = velocity;
}

void MatchStatistics::touched(const Frame& frame, const FrameRobot& robot, const Vector2& velocity,
                              double before) {
  const Vector2 p_W = p_WBall_;
  const bool same = touch_ && touch_->team == robot.team && touch_->unum == robot.unum &&
                    frame.time - touch_->last <= kSameTouch;
  if (!same) {
    closeTouch("", p_W, robot.team, robot.unum);
    ++player(robot.team, robot.unum).touches;
    touch_ = Touch{};
    touch_->team = robot.team;
    touch_->unum = robot.unum;
    touch_->begin = frame.time;
    touch_->before = before;
    touch_->setPiece =
        frame.mode != PlayMode::PlayOn || (fromSetPiece_ && frame.time - playSince_ <= kSetPieceTouch);
    touch_->swapped = frame.swapped;
  }
  if (touch_->kick.empty()) touch_->kick = robot.kick;
  touch_->last = frame.time;
  touch_->p_W = p_W;
  refreshTouch(frame, velocity);
}

// Within a short time after the contact the ball shows its full speed.
void MatchStatistics::refreshTouch(const Frame& frame, const Vector2& velocity) {
  if (!touch_ || frame.time - touch_->last > kSameTouch) return;
  if (velocity.norm() <= touch_->speed) return;
  touch_->speed = velocity.norm();
  touch_->velocity = velocity;
}

// The ball would cross the goal line within `margin` of the goal before it lies still.
bool MatchStatistics::isShot(const Touch& touch, double margin) const {
  const double sign = (touch.team == 1) != touch.swapped ? -1.0 : 1.0;
  const Vector2 p = sign * touch.p_W;
  const Vector2 v = sign * touch.velocity;
  const double ahead = field_.length / 2.0 - p.x();
  if (v.x() <= 0.0 || ahead < 0.0) return false;
  const double y = p.y() + v.y() / v.x() * ahead;
  const double way = ahead * v.norm() / v.x();
  return std::abs(y) <= field_.goalWidth / 2.0 + margin && way <= v.norm() / kDrag + kFlight;
}

void MatchStatistics::closeTouch(const std::string& outcome, const Vector2& p_WEnd, TeamIndex nextTeam,
                                 int nextUnum) {
  if (!touch_) return;
  const Touch touch = *touch_;
  touch_.reset();
  TeamStatistics& team = teamAt(touch.team);
  const bool goal = outcome == "goal";
  const bool mate = nextTeam == touch.team && nextUnum != touch.unum;
  const bool self = nextTeam == touch.team && nextUnum == touch.unum;
  const bool kick = touch.isKick();
  const bool shot = goal || (kick && isShot(touch, kShotMargin));
  const bool onTarget = goal || (kick && isShot(touch, 0.0));
  const bool saved = onTarget && nextTeam >= 0 && nextTeam != touch.team && nextUnum == 1;
  team.shots += shot ? 1 : 0;
  team.shotsOnTarget += onTarget ? 1 : 0;
  if (saved) ++teamAt(nextTeam).saves;
  const double distance = (p_WEnd - touch.p_W).norm();
  const bool away = nextTeam >= 0 ? !self : outcome == "out";
  if (!shot && !touch.setPiece && away && distance >= kPassLength) {
    ++team.passesTried;
    team.passesCompleted += mate ? 1 : 0;
  }
  if (!kick) return;
  ++player(touch.team, touch.unum).kicks;
  const double sign = (touch.team == 1) != touch.swapped ? -1.0 : 1.0;
  KickStatistics record;
  record.time = touch.begin;
  record.unum = touch.unum;
  record.speed = touch.speed;
  record.from = sign * touch.p_W;
  record.to = sign * p_WEnd;
  record.shot = shot;
  record.onTarget = onTarget;
  record.setPiece = touch.setPiece;
  record.name = touch.kick;
  record.outcome = !outcome.empty() ? outcome : saved ? "saved" : self ? "self" : mate ? "mate" : "opponent";
  if (onTarget && nextTeam == 1 - touch.team) {
    deflected_ = Deflected{touch.team, touch.unum, sampleTime_.value_or(0.0), team.kicks.size()};
  }
  team.kicks.push_back(record);
}

std::map<std::string, KickKind> TeamStatistics::kicksByName() const {
  std::map<std::string, KickKind> kinds;
  for (const KickStatistics& kick : kicks) {
    KickKind& kind = kinds[kick.name];
    ++kind.count;
    kind.distance += kick.distance();
    ++kind.outcomes[kick.outcome];
  }
  return kinds;
}

void MatchStatistics::sampleDuel(const Frame& frame) {
  std::array<double, 2> distance = {1e9, 1e9};
  for (const FrameRobot& robot : frame.robots) {
    if (robot.up < kOnFeet) continue;
    double& least = distance[static_cast<std::size_t>(robot.team)];
    least = std::min(least, (robot.p_W - frame.p_WBall).head<2>().norm());
  }
  const double farther = std::max(distance[0], distance[1]);
  if (!duelSince_ && farther <= kDuelNear) duelSince_ = frame.time;
  if (!duelSince_ || farther < kDuelOver) return;
  if (frame.time - *duelSince_ >= kDuelTime) {
    ++duels_;
    ++teamAt(distance[0] < distance[1] ? 0 : 1).duelsWon;
  }
  duelSince_.reset();
}

}  // namespace nonet::lab
