// Fourth layer of the walk: small corrections by what is measured, the tilt of the torso and the error of the
// centre of mass.
//
// Needs: the measurement. Gives: a changed lean of the torso, turned soles, a shifted landing of the swing
// foot, a share of the step, and whether the robot can stand.
#pragma once

#include <array>

#include "nonet/config/parameters.h"
#include "nonet/motion/limbs.h"
#include "nonet/motion/walk/measurement.h"

namespace nonet::motion {

struct BalanceParameters {
  double comErrorNormal = 0.03;
  double comErrorMost = 0.08;
  double tiltLookAhead = 0.0;
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

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    describeErrors(self, visit);
    describeTorso(self, visit);
    describeSoles(self, visit);
    describeLanding(self, visit);
  }

 private:
  template <class Self, class Visitor>
  static void describeErrors(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"comErrorNormal",
           Unit::Metre,
           {0.0, 1.0},
           search(0.005, 0.1),
           "Error of the centre of mass at which steps begin to shrink (err_norm)"},
          self.comErrorNormal);
    visit({"comErrorMost",
           Unit::Metre,
           {0.001, 2.0},
           search(0.02, 0.3),
           "Error of the centre of mass at which steps are zero (err_max)"},
          self.comErrorMost);
    visit({"tiltLookAhead",
           Unit::Second,
           {-0.1, 0.2},
           search(0.0, 0.06),
           "Time by which the tilt is looked ahead with its rate"},
          self.tiltLookAhead);
  }

  template <class Self, class Visitor>
  static void describeTorso(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"hipPitchGain",
           Unit::None,
           {-3.0, 3.0},
           search(-0.3, 0.5),
           "Commanded lean of the torso backward in rad per rad of tilt forward"},
          self.hipPitchGain);
    visit({"hipPitchRateGain",
           Unit::Second,
           {-1.0, 1.0},
           search(-0.03, 0.05),
           "Commanded lean of the torso backward in rad per rad/s of tilting forward"},
          self.hipPitchRateGain);
    visit({"hipRollGain",
           Unit::None,
           {-3.0, 3.0},
           search(-0.3, 0.5),
           "Commanded lean of the torso to the left in rad per rad of tilt to the right"},
          self.hipRollGain);
    visit({"hipRollRateGain",
           Unit::Second,
           {-1.0, 1.0},
           search(-0.03, 0.05),
           "Commanded lean of the torso to the left in rad per rad/s of tilting to the right"},
          self.hipRollRateGain);
  }

  template <class Self, class Visitor>
  static void describeSoles(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"anklePitchGain",
           Unit::None,
           {-3.0, 3.0},
           search(-0.3, 0.5),
           "How far the toe of the stance foot turns down in rad per rad of tilt forward"},
          self.anklePitchGain);
    visit({"anklePitchRateGain",
           Unit::Second,
           {-1.0, 1.0},
           search(-0.03, 0.05),
           "How far the toe of the stance foot turns down in rad per rad/s of tilting forward"},
          self.anklePitchRateGain);
    visit({"ankleRollGain",
           Unit::None,
           {-3.0, 3.0},
           search(-0.3, 0.5),
           "How far the right edge of the stance foot turns down in rad per rad of tilt to the right"},
          self.ankleRollGain);
    visit({"ankleRollRateGain",
           Unit::Second,
           {-1.0, 1.0},
           search(-0.03, 0.05),
           "How far the right edge of the stance foot turns down in rad per rad/s of tilting to the right"},
          self.ankleRollRateGain);
    visit({"swingLevelGain",
           Unit::None,
           {-2.0, 3.0},
           search(0.0, 1.0),
           "Share of the tilt that is taken out of the swing foot, so that it lands level"},
          self.swingLevelGain);
  }

  template <class Self, class Visitor>
  static void describeLanding(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"stepPitchGain",
           Unit::Metre,
           {-2.0, 2.0},
           search(-0.05, 0.3),
           "How far the swing foot lands ahead in m per rad of tilt forward"},
          self.stepPitchGain);
    visit({"stepPitchRateGain",
           Unit::Metre,
           {-1.0, 1.0},
           search(-0.01, 0.05),
           "How far the swing foot lands ahead in m per rad/s of tilting forward"},
          self.stepPitchRateGain);
    visit({"stepRollGain",
           Unit::Metre,
           {-2.0, 2.0},
           search(-0.05, 0.3),
           "How far the swing foot lands to the right in m per rad of tilt to the right"},
          self.stepRollGain);
    visit({"stepRollRateGain",
           Unit::Metre,
           {-1.0, 1.0},
           search(-0.01, 0.05),
           "How far the swing foot lands to the right in m per rad/s of tilting to the right"},
          self.stepRollRateGain);
  }
};

/// The tilt of a torso that has the attitude `torso` and turns by `gyro`, rad/s, but should have `wanted`.
Tilt tiltAgainst(const BalanceParameters& parameters, const Attitude& torso, const Vector3& gyro,
                 const Attitude& wanted);

/// Share of the wanted step that is made.
double stepShare(const BalanceParameters& parameters, double comError);
/// Whether a standing robot has to step.
bool leansTooFar(const Tilt& tilt);
/// Whether a robot that steps in place may stand.
bool isCalm(const BalanceParameters& parameters, const WalkMeasurement& measurement);

/// The lean to command instead of `wanted`.
Attitude steadied(const BalanceParameters& parameters, const Attitude& wanted, const Tilt& tilt);
/// Turn of the stance foot's sole against the torso.
Attitude ankleTurn(const BalanceParameters& parameters, const Tilt& tilt);
/// What is taken out of the swing foot's attitude.
Attitude swingLevel(const BalanceParameters& parameters, const Tilt& tilt);
/// Shift of the swing foot's landing, m, forward and to the left.
Vector2 landingShift(const BalanceParameters& parameters, const Tilt& tilt);

/// What was commanded in the last cycles, since its measurement comes late.
class CommandHistory {
 public:
  static constexpr std::size_t kDelay =
      2;  // cycles from a command to its measurement (server facts 1.2, 1.5)

  struct Command {
    Vector3 p_SCom = Vector3::Zero();  // centre of mass over the stance foot, m, upright axes
    model::Side stance = model::Side::Left;
    double torsoYaw = 0.0;  // in the walk frame, rad
  };

  void add(const Command& command);
  /// Whose effect is measured now; null while there is none.
  const Command* measuredNow() const;
  void reset() { size_ = 0; }

 private:
  static constexpr std::size_t kMost = kDelay + 1;
  std::array<Command, kMost> commands_{};
  std::size_t size_ = 0;
  std::size_t last_ = 0;
};

}  // namespace nonet::motion
