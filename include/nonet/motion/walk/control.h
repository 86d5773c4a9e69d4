// Walk control: a request (stand, velocity, target) -> speed and parameter set for the walk engine.
//
// Sets, after [MacAlpine 2012a, section 4.2]: `walk` (goToTarget) always; `sprint` when the target lies
// within 15 degrees of the robot's direction; `sidestep` to walk sideways and backward without turning,
// which the paper does not have; `positioning` near the ball (there within 0.8 m of it), and
// here also near another robot, to stand and while stumbling: it is the set that was learned among pushes;
// `dribble` where the request asks for it, with a type that has one.
// Changes are blended. A target that jumps about is averaged (target_filter.h).
#pragma once

#include "nonet/motion/target_filter.h"
#include "nonet/motion/walk/engine.h"
#include "nonet/world/world_state.h"

namespace nonet::motion {

struct WalkSets {
  WalkParameters goToTarget;
  WalkParameters sprint;
  WalkParameters sidestep;
  WalkParameters positioning;
  WalkParameters dribble;

  const WalkParameters& of(WalkSet set) const {
    switch (set) {
      case WalkSet::Sprint:
        return sprint;
      case WalkSet::Sidestep:
        return sidestep;
      case WalkSet::Positioning:
        return positioning;
      case WalkSet::Dribble:
        return dribble;
      default:
        return goToTarget;
    }
  }
};

struct WalkSelection {
  bool useSprint = false;
  bool useSidestep = false;
  bool usePositioning = false;
  bool useDribble = false;
  double sprintAngle = 0.2618;
  double sprintDistance = 0.5;
  double sprintUntil = 0.2;
  double sidestepAngle = 1.0;
  double sidestepTurn = 0.3;
  double positioningDistance = 1.2;
  double crowdDistance = 1.4;
  double crowdFar = 2.0;
  double crowdNear = 0.5;
  double crowdPass = 0.6;
  double positioningTilt = 0.25;
  double blendTime = 0.2;

  /// The set whose stand the robot takes: where rising ends and skills begin.
  WalkSet standSet() const { return usePositioning ? WalkSet::Positioning : WalkSet::GoToTarget; }

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"useSprint", Unit::None, {0, 1}, fixed, "Whether the sprint set is used at all"}, self.useSprint);
    visit({"useSidestep", Unit::None, {0, 1}, fixed, "Whether the sidestep set is used at all"},
          self.useSidestep);
    visit({"usePositioning", Unit::None, {0, 1}, fixed, "Whether the positioning set is used at all"},
          self.usePositioning);
    visit({"useDribble", Unit::None, {0, 1}, fixed, "Whether the dribble set is used at all"},
          self.useDribble);
    visit(
        {"sprintAngle", Unit::Radian, {0.0, 3.2}, fixed, "Sprint: largest angle between heading and target"},
        self.sprintAngle);
    visit({"sprintDistance", Unit::Metre, {0.0, 30.0}, fixed, "Sprint: least distance of the target"},
          self.sprintDistance);
    visit(
        {"sprintUntil", Unit::Metre, {0.0, 30.0}, fixed, "Sprint: kept until the target is nearer than this"},
        self.sprintUntil);
    visit({"sidestepAngle",
           Unit::Radian,
           {0.0, 3.2},
           fixed,
           "Sidestep: least angle between heading and motion; kept down to three quarters of it"},
          self.sidestepAngle);
    visit({"sidestepTurn",
           Unit::None,
           {0.0, 1.0},
           fixed,
           "Sidestep: largest turn as a share of the fastest; kept up to twice of it"},
          self.sidestepTurn);
    visit(
        {"positioningDistance", Unit::Metre, {0.0, 30.0}, fixed, "Positioning: largest distance of the ball"},
        self.positioningDistance);
    visit({"crowdDistance",
           Unit::Metre,
           {0.0, 30.0},
           fixed,
           "Positioning: largest distance of another robot, which may bump into this one"},
          self.crowdDistance);
    visit(
        {"crowdFar",
         Unit::Metre,
         {0.0, 1000.0},
         fixed,
         "With a target farther than this, ahead, robots that the way passes at some distance are no crowd"},
        self.crowdFar);
    visit({"crowdNear",
           Unit::Metre,
           {0.0, 30.0},
           fixed,
           "Positioning on a long way (crowdFar): largest distance of another robot, wherever it is"},
          self.crowdNear);
    visit({"crowdPass",
           Unit::Metre,
           {0.0, 30.0},
           fixed,
           "Positioning on a long way (crowdFar): largest distance at which it passes another robot soon"},
          self.crowdPass);
    visit({"positioningTilt",
           Unit::Radian,
           {0.0, 3.2},
           fixed,
           "Positioning: least tilt error, of a robot that stumbles; kept until it is back at a third"},
          self.positioningTilt);
    visit({"blendTime", Unit::Second, {0.0, 2.0}, fixed, "Time to change from one set to another"},
          self.blendTime);
  }
};

class WalkControl {
 public:
  WalkControl(const model::RobotModel& model, const WalkSets& sets, const WalkSelection& selection,
              const RunParameters& run = {});

  /// Any other request than WalkVelocity and WalkTo stands.
  void update(const world::WorldState& world, const MotionRequest& wanted, JointTargets& targets);

  /// Begins again from the stand (after a fall, a skill).
  void reset() {
    engine_.reset();
    filter_.reset();
  }
  bool standing() const { return engine_.standing(); }
  const WalkEngine& engine() const { return engine_; }
  WalkSet set() const { return set_; }

 private:
  WalkSet chooseSet(const world::WorldState& world, const MotionRequest& request) const;
  bool sprints(const WalkTo& request) const;
  bool sidesteps(const MotionRequest& request) const;
  MotionRequest calmed(const world::WorldState& world, const MotionRequest& wanted);
  bool isCrowded(const world::WorldState& world, const MotionRequest& request) const;
  bool stumbles() const;
  Pose2 speedFor(const MotionRequest& request) const;
  double runShare(double cycleTime);

  WalkSets sets_;
  WalkSelection selection_;
  WalkEngine engine_;
  TargetFilter filter_;
  WalkSet set_ = WalkSet::GoToTarget;
  WalkParameters from_;  // active when the set changed
  WalkParameters active_;
  double blended_ = 1.0;  // share of the change that is done
  int slowsSince_ = 0;    // cycles in which it slows down to leave the sprint set
  double run_ = 0.0;      // share of the run: it comes with the sprint set, and goes with it
};

}  // namespace nonet::motion
