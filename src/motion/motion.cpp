#include "nonet/motion/motion.h"

#include <optional>
#include <variant>

#include "nonet/motion/fall_control.h"
#include "nonet/motion/head_control.h"
#include "nonet/motion/walk/control.h"

namespace nonet::motion {

namespace {

constexpr double kKickRate = 0.35;   // rad/s, of the torso before a kick
constexpr double kKickQuiet = 0.04;  // s, so long: a robot that rocks on its feet is quiet only for a moment

// Takes out the jump when another source of targets takes over: the difference to what was commanded last
// fades away.
class Transition {
 public:
  void begin(const model::JointArray& from, const model::JointArray& to, double duration) {
    for (std::size_t i = 0; i < model::kJointCount; ++i) offset_[i] = from[i] - to[i];
    duration_ = duration;
    left_ = duration;
  }
  void apply(double time, model::JointArray& angles) {
    if (left_ <= 0.0) return;
    left_ -= time;
    const double share = left_ > 0.0 ? left_ / duration_ : 0.0;
    const double smooth = share * share * (3.0 - 2.0 * share);
    for (std::size_t i = 0; i < model::kJointCount; ++i) angles[i] += smooth * offset_[i];
  }

 private:
  model::JointArray offset_{};
  double duration_ = 0.0;
  double left_ = 0.0;
};

}  // namespace

struct Motion::Stages {
  Stages(const model::RobotModel& robot, const MotionParameters& motionParameters,
         const std::string& skillFolder)
      : parameters(motionParameters),
        library(skillFolder, motionParameters.skills),
        stand(
            WalkEngine::standAngles(robot, motionParameters.sets.of(motionParameters.selection.standSet()))),
        player(robot, library, stand),
        walk(robot, motionParameters.sets, motionParameters.selection),
        fall(robot, library, motionParameters.fall, stand),
        head(robot, motionParameters.head) {}

  enum class Mode : std::uint8_t { Walk, Skill, Fall };

  bool updateSkill(const world::WorldState& world, const MotionRequest& request);
  bool startSkill(const MotionRequest& request);
  void updateWalk(const world::WorldState& world, const MotionRequest& request);

  MotionParameters parameters;
  SkillLibrary library;
  model::JointArray stand;
  SkillPlayer player;
  WalkControl walk;
  FallControl fall;
  HeadControl head;
  Transition transition;
  JointTargets targets;
  MotionState state;
  Mode mode = Mode::Walk;
  std::optional<PlaySkill> begun;  // the skill that was begun and is still asked for
  bool skillDone = false;          // the request that is still made was carried out
  bool started = false;
  bool putDown = false;  // its steps are over
  double quiet = 0.0;    // s, for which the robot has stood still
};

// A skill or kick that has begun is played to its end.
bool Motion::Stages::updateSkill(const world::WorldState& world, const MotionRequest& request) {
  if (mode != Mode::Skill) {
    const auto* skill = std::get_if<PlaySkill>(&request);
    const bool wanted = skill != nullptr || std::holds_alternative<KickTo>(request);
    // A skill is played once for a request, however long it is made; a ball that still lies there is kicked
    // again.
    const bool same = skill != nullptr && begun == *skill;
    if (!wanted) begun.reset();
    if (!wanted || (skillDone && same)) {
      skillDone = skillDone && wanted;
      return false;
    }
    skillDone = false;
    begun = skill != nullptr ? std::optional(*skill) : std::nullopt;
    if (!startSkill(request)) return false;
  }
  state.busy = true;
  if (player.update(world, targets) == SkillPlayer::Result::Running) return true;
  state.skillFinished = true;
  skillDone = true;
  mode = Mode::Walk;
  return true;
}

bool Motion::Stages::startSkill(const MotionRequest& request) {
  bool started = false;
  if (const auto* kick = std::get_if<KickTo>(&request)) {
    if (quiet < kKickQuiet) return false;
    started = player.start("kick_forward", kick->foot == model::Side::Right, targets.angles, kick->ball);
  } else if (const auto* skill = std::get_if<PlaySkill>(&request)) {
    started = player.start(skill->name, skill->side == model::Side::Right, targets.angles);
  }
  if (!started) {
    state.skillFinished = true;  // no such skill: nothing to wait for
    skillDone = true;
    return false;
  }
  mode = Mode::Skill;
  return true;
}

void Motion::Stages::updateWalk(const world::WorldState& world, const MotionRequest& request) {
  const bool back = mode != Mode::Walk || !started || state.skillFinished || putDown;
  putDown = false;
  if (back) walk.reset();
  const model::JointArray before = started ? targets.angles : world.body.joints;
  mode = Mode::Walk;
  walk.update(world, request, targets);
  if (back) transition.begin(before, targets.angles, parameters.transition.standTime);
  transition.apply(world.body.cycleTime, targets.angles);
}

Motion::Motion(const model::RobotModel& model, const MotionParameters& parameters,
               const std::string& skillFolder)
    : stages_(std::make_unique<Stages>(model, parameters, skillFolder)) {}
Motion::~Motion() = default;

const MotionState& Motion::state() const {
  return stages_->state;
}
const WalkControl& Motion::walk() const {
  return stages_->walk;
}

const FallControl& Motion::fall() const {
  return stages_->fall;
}

const JointTargets& Motion::update(const world::WorldState& world, const MotionRequest& request,
                                   const HeadRequest& head, const std::optional<Pose2>& beam) {
  Stages& s = *stages_;
  s.state = MotionState{};
  s.state.request = request;
  s.state.beam = beam;
  s.putDown = s.putDown || beam.has_value();
  const bool skillRuns = s.mode == Stages::Mode::Skill;
  const bool still = s.walk.standing() && world.body.gyro.norm() < kKickRate && world.body.footContact[0] &&
                     world.body.footContact[1];
  s.quiet = still ? s.quiet + world.body.cycleTime : 0.0;
  if (!skillRuns && s.started && s.fall.update(world, s.player, s.targets)) {
    s.mode = Stages::Mode::Fall;
    s.head.release();
  } else if (s.started && s.updateSkill(world, request)) {
    s.head.release();
  } else {
    s.updateWalk(world, request);
    s.head.update(world.body, head, s.targets);
  }
  s.state.rising = s.fall.active();
  s.started = true;
  return s.targets;
}

}  // namespace nonet::motion
