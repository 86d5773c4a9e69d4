// What the known experiments did before their recording began: placing, standing, crouching, falling. Where a
// controller was at work it is repeated, on the joint angles as printed.
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include <fmt/format.h>

#include "nonet/model/ball.h"
#include "nonet/protocol/rounding.h"

#include "sim/fidelity/replay_server.h"

namespace nonet::sim {

namespace {

using model::JointId;
using Speeds = std::vector<std::pair<JointId, float>>;
using Targets = std::map<JointId, double>;  // degrees

constexpr double kMaxSpeed = 6.1395;  // rad/s

int cyclesOf(double seconds) {
  return static_cast<int>(std::nearbyint(seconds / kCycleTime));
}

std::string ballCommand(double x, double y, double z = model::kBallRadius) {
  return fmt::format("(ball (pos {} {} {})(vel 0.0 0.0 0.0))", x, y, z);
}

const std::string& ballFarAway() {
  static const std::string command = ballCommand(12, 8);
  return command;
}

Speeds zeroSpeeds() {
  Speeds speeds;
  for (std::size_t i = 0; i < model::kJointCount; ++i) {
    const JointId joint = model::jointAt(i);
    if (joint != JointId::RLeg7 && joint != JointId::LLeg7) speeds.emplace_back(joint, 0.0F);
  }
  return speeds;
}

// Gait parameters of the recorded stepping and walking; before the recording the robot only takes their
// crouch.
struct Crouch {
  double crouch;
  double lean;
};
constexpr Crouch kStepping{15.0, 0.3};
constexpr Crouch kWalking{26.1, 7.9};

Targets crouchTargets(const Crouch& gait) {
  Targets targets{{JointId::LArm1, -90.0}, {JointId::RArm1, -90.0}};
  for (const bool left : {true, false}) {
    const auto leg = [left](int n) {
      return model::jointAt(index(left ? JointId::LLeg1 : JointId::RLeg1) + static_cast<std::size_t>(n) - 1);
    };
    targets[leg(3)] = gait.crouch + gait.lean;
    targets[leg(4)] = -2.0 * gait.crouch;
    targets[leg(5)] = gait.crouch;
    targets[leg(2)] = 0.0;
    targets[leg(6)] = 0.0;
  }
  return targets;
}

class History {
 public:
  explicit History(ReplayServer& server) : server_(server) { server_.connectRobots(); }

  void step(const ReplayServer::Answer& answer = {}) { server_.step(answer); }
  void wait(double seconds, const Speeds& speeds = {}) {
    for (int i = 0; i < cyclesOf(seconds); ++i) step({{speeds}, "", ""});
  }
  void trainer(const std::string& command) { step({{}, command, ""}); }

  /// Moves a robot by the trainer, and wakes it by a small speed of the head.
  void place(double x, double y, double angle, double z, const std::string& ball = "",
             std::size_t agent = 0) {
    const std::string move = fmt::format("(agent (unum 1)(team {})(move {} {} {} {}))",
                                         agent == 0 ? "Left" : "Right", x, y, z, angle - 90.0);
    for (const float speed : {0.01F, -0.01F, 0.0F}) {
      ReplayServer::Answer answer;
      answer.speeds.resize(agent + 1);
      answer.speeds[agent] = {{JointId::Head1, speed}};
      if (speed > 0.0F) answer.trainer = move + ball;
      step(answer);
    }
  }
  void stand(double x = -5.0, double y = 0.0, const std::string& ball = ballFarAway()) {
    place(x, y, 0.0, 0.4, ball);
    wait(1.0);
  }
  /// A P controller, as the recording agents had it: gain in 1/s, speeds cut and sent with six digits.
  Speeds toward(const Targets& targets, double gain, double limit = kMaxSpeed, std::size_t agent = 0) const {
    Speeds speeds;
    for (const auto& [joint, target] : targets) {
      const double error = (target - server_.printedAngle(agent, joint)) * (std::numbers::pi / 180.0);
      const double speed = std::max(-limit, std::min(limit, gain * error));
      speeds.emplace_back(joint, static_cast<float>(protocol::roundToSixDigits(speed)));
    }
    return speeds;
  }
  void crouch(const Crouch& gait) {
    const Targets targets = crouchTargets(gait);
    for (int i = 0; i < cyclesOf(1.0); ++i) {
      ReplayServer::Answer answer;
      for (std::size_t k = 0; k < server_.robotCount(); ++k) {
        answer.speeds.push_back(toward(targets, 5.0, kMaxSpeed, k));
      }
      step(answer);
    }
  }
  /// Tips the otherwise stiff robot over its ankles onto its back.
  void fallBack() {
    const Targets targets{{JointId::LLeg5, -35.0}, {JointId::RLeg5, -35.0}};
    for (int i = 0; i < 60; ++i) {
      Speeds speeds = zeroSpeeds();
      for (const auto& moving : toward(targets, 6.0, 3.0)) speeds.push_back(moving);
      step({{speeds}, "", ""});
    }
  }
  void faceToFace(double gap, double offset) {
    Targets straight;
    for (const auto& [joint, speed] : zeroSpeeds()) straight[joint] = 0.0;
    for (int i = 0; i < 2; ++i) {
      place(-3, 4, 0, 0.4, ballFarAway());
      place(3, 4, 180, 0.4, "", 1);
      for (int k = 0; k < 50; ++k) {
        step({{toward(straight, 10.0), toward(straight, 10.0, kMaxSpeed, 1)}, "", ""});
      }
    }
    step({{zeroSpeeds(), zeroSpeeds()}, "", ""});
    place(-gap / 2, 4, 0, 0.4);
    place(gap / 2, 4 + offset, 180, 0.4, "", 1);
    wait(1.0);
  }

 private:
  ReplayServer& server_;
};

using Prelude = std::function<void(History&)>;

/// The balls that roll or fly are set from somewhere on the field; the robot stands far from them.
Prelude ballExperiment(double x, double y, double secondsMore) {
  return [=](History& history) {
    history.stand(-10, -8, ballCommand(x, y));
    history.wait(secondsMore);
  };
}

Prelude inTheAir(double height, double seconds) {
  return [=](History& history) {
    history.place(-5, 0, 0, height, ballFarAway());
    history.wait(seconds);
  };
}

Prelude crouching(double x, double y, const std::string& ball, const Crouch& gait) {
  return [=](History& history) {
    history.stand(x, y, ball);
    history.crouch(gait);
  };
}

const std::map<std::string, Prelude>& preludes() {
  static const Prelude kStand = [](History& history) { history.stand(); };
  static const Prelude kWait = [](History& history) { history.wait(0.2); };
  static const Prelude kBallInAir = ballExperiment(0, 4, 0.0);
  static const std::map<std::string, Prelude> table{
      {"settle",
       [](History& history) {
         history.trainer("(playMode BeforeKickOff)");
         history.wait(0.2);
       }},
      {"settle_asleep",
       [](History& history) {
         history.wait(1.0);
         history.trainer("(playMode BeforeKickOff)");
         history.wait(0.2);
       }},
      {"settle_move", kWait},
      {"drop", kWait},
      {"joint_pulses_air", inTheAir(30.0, 0.2)},
      {"joint_speed_limit", inTheAir(30.0, 0.1)},
      {"joint_stops", inTheAir(60.0, 0.1)},
      {"joint_pulses_lying",
       [](History& history) {
         history.stand();
         history.fallBack();
         history.wait(1.5, zeroSpeeds());
       }},
      {"joint_pulses_standing", kStand},
      {"crouch_rise", kStand},
      {"hop", kStand},
      {"fall_front", kStand},
      {"fall_back", kStand},
      {"fall_left", kStand},
      {"fall_right", kStand},
      {"step_in_place", crouching(-5, 0, ballFarAway(), kStepping)},
      {"walk_until_fall", crouching(-10, 0, ballFarAway(), kWalking)},
      {"walk_into_post", crouching(14.3, 1.07, ballCommand(0, 4), kWalking)},
      {"kick", [](History& history) { history.stand(0, 4, ballCommand(0.157, 3.945)); }},
      {"ball_roll_0p5", ballExperiment(-3, 2, 0.5)},
      {"ball_roll_1", ballExperiment(-3, 2, 0.5)},
      {"ball_roll_2", ballExperiment(-3, 2, 0.5)},
      {"ball_roll_4", ballExperiment(-13, 2, 0.5)},
      {"ball_roll_6", ballExperiment(-13, 2, 0.5)},
      {"ball_drop", kBallInAir},
      {"ball_loft", kBallInAir},
      {"ball_post", kBallInAir},
      {"ball_post_side", kBallInAir},
      {"ball_bar", kBallInAir},
      {"ball_goal", kBallInAir},
      {"collide",
       [](History& history) {
         history.faceToFace(1.0, 0.03);
         history.crouch(kWalking);
       }},
      {"fall_onto_robot", [](History& history) { history.faceToFace(0.55, 0.05); }},
  };
  return table;
}

}  // namespace

bool replayHistory(const std::string& scenario, ReplayServer& server) {
  const auto found = preludes().find(scenario);
  if (found == preludes().end()) return false;
  History history(server);
  found->second(history);
  return true;
}

bool replayStanding(const RecordedCycle& start, ReplayServer& server) {
  constexpr double kStandingHeight = 0.38387;  // m, torso of a type 0 robot at rest
  for (const RecordedRobot& robot : start.robots) {
    const auto torso = robot.parts.find(model::BodyId::Torso);
    if (torso == robot.parts.end() || !torso->second.rotation) return false;
    if (std::abs(torso->second.position.z() - kStandingHeight) > 0.1) return false;
    for (const auto& [joint, angle] : robot.joints) {
      if (std::abs(angle) > 0.011) return false;
    }
  }
  const auto to = [](double value, double unit) { return std::round(value / unit) * unit; };
  History history(server);
  for (std::size_t i = 0; i < start.robots.size(); ++i) {
    const RecordedRobot::Part& torso = start.robots[i].parts.at(model::BodyId::Torso);
    const Eigen::Vector3d forward = torso.rotation->col(1);
    const double angle = std::atan2(forward.y(), forward.x()) * 180.0 / std::numbers::pi;
    const std::string ball =
        i == 0 ? ballCommand(to(start.ball.x(), 1e-3), to(start.ball.y(), 1e-3)) : std::string();
    history.place(to(torso.position.x(), 1e-3), to(torso.position.y(), 1e-3), to(angle, 0.1), 0.4, ball, i);
  }
  history.wait(1.0);
  return true;
}

}  // namespace nonet::sim
