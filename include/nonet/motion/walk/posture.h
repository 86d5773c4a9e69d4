// Third layer of the walk: how the torso leans and turns, and where the arms are.
//
// Needs: the step (GaitState) and a foot. Gives: the wanted attitude of the torso, its turn, the arms.
#pragma once

#include "nonet/motion/walk/gait.h"
#include "nonet/motion/walk/measurement.h"

namespace nonet::motion {

struct WalkPostureParameters {
  double torsoPitch = 0.0;
  double pitchPerStep = 0.0;
  double pitchPerStepBack = 0.0;
  double rollPerSideStep = 0.0;
  double yawPerStep = 0.0;
  double accelerationPitch = 0.0;
  double accelerationRoll = 0.0;
  double armPitch = -1.57;
  double armYaw = 0.15;
  double elbow = 0.2;
  double armSwing = 1.0;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    describeTorso(self, visit);
    describeArms(self, visit);
  }

 private:
  template <class Self, class Visitor>
  static void describeTorso(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"torsoPitch", Unit::Radian, {-1.0, 1.0}, search(-0.2, 0.3), "Lean of the torso forward"},
          self.torsoPitch);
    visit({"pitchPerStep",
           Unit::None,
           {-20.0, 20.0},
           search(-3.0, 3.0),
           "Further lean forward in rad per m of forward step"},
          self.pitchPerStep);
    visit({"pitchPerStepBack",
           Unit::None,
           {-20.0, 20.0},
           search(-3.0, 3.0),
           "Further lean backward in rad per m of backward step"},
          self.pitchPerStepBack);
    visit({"rollPerSideStep",
           Unit::None,
           {-20.0, 20.0},
           search(-3.0, 3.0),
           "Lean to the side of the motion in rad per m of side step"},
          self.rollPerSideStep);
    visit(
        {"yawPerStep",
         Unit::None,
         {-20.0, 20.0},
         search(-1.0, 4.0),
         "Turn of the torso at the ends of a step in rad per m of forward step: the hip of the foot ahead is "
         "ahead"},
        self.yawPerStep);
    visit({"accelerationPitch",
           Unit::None,
           {-5.0, 5.0},
           search(-1.0, 2.0),
           "Lean forward while the robot speeds up: 0 = none, 1 = along gravity and acceleration together"},
          self.accelerationPitch);
    visit({"accelerationRoll",
           Unit::None,
           {-5.0, 5.0},
           search(-1.0, 2.0),
           "Lean to the inside of a curve: 0 = none, 1 = along gravity and acceleration together"},
          self.accelerationRoll);
  }

  template <class Self, class Visitor>
  static void describeArms(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"armPitch",
           Unit::Radian,
           {-2.0, 2.0},
           search(-2.0, 0.0),
           "Pitch of the shoulders: 0 = arms forward, -1.57 = arms hanging"},
          self.armPitch);
    visit({"armYaw", Unit::Radian, {0.0, 1.6}, search(0.0, 1.0), "How far the arms point outwards"},
          self.armYaw);
    visit({"elbow", Unit::Radian, {0.0, 1.5}, search(0.0, 1.5), "How far the elbows are bent"}, self.elbow);
    visit({"armSwing",
           Unit::None,
           {-20.0, 20.0},
           search(-4.0, 8.0),
           "Swing of each arm in rad per m that the foot of the other side is ahead"},
          self.armSwing);
  }
};

/// The attitude that the torso should have.
Attitude wantedLean(const WalkPostureParameters& parameters, const GaitState& gait);
/// Turn of the torso at the end of a step, rad.
double torsoYawStroke(const WalkPostureParameters& parameters, const GaitState& gait);
/// Turn of the torso now, rad, counter-clockwise.
double torsoYaw(const WalkPostureParameters& parameters, const GaitState& gait);
/// One arm; `otherFoot` is how far the foot of the other side is ahead, m.
ArmAttitude walkingArm(const WalkPostureParameters& parameters, double otherFoot);

}  // namespace nonet::motion
