#include "nonet/lab/reports/walk_report.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "nonet/math/direction.h"
#include "nonet/math/random.h"
#include "nonet/math/straight_way.h"
#include "nonet/world/world_state.h"

#include "lab/common/parallel.h"
#include "lab/reports/walk_speeds.h"
#include "lab/trial/any_pose.h"

namespace nonet::lab {

namespace {

using motion::MotionRequest;

constexpr double kFast = 10.0;        // m/s: more than any set allows, so that the set decides
constexpr double kFastTurn = 20.0;    // rad/s
constexpr double kHeadingGain = 2.0;  // 1/s, keeps the robot's heading while it walks in a direction
constexpr double kFarTarget = 40.0;   // m

struct Walk {
  double fromStand = 0.0;
  double steady = 0.0;
  double odometryError = 0.0;
  bool fell = false;
};

// A pose as a localization would tell it: new noise with every vision message.
class NoisyPose {
 public:
  NoisyPose(const WalkReportSettings& settings, Random random) : settings_(&settings), random_(random) {}
  Pose2 of(const MeasuredRobot& trial) {
    if (cycle_++ % 3 == 0) {
      const double rotation = random_.normal(0.0, settings_->headingNoise);
      const double y = random_.normal(0.0, settings_->positionNoise);
      noise_ = Pose2(random_.normal(0.0, settings_->positionNoise), y, rotation);
    }
    const Pose2 pose = trial.pose();
    return {pose.translation + noise_.translation, wrapAngle(pose.rotation + noise_.rotation)};
  }

 private:
  const WalkReportSettings* settings_;
  Random random_;
  Pose2 noise_;
  int cycle_ = 0;
};

// Ten seconds lead out of a server's field, but into neither a goal nor the ball.
Pose2 withFreeWay(Random& random) {
  constexpr double kRoom = 0.6;  // m
  const world::FieldGeometry field;
  const auto bars = [&](const Pose2& start, const Vector2& place, double room) {
    return StraightWay(start.translation, start * Vector2(kFarTarget, 0.0)).distanceTo(place) < room;
  };
  Pose2 start;
  do {
    start = anyPose(random, kPi);
  } while (bars(start, field.theirGoal(), field.post() + kRoom) ||
           bars(start, field.ownGoal(), field.post() + kRoom) || bars(start, kMeasuredRobotBall, kRoom));
  return start;
}

// Stands there for a random while, so that trials differ in the phase of vision and in the last digits.
void begin(MeasuredRobot& trial, const Pose2& start, Random& random) {
  trial.settle(start);
  trial.run(MotionRequest{}, random.uniform(0.02, 0.4));
}

Walk walkInDirection(MeasuredRobot& trial, const WalkReportSettings& settings, double direction,
                     std::uint64_t seed) {
  Random random(seed);
  begin(trial, anyPose(random, kPi), random);
  NoisyPose noisy(settings, random.fork(1));
  const Pose2 start = trial.pose();
  const Vector2 along = unitVector(direction);
  motion::WalkVelocity request;
  Walk walk;
  WalkSpeeds speeds;
  const int cycles = static_cast<int>((WalkSpeeds::kAccelerate + WalkSpeeds::kSteady) / kCycleTime);
  for (int i = 0; i < cycles; ++i) {
    const double error = wrapAngle(start.rotation - noisy.of(trial).rotation);
    request.velocity = Pose2(kFast * along, kHeadingGain * error);
    trial.step(request);
    if (trial.down()) {
      walk.fell = true;
      break;
    }
    speeds.add((start.inverse() * trial.pose()).translation.dot(along));
  }
  walk.fromStand = speeds.fromStand;
  walk.steady = speeds.steady;
  return walk;
}

Walk walkTenSeconds(MeasuredRobot& trial, const WalkReportSettings& settings, std::uint64_t seed) {
  Random random(seed);
  begin(trial, withFreeWay(random), random);
  NoisyPose noisy(settings, random.fork(1));
  const Pose2 start = trial.pose();
  const Pose2 odometryStart = trial.belief().body.odometry;
  const Vector2 target = start * Vector2(kFarTarget, 0.0);
  motion::WalkTo request;
  request.stopAtTarget = false;
  Walk walk;
  for (int i = 0; i < 500; ++i) {
    request.target = Pose2(noisy.of(trial).inverse() * target, 0.0);
    trial.step(request);
    if (trial.down()) {
      walk.fell = true;
      break;
    }
  }
  const Pose2 walked = start.inverse() * trial.pose();
  const Pose2 believed = odometryStart.inverse() * trial.belief().body.odometry;
  walk.steady = walked.translation.x() / 10.0;
  walk.odometryError =
      (walked.translation - believed.translation).norm() / std::max(walked.translation.norm(), 1e-6);
  return walk;
}

Walk turnOnTheSpot(MeasuredRobot& trial, double sense, std::uint64_t seed) {
  Random random(seed);
  begin(trial, anyPose(random, kPi), random);
  motion::WalkVelocity request;
  request.velocity = Pose2(0.0, 0.0, sense * kFastTurn);
  Walk walk;
  double turned = 0.0;
  double last = trial.pose().rotation;
  const int accelerate = static_cast<int>(1.0 / kCycleTime);
  const int cycles = accelerate + static_cast<int>(WalkSpeeds::kSteady / kCycleTime);
  for (int i = 0; i < cycles; ++i) {
    trial.step(request);
    const double now = trial.pose().rotation;
    if (i >= accelerate) turned += wrapAngle(now - last);
    last = now;
    if (trial.down()) {
      walk.fell = true;
      break;
    }
  }
  walk.steady = sense * turned / WalkSpeeds::kSteady;
  return walk;
}

}  // namespace

WalkReport measureWalk(const WalkReportSettings& settings) {
  // One job per walk; measures in a fixed order: directions, ten seconds, turns.
  const int trials = settings.trials;
  const int directions = kWalkDirections * trials;
  const int count = directions + trials + 2 * trials;
  std::vector<Walk> walks(static_cast<std::size_t>(count));
  const Random seeds(settings.seed);
  std::unique_ptr<MeasuredRobot> remote;
  if (settings.server) remote = connectMeasuredRobot(settings.setup, *settings.server);
  inParallel(count, remote ? 1 : settings.threads, settings.progress, "walks", [&](int i) {
    const std::uint64_t seed = seeds.fork(static_cast<std::uint64_t>(i)).next();
    std::unique_ptr<MeasuredRobot> own;
    if (!remote) {
      TrialSettings setup = settings.setup;
      setup.seed = seed;
      own = makeMeasuredRobot(onOpenGround(setup));
    }
    MeasuredRobot& robot = remote ? *remote : *own;
    Walk& walk = walks[static_cast<std::size_t>(i)];
    if (i < directions) {
      const int direction = i / trials;
      walk = walkInDirection(robot, settings, 2.0 * kPi * direction / kWalkDirections, seed);
    } else if (i < directions + trials) {
      walk = walkTenSeconds(robot, settings, seed);
    } else {
      walk = turnOnTheSpot(robot, (i - directions) % 2 == 0 ? 1.0 : -1.0, seed);
    }
  });

  WalkReport report;
  report.robotType = settings.setup.robotType;
  report.trials = count;
  const auto collect = [&](int begin, int end, double Walk::*what) {
    std::vector<double> samples;
    for (int i = begin; i < end; ++i) samples.push_back(walks[static_cast<std::size_t>(i)].*what);
    return estimate(samples);
  };
  for (int d = 0; d < kWalkDirections; ++d) {
    const auto at = static_cast<std::size_t>(d);
    report.steady[at] = collect(d * trials, (d + 1) * trials, &Walk::steady);
    report.fromStand[at] = collect(d * trials, (d + 1) * trials, &Walk::fromStand);
    for (int i = d * trials; i < (d + 1) * trials; ++i) {
      report.fallsByDirection[at] += walks[static_cast<std::size_t>(i)].fell ? 1 : 0;
    }
  }
  report.forwardTenSeconds = collect(directions, directions + trials, &Walk::steady);
  report.odometryError = collect(directions, directions + trials, &Walk::odometryError);
  report.turn = collect(directions + trials, count, &Walk::steady);
  for (const Walk& walk : walks) report.falls += walk.fell ? 1 : 0;
  if (settings.courses > 0) {
    report.course =
        measureCourses(settings.setup, settings.seed, settings.courses, settings.threads, settings.progress);
  }
  return report;
}

}  // namespace nonet::lab
