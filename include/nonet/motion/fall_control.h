// Falling and rising: protects while the robot falls, then gets it up, with another attempt when one fails.
//
// Needs: the posture (world stage), the skills rise_front, rise_back, rise_side and their second and third
// variants (rise_front_2, ...). Gives: joint targets while it is in control.
#pragma once

#include "nonet/config/parameters.h"
#include "nonet/motion/request.h"
#include "nonet/motion/skill_player.h"
#include "nonet/world/world_state.h"

namespace nonet::motion {

struct FallParameters {
  double softness = 0.3;
  double quietRate = 4.0;
  double longestWait = 0.6;
  double reconsiderTime = 0.35;
  double settleTime = 0.8;
  double settledTilt = 0.12;
  double settledRate = 0.8;
  double armPitch = -1.57;
  double armYaw = 0.4;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"softness", Unit::None, {0.0, 1.0}, fixed, "Stiffness of the joints while falling"},
          self.softness);
    visit(
        {"quietRate", Unit::RadianPerSecond, {0.1, 20.0}, fixed, "Turning slower than this, the robot lies"},
        self.quietRate);
    visit({"longestWait",
           Unit::Second,
           {0.0, 5.0},
           fixed,
           "The robot rises after lying this long even if it still moves"},
          self.longestWait);
    visit({"reconsiderTime",
           Unit::Second,
           {0.0, 5.0},
           fixed,
           "A robot that began to rise while it still fell, and came to lie on another side, begins anew so "
           "long"},
          self.reconsiderTime);
    visit({"settleTime",
           Unit::Second,
           {0.0, 5.0},
           fixed,
           "After a rising skill the robot may sway so long before the next attempt begins"},
          self.settleTime);
    visit({"settledTilt", Unit::Radian, {0.0, 1.0}, fixed, "After rising: leaning less than this"},
          self.settledTilt);
    visit({"settledRate",
           Unit::RadianPerSecond,
           {0.0, 20.0},
           fixed,
           "After rising: turning slower than this, and upright (settledTilt), the robot may walk again"},
          self.settledRate);
    visit({"armPitch", Unit::Radian, {-2.0, 2.0}, fixed, "Shoulder pitch while falling"}, self.armPitch);
    visit({"armYaw", Unit::Radian, {0.0, 1.6}, fixed, "Arms outwards while falling"}, self.armYaw);
  }
};

class FallControl {
 public:
  /// `stand`: the angles to come back to while a fall is not yet certain.
  FallControl(const model::RobotModel& model, const SkillLibrary& library, const FallParameters& parameters,
              const model::JointArray& stand);

  /// True while it is in control and has filled the targets.
  bool update(const world::WorldState& world, SkillPlayer& player, JointTargets& targets);

  /// The robot stands, whatever it was doing.
  void reset(double time);

  bool rising() const { return phase_ == Phase::Rising || phase_ == Phase::Settling; }
  bool active() const { return phase_ != Phase::None; }
  int attempts() const { return attempts_; }

 private:
  // Settling: the skill is over, the robot still sways into the stand.
  enum class Phase : std::uint8_t { None, Falling, Rising, Settling };
  bool settle(const world::WorldState& world, JointTargets& targets);
  void protect(bool down, JointTargets& targets) const;
  bool startRising(world::Posture posture, SkillPlayer& player, const world::WorldState& world,
                   JointTargets& targets);
  bool liesOtherwise(const world::WorldState& world) const;

  const model::RobotModel* model_;
  const SkillLibrary* library_;
  FallParameters parameters_;
  model::JointArray stand_;
  Phase phase_ = Phase::None;
  world::Posture risesFrom_ = world::Posture::Upright;
  double risingSince_ = 0.0;    // server time, s
  int attempts_ = 0;            // since the robot last stood for a while
  double settlingSince_ = 0.0;  // server time, s
  double lyingSince_ = 0.0;     // server time, s
  bool lying_ = false;
  double uprightSince_ = 0.0;  // server time, s
};

}  // namespace nonet::motion
