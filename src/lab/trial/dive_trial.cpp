#include "nonet/lab/trial/dive_trial.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "nonet/math/random.h"
#include "nonet/model/ball.h"

namespace nonet::lab {

namespace {

using model::kBallRadius;
using model::Side;
using motion::MotionRequest;

constexpr double kSure = 0.01;        // m by which the ball must meet the robot
constexpr double kLongestDive = 4.0;  // s
constexpr double kLongestRise = 12.0;
constexpr double kDivedLasts = 0.6;  // s that a stand must last
constexpr double kUpright = 0.2;     // rad

/// A ball with its centre here touches one of the robot's parts.
struct Disc {
  double aside;   // m, to the side of the dive
  double height;  // m
  double radius;  // m
};

// A part as three discs along its longest axis, each as wide as its middle axis.
void addDiscs(const RobotTrial& trial, const sim::World& world, const model::BodySpec& body,
              const Pose2& start, double sign, std::vector<Disc>& discs) {
  const sim::ScenePose& pose = world.bodyPose(trial.robot(), body.id);
  Vector3 half = Vector3::Constant(body.shape.size.x());
  if (body.shape.kind == model::ShapeKind::Box) half = 0.5 * body.shape.size;
  if (body.shape.kind == model::ShapeKind::Capsule) half.z() += 0.5 * body.shape.size.y();
  // The scene's axes: x right, y forward.
  const Vector3 extent(half.y(), half.x(), half.z());
  Eigen::Index longest = 0;
  extent.maxCoeff(&longest);
  std::array<double, 3> sorted{extent.x(), extent.y(), extent.z()};
  std::sort(sorted.begin(), sorted.end());
  const double radius = sorted[1];
  const Vector3 along = pose.rotation.cast<double>().col(longest) * (sorted[2] - radius);
  for (const double share : {-1.0, 0.0, 1.0}) {
    const Vector3 p = pose.position.cast<double>() + share * along;
    discs.push_back({sign * (start.inverse() * Vector2(p.head<2>())).y(), p.z(), radius});
  }
}

std::array<Dive::Places, Dive::kHeights.size()> barredNow(RobotTrial& trial, const Pose2& start, Side side) {
  std::vector<Disc> discs;
  const double sign = side == Side::Left ? 1.0 : -1.0;
  for (const model::BodySpec& body : trial.model().bodies())
    if (body.collider) addDiscs(trial, trial.physics(), body, start, sign, discs);
  std::array<Dive::Places, Dive::kHeights.size()> barred{};
  for (std::size_t h = 0; h < Dive::kHeights.size(); ++h) {
    for (int i = 0; i < Dive::kPlaces; ++i) {
      barred[h][static_cast<std::size_t>(i)] = std::any_of(discs.begin(), discs.end(), [&](const Disc& disc) {
        const double distance = std::hypot(disc.aside - Dive::placeAt(i), disc.height - Dive::kHeights[h]);
        return distance < disc.radius + kBallRadius - kSure;
      });
    }
  }
  return barred;
}

void rise(RobotTrial& trial, Dive& dive) {
  const double begin = trial.time();
  double since = begin;
  while (trial.time() - begin < kLongestRise) {
    trial.step(MotionRequest{});
    dive.attempts = std::max(dive.attempts, trial.motion().fall().attempts());
    const bool up = trial.tilt() < kUpright && !trial.down() && !trial.motion().state().rising;
    if (!up) since = trial.time();
    if (trial.time() - since < kDivedLasts) continue;
    dive.stands = true;
    dive.riseTime = since - begin;
    return;
  }
}

}  // namespace

Dive diveAndRise(const TrialSettings& setup, std::string_view name, Side side, std::uint64_t seed) {
  TrialSettings own = setup;
  own.seed = seed;
  RobotTrial trial(own);
  Random random(seed);
  trial.settle(Pose2(0.0, 0.0, random.uniform(-kPi, kPi)));
  motion::WalkVelocity step;
  step.velocity.rotation = random.uniform(-0.5, 0.5);
  step.velocity.translation.y() = random.uniform(-0.2, 0.2);
  trial.run(step, random.uniform(0.0, 0.6));  // a goalie is seldom quite still
  const Pose2 start = trial.pose();
  const motion::PlaySkill request{name, side};
  Dive dive;
  const double begin = trial.time();
  int next = 0;
  while (trial.time() - begin < kLongestDive && !trial.motion().state().skillFinished) {
    trial.step(request);
    if (next == Dive::kTimes || trial.time() - begin < Dive::timeAt(next) - 1e-6) continue;
    dive.barred[static_cast<std::size_t>(next)] = barredNow(trial, start, side);
    ++next;
  }
  rise(trial, dive);
  return dive;
}

}  // namespace nonet::lab
