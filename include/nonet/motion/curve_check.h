// Whether the foot of a kick can follow its curve through the ball from here, and the robot stays over its
// stance foot meanwhile [MacAlpine 2012a, section 5.1.1]: such a kick begins only then.
//
// Needs: the catalogue, the ball. A kick whose skill has no curve `from ball` is never held up.
#pragma once

#include <optional>
#include <vector>

#include "nonet/model/kinematics.h"
#include "nonet/model/robot_model.h"
#include "nonet/motion/foot_curve.h"
#include "nonet/motion/kick_catalogue.h"
#include "nonet/motion/skill_library.h"

namespace nonet::motion {

/// The curve of a kick with the left foot, as far as the skill's text tells.
struct PlannedCurve {
  const Instruction* instruction = nullptr;
  FootCurve curve;                     // planned; its origin is the ball, torso frame
  bool meetsBall = true;               // false: it leads to the ball, and a swing right after it meets it
  model::JointArray posture{};         // when it begins
  Matrix3 R_LR = Matrix3::Identity();  // torso then -> level frame with the heading of the stand
};

/// How far inside the edges of the stance foot (of the kick with the left foot) the centre of mass is, m;
/// negative beyond them.
double insideStanceFoot(const model::RobotModel& model, const model::BodyPoses& bodies);

class CurveCheck {
 public:
  static constexpr int kSamples = 12;           // of the curve
  static constexpr double kReached = 0.9;       // share of them that the leg must reach: more than this
  static constexpr double kInsideFoot = 0.005;  // m, of the centre of mass from the stance foot's edge

  /// The library must outlive it. `stand`: the angles of the stand that kicks begin in.
  CurveCheck(const model::RobotModel& model, const SkillLibrary& library, const model::JointArray& stand);

  struct Result {
    double reached = 1.0;  // share of the samples
    bool balanced = true;  // the centre of mass is above the stance foot at all that are reached
    bool allows() const { return balanced && reached > kReached; }
  };
  /// With the ball at `p_RBall` (robot frame on the ground, m) when the kick begins. Looks no further once
  /// it is clear that the kick is not allowed: then `reached` is what is still possible.
  Result check(const KickOption& option, const Vector2& p_RBall) const;

  /// What check() looks at, for a ball to the left of a kick with the left foot. Nothing: the kick has no
  /// curve `from ball`.
  std::optional<PlannedCurve> plan(const KickOption& option, const Vector2& p_RBall) const;

 private:
  // How the joints are, as far as the text tells, when the curve begins; of the kick with the left foot.
  struct Kick {
    const Instruction* curve = nullptr;
    bool meetsBall = true;
    model::JointArray posture{};
  };

  const model::RobotModel* model_;
  model::JointArray stand_;
  std::vector<Kick> kicks_;  // one for each skill of the library
};

}  // namespace nonet::motion
