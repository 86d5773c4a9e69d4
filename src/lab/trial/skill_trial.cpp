#include "nonet/lab/trial/skill_trial.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "nonet/agent/robot.h"
#include "nonet/lab/trial/true_pose.h"
#include "nonet/math/angle.h"
#include "nonet/motion/kick_catalogue.h"
#include "nonet/motion/skill_player.h"
#include "nonet/motion/walk/engine.h"
#include "nonet/sim/server/monitor.h"
#include "nonet/sim/simulation.h"
#include "nonet/world/ball_law.h"

#include "lab/trial/trial_server.h"

namespace nonet::lab {

namespace {

constexpr double kPreparation = 3.0;       // s to be beamed, to stand and to come to rest
constexpr double kHolds = 1.0;             // s that the last posture is watched
constexpr double kLongestSkill = 20.0;     // s
constexpr double kRollsOut = 8.0;          // s, for a ball that flies and bounces
constexpr double kTouched = 0.1;           // m/s: a ball that lies still has been touched
constexpr double kMoves = toRadians(1.0);  // a joint that is told to change by less stays where it is

// A robot on a field of its own, with the motion's player and joint control.
class Stage {
 public:
  explicit Stage(const SkillTrialSettings& settings)
      : settings_(settings),
        robot_(agent::robotSettings(settings.agent)),
        library_(settings.agent.skillFolder, settings.agent.parameters.motion.skills),
        player_(robot_.model(), library_, standOf(settings.agent)),
        simulation_(trialServer({}, kPreparation), settings.agent.seed) {
    if (library_.find(settings.skill) < 0) {
      throw std::runtime_error(fmt::format("there is no skill '{}' in {}: use one of {}", settings.skill,
                                           settings.agent.skillFolder, fmt::join(names(), ", ")));
    }
    protocol::SceneEffector scene;
    scene.robotType = settings.agent.robotType;
    protocol::InitEffector init;
    init.unum = 2;
    init.team.assign(settings.agent.team);
    handle_ = simulation_.enter(scene, init);
  }

  SkillTrial run() {
    stand();
    simulation_.trainer("(playMode PlayOn)");
    X_WR_ = truePose(world(), body());
    if (!settings_.monitorLog.empty()) log_.emplace(simulation_, settings_.monitorLog, 1);
    placeBall();
    begin();
    for (double over = 0.0; goesOn(over);) {
      cycle();
      if (!player_.running()) over += kCycleTime;
    }
    if (trial_.kick) judgeBall();
    if (log_) {
      log_->close();
      trial_.recordingError = log_->error();
    }
    return std::move(trial_);
  }

 private:
  static model::JointArray standOf(const agent::AgentSettings& agent) {
    const motion::MotionParameters& motion = agent.parameters.motion;
    return motion::WalkEngine::standAngles(model::robotModel(agent.robotType),
                                           motion.sets.of(motion.selection.standSet()));
  }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < library_.size(); ++i)
      names.push_back(library_.skill(static_cast<int>(i)).name);
    return names;
  }

  const sim::World& world() const { return simulation_.world(); }
  sim::RobotHandle body() const { return simulation_.agents().front().robot; }
  world::BallMotion ball() const {
    return {world().ballPosition().cast<double>(), world().ballVelocity().cast<double>()};
  }

  // One cycle; what to send is made from what is sensed.
  template <class Answer>
  void step(const Answer& answer) {
    if (const protocol::Percept* percept = simulation_.sense(handle_)) {
      robot_.sense(*percept);
      effectors_.clear();
      answer();
      simulation_.act(handle_, effectors_);
    }
    simulation_.step();
    if (log_) log_->cycle();
  }

  void stand() {
    const Pose2 place(-5.0, 0.0, 0.0);  // the ball lies on the centre spot, out of reach
    team::Action action;
    action.head = motion::HeadRequest{motion::HeadRequest::Kind::Look, Vector3::Zero(), 0.0, 0.0};
    bool beamed = false;
    const long cycles = std::lround(kPreparation / kCycleTime);
    for (long i = 0; i < cycles; ++i) {
      step([&] {
        action.beam.reset();
        if (!beamed && robot_.world().game.unum != 0) {
          action.beam = place;
          beamed = true;
        }
        robot_.act(action, effectors_);
      });
    }
  }

  // Where the user wants it, or where the kick does.
  void placeBall() {
    const motion::Skill& skill = library_.skill(library_.find(settings_.skill));
    std::optional<motion::KickHead> head = skill.kick;
    if (head && settings_.mirrored) head = motion::mirroredHead(*head);
    if (!head && !settings_.ball) return;
    trial_.kick.emplace();
    trial_.kick->p_RPlace = settings_.ball ? *settings_.ball : head->p_RBall;
    trial_.kick->intended = head ? head->direction : 0.0;
    trial_.kick->fromWalk = head && head->fromWalk;
    const Vector2 p_WB = X_WR_ * trial_.kick->p_RPlace;
    simulation_.trainer(
        fmt::format("(ball (pos {} {} {})(vel 0 0 0))", p_WB.x(), p_WB.y(), world::kBallRestHeight));
  }

  void begin() {
    std::optional<motion::KickAim> aim;
    if (trial_.kick) {
      const motion::Skill& skill = library_.skill(library_.find(settings_.skill));
      aim.emplace().ball = trial_.kick->p_RPlace;
      if (skill.kick) aim->distance = skill.kick->longest;
    }
    targets_.angles = robot_.world().body.joints;
    targets_.stiffness.fill(1.0);
    player_.start(settings_.skill, settings_.mirrored, targets_.angles, aim);
  }

  bool goesOn(double over) const {
    const double now = static_cast<double>(trial_.cycles.size()) * kCycleTime;
    if (settings_.seconds > 0.0) return now < settings_.seconds - 0.5 * kCycleTime;
    if (player_.running()) return now < kLongestSkill;
    return over < kHolds ||
           (trial_.kick && trial_.kick->contact && world::isFlying(ball()) && over < kRollsOut);
  }

  void cycle() {
    SkillCycle& now = trial_.cycles.emplace_back();
    now.time = static_cast<double>(trial_.cycles.size() - 1) * kCycleTime;
    for (const model::JointSpec& joint : robot_.model().joints())
      now.angle[model::index(joint.id)] = world().jointAngle(body(), joint.id);
    now.torsoHeight = world().bodyPose(body(), model::BodyId::Torso).position.z();
    now.tilt = trueTilt(world(), body());
    now.ballSpeed = trial_.kick ? ball().v_FB.norm() : 0.0;
    trial_.fell = trial_.fell || isDown(world(), body());
    now.target = targets_.angles;
    if (trial_.kick) watchBall(*trial_.kick, now);
    step([&] { play(now.time); });
  }

  void play(double time) {
    if (player_.running()) {
      believed_ = robot_.world();
      if (trial_.kick) {  // the eyes are no part of what is tried
        believed_.ball.known = true;
        believed_.ball.v_FB = ball().v_FB;
        believed_.ball.p_RB = truePose(world(), body()).inverse() * Vector2(ball().p_FB.head<2>());
      }
      mark(time);
      const motion::SkillPlayer::Result result = player_.update(believed_, targets_);
      noteStretch();
      using Result = SkillTrial::Result;
      // A skill of whole cycles says in the cycle after its last that there is no more.
      trial_.duration = result == motion::SkillPlayer::Result::Running ? time + kCycleTime : time;
      if (result == motion::SkillPlayer::Result::Finished) trial_.result = Result::Finished;
      if (result == motion::SkillPlayer::Result::Failed) trial_.result = Result::Failed;
    }
    robot_.follow(targets_, effectors_);
  }

  void mark(double time) {
    const motion::SkillPlayer::Place place = player_.statement();
    if (!trial_.marks.empty() && trial_.marks.back().line == place.line &&
        trial_.marks.back().skill == place.skill)
      return;
    if (place.line > 0) trial_.marks.push_back({time, std::string(place.skill), place.line});
  }

  // One statement may be played more than once.
  void noteStretch() {
    const std::optional<motion::SkillPlayer::Stretch>& stretch = player_.stretch();
    if (!stretch) return;
    if (!trial_.stretches.empty() && trial_.stretches.back() == *stretch) return;
    trial_.stretches.push_back(*stretch);
  }

  void watchBall(SkillKick& kick, const SkillCycle& now) const {
    if (!kick.contact && now.ballSpeed > kTouched) {
      kick.contact = true;
      kick.time = now.time;
    }
    kick.speed = std::max(kick.speed, now.ballSpeed);
    kick.height = std::max(kick.height, ball().p_FB.z());
  }

  // The rest of a roll is certain.
  void judgeBall() {
    SkillKick& kick = *trial_.kick;
    if (!kick.contact) return;
    const Vector2 way = X_WR_.inverse() * world::restPlace(ball()) - kick.p_RPlace;
    kick.distance = way.norm();
    kick.direction = std::atan2(way.y(), way.x());
  }

  const SkillTrialSettings& settings_;
  agent::Robot robot_;
  motion::SkillLibrary library_;
  motion::SkillPlayer player_;
  sim::Simulation simulation_;
  sim::AgentHandle handle_ = sim::kNoAgent;
  std::optional<sim::MonitorLog> log_;
  Pose2 X_WR_;  // when the skill began
  world::WorldState believed_;
  motion::JointTargets targets_;
  protocol::Effectors effectors_;
  SkillTrial trial_;
};

}  // namespace

std::vector<model::JointId> SkillTrial::moved() const {
  std::vector<model::JointId> joints;
  for (std::size_t i = 0; i < model::kJointCount; ++i) {
    const auto less = [i](const SkillCycle& a, const SkillCycle& b) { return a.target[i] < b.target[i]; };
    const auto [low, high] = std::minmax_element(cycles.begin(), cycles.end(), less);
    if (low == cycles.end()) continue;
    if (high->target[i] - low->target[i] > kMoves) joints.push_back(model::jointAt(i));
  }
  return joints;
}

SkillTrial playSkill(const SkillTrialSettings& settings) {
  return Stage(settings).run();
}

}  // namespace nonet::lab
