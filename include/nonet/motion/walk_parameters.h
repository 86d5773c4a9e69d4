// Declared parameters of the walk engine: one object is one parameter set.
//
// Names follow [MacAlpine 2012b, table 1], where that paper names them: maxStep, y_shift, z_torso, z_step,
// f_g, f_a, f_s, f_m, phi_length, delta_step, y_sep, x_offset, x_factor, err_norm, err_max. Ranges bound only
// what breaks the code: learned optima lie outside what a physical reading would allow.
#pragma once

#include "nonet/config/parameters.h"

namespace nonet::motion {

struct WalkParameters {
  // Step sizes
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
  // Pendulum and torso
  double phiLength = 0.12;
  double zTorso = 0.88;
  double yShift = 0.0;
  double swayFactor = 1.0;
  double xPendulum = 1.0;
  double pendulumHeight = 0.26;
  double xOffset = -0.015;
  double xFactor = 0.0;
  double xFactorBack = 0.0;
  double yFactor = 0.0;
  double torsoPitch = 0.0;
  double torsoPitchStep = 0.0;
  double torsoPitchStepBack = 0.0;
  double torsoRollStep = 0.0;
  double torsoYawStep = 0.0;
  double accelerationFilter = 0.3;
  double accelerationShiftX = 0.0;
  double accelerationShiftY = 0.0;
  double accelerationPitch = 0.0;
  double accelerationRoll = 0.0;
  double comGainX = 0.0;
  double comGainY = 0.0;
  // Feet
  double ySep = 0.11;
  double zStep = 0.03;
  double fG = 0.0;
  double fA = 1.0;
  double fS = 0.0;
  double fM = 1.0;
  double swingStraightness = 0.0;
  double liftStraightness = 0.0;
  double zPush = 0.0;
  double swingPitch = 0.0;
  double footPitch = 0.0;
  double footRoll = 0.0;
  double footYaw = 0.0;
  double turnYaw = 0.5;
  double yawOut = 1.0;
  double turnOut = 0.0;
  double sideOut = 0.0;
  double startLift = 0.5;
  // Feedback
  double errNorm = 0.03;
  double errMax = 0.08;
  double balanceTilt = 0.15;
  double comDelay = 0.04;
  double tiltDelay = 0.0;
  double hipPitchGain = 0.0;
  double hipPitchRateGain = 0.0;
  double hipRollGain = 0.0;
  double hipRollRateGain = 0.0;
  double anklePitchGain = 0.0;
  double anklePitchRateGain = 0.0;
  double ankleRollGain = 0.0;
  double ankleRollRateGain = 0.0;
  double swingLevelGain = 0.5;
  double stepPitchGain = 0.05;
  double stepPitchRateGain = 0.01;
  double stepRollGain = 0.05;
  double stepRollRateGain = 0.01;
  // Recovering from a large tilt
  double recoverTilt = 0.2;
  double recoverLevelPitch = 0.0;
  double recoverLevelRoll = 0.0;
  double recoverStepPitch = 0.0;
  double recoverStepRoll = 0.0;
  // Arms
  double armPitch = -1.57;
  double armYaw = 0.15;
  double armRoll = 0.0;
  double elbow = 0.2;
  double armSwing = 1.0;
  // Going to a target
  double targetGain = 3.0;
  double targetTurnGain = 4.0;
  double targetTurnDistance = 0.5;
  double targetSmoothing = 0.0;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    describeSteps(self, visit);
    describeTorso(self, visit);
    describeFeet(self, visit);
    describeFeedback(self, visit);
    describeRecovery(self, visit);
    describeRest(self, visit);
  }

 private:
  template <class Self, class Visitor>
  static void describeSteps(Self& self, Visitor&& visit) {
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
           "Largest turn of one step (maxStep_theta)"},
          self.maxStepTheta);
    visit({"combineExponent",
           Unit::None,
           {0.5, 20.0},
           search(1.0, 4.0),
           "Steps in several directions at once stay within the unit ball of this norm"},
          self.combineExponent);
    visit({"deltaStepX",
           Unit::None,
           {0.0, 1.0},
           search(0.05, 1.0),
           "Share of the gap to the desired step closed in a cycle (delta_step x)"},
          self.deltaStepX);
    visit({"deltaStepY", Unit::None, {0.0, 1.0}, search(0.05, 1.0), "The same sideways (delta_step y)"},
          self.deltaStepY);
    visit({"deltaStepTheta",
           Unit::None,
           {0.0, 1.0},
           search(0.05, 1.0),
           "The same for turning (delta_step theta)"},
          self.deltaStepTheta);
    visit(
        {"maxChangeX", Unit::Metre, {0.0, 0.3}, search(0.001, 0.03), "Largest change of the step in a cycle"},
        self.maxChangeX);
    visit({"maxChangeY", Unit::Metre, {0.0, 0.3}, search(0.001, 0.03), "The same sideways"}, self.maxChangeY);
    visit({"maxChangeTheta", Unit::Radian, {0.0, 1.5}, search(0.01, 0.3), "The same for turning"},
          self.maxChangeTheta);
    visit({"brake",
           Unit::None,
           {0.05, 5.0},
           search(0.3, 1.5),
           "Factor on delta_step and the largest change of translation while the step shrinks"},
          self.brake);
  }

  template <class Self, class Visitor>
  static void describeTorso(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"phiLength",
           Unit::Second,
           {0.02, 1.0},
           search(0.04, 0.24),
           "Duration of one step, rounded to whole cycles (phi_length)"},
          self.phiLength);
    visit({"zTorso",
           Unit::None,
           {0.4, 1.1},
           search(0.7, 1.0),
           "Torso height above the sole as a share of that with straight legs (z_torso)"},
          self.zTorso);
    visit({"yShift",
           Unit::Metre,
           {-0.2, 0.2},
           search(-0.01, 0.03),
           "Shift over the stance foot in mid-step, beyond that of the pendulum (y_shift)"},
          self.yShift);
    visit({"swayFactor", Unit::None, {-5.0, 5.0}, search(0.0, 2.0), "Factor on the pendulum's own sway"},
          self.swayFactor);
    visit({"xPendulum",
           Unit::None,
           {-5.0, 5.0},
           search(0.0, 2.0),
           "Forward motion: 0 = steady, 1 = as the pendulum"},
          self.xPendulum);
    visit({"pendulumHeight",
           Unit::Metre,
           {0.02, 2.0},
           search(0.1, 0.5),
           "Height of the pendulum: k^2 = g / height"},
          self.pendulumHeight);
    visit({"xOffset", Unit::Metre, {-0.2, 0.2}, search(-0.03, 0.02), "Feet ahead of the torso (x_offset)"},
          self.xOffset);
    visit({"xFactor",
           Unit::None,
           {-3.0, 3.0},
           search(-0.5, 0.5),
           "Torso ahead per forward step size (x_factor)"},
          self.xFactor);
    visit({"xFactorBack",
           Unit::None,
           {-3.0, 3.0},
           search(-0.5, 0.5),
           "The same in backward steps, where both are negative"},
          self.xFactorBack);
    visit({"yFactor", Unit::None, {-3.0, 3.0}, search(-0.5, 0.5), "Torso to the side per side step size"},
          self.yFactor);
    visit({"torsoPitch", Unit::Radian, {-1.0, 1.0}, search(-0.2, 0.3), "Torso leaning forward"},
          self.torsoPitch);
    visit({"torsoPitchStep",
           Unit::None,
           {-20.0, 20.0},
           search(-3.0, 3.0),
           "Further lean in rad per metre of forward step"},
          self.torsoPitchStep);
    visit({"torsoPitchStepBack",
           Unit::None,
           {-20.0, 20.0},
           search(-3.0, 3.0),
           "The same in backward steps, where both are negative"},
          self.torsoPitchStepBack);
    visit({"torsoRollStep",
           Unit::None,
           {-20.0, 20.0},
           search(-3.0, 3.0),
           "Lean to the side in rad per metre of side step"},
          self.torsoRollStep);
    visit({"torsoYawStep",
           Unit::None,
           {-20.0, 20.0},
           search(-1.0, 4.0),
           "The swing foot's hip goes ahead: turn of the torso at the ends of a step in rad per metre of it"},
          self.torsoYawStep);
    visit({"accelerationFilter",
           Unit::None,
           {0.01, 1.0},
           search(0.1, 1.0),
           "Share of the gap to the commanded acceleration closed in a cycle"},
          self.accelerationFilter);
    visit({"accelerationShiftX",
           Unit::None,
           {-5.0, 5.0},
           search(-1.0, 2.0),
           "Torso ahead as this acceleration asks of a pendulum: 0 = not, 1 = wholly"},
          self.accelerationShiftX);
    visit({"accelerationShiftY",
           Unit::None,
           {-5.0, 5.0},
           search(-1.0, 2.0),
           "The same sideways, towards the inside of a curve"},
          self.accelerationShiftY);
    visit({"accelerationPitch",
           Unit::None,
           {-5.0, 5.0},
           search(-1.0, 2.0),
           "Lean into it: 1 = along gravity and acceleration together"},
          self.accelerationPitch);
    visit({"accelerationRoll", Unit::None, {-5.0, 5.0}, search(-1.0, 2.0), "The same sideways"},
          self.accelerationRoll);
    visit({"comGainX",
           Unit::None,
           {-1.0, 2.0},
           search(0.0, 1.0),
           "Share of the centre of mass' forward offset that the feet follow"},
          self.comGainX);
    visit({"comGainY", Unit::None, {-1.0, 2.0}, search(0.0, 1.0), "The same sideways"}, self.comGainY);
  }

  template <class Self, class Visitor>
  static void describeFeet(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"ySep", Unit::Metre, {0.0, 0.4}, search(0.08, 0.16), "Separation of the feet (y_sep)"}, self.ySep);
    visit({"zStep", Unit::Metre, {0.0, 0.3}, search(0.01, 0.1), "Lift of the swing foot (z_step)"},
          self.zStep);
    visit({"fG",
           Unit::None,
           {-2.0, 2.0},
           search(-0.5, 0.3),
           "Share of the step before the swing foot lifts (f_g)"},
          self.fG);
    visit({"fA", Unit::None, {0.01, 4.0}, search(0.5, 1.8), "Share of the step in the air (f_a)"}, self.fA);
    visit({"fS",
           Unit::None,
           {-2.0, 2.0},
           search(-0.3, 0.3),
           "Share of the step before the swing foot moves (f_s)"},
          self.fS);
    visit({"fM", Unit::None, {0.01, 4.0}, search(0.5, 1.5), "Share of the step in which it moves (f_m)"},
          self.fM);
    visit({"swingStraightness",
           Unit::None,
           {-1.0, 2.0},
           search(0.0, 1.0),
           "The swing foot's way over time: 0 = half a cosine, 1 = steady"},
          self.swingStraightness);
    visit({"liftStraightness",
           Unit::None,
           {-1.0, 2.0},
           search(0.0, 1.0),
           "Its lift over time: 0 = a cosine, 1 = up and down at a steady speed"},
          self.liftStraightness);
    visit({"zPush", Unit::Metre, {-0.1, 0.1}, search(-0.01, 0.01), "Stretch of the stance leg in mid-step"},
          self.zPush);
    visit({"swingPitch",
           Unit::Radian,
           {-1.5, 1.5},
           search(-0.3, 0.3),
           "Swing ankle offset: toe down in mid-step"},
          self.swingPitch);
    visit({"footPitch", Unit::Radian, {-1.0, 1.0}, search(-0.1, 0.1), "Both feet: toe down"}, self.footPitch);
    visit({"footRoll", Unit::Radian, {-1.0, 1.0}, search(-0.1, 0.1), "Both feet: inner edge down"},
          self.footRoll);
    visit({"footYaw", Unit::Radian, {-0.5, 0.8}, search(-0.1, 0.2), "Both feet: toes outwards"},
          self.footYaw);
    visit({"turnYaw",
           Unit::None,
           {-1.0, 2.0},
           search(0.3, 0.7),
           "Toes further outwards per turn: a hip turns its leg outwards only, so that a half is needed"},
          self.turnYaw);
    visit(
        {"yawOut", Unit::None, {-2.0, 4.0}, search(0.0, 1.5), "Toes further outwards per turn of the torso"},
        self.yawOut);
    visit({"turnOut", Unit::Metre, {-0.3, 0.3}, search(-0.03, 0.05), "Wider feet per radian of turn"},
          self.turnOut);
    visit({"sideOut",
           Unit::None,
           {-1.0, 2.0},
           search(-0.2, 0.6),
           "Wider feet per side step: with a half the closing foot comes beside the other one"},
          self.sideOut);
    visit({"startLift", Unit::None, {0.0, 2.0}, search(0.0, 1.0), "Share of the lift in the first step"},
          self.startLift);
  }

  template <class Self, class Visitor>
  static void describeFeedback(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"errNorm",
           Unit::Metre,
           {0.0, 1.0},
           search(0.005, 0.1),
           "Error of the centre of mass at which steps begin to shrink (err_norm)"},
          self.errNorm);
    visit({"errMax", Unit::Metre, {0.001, 2.0}, search(0.02, 0.3), "Error at which steps are zero (err_max)"},
          self.errMax);
    visit({"balanceTilt",
           Unit::Radian,
           {0.02, 3.2},
           fixed,
           "A standing robot that leans more than this steps in place until it is calm"},
          self.balanceTilt);
    visit({"comDelay", Unit::Second, {0.0, 0.14}, fixed, "From a target to its measurement"}, self.comDelay);
    visit({"tiltDelay", Unit::Second, {-0.1, 0.2}, search(0.0, 0.06), "Look ahead of the tilt by its rate"},
          self.tiltDelay);
    visit(
        {"hipPitchGain", Unit::None, {-3.0, 3.0}, search(-0.3, 0.5), "Torso pitch corrected per pitch error"},
        self.hipPitchGain);
    visit({"hipPitchRateGain", Unit::Second, {-1.0, 1.0}, search(-0.03, 0.05), "Per pitch rate"},
          self.hipPitchRateGain);
    visit({"hipRollGain", Unit::None, {-3.0, 3.0}, search(-0.3, 0.5), "Torso roll corrected per roll error"},
          self.hipRollGain);
    visit({"hipRollRateGain", Unit::Second, {-1.0, 1.0}, search(-0.03, 0.05), "Per roll rate"},
          self.hipRollRateGain);
    visit({"anklePitchGain",
           Unit::None,
           {-3.0, 3.0},
           search(-0.3, 0.5),
           "Stance foot: toe down per pitch error"},
          self.anklePitchGain);
    visit({"anklePitchRateGain", Unit::Second, {-1.0, 1.0}, search(-0.03, 0.05), "Per pitch rate"},
          self.anklePitchRateGain);
    visit({"ankleRollGain",
           Unit::None,
           {-3.0, 3.0},
           search(-0.3, 0.5),
           "Stance foot: right edge down per roll error"},
          self.ankleRollGain);
    visit({"ankleRollRateGain", Unit::Second, {-1.0, 1.0}, search(-0.03, 0.05), "Per roll rate"},
          self.ankleRollRateGain);
    visit({"swingLevelGain",
           Unit::None,
           {-2.0, 3.0},
           search(0.0, 1.0),
           "Share of the tilt error taken out of the swing foot, so that it lands level"},
          self.swingLevelGain);
    visit({"stepPitchGain", Unit::Metre, {-2.0, 2.0}, search(-0.05, 0.3), "Swing foot ahead per pitch error"},
          self.stepPitchGain);
    visit({"stepPitchRateGain", Unit::Metre, {-1.0, 1.0}, search(-0.01, 0.05), "Per pitch rate, m s/rad"},
          self.stepPitchRateGain);
    visit({"stepRollGain", Unit::Metre, {-2.0, 2.0}, search(-0.05, 0.3), "Swing foot aside per roll error"},
          self.stepRollGain);
    visit({"stepRollRateGain", Unit::Metre, {-1.0, 1.0}, search(-0.01, 0.05), "Per roll rate, m s/rad"},
          self.stepRollRateGain);
  }

  // A body that tilts with level feet commanded stands on their edges, and on the low side the swing foot
  // never clears the ground: small gains that suit a walk keep a robot stepping at that tilt until it falls.
  template <class Self, class Visitor>
  static void describeRecovery(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"recoverTilt",
           Unit::Radian,
           {0.0, 3.2},
           search(0.1, 0.35),
           "Tilt error beyond which the gains for recovering act, on what is beyond"},
          self.recoverTilt);
    visit({"recoverLevelPitch",
           Unit::None,
           {-3.0, 3.0},
           search(0.0, 1.0),
           "Legs turned against the torso, to stay upright under it: 1 = wholly"},
          self.recoverLevelPitch);
    visit({"recoverLevelRoll", Unit::None, {-3.0, 3.0}, search(0.0, 1.0), "The same sideways"},
          self.recoverLevelRoll);
    visit({"recoverStepPitch",
           Unit::Metre,
           {-2.0, 2.0},
           search(0.0, 0.3),
           "Swing foot ahead per radian of pitch beyond"},
          self.recoverStepPitch);
    visit({"recoverStepRoll", Unit::Metre, {-2.0, 2.0}, search(0.0, 0.3), "Swing foot aside, the same"},
          self.recoverStepRoll);
  }

  template <class Self, class Visitor>
  static void describeRest(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"armPitch", Unit::Radian, {-2.0, 2.0}, search(-2.0, 0.0), "Shoulder pitch, 0 = forward"},
          self.armPitch);
    visit({"armYaw", Unit::Radian, {0.0, 1.6}, search(0.0, 1.0), "Arms outwards"}, self.armYaw);
    visit({"armRoll", Unit::Radian, {-2.0, 2.0}, fixed, "Upper arms rolled"}, self.armRoll);
    visit({"elbow", Unit::Radian, {0.0, 1.5}, search(0.0, 1.5), "Elbows bent"}, self.elbow);
    visit({"armSwing",
           Unit::None,
           {-20.0, 20.0},
           search(-4.0, 8.0),
           "Swing of the arms against the legs, rad per metre of foot offset"},
          self.armSwing);
    visit({"targetGain", Unit::Hertz, {0.1, 50.0}, search(1.0, 10.0), "Speed per distance near a target"},
          self.targetGain);
    visit({"targetTurnGain",
           Unit::Hertz,
           {0.1, 50.0},
           search(1.0, 10.0),
           "Turning speed per angle to the target"},
          self.targetTurnGain);
    visit({"targetTurnDistance",
           Unit::Metre,
           {0.0, 10.0},
           fixed,
           "Nearer than this the robot takes the heading of the target, farther it faces the target"},
          self.targetTurnDistance);
    visit({"targetSmoothing",
           Unit::Second,
           {0.0, 5.0},
           search(0.0, 1.0),
           "Time over which the place of a target that jumps about is averaged"},
          self.targetSmoothing);
  }
};

/// The set between two others: share 0 gives `from`, 1 gives `to`.
WalkParameters blend(const WalkParameters& from, const WalkParameters& to, double share);

}  // namespace nonet::motion
