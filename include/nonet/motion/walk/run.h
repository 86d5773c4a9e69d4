// Sixth layer of the walk: what a run adds to the joint angles of the gait.
//
// The gait moves soles on straight lines and leaves the joints to the inverse kinematics. A run is faster
// than lines allow: the knee stretches while the leg goes back, the heel comes up behind. So each joint gets
// a swing of its own on top, periodic in the stride (two steps): a mean, the stride's own frequency and twice
// of it. Both sides move alike, half a stride apart, so a curve for each kind of joint is all there is.
//
// Needs: the step (GaitState), how much of the run is wanted. Gives: changed joint angles.
#pragma once

#include "nonet/config/parameters.h"
#include "nonet/model/robot_model.h"
#include "nonet/motion/walk/gait.h"

namespace nonet::motion {

/// Of one joint over a stride, rad. The stride begins where the joint's own leg begins to stand.
struct JointSwing {
  double mean = 0.0;
  double cos1 = 0.0;
  double sin1 = 0.0;
  double cos2 = 0.0;
  double sin2 = 0.0;

  /// `stride`: share of the stride that is over.
  double at(double stride) const;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    constexpr double kMost = 1.0;  // rad
    const auto angle = [](std::string_view name, std::string_view text) {
      return Declaration{name, Unit::Radian, {-kMost, kMost}, search(-0.5, 0.5), text};
    };
    visit(angle("mean", "Run: the joint's mean, added to the gait's angle"), self.mean);
    visit(angle("cos1", "Run: what it adds as the cosine of the stride"), self.cos1);
    visit(angle("sin1", "Run: what it adds as the sine of the stride"), self.sin1);
    visit(angle("cos2", "Run: what it adds as the cosine of a step, half a stride"), self.cos2);
    visit(angle("sin2", "Run: what it adds as the sine of a step, half a stride"), self.sin2);
  }
};

/// Signs as on the left side: rolls are mirrored.
struct RunParameters {
  JointSwing hipYawPitch;
  JointSwing hipRoll;
  JointSwing hipPitch;
  JointSwing knee;
  JointSwing anklePitch;
  JointSwing ankleRoll;
  JointSwing toe;  // type 4
  JointSwing shoulder;
  JointSwing elbow;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit.group("hipYawPitch", self.hipYawPitch);
    visit.group("hipRoll", self.hipRoll);
    visit.group("hipPitch", self.hipPitch);
    visit.group("knee", self.knee);
    visit.group("anklePitch", self.anklePitch);
    visit.group("ankleRoll", self.ankleRoll);
    visit.group("toe", self.toe);
    visit.group("shoulder", self.shoulder);
    visit.group("elbow", self.elbow);
  }
};

/// Of the whole run: as much as the step is of the largest one, so that who stumbles or stops walks again.
double runShare(const GaitParameters& parameters, const GaitState& gait);

/// Adds `share` of the run to the angles of legs and arms.
void addRun(const RunParameters& parameters, const GaitState& gait, double share,
            const model::RobotModel& model, model::JointArray& angles);

}  // namespace nonet::motion
