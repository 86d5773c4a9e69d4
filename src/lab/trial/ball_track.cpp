#include "nonet/lab/trial/ball_track.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nonet/math/direction.h"

namespace nonet::lab {

namespace {

constexpr double kTouched = 0.03;      // m that the ball has moved
constexpr double kCornerPassed = 0.5;  // m, from the corner
constexpr double kSpeedOver = 0.1;     // s over which a speed is measured
constexpr double kReboundTime = 1.0;   // s

Vector2 unit(const Vector2& v) {
  return v / std::max(v.norm(), 1e-9);
}

double distanceFromLeg(const Vector2& point, const Vector2& from, const Vector2& to) {
  const Vector2 way = to - from;
  const double along = std::clamp((point - from).dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (point - from - along * way).norm();
}

double distanceFrom(const BallPath& path, const Vector2& point) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < path.corners.size(); ++i)
    least = std::min(least, distanceFromLeg(point, path.corners[i - 1], path.corners[i]));
  return least;
}

// Which leg the ball is on: the next one once it has come to the corner or beyond it.
class Progress {
 public:
  explicit Progress(const BallPath& path) : path_(path) {}

  void update(const Vector2& ball) {
    while (leg_ + 2 < path_.corners.size() && passed(ball)) done_ += length(leg_++);
    farthest_ = std::max(farthest_, done_ + std::clamp(along(ball), 0.0, length(leg_)));
  }
  double farthest() const { return farthest_; }

 private:
  double length(std::size_t leg) const { return (path_.corners[leg + 1] - path_.corners[leg]).norm(); }
  double along(const Vector2& ball) const {
    return (ball - path_.corners[leg_]).dot(unit(path_.corners[leg_ + 1] - path_.corners[leg_]));
  }
  bool passed(const Vector2& ball) const {
    const Vector2& corner = path_.corners[leg_ + 1];
    if ((ball - corner).norm() > kCornerPassed) return false;
    const Vector2 next = unit(path_.corners[leg_ + 2] - corner);
    return along(ball) >= length(leg_) || (ball - corner).dot(next) > 0.0;
  }

  const BallPath& path_;
  std::size_t leg_ = 0;
  double done_ = 0.0;
  double farthest_ = 0.0;
};

}  // namespace

double BallPath::length() const {
  double sum = 0.0;
  for (std::size_t i = 1; i < corners.size(); ++i) sum += (corners[i] - corners[i - 1]).norm();
  return sum;
}

BallPath straightPath(const Pose2& start, double length) {
  return {{start.translation, start * Vector2(length, 0.0)}};
}

BallPath slalomPath(const Pose2& start, int turns, double angle, double leg) {
  BallPath path;
  Vector2 corner = Vector2::Zero();
  path.corners.push_back(start * corner);
  for (int i = 0; i <= turns; ++i) {
    const double heading = i % 2 == 0 ? 0.5 * angle : -0.5 * angle;
    corner += leg * unitVector(heading);
    path.corners.push_back(start * corner);
  }
  return path;
}

DribbleResult measureDribble(const BallTrack& track, const BallPath& path) {
  DribbleResult result;
  if (track.empty()) return result;
  const double whole = path.length();
  Progress progress(path);
  bool touched = false;
  int samples = 0;
  int away = 0;
  double begin = 0.0;
  double end = track.back().time;
  for (const BallSample& sample : track) {
    if (!touched) {
      touched = (sample.ball - track.front().ball).norm() > kTouched;
      begin = sample.time;
      if (!touched) continue;
    }
    progress.update(sample.ball);
    const double apart = (sample.ball - sample.X_WR.translation).norm();
    const double aside = distanceFrom(path, sample.ball);
    result.apart = std::max(result.apart, apart);
    result.aside = std::max(result.aside, aside);
    ++samples;
    away += apart > path.keep || aside > path.width ? 1 : 0;
    result.arrived = progress.farthest() >= whole - 1e-9;
    end = sample.time;
    if (result.arrived) break;
  }
  result.lost = away > 0;
  result.tooFar = result.apart > path.keep;
  result.away = static_cast<double>(away) / std::max(samples, 1);
  result.progress = progress.farthest();
  if (end > begin) result.speed = result.progress / (end - begin);
  return result;
}

ReceiveResult measureReceive(const BallTrack& track, const ReceiveRule& rule) {
  ReceiveResult result;
  if (track.empty()) return result;
  const auto beside = [](const BallSample& sample) { return Vector2(sample.ball - sample.X_WR.translation); };
  result.time = track.back().time;
  result.closest = std::numeric_limits<double>::infinity();
  double latest = std::numeric_limits<double>::infinity();  // when it must be held
  double closestAt = 0.0;
  std::size_t since = 0;  // begin of the time near, or of its last `lasts`
  for (std::size_t i = 0; i < track.size(); ++i) {
    const double apart = beside(track[i]).norm();
    const double time = track[i].time;
    if (apart < result.closest) {
      result.closest = result.rebound = apart;
      closestAt = time;
    }
    if (time < closestAt + kReboundTime) result.rebound = std::max(result.rebound, apart);
    if (apart > rule.near) {
      since = i + 1;
      continue;
    }
    latest = std::min(latest, time + rule.patience);
    if (result.held || time - track[since].time < rule.lasts - 1e-9) continue;
    while (time - track[since + 1].time >= rule.lasts - 1e-9) ++since;
    const double moved = (beside(track[i]) - beside(track[since])).norm();
    if (moved > rule.slow * rule.lasts || track[since].time > latest) continue;
    result.held = true;
    result.time = track[since].time;
  }
  return result;
}

double runSpeed(const BallTrack& track, double after, double seconds) {
  const BallSample* from = nullptr;
  for (const BallSample& sample : track) {
    const Vector2& place = sample.X_WR.translation;
    if (from == nullptr && (place - track.front().X_WR.translation).norm() >= after) from = &sample;
    if (from == nullptr || sample.time - from->time < seconds - 1e-9) continue;
    return (place - from->X_WR.translation).norm() / (sample.time - from->time);
  }
  return 0.0;
}

double stopTime(const BallTrack& track, double begin, double still) {
  if (track.empty()) return 0.0;
  double last = begin;
  std::size_t before = 0;
  for (const BallSample& sample : track) {
    while (sample.time - track[before].time > kSpeedOver + 1e-9) ++before;
    const double time = sample.time - track[before].time;
    if (time <= 0.0 || sample.time <= begin) continue;
    const double speed = (sample.X_WR.translation - track[before].X_WR.translation).norm() / time;
    if (speed > still) last = sample.time;
  }
  return last - begin;
}

}  // namespace nonet::lab
