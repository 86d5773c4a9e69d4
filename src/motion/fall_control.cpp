#include "nonet/motion/fall_control.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace nonet::motion {

using model::Side;
using world::Posture;

namespace {

constexpr double kStandsAgain = 0.8;  // s upright until a fall counts as a new one
constexpr double kLowest = 0.5;       // share of the standing height: below it the robot will not sway up
constexpr int kVariants = 3;

struct RiseSkills {
  std::array<std::string_view, kVariants> names;
};
constexpr RiseSkills kFront{{{"rise_front", "rise_front_2", "rise_front_3"}}};
constexpr RiseSkills kBack{{{"rise_back", "rise_back_2", "rise_back_3"}}};
constexpr RiseSkills kSide{{{"rise_side", "rise_side_2", "rise_side_3"}}};

}  // namespace

FallControl::FallControl(const model::RobotModel& model, const SkillLibrary& library,
                         const FallParameters& parameters, const model::JointArray& stand)
    : model_(&model), library_(&library), parameters_(parameters), stand_(stand) {}

bool FallControl::update(const world::WorldState& world, SkillPlayer& player, JointTargets& targets) {
  const world::BodyState& body = world.body;
  const bool upright = body.posture == Posture::Upright;
  if (phase_ == Phase::None) {
    // Also after a skill, during which nobody asks.
    if (world.time - uprightSince_ > kStandsAgain) attempts_ = 0;
    if (upright) return false;
    phase_ = Phase::Falling;
    lying_ = false;
  }
  if (phase_ == Phase::Falling) {
    if (upright) {
      phase_ = Phase::None;
      uprightSince_ = world.time;
      return false;
    }
    const bool fallen = world::isFallen(body.posture);
    if (fallen && !lying_) {
      lying_ = true;
      lyingSince_ = world.time;
    }
    const bool quiet = body.gyro.norm() < parameters_.quietRate;
    const bool waited = lying_ && world.time - lyingSince_ > parameters_.longestWait;
    if (!fallen || (!quiet && !waited) || !startRising(body.posture, player, world, targets)) {
      protect(fallen, targets);
      return true;
    }
    ++attempts_;
    phase_ = Phase::Rising;
    risingSince_ = world.time;
  }
  if (phase_ == Phase::Rising) {
    if (liesOtherwise(world)) startRising(body.posture, player, world, targets);
    if (player.update(world, targets) == SkillPlayer::Result::Running) return true;
    phase_ = Phase::Settling;
    settlingSince_ = world.time;
  }
  return settle(world, targets);
}

void FallControl::reset(double time) {
  phase_ = Phase::None;
  lying_ = false;
  attempts_ = 0;
  uprightSince_ = time;
}

// The skill is over: the robot comes to rest in its stand, or the next attempt begins from what it has come
// to.
bool FallControl::settle(const world::WorldState& world, JointTargets& targets) {
  const world::BodyState& body = world.body;
  lying_ = false;
  uprightSince_ = world.time;
  const bool late = world.time - settlingSince_ > parameters_.settleTime;
  const bool upright = body.posture == Posture::Upright;
  const bool quiet = std::hypot(body.pitch, body.roll) < parameters_.settledTilt &&
                     body.gyro.norm() < parameters_.settledRate;
  if (upright && (quiet || late)) {
    phase_ = Phase::None;
    return false;
  }
  const bool low = body.torsoHeight < kLowest * model_->standingHeight();
  if (low || late) {
    phase_ = Phase::Falling;
    protect(world::isFallen(body.posture), targets);
  }
  return true;
}

// A robot that only leans far stands best on both feet: a step frozen in the middle would throw it over. Once
// it is down everything straightens, so that the rising skills, which all begin from there, lose no time.
void FallControl::protect(bool down, JointTargets& targets) const {
  targets.angles = down ? model::JointArray{} : stand_;
  const double yaw = down ? 0.0 : parameters_.armYaw;
  for (const Side side : {Side::Left, Side::Right}) {
    setArm(side, ArmAttitude{parameters_.armPitch, yaw, 0.0, 0.0}, targets.angles);
  }
  targets.stiffness.fill(parameters_.softness);
}

bool FallControl::startRising(Posture posture, SkillPlayer& player, const world::WorldState& world,
                              JointTargets& targets) {
  const RiseSkills& skills = posture == Posture::FallenFront  ? kFront
                             : posture == Posture::FallenBack ? kBack
                                                              : kSide;
  const int before = phase_ == Phase::Rising ? attempts_ - 1 : attempts_;
  std::string_view name = skills.names[static_cast<std::size_t>(before % kVariants)];
  if (library_->find(name) < 0) name = skills.names[0];
  targets.angles = world.body.joints;
  targets.stiffness.fill(1.0);
  if (!player.start(name, posture == Posture::FallenRight, targets.angles)) return false;
  risesFrom_ = posture;
  return true;
}

// All rising skills begin with straightening, which may as well be done while the robot still falls: only
// then is it certain on which side it lies.
bool FallControl::liesOtherwise(const world::WorldState& world) const {
  return world::isFallen(world.body.posture) && world.body.posture != risesFrom_ &&
         world.time - risingSince_ < parameters_.reconsiderTime;
}

}  // namespace nonet::motion
