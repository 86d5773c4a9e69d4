// Kinematics: forward, legs and arms in closed form, at the limits, and the numeric solver for comparison.
#include <vector>

#include <benchmark/benchmark.h>

#include "nonet/math/random.h"
#include "nonet/model/inverse_kinematics.h"
#include "nonet/model/kinematics.h"
#include "nonet/model/numeric_inverse_kinematics.h"

namespace nonet::model {
namespace {

struct Target {
  Pose3 X_RS;
  Vector3 p_RH;
};

// Random poses of type 3; `beyond` pushes the angles out of their limits by up to that much.
std::vector<Target> targets(double beyond) {
  const RobotModel& model = robotModel(3);
  Random random(5);
  std::vector<Target> made;
  while (made.size() < 256) {
    JointArray angles{};
    for (const JointSpec& joint : model.joints()) {
      angles[index(joint.id)] =
          random.uniform(joint.low, joint.high) + (beyond > 0.0 ? random.uniform(-beyond, beyond) : 0.0);
    }
    BodyPoses poses;
    forwardKinematics(model, angles, poses);
    const Target target{solePose(model, poses, Side::Left), poses[index(BodyId::LLowerArm)].translation()};
    LegAngles leg{};
    const Reach reach = legInverseKinematics(model, Side::Left, target.X_RS, leg);
    if ((beyond > 0.0) == (reach == Reach::Limited)) made.push_back(target);
  }
  return made;
}

void forwardKinematicsOfAllBodies(benchmark::State& state) {
  const RobotModel& model = robotModel(4);
  JointArray angles{};
  angles.fill(0.1);
  BodyPoses poses;
  for (auto _ : state) {
    forwardKinematics(model, angles, poses);
    benchmark::DoNotOptimize(poses);
  }
}
BENCHMARK(forwardKinematicsOfAllBodies);

void legOf(benchmark::State& state, double beyond) {
  const RobotModel& model = robotModel(3);
  const std::vector<Target> all = targets(beyond);
  std::size_t i = 0;
  LegAngles leg{};
  for (auto _ : state) {
    legInverseKinematics(model, Side::Left, all[i++ % all.size()].X_RS, leg);
    benchmark::DoNotOptimize(leg);
  }
}
BENCHMARK_CAPTURE(legOf, withinTheLimits, 0.0);
BENCHMARK_CAPTURE(legOf, atTheLimits, 0.3);

void arm(benchmark::State& state) {
  const RobotModel& model = robotModel(3);
  const std::vector<Target> all = targets(0.0);
  std::size_t i = 0;
  ArmAngles angles{};
  for (auto _ : state) {
    armInverseKinematics(model, Side::Left, all[i++ % all.size()].p_RH, angles);
    benchmark::DoNotOptimize(angles);
  }
}
BENCHMARK(arm);

void legByCeres(benchmark::State& state) {
  const RobotModel& model = robotModel(3);
  const std::vector<Target> all = targets(0.0);
  std::size_t i = 0;
  for (auto _ : state) {
    LegAngles leg{};
    leg[3] = -0.5;
    numericLegInverseKinematics(model, Side::Left, all[i++ % all.size()].X_RS, leg);
    benchmark::DoNotOptimize(leg);
  }
}
BENCHMARK(legByCeres);

}  // namespace
}  // namespace nonet::model
