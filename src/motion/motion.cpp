#include "nonet/motion/motion.h"

#include <optional>
#include <variant>

#include "nonet/motion/fall_control.h"
#include "nonet/motion/head_control.h"
#include "nonet/motion/kick_control.h"
#include "nonet/motion/walk/control.h"

namespace nonet::motion {

namespace {

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
        library(sharedSkillLibrary(skillFolder, motionParameters.skills)),
        catalogue(*library, robot.type()),
        stand(
            WalkEngine::standAngles(robot, motionParameters.sets.of(motionParameters.selection.standSet()))),
        curves(robot, *library, stand),
        kicks(catalogue, motionParameters.kick, &curves),
        player(robot, *library, stand),
        walk(robot, motionParameters.sets, motionParameters.selection, motionParameters.run),
        fall(robot, *library, motionParameters.fall, stand),
        head(robot, motionParameters.head) {}

  enum class Mode : std::uint8_t { Walk, Skill, Fall };

  bool updateSkill(const world::WorldState& world, const MotionRequest& request);
  bool startSkill(const PlaySkill& request);
  bool startKick(const KickTo& request);
  void updateWalk(const world::WorldState& world, const MotionRequest& request);
  void endEverything(double time);

  MotionParameters parameters;
  std::shared_ptr<const SkillLibrary> library;
  KickCatalogue catalogue;
  model::JointArray stand;
  CurveCheck curves;
  KickControl kicks;
  SkillPlayer player;
  WalkControl walk;
  FallControl fall;
  HeadControl head;
  Transition transition;
  JointTargets targets;
  MotionState state;
  Mode mode = Mode::Walk;
  std::optional<PlaySkill> begun;          // the skill that was begun and is still asked for
  bool skillDone = false;                  // the request that is still made was carried out
  std::optional<MotionRequest> kickSteps;  // to the place for the kick that is asked for
  std::string_view kickName;               // of the one that runs
  bool skillEnded = false;                 // in the last cycle: the walk begins anew
  bool started = false;
  bool putDown = false;  // its steps are over
  double quiet = 0.0;    // s, for which the robot has stood still
};

// A skill or kick that has begun is played to its end.
bool Motion::Stages::updateSkill(const world::WorldState& world, const MotionRequest& request) {
  if (mode != Mode::Skill) {
    kickSteps.reset();
    const auto* skill = std::get_if<PlaySkill>(&request);
    const auto* kick = std::get_if<KickTo>(&request);
    const bool wanted = skill != nullptr || kick != nullptr;
    // A skill is played once for a request, however long it is made; a ball that still lies there is kicked
    // again.
    const bool same = skill != nullptr && begun == *skill;
    if (!wanted) begun.reset();
    if (kick == nullptr) kicks.reset();
    if (!wanted || (skillDone && same)) {
      skillDone = skillDone && wanted;
      return false;
    }
    skillDone = false;
    begun = skill != nullptr ? std::optional(*skill) : std::nullopt;
    if (!(skill != nullptr ? startSkill(*skill) : startKick(*kick))) return false;
    mode = Mode::Skill;
  }
  state.busy = true;
  state.kick.name = kickName;
  if (player.update(world, targets) == SkillPlayer::Result::Running) return true;
  state.skillFinished = true;
  skillDone = true;
  skillEnded = true;
  mode = Mode::Walk;
  return true;
}

bool Motion::Stages::startSkill(const PlaySkill& request) {
  kickName = {};
  if (player.start(request.name, request.side == model::Side::Right, targets.angles)) return true;
  state.skillFinished = true;  // no such skill: nothing to wait for
  skillDone = true;
  return false;
}

bool Motion::Stages::startKick(const KickTo& request) {
  const KickStep step = kicks.update(request, walk.engine(), quiet);
  if (step.option == nullptr) return false;
  const KickOption& option = *step.option;
  state.kick = {option.name, option.foot, step.inPlace, step.aim};
  if (step.begin && player.start(option.name, option.foot == model::Side::Right, targets.angles, step.aim)) {
    kickName = option.name;
    kicks.reset();
    return true;
  }
  if (step.stand) {
    kickSteps.emplace(Stand{.soon = true});
  } else {
    kickSteps.emplace(step.walk);
  }
  return false;
}

void Motion::Stages::updateWalk(const world::WorldState& world, const MotionRequest& request) {
  const bool back = mode != Mode::Walk || !started || skillEnded || putDown;
  putDown = false;
  skillEnded = false;
  if (back) walk.reset();
  const model::JointArray before = started ? targets.angles : world.body.joints;
  mode = Mode::Walk;
  walk.update(world, kickSteps ? *kickSteps : request, targets);
  if (back) transition.begin(before, targets.angles, parameters.transition.standTime);
  transition.apply(world.body.cycleTime, targets.angles);
}

// The robot was put onto its feet: a fall, and a skill that was begun elsewhere, are over.
void Motion::Stages::endEverything(double time) {
  fall.reset(time);
  if (mode != Mode::Skill) return;
  mode = Mode::Walk;
  skillDone = true;
  skillEnded = true;
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
  s.state.kicks = s.catalogue.options();
  s.putDown = s.putDown || beam.has_value();
  if (world.body.putUpright) s.endEverything(world.time);
  const bool skillRuns = s.mode == Stages::Mode::Skill;
  const bool still = s.walk.standing() && world.body.gyro.norm() < s.parameters.kick.quietRate &&
                     world.body.footContact[0] && world.body.footContact[1];
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
