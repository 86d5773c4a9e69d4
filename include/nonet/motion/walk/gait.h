// First layer of the walk: when which foot steps, how far, and where the swing foot is.
//
// All planning happens in the walk frame W: on the ground below the undisturbed torso, x forward, moving with
// the commanded speed. The stance foot stands still on the ground, so in W it moves backwards; the swing foot
// goes to where half a step ahead of W will be when it lands. There is no double support.
//
// Needs: the wanted speed, and what balance and recovery say (GaitInput). Gives: the step (GaitState) and
// both feet in W.
#pragma once

#include <array>

#include "nonet/config/parameters.h"
#include "nonet/math/pose2.h"
#include "nonet/motion/limbs.h"
#include "nonet/motion/walk/measurement.h"

namespace nonet::motion {

struct GaitParameters {
  double maxStepX = 0.07;
  double maxStepXBack = 0.05;
  double maxStepY = 0.045;
  double maxStepTheta = 0.25;
  double combineExponent = 1.5;
  double deltaStepX = 0.15;
  double deltaStepY = 0.15;
  double deltaStepTheta = 0.2;
  double maxChangeX = 0.004;
  double maxChangeY = 0.004;
  double maxChangeTheta = 0.03;
  double brake = 1.0;
  double stopStep = 0.025;
  double stopTurn = 0.12;
  double accelerationFilter = 0.3;
  double stepDuration = 0.12;
  double footSeparation = 0.11;
  double stepHeight = 0.03;
  double startLift = 0.5;
  double liftBegin = 0.0;
  double liftLength = 1.0;
  double liftStraightness = 0.0;
  double swingBegin = 0.0;
  double swingLength = 1.0;
  double swingStraightness = 0.0;
  double stanceStretch = 0.0;
  double swingPitch = 0.0;
  double footPitch = 0.0;
  double footRoll = 0.0;
  double footYaw = 0.0;
  double footYawPerTurn = 0.5;
  double footYawPerTorsoYaw = 1.0;
  double widthPerTurn = 0.0;
  double widthPerSideStep = 0.0;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    describeStepSize(self, visit);
    describeSwing(self, visit);
    describeFeet(self, visit);
  }

 private:
  template <class Self, class Visitor>
  static void describeStepSize(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"maxStepX", Unit::Metre, {0.0, 0.3}, search(0.02, 0.12), "Largest step forward (maxStep_x)"},
          self.maxStepX);
    visit({"maxStepXBack", Unit::Metre, {0.0, 0.3}, search(0.02, 0.1), "Largest step backward"},
          self.maxStepXBack);
    visit({"maxStepY", Unit::Metre, {0.0, 0.3}, search(0.01, 0.1), "Largest step sideways (maxStep_y)"},
          self.maxStepY);
    visit({"maxStepTheta",
           Unit::Radian,
           {0.0, 1.5},
           search(0.1, 0.9),
           "Largest turn in one step (maxStep_theta)"},
          self.maxStepTheta);
    visit(
        {"combineExponent",
         Unit::None,
         {0.5, 20.0},
         search(1.0, 4.0),
         "Exponent of the norm that bounds steps in several directions at once: their shares of the largest "
         "steps have a norm of at most 1"},
        self.combineExponent);
    visit({"deltaStepX",
           Unit::None,
           {0.0, 1.0},
           search(0.05, 1.0),
           "Share of the gap to the desired step forward that is closed in a cycle (delta_step x)"},
          self.deltaStepX);
    visit({"deltaStepY",
           Unit::None,
           {0.0, 1.0},
           search(0.05, 1.0),
           "Share of the gap to the desired step sideways that is closed in a cycle (delta_step y)"},
          self.deltaStepY);
    visit({"deltaStepTheta",
           Unit::None,
           {0.0, 1.0},
           search(0.05, 1.0),
           "Share of the gap to the desired turn of a step that is closed in a cycle (delta_step theta)"},
          self.deltaStepTheta);
    visit({"maxChangeX",
           Unit::Metre,
           {0.0, 0.3},
           search(0.001, 0.03),
           "Largest change of the forward step in a cycle"},
          self.maxChangeX);
    visit({"maxChangeY",
           Unit::Metre,
           {0.0, 0.3},
           search(0.001, 0.03),
           "Largest change of the side step in a cycle"},
          self.maxChangeY);
    visit({"maxChangeTheta",
           Unit::Radian,
           {0.0, 1.5},
           search(0.01, 0.3),
           "Largest change of the turn of a step in a cycle"},
          self.maxChangeTheta);
    visit({"brake",
           Unit::None,
           {0.05, 5.0},
           search(0.3, 1.5),
           "Factor on deltaStepX, deltaStepY, maxChangeX and maxChangeY while the step shrinks"},
          self.brake);
    visit({"stopStep",
           Unit::Metre,
           {0.0, 0.3},
           search(0.005, 0.04),
           "Coming to a stand soon: a step smaller than this is the last"},
          self.stopStep);
    visit({"stopTurn",
           Unit::Radian,
           {0.0, 1.5},
           search(0.03, 0.3),
           "Coming to a stand soon: likewise its turn"},
          self.stopTurn);
    visit({"accelerationFilter",
           Unit::None,
           {0.01, 1.0},
           search(0.1, 1.0),
           "Share of the gap between the filtered and the commanded acceleration that is closed in a cycle"},
          self.accelerationFilter);
  }

  template <class Self, class Visitor>
  static void describeSwing(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"stepDuration",
           Unit::Second,
           {0.02, 1.0},
           search(0.04, 0.24),
           "Duration of one step, rounded to whole cycles (phi_length)"},
          self.stepDuration);
    visit({"stepHeight", Unit::Metre, {0.0, 0.3}, search(0.01, 0.1), "Lift of the swing foot (z_step)"},
          self.stepHeight);
    visit({"startLift",
           Unit::None,
           {0.0, 2.0},
           search(0.0, 1.0),
           "Share of stepHeight that the first step after a stand is lifted"},
          self.startLift);
    visit({"liftBegin",
           Unit::None,
           {-2.0, 2.0},
           search(-0.5, 0.3),
           "Share of the step that is over when the swing foot lifts (f_g)"},
          self.liftBegin);
    visit({"liftLength",
           Unit::None,
           {0.01, 4.0},
           search(0.5, 1.8),
           "Share of the step that the swing foot is in the air (f_a)"},
          self.liftLength);
    visit({"liftStraightness",
           Unit::None,
           {-1.0, 2.0},
           search(0.0, 1.0),
           "Lift of the swing foot over time: 0 = a cosine, 1 = up and down at a steady speed"},
          self.liftStraightness);
    visit({"swingBegin",
           Unit::None,
           {-2.0, 2.0},
           search(-0.3, 0.3),
           "Share of the step that is over when the swing foot begins to move over the ground (f_s)"},
          self.swingBegin);
    visit({"swingLength",
           Unit::None,
           {0.01, 4.0},
           search(0.5, 1.5),
           "Share of the step in which the swing foot moves over the ground (f_m)"},
          self.swingLength);
    visit({"swingStraightness",
           Unit::None,
           {-1.0, 2.0},
           search(0.0, 1.0),
           "Way of the swing foot over time: 0 = half a cosine, 1 = at a steady speed"},
          self.swingStraightness);
    visit({"stanceStretch",
           Unit::Metre,
           {-0.1, 0.1},
           search(-0.01, 0.01),
           "Stretch of the stance leg in the middle of the step"},
          self.stanceStretch);
  }

  template <class Self, class Visitor>
  static void describeFeet(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"footSeparation",
           Unit::Metre,
           {0.0, 0.4},
           search(0.08, 0.16),
           "Distance between the feet sideways (y_sep)"},
          self.footSeparation);
    visit({"swingPitch",
           Unit::Radian,
           {-1.5, 1.5},
           search(-0.3, 0.3),
           "How far the toe of the swing foot points down at its greatest lift"},
          self.swingPitch);
    visit({"footPitch", Unit::Radian, {-1.0, 1.0}, search(-0.1, 0.1), "How far both toes point down"},
          self.footPitch);
    visit({"footRoll",
           Unit::Radian,
           {-1.0, 1.0},
           search(-0.1, 0.1),
           "How far the inner edges of both feet point down"},
          self.footRoll);
    visit({"footYaw", Unit::Radian, {-0.5, 0.8}, search(-0.1, 0.2), "How far both toes point outwards"},
          self.footYaw);
    visit({"footYawPerTurn",
           Unit::None,
           {-1.0, 2.0},
           search(0.3, 0.7),
           "Further outward turn of the landing foot in rad per rad of turn of the step: a hip turns its leg "
           "outwards only, so that a half is needed"},
          self.footYawPerTurn);
    visit({"footYawPerTorsoYaw",
           Unit::None,
           {-2.0, 4.0},
           search(0.0, 1.5),
           "Further outward turn of the landing foot in rad per rad that the torso turns to and fro"},
          self.footYawPerTorsoYaw);
    visit({"widthPerTurn",
           Unit::Metre,
           {-0.3, 0.3},
           search(-0.03, 0.05),
           "How much further out each foot lands in m per rad of turn of the step"},
          self.widthPerTurn);
    visit({"widthPerSideStep",
           Unit::None,
           {-1.0, 2.0},
           search(-0.2, 0.6),
           "How much further out each foot lands in m per m of side step: with a half the closing foot comes "
           "beside the other one"},
          self.widthPerSideStep);
  }
};

/// The step that is under way, for the layers above.
struct GaitState {
  bool standing = true;
  double phase = 1.0;                // share of the step that is over, (0, 1]
  double stepDuration = kCycleTime;  // s
  model::Side stance = model::Side::Left;
  Pose2 step;                              // step size in force, m, m, rad
  Vector2 acceleration = Vector2::Zero();  // as commanded, filtered, m/s^2
};

/// What the robot is to do.
struct WalkCommand {
  Pose2 speed;        // m/s, m/s, rad/s; the gait shrinks it to what the set allows
  bool walk = false;  // false: come to a stand
  bool soon = false;  // out of small steps earlier than else
  double run = 0.0;   // share of the run (run.h) that a full step gets
};

struct GaitInput {
  double cycleTime = 0.0;  // s
  WalkCommand command;
  double stepShare = 1.0;   // what balance allows of the step
  bool stumbles = false;    // recovery acts: speed up anew afterwards
  bool leans = false;       // too far to stand
  bool calm = true;         // enough to stand
  double leanToLeft = 0.0;  // rad
  Push push{};              // which the step follows at once
};

class Gait {
 public:
  /// One cycle of step size, phase and walk frame. The swing foot does not move in it yet.
  void update(const GaitParameters& parameters, const GaitInput& input);
  /// Where the swing foot lands, X_WS as of now; `torsoYaw` is the turn of the torso at the end of a step.
  Pose2 landing(const GaitParameters& parameters, double torsoYaw) const;
  /// Moves the swing foot to where it is now on its way to `landing`.
  void moveSwingFoot(const GaitParameters& parameters, const Pose2& landing);

  /// Stands with both feet on the ground.
  void reset();
  const GaitState& state() const { return state_; }
  /// X_WS, its sole on the ground plane.
  const Pose2& foot(model::Side side) const { return feet_[index(side)]; }
  bool swings(model::Side side) const { return !state_.standing && side != state_.stance; }
  /// Height of the swing foot as a share of stepHeight.
  double lift(const GaitParameters& parameters) const;
  /// Commanded change of the walk frame in the last cycle.
  const Pose2& odometryStep() const { return odometryStep_; }
  /// Of one step in whole cycles, s.
  static double stepDuration(const GaitParameters& parameters);

 private:
  void placeFeet(const GaitParameters& parameters);
  void updateStepSize(const GaitParameters& parameters, const GaitInput& input);
  void followPush(const GaitParameters& parameters, const Push& push);
  void updateAcceleration(const GaitParameters& parameters, const Vector2& stepChange, double cycles);
  void advancePhase(const GaitInput& input);
  void beginStep(model::Side stance);
  void moveFrame(double cycleTime);

  GaitState state_;
  Pose2 filteredStep_;         // before what balance takes of it, m, m, rad
  std::array<Pose2, 2> feet_;  // X_WS
  Pose2 swingStart_;           // X_WS of the swing foot at the begin of the step
  bool feetPlaced_ = false;
  int stepsDone_ = 0;     // since the stand
  int stepsInPlace_ = 0;  // consecutive, while stopping
  Pose2 odometryStep_;
};

}  // namespace nonet::motion
