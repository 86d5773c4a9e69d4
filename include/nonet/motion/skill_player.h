// Runs a skill: one instruction after the other, as many in a cycle as take no time.
//
// Needs: the library, the body, the ball. Gives: joint targets. Times that are no whole cycles carry over:
// two moves of 30 ms take three cycles, so that the result changes smoothly with the numbers.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "nonet/motion/foot_curve.h"
#include "nonet/motion/limbs.h"
#include "nonet/motion/request.h"
#include "nonet/motion/skill_library.h"
#include "nonet/world/world_state.h"

namespace nonet::motion {

class SkillPlayer {
 public:
  enum class Result : std::uint8_t { Running, Finished, Failed };

  /// `stand`: the angles that the target "stand" means.
  SkillPlayer(const model::RobotModel& model, const SkillLibrary& library,
              const model::JointArray& stand = {});

  /// False if there is no such skill. Begins at the angles in `commanded` (what the joints were told last).
  /// `aim`: for kicks. Without it curves "from ball" take the ball to be where the world state has it when
  /// the curve begins.
  bool start(std::string_view name, bool mirrored, const model::JointArray& commanded,
             const std::optional<KickAim>& aim = std::nullopt);
  void stop() { depth_ = 0; }
  bool running() const { return depth_ > 0; }

  /// Which statement is being carried out: where it stands in its file. Line 0: none.
  struct Place {
    std::string_view skill;
    int line = 0;
  };
  Place statement() const;

  /// The last curve since the start that takes longer than its text says, since a joint would be too fast.
  struct Stretch {
    int line = 0;         // of its file
    double wanted = 0.0;  // s
    double taken = 0.0;   // s
    friend bool operator==(const Stretch&, const Stretch&) = default;
  };
  const std::optional<Stretch>& stretch() const { return stretch_; }

  /// One cycle. The targets keep their last values when the skill is over.
  Result update(const world::WorldState& world, JointTargets& targets);

 private:
  struct Frame {
    int skill = 0;
    int at = 0;
    bool mirrored = false;
    std::array<int, 8> loops{};
  };
  enum class Outcome : std::uint8_t { Next, Stay, Ended, Failed };

  Outcome execute(const Instruction& instruction, const Skill& skill, const world::WorldState& world,
                  double& budget, JointTargets& targets);
  Outcome spendTime(const Instruction& instruction, const Skill& skill, const world::WorldState& world,
                    double& budget, JointTargets& targets);
  bool holds(const Skill& skill, int node, bool mirrored, const world::WorldState& world) const;
  double quantity(Quantity quantity, bool mirrored, const world::WorldState& world) const;
  void begin(const Skill& skill, const Instruction& instruction, bool mirrored,
             const world::WorldState& world, const JointTargets& targets);
  void keepReachable();
  void chooseGoals(const Instruction& instruction, bool mirrored);
  void shiftFoot(const FootShift& shift, bool mirrored);
  void place(const Instruction& instruction, bool mirrored, double share, JointTargets& targets) const;
  void placeSwing(JointTargets& targets) const;
  void planCurve(const Instruction& instruction, bool mirrored, const world::WorldState& world);
  void placeFeet(const Instruction& instruction, bool mirrored, double share, JointTargets& targets) const;
  Vector3 curveOrigin(const Instruction& instruction, const world::WorldState& world) const;
  void followBall(const Instruction& instruction, const world::WorldState& world);
  void setLeg(model::Side side, const Pose3& X_RS, JointTargets& targets) const;
  Frame& top() { return frames_[static_cast<std::size_t>(depth_ - 1)]; }

  const model::RobotModel* model_;
  const SkillLibrary* library_;
  model::JointArray stand_;
  std::array<Frame, SkillLibrary::kDeepestCall + 1> frames_{};
  int depth_ = 0;
  double time_ = 0.0;            // since the start of the outermost skill, s
  bool begun_ = false;           // the present instruction has begun
  double inInstruction_ = 0.0;   // s
  double duration_ = 0.0;        // of the present instruction, s
  model::JointArray from_{};     // angles at its begin
  model::JointArray to_{};       // at its end, where `moves_` says so
  model::JointArray after_{};    // delays of a swing, s
  std::uint32_t moves_ = 0;      // bit per joint
  FootPoses feetFrom_{};         // sole poses at its begin
  std::optional<Vector2> ball_;  // given at the start
  KickInputs inputs_ = KickInputs::Zero();
  FootCurve curve_;                   // the present one
  Vector3 anchor_ = Vector3::Zero();  // its origin when it was planned
  std::optional<Stretch> stretch_;
};

}  // namespace nonet::motion
