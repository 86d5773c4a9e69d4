// Second layer of the walk: the torso over the feet, on a linear inverted pendulum after [Graf 2009].
//
// Over the stance foot the torso swings on the orbit of a linear pendulum x'' = k^2 x, symmetric about the
// middle of the step. The orbits of two steps meet at the change of feet, in position and velocity.
//
// Needs: the step (GaitState). Gives: the torso over the walk frame, and the soles below the torso.
#pragma once

#include "nonet/motion/walk/gait.h"

namespace nonet::motion {

struct PendulumParameters {
  double torsoHeight = 0.88;
  double height = 0.26;
  double yShift = 0.0;
  double swayFactor = 1.0;
  double surgeFactor = 1.0;
  double feetAhead = -0.015;
  double aheadPerStep = 0.0;
  double aheadPerStepBack = 0.0;
  double asidePerStep = 0.0;
  double accelerationShiftX = 0.0;
  double accelerationShiftY = 0.0;
  double comCompensationX = 0.0;
  double comCompensationY = 0.0;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    describeOrbit(self, visit);
    describeOffsets(self, visit);
  }

 private:
  template <class Self, class Visitor>
  static void describeOrbit(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"torsoHeight",
           Unit::None,
           {0.4, 1.1},
           search(0.7, 1.0),
           "Height of the torso above the soles as a share of that with straight legs (z_torso)"},
          self.torsoHeight);
    visit(
        {"height",
         Unit::Metre,
         {0.02, 2.0},
         search(0.1, 0.5),
         "Height of the pendulum that swings as the torso does, k^2 = g / height: it stands for a frequency, "
         "learned values are far below the centre of mass"},
        self.height);
    visit({"yShift",
           Unit::Metre,
           {-0.2, 0.2},
           search(-0.01, 0.03),
           "Sway of the torso towards the stance foot in mid-step, beyond that of the pendulum (y_shift)"},
          self.yShift);
    visit({"swayFactor",
           Unit::None,
           {-5.0, 5.0},
           search(0.0, 2.0),
           "Factor on the sway of the torso sideways: 0 = none, 1 = as the pendulum"},
          self.swayFactor);
    visit(
        {"surgeFactor",
         Unit::None,
         {-5.0, 5.0},
         search(0.0, 2.0),
         "Factor on the change of the torso's forward speed within a step: 0 = steady, 1 = as the pendulum"},
        self.surgeFactor);
  }

  template <class Self, class Visitor>
  static void describeOffsets(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"feetAhead",
           Unit::Metre,
           {-0.2, 0.2},
           search(-0.03, 0.02),
           "How far the feet are ahead of the torso (x_offset)"},
          self.feetAhead);
    visit({"aheadPerStep",
           Unit::None,
           {-3.0, 3.0},
           search(-0.5, 0.5),
           "How far the torso moves ahead in m per m of forward step (x_factor)"},
          self.aheadPerStep);
    visit({"aheadPerStepBack",
           Unit::None,
           {-3.0, 3.0},
           search(-0.5, 0.5),
           "How far the torso moves back in m per m of backward step"},
          self.aheadPerStepBack);
    visit({"asidePerStep",
           Unit::None,
           {-3.0, 3.0},
           search(-0.5, 0.5),
           "How far the torso moves to the side of the motion in m per m of side step"},
          self.asidePerStep);
    visit({"accelerationShiftX",
           Unit::None,
           {-5.0, 5.0},
           search(-1.0, 2.0),
           "Shift of the torso ahead while the robot speeds up: 0 = none, 1 = as far as a pendulum of this "
           "height has to be for it"},
          self.accelerationShiftX);
    visit(
        {"accelerationShiftY",
         Unit::None,
         {-5.0, 5.0},
         search(-1.0, 2.0),
         "Shift of the torso to the inside of a curve: 0 = none, 1 = as far as a pendulum of this height has "
         "to be for it"},
        self.accelerationShiftY);
    visit({"comCompensationX",
           Unit::None,
           {-1.0, 2.0},
           search(0.0, 1.0),
           "Share of the centre of mass' forward offset from the torso by which the torso is moved back: "
           "with 1 "
           "the centre of mass is on the planned path, with 0 the torso"},
          self.comCompensationX);
    visit({"comCompensationY",
           Unit::None,
           {-1.0, 2.0},
           search(0.0, 1.0),
           "Share of the centre of mass' side offset from the torso by which the torso is moved back: with 1 "
           "the centre of mass is on the planned path, with 0 the torso; below 0 the torso sways less"},
          self.comCompensationY);
  }
};

/// The torso over the walk frame, m.
Vector2 pendulumOffset(const PendulumParameters& parameters, const GaitState& gait, double footSeparation);

/// The sole of a foot on the ground, m, in upright axes at the torso. `p_TS`: of the foot from the point
/// below the undisturbed torso. `p_TCom`: the commanded centre of mass in the same axes. `standingHeight`: of
/// the torso with straight legs.
Vector3 soleBelowTorso(const PendulumParameters& parameters, const GaitState& gait, const Vector2& p_TS,
                       const Vector3& p_TCom, double standingHeight);

}  // namespace nonet::motion
