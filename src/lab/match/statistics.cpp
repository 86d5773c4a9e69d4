#include "nonet/lab/match/statistics.h"

#include <algorithm>
#include <cmath>

namespace nonet::lab {
namespace {

using protocol::PlayMode;

constexpr double kSampleTime = 0.1;   // s
constexpr double kOneFoul = 1.0;      // s between records of one foul, at most
constexpr double kLongestStep = 0.5;  // s without a frame: nothing is known of the time between
constexpr double kFallenBelow = 0.5;  // of up; between the two a robot keeps the stance it had
constexpr double kStandingAbove = 0.9;
constexpr double kPaceUpright = 0.7;    // lowest up in a stretch whose speed counts
constexpr double kFastestRobot = 4.0;   // m/s: who is faster was put there
constexpr double kStepTime = 0.5;       // s: sway is shorter than that
constexpr double kDeflectedTime = 3.0;  // s
constexpr double kTiny = 1e-3;

int cell(double value, double size, int count) {
  return std::clamp(static_cast<int>(std::floor((value / size + 0.5) * count)), 0, count - 1);
}

}  // namespace

std::string_view foulName(int type) {
  constexpr std::array<std::string_view, 8> kNames = {"crowding",       "touching",      "illegal_defence",
                                                      "illegal_attack", "incapable",     "kick_off",
                                                      "charging",       "self_collision"};
  return type >= 0 && type < static_cast<int>(kNames.size()) ? kNames[static_cast<std::size_t>(type)]
                                                             : "other";
}

MatchStatistics::MatchStatistics(const StatisticsField& field)
    : field_(field),
      ballPlaces_(static_cast<std::size_t>(std::lround(field.length) * std::lround(field.width)), 0) {}

PlayerStatistics& MatchStatistics::player(TeamIndex team, int unum) {
  PlayerStatistics& player = teamAt(team).players[unum];
  if (player.places.empty()) player.places.assign(kPlaceColumns * kPlaceRows, 0);
  return player;
}

// A robot that is carried away has a new record in every cycle (server facts 4.10), a self-collision one for
// each pair of limbs: all that come within a second are one foul.
void MatchStatistics::countFoul(const FrameFoul& foul, double time) {
  const auto [last, first] = fouledAt_.try_emplace({foul.team, foul.unum, foul.type}, time);
  const bool goesOn = !first && time >= last->second && time < last->second + kOneFoul;
  last->second = time;
  if (!goesOn) ++teamAt(foul.team).fouls[std::string(foulName(foul.type))];
}

void MatchStatistics::add(const Frame& frame) {
  endTime_ = std::max(endTime_, frame.time);
  for (const FrameFoul& foul : frame.fouls) countFoul(foul, frame.time);
  if (!any_) {
    score_ = frame.score;
    modeSince_ = frame.time;
  }
  newGoals(frame);
  if (!any_ || frame.mode != mode_) newMode(frame);
  any_ = true;

  const double step = sampleTime_ ? frame.time - *sampleTime_ : kLongestStep + 1.0;
  if (step >= 0.0 && step < kSampleTime - kTiny) return;
  if (step >= 0.0 && step <= kLongestStep) {
    sample(frame, step);
  } else {
    // A break: what was known of movements is worth nothing.
    velocity_.reset();
    tracks_.clear();
    touch_.reset();
    duelSince_.reset();
  }
  sampleTime_ = frame.time;
  p_WBall_ = frame.p_WBall.head<2>();
}

void MatchStatistics::newGoals(const Frame& frame) {
  for (const TeamIndex team : {0, 1}) {
    const auto i = static_cast<std::size_t>(team);
    for (; score_[i] < frame.score[i]; ++score_[i]) {
      GoalStatistics goal{frame.time, team, 0, false, {}};
      if (kickOffSince_) goal.afterKickOff = frame.time - *kickOffSince_;
      scored(team, goal, frame);
      goals_.push_back(goal);
    }
    score_[i] = frame.score[i];  // a trainer may take goals back
  }
}

// The ball's way ends in the goal: of whom?
void MatchStatistics::scored(TeamIndex team, GoalStatistics& goal, const Frame& frame) {
  const bool deflected = touch_ && touch_->team != team && !touch_->isKick() && deflected_ &&
                         deflected_->team == team && frame.time - deflected_->time < kDeflectedTime;
  if (deflected) {
    KickStatistics& kick = teamAt(team).kicks[deflected_->record];
    if (kick.outcome == "saved") --teamAt(1 - team).saves;
    kick.outcome = "goal";
    goal.scorer = deflected_->unum;
    touch_.reset();
  } else if (touch_) {
    goal.scorer = touch_->unum;
    goal.own = touch_->team != team;
    closeTouch(goal.own ? "own goal" : "goal", frame.p_WBall.head<2>(), -1, 0);
  } else {
    ++teamAt(team).shots;
    ++teamAt(team).shotsOnTarget;
  }
  deflected_.reset();
  if (goal.scorer != 0 && !goal.own) ++player(team, goal.scorer).goals;
}

// Set pieces are timed by their modes; a ball that leaves play ends the way of the last touch.
void MatchStatistics::newMode(const Frame& frame) {
  if (any_ && isSetPiece(mode_) && modeTeam_ >= 0) {
    SetPieceStatistics& piece = teamAt(modeTeam_).setPieces[std::string(kindOfMode(mode_))];
    const double seconds = std::max(0.0, frame.time - modeSince_);
    ++piece.count;
    piece.seconds += seconds;
    piece.longest = std::max(piece.longest, seconds);
  }
  if (frame.mode == PlayMode::PlayOn) {
    playSince_ = frame.time;
    fromSetPiece_ = isSetPiece(mode_);
    if (kindOfMode(mode_) == "kick_off") kickOffSince_ = frame.time;
  } else if (mode_ == PlayMode::PlayOn && kindOfMode(frame.mode) != "pass") {
    const std::string_view kind = kindOfMode(frame.mode);
    const bool out = kind == "kick_in" || kind == "corner_kick" || kind == "goal_kick";
    closeTouch(out ? "out" : "open", p_WBall_, -1, 0);
  }
  mode_ = frame.mode;
  modeSince_ = frame.time;
  modeTeam_ = frame.teamOfMode();
  duelSince_.reset();
}

void MatchStatistics::sample(const Frame& frame, double step) {
  if (step < kTiny) return;
  const bool inPlay = mode_ == PlayMode::PlayOn;
  sampleRobots(frame, step, inPlay);
  sampleBall(frame, step);
  if (!inPlay) return;
  sampleDuel(frame);
  secondsInPlay_ += step;
  const Vector2 p = frame.seenBy(0, frame.p_WBall);
  thirds_[static_cast<std::size_t>(cell(p.x(), field_.length, 3))] += step;
  const int columns = static_cast<int>(std::lround(field_.length));
  const int rows = static_cast<int>(std::lround(field_.width));
  const int place = cell(p.y(), field_.width, rows) * columns + cell(p.x(), field_.length, columns);
  ++ballPlaces_[static_cast<std::size_t>(place)];
  if (ballPath_.empty() || frame.time >= ballPath_.back()[0] + 1.0 - kTiny)
    ballPath_.push_back({frame.time, p.x(), p.y()});
  if (touch_) teamAt(touch_->team).possession += step;
}

void MatchStatistics::sampleRobots(const Frame& frame, double step, bool inPlay) {
  for (const FrameRobot& robot : frame.robots) {
    PlayerStatistics& player = this->player(robot.team, robot.unum);
    player.robotType = robot.robotType;
    Track& track = tracks_[{robot.team, robot.unum}];
    if (robot.up < kFallenBelow) {
      if (track.down == false) ++player.falls;
      track.down = true;
    } else if (robot.up > kStandingAbove) {
      track.down = false;
    }
    if (track.down == true) player.secondsDown += step;
    if (!robot.role.empty()) player.secondsInRole[std::string(robot.role)] += step;
    if (!inPlay || robot.up < kPaceUpright) {
      track.places.clear();
      track.step.reset();
    } else {
      player.secondsUp += step;
      samplePace(robot, track, player, frame.time);
    }
    if (!inPlay) continue;
    const Vector2 p = frame.seenBy(robot.team, robot.p_W);
    const int row = cell(p.y(), field_.width, kPlaceRows);
    const int place = row * kPlaceColumns + cell(p.x(), field_.length, kPlaceColumns);
    ++player.places[static_cast<std::size_t>(place)];
  }
}

void MatchStatistics::samplePace(const FrameRobot& robot, Track& track, PlayerStatistics& player,
                                 double time) {
  const Track::Place here{time, robot.p_W.head<2>()};
  if (!track.places.empty()) {
    const Track::Place& before = track.places.back();
    if ((here.p_W - before.p_W).norm() > kFastestRobot * (time - before.time)) {
      track.places.clear();
      track.step.reset();
    }
  }
  if (!track.step) track.step = here;
  if (time - track.step->time >= kStepTime - kTiny) {
    player.walked += (here.p_W - track.step->p_W).norm();
    track.step = here;
  }
  track.places.push_back(here);
  for (const double window : {1.0, 3.0}) {
    // The earliest place within the window; it counts if the window is full but for a tenth.
    const auto begin = std::find_if(track.places.begin(), track.places.end(), [&](const Track::Place& place) {
      return time - place.time <= window + kTiny;
    });
    const double seconds = time - begin->time;
    if (seconds < 0.9 * window) continue;
    double& best = window == 1.0 ? player.bestSpeed1 : player.bestSpeed3;
    best = std::max(best, (here.p_W - begin->p_W).norm() / seconds);
  }
  while (time - track.places.front().time > 3.0 + kTiny) track.places.pop_front();
}

}  // namespace nonet::lab
