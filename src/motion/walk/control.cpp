#include "nonet/motion/walk/control.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/world/others.h"

namespace nonet::motion {

namespace {

constexpr double kLeastSidestep = 0.02;  // m; shorter steps need no set of their own

constexpr double kKeepSet = 1.3;  // the positioning set is kept up to this multiple of its distances

constexpr double kKeepSprint = 1.2;  // likewise the sprint set, up to this multiple of its angle

// Out of a run the robot first slows down, nearly straight ahead, until its step is shorter than the sprint
// set's stopStep: where the set changed at full steps every tenth stop ended in a fall, and every third turn
// about. Done for longer than a moment it is done to its end, though the target may be ahead again: who had
// slowed down and at once gathered speed anew fell more often.
constexpr double kRunOutTurn = 0.5;  // rad/s
constexpr int kMoment = 4;           // cycles

constexpr double kCalm =
    1.0 / 3.0;  // and until tilt errors are below this share of the one that called for it

// On a long way ahead another robot is in it if they meet soon.
constexpr double kLongWayAngle = 0.4;  // rad between the way and where the robot faces
constexpr double kLongWayPace = 1.6;   // m/s, about what it runs
constexpr double kSoon = 1.0;          // s

// How near two points come to each other soon, if they go on as they do; m.
double nearestSoon(const Vector2& offset, const Vector2& velocity) {
  const double time = -offset.dot(velocity) / std::max(velocity.squaredNorm(), 1e-6);
  return (offset + std::clamp(time, 0.0, kSoon) * velocity).norm();
}

// The velocity on such a way, own field frame.
std::optional<Vector2> longWay(const Pose2& X_FR, const MotionRequest& request, double far) {
  const auto* walk = std::get_if<WalkTo>(&request);
  if (walk == nullptr || walk->target.translation.norm() < far) return std::nullopt;
  const Vector2& way = walk->target.translation;
  if (std::abs(directionOf(way)) > kLongWayAngle) return std::nullopt;
  return kLongWayPace * X_FR.rotate(way.normalized());
}

WalkCommand slowedDown(double turn) {
  return {.speed = Pose2(0.0, 0.0, std::clamp(turn, -kRunOutTurn, kRunOutTurn)), .walk = true};
}

WalkSet setAskedFor(const MotionRequest& request) {
  return std::visit(
      [](const auto& kind) {
        if constexpr (requires { kind.set; }) return kind.set;
        return WalkSet::Automatic;
      },
      request);
}

}  // namespace

WalkControl::WalkControl(const model::RobotModel& model, const WalkSets& sets, const WalkSelection& selection,
                         const RunParameters& run)
    : sets_(sets),
      selection_(selection),
      engine_(model, run),
      set_(selection.standSet()),
      from_(sets_.of(set_)),
      active_(from_) {}

void WalkControl::update(const world::WorldState& world, const MotionRequest& wanted, JointTargets& targets) {
  const MotionRequest request = calmed(world, wanted);
  const WalkSet wantedSet = chooseSet(world, request);
  const bool runsOut = (slowsSince_ > kMoment || wantedSet != set_) && set_ == WalkSet::Sprint &&
                       !stumbles() && engine_.gait().step.translation.x() > sets_.sprint.gait.stopStep;
  slowsSince_ = runsOut ? slowsSince_ + 1 : 0;
  const WalkSet set = runsOut ? set_ : wantedSet;
  if (set != set_) {
    set_ = set;
    from_ = active_;
    blended_ = 0.0;
  }
  if (blended_ < 1.0) {
    const double time = std::max(selection_.blendTime, kCycleTime);
    blended_ = std::min(1.0, blended_ + world.body.cycleTime / time);
    active_ = blend(from_, sets_.of(set_), blended_);
  }
  WalkCommand command;
  command.speed = speedFor(request);
  command.walk = std::holds_alternative<WalkVelocity>(request) || std::holds_alternative<WalkTo>(request);
  if (const auto* stand = std::get_if<Stand>(&request)) command.soon = stand->soon;
  if (runsOut) command = slowedDown(command.speed.rotation);
  command.run = runShare(world.body.cycleTime);
  engine_.update(world.body, active_, command, targets);
}

double WalkControl::runShare(double cycleTime) {
  const double change = cycleTime / std::max(selection_.blendTime, kCycleTime);
  run_ = std::clamp(run_ + (set_ == WalkSet::Sprint ? change : -change), 0.0, 1.0);
  if (engine_.standing()) run_ = 0.0;
  return run_;
}

// As seen from the walk frame, in which the torso turns to and fro.
Pose2 WalkControl::speedFor(const MotionRequest& request) const {
  const Pose2 X_WR(Vector2::Zero(), engine_.measurement().torsoYaw);
  Pose2 speed;
  if (const auto* walk = std::get_if<WalkVelocity>(&request)) {
    speed = walk->velocity;
    speed.translation = X_WR.rotate(speed.translation);
  }
  if (const auto* walk = std::get_if<WalkTo>(&request)) {
    speed = speedTowards(active_.approach, active_.gait, X_WR * walk->target, walk->stopAtTarget,
                         walk->turnAtOnce);
  }
  return speed;
}

MotionRequest WalkControl::calmed(const world::WorldState& world, const MotionRequest& wanted) {
  MotionRequest request = wanted;
  if (auto* walk = std::get_if<WalkTo>(&request)) {
    walk->target = filter_.update(walk->target, world.body.odometryStep, world.body.cycleTime,
                                  active_.approach.smoothing);
  } else {
    filter_.reset();
  }
  return request;
}

WalkSet WalkControl::chooseSet(const world::WorldState& world, const MotionRequest& request) const {
  const WalkSet asked = setAskedFor(request);
  const bool canDo = asked != WalkSet::Dribble || (selection_.useDribble && !stumbles());
  if (asked != WalkSet::Automatic && canDo) return asked;
  const bool stand = std::holds_alternative<Stand>(request);
  if (selection_.usePositioning && (stand || stumbles() || isCrowded(world, request)))
    return WalkSet::Positioning;
  if (stand) return set_;
  const auto* walk = std::get_if<WalkTo>(&request);
  if (selection_.useSprint && walk != nullptr && sprints(*walk)) return WalkSet::Sprint;
  return selection_.useSidestep && sidesteps(request) ? WalkSet::Sidestep : WalkSet::GoToTarget;
}

// The direction of the walk counts: the torso turns to and fro against it.
bool WalkControl::sprints(const WalkTo& request) const {
  const Vector2& target = request.target.translation;
  const double angle = wrapAngle(directionOf(target) + engine_.measurement().torsoYaw);
  const bool already = set_ == WalkSet::Sprint;
  return target.norm() > (already ? selection_.sprintUntil : selection_.sprintDistance) &&
         std::abs(angle) < (already ? kKeepSprint : 1.0) * selection_.sprintAngle;
}

bool WalkControl::sidesteps(const MotionRequest& request) const {
  const bool already = set_ == WalkSet::Sidestep;
  const Pose2 speed = speedFor(request);
  const double stepTime = Gait::stepDuration(active_.gait);
  const double forward = speed.translation.x();
  const double aside = speed.translation.y();
  if (speed.translation.norm() * stepTime < kLeastSidestep) return false;
  const double turn = std::abs(speed.rotation) * stepTime / std::max(active_.gait.maxStepTheta, 1e-6);
  return std::abs(std::atan2(aside, forward)) > (already ? 0.75 : 1.0) * selection_.sidestepAngle &&
         turn < (already ? 2.0 : 1.0) * selection_.sidestepTurn;
}

bool WalkControl::stumbles() const {
  const double share = set_ == WalkSet::Positioning ? kCalm : 1.0;
  return engine_.measurement().tilt.largest() > share * selection_.positioningTilt;
}

bool WalkControl::isCrowded(const world::WorldState& world, const MotionRequest& request) const {
  const double keep = set_ == WalkSet::Positioning ? kKeepSet : 1.0;
  if (world.ball.known && world.ball.p_RB.norm() < keep * selection_.positioningDistance) return true;
  if (!world.self.localized) return false;
  const Pose2& X_FR = world.self.X_FR;
  const std::optional<Vector2> way = longWay(X_FR, request, selection_.crowdFar);
  return world::anyOther(world, [&](const world::PlayerState& player) {
    const Vector2 offset = player.X_FP.translation - X_FR.translation;
    if (offset.norm() >= keep * selection_.crowdDistance) return false;
    if (!way || offset.norm() < keep * selection_.crowdNear) return true;
    const Vector2 velocity = player.fallen ? Vector2(Vector2::Zero()) : player.v_FP;
    return nearestSoon(offset, velocity - *way) < keep * selection_.crowdPass;
  });
}

}  // namespace nonet::motion
