// getup: rising from a fall to any side. The fall itself is fuzzed: how the ankles and hips throw the robot
// over, how limp it is on the way down and how long it lies.
#include <algorithm>
#include <cmath>
#include <memory>

#include "tasks.h"

namespace nonet::lab {

namespace {

using model::JointId;

constexpr int kFalls = 4;            // one to each side
constexpr double kLongest = 6.0;     // s, then the attempt has failed
constexpr double kFailure = 4.0;     // s, added for a failure
constexpr double kUpright = 0.25;    // rad
constexpr double kSteady = 0.4;      // s upright before it counts
constexpr double kFallTime = 1.6;    // s
constexpr double kHighEnough = 0.8;  // of the height at which it stood

class GetupTask final : public Task {
 public:
  std::string_view name() const override { return "getup"; }
  std::string_view description() const override {
    return "rise after fuzzed falls to the front, the back and both sides: fast and always";
  }
  std::vector<std::string> searchedKeys() const override { return {"motion.skills.rise_"}; }

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override {
    const TrialSetup setup = trialSetup(parameters, seed, settings);
    Random random = Random(seed).fork(4);
    double time = 0.0;
    int risen = 0;
    for (int side = 0; side < kFalls; ++side) {
      RobotTrial trial(setup);
      trial.settle(Pose2(0.0, 0.0, random.uniform(-kPi, kPi)));
      const double standing = trial.torsoPosition().z();
      fall(trial, side, random);
      const double taken = rise(trial, kHighEnough * standing);
      risen += taken < kLongest ? 1 : 0;
      time += taken < kLongest ? taken : kLongest + kFailure;
    }
    return {.fitness = -time / kFalls,
            .measures = {{"success", static_cast<double>(risen) / kFalls}, {"time_s", time / kFalls}}};
  }

 private:
  // Sides: front, back, left, right.
  static void fall(RobotTrial& trial, int side, Random& random) {
    motion::JointTargets targets;
    targets.angles = trial.belief().body.joints;
    targets.stiffness.fill(random.uniform(0.3, 1.0));
    const auto add = [&](JointId joint, double angle) { targets.angles[model::index(joint)] += angle; };
    const double sign = side % 2 == 0 ? 1.0 : -1.0;
    const double lean = sign * random.uniform(0.6, 0.9);
    if (side < 2) {
      // Positive ankle pitch lifts the toes: the robot tips backwards.
      for (const JointId joint : {JointId::LLeg5, JointId::RLeg5}) add(joint, -lean);
    } else {
      for (const JointId joint : {JointId::LLeg2, JointId::RLeg2, JointId::LLeg6, JointId::RLeg6})
        add(joint, lean * 0.7);
    }
    for (std::size_t i = 0; i < model::kJointCount; ++i) targets.angles[i] += 0.15 * random.normal();
    const int cycles = static_cast<int>(kFallTime / kCycleTime);
    for (int i = 0; i < cycles; ++i) trial.stepJoints(targets);
    const int waits = static_cast<int>(random.below(15));
    for (int i = 0; i < waits; ++i) trial.stepJoints(targets);
  }

  // Seconds until the robot stands and stays up; at least kLongest if it does not.
  static double rise(RobotTrial& trial, double height) {
    const double begin = trial.time();
    double since = begin;
    while (trial.time() - begin < kLongest + kSteady) {
      trial.step(motion::MotionRequest{});
      const Vector3 torso = trial.torsoPosition();
      if (!torso.allFinite() || torso.norm() > 50.0) return kLongest;
      const bool up = trial.tilt() < kUpright && torso.z() > height;
      if (!up) since = trial.time();
      if (trial.time() - since >= kSteady) return since - begin;
    }
    return kLongest;
  }
};

}  // namespace

const Task& getupTask() {
  static const GetupTask task;
  return task;
}

}  // namespace nonet::lab
