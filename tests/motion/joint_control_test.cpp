#include "nonet/motion/joint_control.h"

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "nonet/math/angle.h"
#include "nonet/math/random.h"
#include "nonet/protocol/rounding.h"
#include "nonet/sim/physics/world.h"

namespace nonet::motion {
namespace {

using model::JointId;
using model::RobotModel;
using model::robotModel;

constexpr double kPrinting = toRadians(0.0051);  // half a printing step of the angles, and 32-bit rounding

double printed(double radians) {
  return protocol::radiansOnWire(static_cast<float>(toDegrees(radians)));
}

/// Joints that do exactly what server facts 1.2 and 2.4 say: speeds are reached at once; a command is
/// applied two messages later, and ignored at or beyond a stop; a joint beyond a stop is thrown back.
class IdealRobot {
 public:
  explicit IdealRobot(int type, double gain = 1.0) : model_(robotModel(type)), gain_(gain) {}

  /// The next message; cycleTime counts the cycles since the last call.
  world::BodyState sense() {
    world::BodyState body;
    for (const model::JointSpec& joint : model_.joints()) {
      body.joints[model::index(joint.id)] = printed(angles[model::index(joint.id)]);
    }
    body.cycleTime = kCycleTime * cycles_;
    cycles_ = 0;
    return body;
  }

  /// One cycle of the server after that message; nothing was sent if `answer` is null.
  void step(const protocol::Effectors* answer) {
    for (const model::JointSpec& joint : model_.joints()) {
      const std::size_t i = model::index(joint.id);
      const bool inside = angles[i] > joint.low && angles[i] < joint.high;
      if (pending_ && inside) {
        // The reader of the real server sees the text and clamps in 32 bits.
        const auto limit = static_cast<float>(joint.maxSpeed);
        speeds_[i] = std::clamp(static_cast<float>(pending_->speeds[i]), -limit, limit);
      }
      const bool outward = angles[i] >= joint.high ? speeds_[i] > 0.0F : speeds_[i] < 0.0F;
      angles[i] += (inside || !outward ? 1.0 : -1.0) * gain_ * kCycleTime * static_cast<double>(speeds_[i]);
    }
    pending_.reset();
    if (answer != nullptr) pending_ = *answer;
    ++cycles_;
  }

  model::JointArray angles{};

 private:
  const RobotModel& model_;
  double gain_;
  std::array<float, model::kJointCount> speeds_{};
  std::optional<protocol::Effectors> pending_;
  int cycles_ = 0;
};

JointTargets targetsAt(double angle) {
  JointTargets targets;
  targets.angles.fill(angle);
  targets.stiffness.fill(1.0);
  return targets;
}

/// The middle of the range plus a share of its half.
double withinRange(const model::JointSpec& joint, double share) {
  return 0.5 * (joint.low + joint.high) + share * 0.5 * (joint.high - joint.low);
}

void expectAll(const RobotModel& model, const model::JointArray& angles, const model::JointArray& wanted,
               double tolerance) {
  for (const model::JointSpec& joint : model.joints()) {
    const std::size_t i = model::index(joint.id);
    EXPECT_NEAR(angles[i], wanted[i], tolerance) << perceptorName(joint.id);
  }
}

TEST(JointControl, SmallStepIsDoneInTwoMessagesAndStays) {
  for (int type = 0; type < model::kRobotTypeCount; ++type) {
    const RobotModel& model = robotModel(type);
    IdealRobot robot(type);
    JointControl control(model, {});
    JointTargets targets = targetsAt(0.0);
    for (const model::JointSpec& joint : model.joints()) {
      const double toMiddle = withinRange(joint, 0.0) > 0.0 ? 1.0 : -1.0;
      targets.angles[model::index(joint.id)] = toMiddle * std::min(0.06, 0.9 * joint.maxSpeed * kCycleTime);
    }
    for (int k = 0; k < 20; ++k) {
      const world::BodyState body = robot.sense();
      if (k >= 2) expectAll(model, body.joints, targets.angles, 2.0 * kPrinting);
      protocol::Effectors effectors;
      control.update(body, targets, effectors);
      EXPECT_EQ(effectors.speedsPresent, model.hasToes()
                                             ? (1U << 24) - 1
                                             : (1U << 24) - 1 - (1U << model::index(JointId::RLeg7)) -
                                                   (1U << model::index(JointId::LLeg7)));
      robot.step(&effectors);
    }
  }
}

TEST(JointControl, LongStepGoesAtFullSpeedWithoutOvershoot) {
  const RobotModel& model = robotModel(2);  // its ankles have other speeds
  IdealRobot robot(2);
  JointControl control(model, {});
  const JointId joints[] = {JointId::LArm1, JointId::LLeg5, JointId::RLeg6};
  JointTargets targets = targetsAt(0.0);
  for (const JointId id : joints) targets.angles[model::index(id)] = 0.7;
  for (int k = 0; k < 40; ++k) {
    const world::BodyState body = robot.sense();
    for (const JointId id : joints) {
      const double expected = std::min(0.7, std::max(0, k - 1) * kCycleTime * model.joint(id).maxSpeed);
      EXPECT_NEAR(body.joints[model::index(id)], expected, 2.0 * kPrinting) << perceptorName(id) << ' ' << k;
    }
    protocol::Effectors effectors;
    control.update(body, targets, effectors);
    robot.step(&effectors);
  }
}

// Sweeps through most of each joint's range, slow to fast. The joint is where it should be two messages
// later, up to the printing of angle and speed: that is all the latency allows.
TEST(JointControl, FollowsSinusoidsTwoMessagesLater) {
  for (const double frequency : {0.5, 1.0, 2.0}) {
    for (int type = 0; type < model::kRobotTypeCount; ++type) {
      const RobotModel& model = robotModel(type);
      IdealRobot robot(type);
      JointControl control(model, {});
      std::array<JointTargets, 3> history{};
      double worst = 0.0;
      for (int k = 0; k < 300; ++k) {
        const world::BodyState body = robot.sense();
        JointTargets targets = targetsAt(0.0);
        for (const model::JointSpec& joint : model.joints()) {
          // As wide as range and speed allow.
          const double widest = 0.9 * joint.maxSpeed / (2.0 * kPi * frequency);
          const double share = std::min(0.8, widest / (0.5 * (joint.high - joint.low)));
          targets.angles[model::index(joint.id)] =
              withinRange(joint, share * std::sin(2.0 * kPi * frequency * k * kCycleTime));
        }
        if (k > 60) {  // first it must get there
          for (const model::JointSpec& joint : model.joints()) {
            const std::size_t i = model::index(joint.id);
            worst = std::max(worst, std::abs(robot.angles[i] - history[(k + 1) % 3].angles[i]));
          }
        }
        history[k % 3] = targets;
        protocol::Effectors effectors;
        control.update(body, targets, effectors);
        robot.step(&effectors);
      }
      EXPECT_LT(worst, 2.0 * kPrinting) << "type " << type << ", " << frequency << " Hz";
    }
  }
}

TEST(JointControl, NeverTouchesTheStops) {
  Random random(3);
  for (int type = 0; type < model::kRobotTypeCount; ++type) {
    const RobotModel& model = robotModel(type);
    IdealRobot robot(type);
    const ControlParameters parameters;
    JointControl control(model, parameters);
    JointTargets targets = targetsAt(0.0);
    for (int k = 0; k < 3000; ++k) {
      for (const model::JointSpec& joint : model.joints()) {
        const std::size_t i = model::index(joint.id);
        // Wild targets, far beyond the stops, that change at any moment.
        if (random.uniform() < 0.05) targets.angles[i] = random.uniform(-6.0, 6.0);
        EXPECT_GT(robot.angles[i], joint.low) << perceptorName(joint.id);
        EXPECT_LT(robot.angles[i], joint.high) << perceptorName(joint.id);
      }
      protocol::Effectors effectors;
      control.update(robot.sense(), targets, effectors);
      robot.step(&effectors);
    }
    // Held against a stop it rests at the margin.
    for (int k = 0; k < 60; ++k) {
      protocol::Effectors effectors;
      control.update(robot.sense(), targetsAt(10.0), effectors);
      robot.step(&effectors);
    }
    for (const model::JointSpec& joint : model.joints()) {
      EXPECT_NEAR(robot.angles[model::index(joint.id)], joint.high - parameters.stopMargin, 2.0 * kPrinting);
    }
  }
}

// A command stays in force until the next one arrives, so a lost message costs at most one more cycle of it.
TEST(JointControl, LostMessagesDoNotConfuseIt) {
  Random random(4);
  const RobotModel& model = robotModel(0);
  IdealRobot robot(0);
  JointControl control(model, {});
  for (int episode = 0; episode < 30; ++episode) {
    JointTargets targets = targetsAt(0.0);
    for (const model::JointSpec& joint : model.joints()) {
      targets.angles[model::index(joint.id)] = withinRange(joint, random.uniform(-0.7, 0.7));
    }
    for (int k = 0; k < 100; ++k) {
      const bool lost = k < 50 && random.uniform() < 0.3;
      if (lost) {
        robot.step(nullptr);
        continue;
      }
      protocol::Effectors effectors;
      control.update(robot.sense(), targets, effectors);
      robot.step(&effectors);
    }
    expectAll(model, robot.angles, targets.angles, 2.0 * kPrinting);
  }
}

TEST(JointControl, OneLostMessageIsAccountedForExactly) {
  // Message 1 is lost. The command of message 0 acts in steps 2 and 3, so message 2 shows one cycle of it and
  // one is under way: a controller that forgot it would send the joint too far.
  const RobotModel& model = robotModel(0);
  IdealRobot robot(0);
  JointControl control(model, {});
  const std::size_t i = model::index(JointId::LArm1);
  JointTargets targets = targetsAt(0.0);
  targets.angles[i] = 0.3;
  protocol::Effectors effectors;
  control.update(robot.sense(), targets, effectors);
  robot.step(&effectors);
  robot.step(nullptr);
  for (int k = 2; k < 12; ++k) {
    control.update(robot.sense(), targets, effectors);
    robot.step(&effectors);
    EXPECT_LT(robot.angles[i], 0.3 + 2.0 * kPrinting);
  }
  EXPECT_NEAR(robot.angles[i], 0.3, 2.0 * kPrinting);
}

TEST(JointControl, APushIsCorrectedWithinTwoMessages) {
  const RobotModel& model = robotModel(0);
  IdealRobot robot(0);
  JointControl control(model, {});
  const JointTargets targets = targetsAt(-0.01);
  const std::size_t i = model::index(JointId::RLeg4);
  for (int k = 0; k < 20; ++k) {
    if (k == 10) robot.angles[i] -= 0.08;
    const world::BodyState body = robot.sense();
    if (k >= 12) {
      EXPECT_NEAR(body.joints[i], -0.01, 2.0 * kPrinting);
    }
    protocol::Effectors effectors;
    control.update(body, targets, effectors);
    robot.step(&effectors);
  }
}

// A loaded joint moves less (or more) than commanded. With both gains below, z^2 = 1 - gain has its roots
// inside the unit circle: the error decays as sqrt(|1 - gain|)^k.
TEST(JointControl, StableWhenTheJointMovesLessOrMoreThanCommanded) {
  for (const double gain : {0.4, 0.7, 1.3}) {
    const RobotModel& model = robotModel(0);
    IdealRobot robot(0, gain);
    JointControl control(model, {});
    JointTargets targets = targetsAt(0.0);
    const std::size_t i = model::index(JointId::LLeg3);
    targets.angles[i] = 0.1;
    for (int k = 0; k < 42; ++k) {
      protocol::Effectors effectors;
      control.update(robot.sense(), targets, effectors);
      robot.step(&effectors);
      const double bound = 0.11 * std::pow(std::abs(1.0 - gain), (k - 2) / 2.0) + 6.0 * kPrinting;
      if (k >= 2) {
        EXPECT_LT(std::abs(robot.angles[i] - 0.1), bound) << gain << " " << k;
      }
    }
  }
}

TEST(JointControl, IntegralRemovesASteadyErrorAndDoesNotWindUp) {
  const RobotModel& model = robotModel(0);
  IdealRobot robot(0);
  ControlParameters parameters;
  parameters.proportional = 0.3;
  parameters.integral = 0.02;
  JointControl control(model, parameters);
  const std::size_t i = model::index(JointId::LArm1);
  JointTargets targets = targetsAt(0.0);
  targets.angles[i] = 1.5;
  double highest = 0.0;
  for (int k = 0; k < 300; ++k) {
    protocol::Effectors effectors;
    robot.angles[i] -= 0.002;  // a steady drift
    control.update(robot.sense(), targets, effectors);
    robot.step(&effectors);
    highest = std::max(highest, robot.angles[i]);
  }
  EXPECT_NEAR(robot.angles[i], 1.5, 0.003);
  EXPECT_LT(highest, 1.6);  // with wind-up over the 12 cycles of full speed it would pass 1.7
}

TEST(JointControl, StiffnessScalesAndZeroLetsGo) {
  const RobotModel& model = robotModel(0);
  world::BodyState body;
  body.cycleTime = kCycleTime;
  JointTargets targets = targetsAt(0.0);
  const std::size_t full = model::index(JointId::LArm1);
  const std::size_t half = model::index(JointId::RArm1);
  const std::size_t none = model::index(JointId::Head1);
  const std::size_t broken = model::index(JointId::Head2);
  for (const std::size_t i : {full, half, none}) targets.angles[i] = 0.1;
  targets.stiffness[half] = 0.5;
  targets.stiffness[none] = 0.0;
  targets.angles[broken] = std::numeric_limits<double>::quiet_NaN();
  JointControl control(model, {});
  protocol::Effectors effectors;
  control.update(body, targets, effectors);
  EXPECT_DOUBLE_EQ(effectors.speeds[full], 5.0);
  EXPECT_DOUBLE_EQ(effectors.speeds[half], 2.5);
  EXPECT_EQ(effectors.speeds[none], 0.0);
  EXPECT_EQ(effectors.speeds[broken], 0.0);
  EXPECT_TRUE(effectors.hasSpeed(JointId::Head1));
  // The same again: the command is under way, nothing is left to do. After a reset it is forgotten.
  control.update(body, targets, effectors);
  EXPECT_DOUBLE_EQ(effectors.speeds[full], 0.0);
  control.update(body, targets, effectors);
  EXPECT_DOUBLE_EQ(effectors.speeds[full], 5.0);
  control.reset();
  control.update(body, targets, effectors);
  EXPECT_DOUBLE_EQ(effectors.speeds[full], 5.0);
}

TEST(JointControl, SpeedsHaveTheDigitsOfTheText) {
  Random random(6);
  const RobotModel& model = robotModel(3);
  JointControl control(model, {});
  world::BodyState body;
  body.cycleTime = kCycleTime;
  for (int k = 0; k < 200; ++k) {
    JointTargets targets = targetsAt(random.uniform(-2.0, 2.0));
    protocol::Effectors effectors;
    control.update(body, targets, effectors);
    for (const model::JointSpec& joint : model.joints()) {
      const double speed = effectors.speeds[model::index(joint.id)];
      EXPECT_EQ(speed, protocol::roundToSixDigits(speed));
    }
  }
}

TEST(JointControl, ParametersAreDeclaredWell) {
  EXPECT_TRUE(config::declarationFaults(ControlParameters{}).empty());
}

/// One robot in the simulation, in free fall from a great height.
class SimulatedRobot {
 public:
  explicit SimulatedRobot(int type) : model_(robotModel(type)), robot_(world_.addRobot(type)) {
    world_.moveRobot(robot_, {0.0F, 0.0F, 500.0F});
  }

  world::BodyState sense() const {
    world::BodyState body;
    for (const model::JointSpec& joint : model_.joints()) {
      body.joints[model::index(joint.id)] = printed(angle(joint.id));
    }
    body.cycleTime = kCycleTime;
    return body;
  }

  double angle(JointId joint) const { return static_cast<double>(world_.jointAngle(robot_, joint)); }

  void step(const protocol::Effectors& answer) {
    if (pending_) {
      for (const model::JointSpec& joint : model_.joints()) {
        world_.setJointSpeed(robot_, joint.id, static_cast<float>(pending_->speeds[model::index(joint.id)]));
      }
    }
    pending_ = answer;
    world_.prePhysics();
    world_.stepPhysics();
  }

 private:
  sim::World world_;
  const RobotModel& model_;
  sim::RobotHandle robot_;
  std::optional<protocol::Effectors> pending_;
};

// The simulated joints have mass and soft hinges: what remains is their motors' give while all of them swing
// at once in free fall.
TEST(JointControl, FollowsSinusoidsInTheSimulation) {
  for (const int type : {0, 2, 3, 4}) {
    const RobotModel& model = robotModel(type);
    SimulatedRobot robot(type);
    JointControl control(model, {});
    std::array<JointTargets, 3> history{};
    double worst = 0.0;
    double squares = 0.0;
    int count = 0;
    for (int k = 0; k < 200; ++k) {
      const world::BodyState body = robot.sense();
      JointTargets targets = targetsAt(0.0);
      for (const model::JointSpec& joint : model.joints()) {
        const double share = 0.3 * std::sin(2.0 * kPi * 1.0 * k * kCycleTime);
        targets.angles[model::index(joint.id)] = withinRange(joint, share);
      }
      if (k > 50) {
        for (const model::JointSpec& joint : model.joints()) {
          const double error = robot.angle(joint.id) - history[(k + 1) % 3].angles[model::index(joint.id)];
          worst = std::max(worst, std::abs(error));
          squares += error * error;
          ++count;
        }
      }
      history[k % 3] = targets;
      protocol::Effectors effectors;
      control.update(body, targets, effectors);
      robot.step(effectors);
    }
    RecordProperty("type" + std::to_string(type) + "_rms_degrees",
                   std::to_string(toDegrees(std::sqrt(squares / count))));
    RecordProperty("type" + std::to_string(type) + "_max_degrees", std::to_string(toDegrees(worst)));
    EXPECT_LT(toDegrees(std::sqrt(squares / count)), 0.05) << "type " << type;
    EXPECT_LT(toDegrees(worst), 0.6) << "type " << type;
  }
}

// One joint after the other at full speed to one stop and then to the other. (All at once, the robot's limbs
// would hit each other.)
TEST(JointControl, StopsAreNotTouchedInTheSimulation) {
  const RobotModel& model = robotModel(4);
  SimulatedRobot robot(4);
  JointControl control(model, {});
  for (const JointId id : {JointId::Head2, JointId::LArm2, JointId::LArm4, JointId::LLeg1, JointId::LLeg2,
                           JointId::LLeg3, JointId::LLeg4, JointId::LLeg5, JointId::LLeg6, JointId::LLeg7}) {
    const model::JointSpec& joint = model.joint(id);
    const double cyclesThere = (joint.high - joint.low) / (joint.maxSpeed * kCycleTime);
    const int cycles = static_cast<int>(cyclesThere) + 12;
    for (int k = 0; k < 3 * cycles; ++k) {
      JointTargets targets = targetsAt(0.0);
      const int phase = k / cycles;  // up, down, back to 0
      targets.angles[model::index(id)] = phase == 0 ? 10.0 : (phase == 1 ? -10.0 : 0.0);
      protocol::Effectors effectors;
      control.update(robot.sense(), targets, effectors);
      robot.step(effectors);
      EXPECT_GT(robot.angle(id), joint.low) << perceptorName(id) << ' ' << k;
      EXPECT_LT(robot.angle(id), joint.high) << perceptorName(id) << ' ' << k;
      if (k == cycles - 1) {
        EXPECT_NEAR(robot.angle(id), joint.high, 0.003) << perceptorName(id);
      }
      if (k == 2 * cycles - 1) {
        EXPECT_NEAR(robot.angle(id), joint.low, 0.003) << perceptorName(id);
      }
    }
  }
}

}  // namespace
}  // namespace nonet::motion
