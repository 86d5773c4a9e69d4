#include "nonet/lab/trial/swing_trial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "nonet/lab/trial/game_trial.h"
#include "nonet/lab/trial/true_pose.h"
#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/math/random.h"
#include "nonet/motion/curve_check.h"
#include "nonet/motion/joint_control.h"
#include "nonet/motion/kick_catalogue.h"
#include "nonet/motion/skill_player.h"
#include "nonet/motion/walk/engine.h"
#include "nonet/sim/referee/self_collision.h"
#include "nonet/world/ball_law.h"

#include "lab/trial/ball_flight.h"
#include "lab/trial/kicker.h"

namespace nonet::lab {

namespace {

constexpr double kStands = 0.8;     // s after the kick's end that the robot must stand,
constexpr double kSettles = 0.2;    // or this long if it is nearly upright and
constexpr double kUpright = 0.15;   // rad
constexpr double kAtRest = 0.3;     // rad/s, hardly turns any more
constexpr double kElsewhere = 1.0;  // rad, so far off its direction the ball is of no use,
constexpr double kOnItsWay = 0.1;   // s after contact, when its way is clear

const motion::KickOption* optionOf(const motion::KickCatalogue& catalogue, std::string_view kick,
                                   model::Side foot) {
  for (const motion::KickOption& option : catalogue.options())
    if (option.name == kick && option.foot == foot) return &option;
  return nullptr;
}

sim::WorldSettings worldOf(bool quickSolver) {
  sim::WorldSettings settings;
  settings.solver = quickSolver ? sim::WorldSettings::Solver::Quick : sim::WorldSettings::Solver::Exact;
  return settings;
}

}  // namespace

std::optional<KickStart> kickStart(const agent::AgentSettings& agent, const sim::Settings& settings,
                                   const KickScene& scene, std::uint64_t seed) {
  Random random(seed);
  const KickGame game = kickGame(agent, scene, random);
  GameTrial trial(settings, game.situation, random.next());
  // Motion tells a cycle later that it has begun: then the world is wanted as it was before that cycle.
  std::array<std::vector<std::uint8_t>, 2> worlds;
  while (trial.time() < scene.longest) {
    std::swap(worlds[0], worlds[1]);
    const motion::MotionState& motion = game.kicker->motion;
    if (motion.askedForKick()) worlds[1] = trial.simulation().world().save();
    trial.step();
    if (!motion.busy) continue;
    for (const motion::KickOption& option : motion.kicks)
      if (option.name == motion.kick.name && option.foot == motion.kick.foot)
        return KickStart{worlds[0], option.foot, motion.kick.aim, option.head.p_RBall};
  }
  return std::nullopt;
}

struct SwingTrial::Implementation {
  Implementation(const agent::AgentSettings& agent, const std::string& name, bool quickSolver)
      : kick(name),
        model(model::robotModel(agent.robotType)),
        library(agent.skillFolder, agent.parameters.motion.skills),
        catalogue(library, agent.robotType),
        stand(motion::WalkEngine::standAngles(
            model, agent.parameters.motion.sets.of(agent.parameters.motion.selection.standSet()))),
        check(model, library, stand),
        control(model, agent.parameters.motion.control),
        player(model, library, stand),
        world(worldOf(quickSolver)) {
    if (optionOf(catalogue, kick, model::Side::Left) == nullptr)
      throw std::runtime_error(fmt::format("type {} has no kick '{}'", agent.robotType, kick));
  }

  // A command acts a cycle after the angles that it was made from, so a joint that was held up is told so a
  // cycle later (joint_control.h).
  void moveJoints() {
    control.update(body, targets, effectors);
    for (const model::JointSpec& joint : model.joints()) {
      world.setJointSpeed(robot, joint.id, static_cast<float>(effectors.speeds[model::index(joint.id)]));
    }
    readJoints();
  }
  void readJoints() {
    for (const model::JointSpec& joint : model.joints())
      body.joints[model::index(joint.id)] = world.jointAngle(robot, joint.id);
  }

  // What curves are anchored by: how the torso stands, and the ball where it is believed to be (off as much
  // as it was at the begin).
  void perceive() {
    const sim::ScenePose& torso = world.bodyPose(robot, model::BodyId::Torso);
    const sim::Vector3f left = -torso.rotation.col(0);  // the server's bodies look along y
    const sim::Vector3f forward = torso.rotation.col(1);
    body.pitch = std::asin(std::clamp(-static_cast<double>(forward.z()), -1.0, 1.0));
    body.roll = std::atan2(static_cast<double>(left.z()), static_cast<double>(torso.rotation(2, 2)));
    body.torsoHeight = static_cast<double>(torso.position.z());
    state.body = body;
    state.ball.known = true;
    state.ball.v_FB = ball().v_FB;
    state.ball.p_RB = truePose(world, robot).inverse() * Vector2(ball().p_FB.head<2>() + p_WBelieved);
  }

  void step() {
    moveJoints();
    world.prePhysics();
    world.stepPhysics();
  }

  world::BallMotion ball() const {
    return {world.ballPosition().cast<double>(), world.ballVelocity().cast<double>()};
  }

  void begin(const KickStart& start, const std::optional<double>& distance) {
    world.restore(start.world);
    robot = world.robots().front();
    const motion::KickOption& option = *optionOf(catalogue, kick, start.foot);
    const Vector2 moved = option.head.p_RBall - start.p_RPlace;
    X_WR = truePose(world, robot);
    sim::Vector3f place = world.ballPosition();
    place.head<2>() += X_WR.rotate(moved).cast<float>();
    world.setBallPosition(place);
    body.cycleTime = kCycleTime;
    readJoints();
    control.reset();
    targets = {};
    targets.angles = body.joints;
    targets.stiffness.fill(1.0);
    direction = X_WR.rotation + option.head.direction + start.aim.turn;
    motion::KickAim aim = start.aim;
    aim.ball += moved;
    p_WBelieved = X_WR * aim.ball - ball().p_FB.head<2>();
    aim.distance = distance.value_or(aim.distance);
    allowed = check.check(option, aim.ball).allows();
    player.start(kick, start.foot == model::Side::Right, targets.angles, aim);
  }

  bool goesElsewhere() const {
    return std::abs(angleDifference(directionOf(ball().v_FB.head<2>()), direction)) > kElsewhere;
  }

  Swing run(const KickStart& start, const std::optional<double>& distance) {
    begin(start, distance);
    Swing swing;
    if (!allowed) return swing;  // motion would not begin it
    Kick& result = swing.kick;
    double time = 0.0;
    double over = 0.0;  // s since the end of the skill
    double tilt = trueTilt(world, robot);
    bool settled = false;
    const Vector2 from = ball().p_FB.head<2>();
    BallFlight flight(from);
    const Pose2 aim(from, direction);
    while (over < kStands && !settled && !result.fell) {
      if (player.running()) {
        perceive();
        player.update(state, targets);
      }
      over += player.running() ? 0.0 : kCycleTime;
      const double before = ball().v_FB.norm();
      step();
      time += kCycleTime;
      const world::BallMotion now = ball();
      if (!result.contact && now.v_FB.norm() > before + kHit) {
        result.contact = true;
        result.time = time;
      }
      result.ballSpeed = std::max(result.ballSpeed, now.v_FB.norm());
      flight.note(now);
      const double tiltBefore = std::exchange(tilt, trueTilt(world, robot));
      if (result.contact) {
        swing.lean = std::max(swing.lean, tilt);
        swing.upright = time - result.time;
      }
      settled = over > kSettles && tilt < kUpright && std::abs(tilt - tiltBefore) < kAtRest * kCycleTime;
      result.fell = isDown(world, robot);
      result.selfCollided = result.selfCollided || sim::selfCollides(world, robot);
      if (over > 0.0 && !result.contact) break;
      if (result.contact && time > result.time + kOnItsWay && goesElsewhere()) break;
    }
    flight.tell(result);
    const Vector2 way = aim.inverse() * world::restPlace(ball());
    result.forward = way.x();
    result.aside = way.y();
    return swing;
  }

  std::string kick;
  const model::RobotModel& model;
  motion::SkillLibrary library;
  motion::KickCatalogue catalogue;
  model::JointArray stand;
  motion::CurveCheck check;
  motion::JointControl control;
  motion::SkillPlayer player;
  sim::World world;
  sim::RobotHandle robot = sim::kNoRobot;
  world::BodyState body;
  world::WorldState state;
  motion::JointTargets targets;
  protocol::Effectors effectors;
  Pose2 X_WR;                             // when the kick began
  Vector2 p_WBelieved = Vector2::Zero();  // ball as it was believed then, from where it was
  double direction = 0.0;                 // world, rad: where the ball should go
  bool allowed = true;                    // by the check of curves
};

SwingTrial::SwingTrial(const agent::AgentSettings& agent, const std::string& kick, bool quickSolver)
    : implementation_(std::make_unique<Implementation>(agent, kick, quickSolver)) {}
SwingTrial::~SwingTrial() = default;

const motion::KickHead& SwingTrial::head() const {
  return optionOf(implementation_->catalogue, implementation_->kick, model::Side::Left)->head;
}

Swing SwingTrial::run(const KickStart& start, const std::optional<double>& distance) {
  return implementation_->run(start, distance);
}

}  // namespace nonet::lab
