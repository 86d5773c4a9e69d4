#include "nonet/lab/kick_report.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "nonet/world/ball_law.h"

#include "parallel.h"

namespace nonet::lab {

namespace {

using model::Side;
using motion::MotionRequest;

// Where the ball lies, seen from the standing robot, and how far off it may be.
constexpr double kAhead = 0.18;  // m
constexpr double kAside = 0.055;
constexpr double kAheadSpread = 0.03;
constexpr double kAsideSpread = 0.02;
constexpr double kBelief = 0.005;  // m, standard deviation of what the robot is told

constexpr double kLongestKick = 3.0;  // s
constexpr double kRollsOut = 8.0;     // s, for the ball
constexpr double kLasts = 1.0;        // s that the robot must stand after the skill
constexpr double kMiss = 0.3;         // m

world::BallMotion ballOf(RobotTrial& trial) {
  return {trial.physics().ballPosition().cast<double>(), trial.physics().ballVelocity().cast<double>()};
}

void putBall(RobotTrial& trial, const Vector2& place) {
  const double radius = trial.physics().settings().ballRadius;
  trial.physics().setBallPosition(Vector3(place.x(), place.y(), radius).cast<float>());
  trial.physics().setBallVelocity(sim::Vector3f::Zero());
}

// The last steps to a ball: slow, in any direction.
void walkAbout(RobotTrial& trial, Random& random) {
  MotionRequest walk;
  walk.kind = MotionRequest::Kind::WalkVelocity;
  walk.velocity = Pose2(random.uniform(-0.1, 0.2), random.uniform(-0.15, 0.15), random.uniform(-0.5, 0.5));
  trial.run(walk, random.uniform(1.0, 2.0));
}

}  // namespace

bool Kick::missed() const {
  return forward < kMiss;
}
double Kick::direction() const {
  return std::atan2(aside, forward);
}

Kick kickOnce(const TrialSetup& setup, Side side, KickFrom from, std::uint64_t seed) {
  TrialSetup own = setup;
  own.seed = seed;
  RobotTrial trial(own);
  Random random(seed);
  trial.settle(Pose2(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-kPi, kPi)));
  const double sign = side == Side::Left ? 1.0 : -1.0;
  const Vector2 ball(kAhead + random.uniform(-kAheadSpread, kAheadSpread),
                     sign * (kAside + random.uniform(-kAsideSpread, kAsideSpread)));
  if (from == KickFrom::Walk) walkAbout(trial, random);
  MotionRequest request;
  request.kind = MotionRequest::Kind::Kick;
  request.side = side;
  request.ball = ball + Vector2(random.normal(0.0, kBelief), random.normal(0.0, kBelief));
  request.target = Pose2(10.0, 0.0, 0.0);
  Kick kick;
  const double begin = trial.time();
  const auto watch = [&] {
    kick.ballSpeed = std::max(kick.ballSpeed, static_cast<double>(trial.physics().ballVelocity().norm()));
    kick.fell = kick.fell || trial.down();
  };
  Pose2 start;
  bool begun = false;
  while (trial.time() - begin < kLongestKick && !trial.motion().state().skillFinished) {
    if (!begun) {
      start = trial.pose();
      putBall(trial, start * ball);  // until the kick begins it lies where it should, wherever the feet go
    }
    trial.step(request);
    begun = begun || trial.motion().state().busy;
    watch();
  }
  kick.duration = trial.time() - begin;
  while (trial.time() - begin < kick.duration + kRollsOut) {
    trial.step(MotionRequest{});
    watch();
    const bool settled = trial.time() - begin > kick.duration + kLasts;
    if (settled && (kick.fell || !world::isFlying(ballOf(trial)))) break;
  }
  // The rest of a roll is certain.
  const Vector2 way = start.inverse() * world::restPlace(ballOf(trial)) - ball;
  kick.forward = way.x();
  kick.aside = way.y();
  return kick;
}

namespace {

KickStatistics statisticsOf(const std::vector<Kick>& kicks) {
  KickStatistics s;
  s.kicks = static_cast<int>(kicks.size());
  const auto count = static_cast<double>(s.kicks);
  double squares = 0.0;
  int hits = 0;
  int straight = 0;
  for (const Kick& kick : kicks) {
    s.falls += kick.fell ? 1 : 0;
    s.misses += kick.missed() ? 1 : 0;
    s.distance += kick.forward / count;
    squares += kick.forward * kick.forward;
    s.duration += kick.duration / count;
    if (kick.missed()) continue;
    ++hits;
    s.directionError += std::abs(kick.direction());
    straight += std::abs(kick.direction()) < toRadians(10.0) ? 1 : 0;
  }
  if (hits > 0) s.directionError /= hits;
  s.withinTen = straight / count;
  const double variance = std::max(0.0, squares / count - s.distance * s.distance);
  s.ci95 = 1.96 * std::sqrt(variance / std::max(1.0, count - 1.0));
  return s;
}

}  // namespace

KickReport measureKicks(const KickReportSettings& settings) {
  const Random seeds(settings.seed);
  std::array<std::vector<Kick>, 2> kicks;
  for (std::vector<Kick>& side : kicks) side.resize(static_cast<std::size_t>(settings.kicks));
  inParallel(2 * settings.kicks, settings.threads, [&](int i) {
    const auto side = static_cast<std::size_t>(i % 2);
    kicks[side][static_cast<std::size_t>(i / 2)] =
        kickOnce(settings.setup, static_cast<Side>(side), settings.from,
                 seeds.fork(static_cast<std::uint64_t>(i)).next());
  });
  return {statisticsOf(kicks[0]), statisticsOf(kicks[1])};
}

std::string kickReportTable(const KickReport& report) {
  std::string out = "foot   kicks  falls  misses  distance m           off deg  within 10 deg  time s\n";
  for (const Side side : {Side::Left, Side::Right}) {
    const KickStatistics& s = report[static_cast<std::size_t>(side)];
    out += fmt::format("{:<5} {:6} {:6} {:7} {:11.2f} +- {:4.2f} {:9.1f} {:13.0f}% {:7.2f}\n",
                       side == Side::Left ? "left" : "right", s.kicks, s.falls, s.misses, s.distance, s.ci95,
                       toDegrees(s.directionError), 100.0 * s.withinTen, s.duration);
  }
  return out;
}

std::string kickReportJson(const KickReport& report) {
  nlohmann::ordered_json json;
  for (const Side side : {Side::Left, Side::Right}) {
    const KickStatistics& s = report[static_cast<std::size_t>(side)];
    json[side == Side::Left ? "left" : "right"] = {{"kicks", s.kicks},
                                                   {"falls", s.falls},
                                                   {"misses", s.misses},
                                                   {"distance_m", {{"mean", s.distance}, {"ci95", s.ci95}}},
                                                   {"direction_error_deg", toDegrees(s.directionError)},
                                                   {"within_10_deg", s.withinTen},
                                                   {"duration_s", s.duration}};
  }
  return json.dump(2) + "\n";
}

}  // namespace nonet::lab
