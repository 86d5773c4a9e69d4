#include "nonet/motion/skill_player.h"

#include <algorithm>
#include <cmath>

#include "nonet/model/ball.h"

namespace nonet::motion {

using model::JointId;
using model::kBallRadius;
using model::Side;

namespace {

// A skill that jumps in a circle without taking time must not hang the robot.
constexpr int kMostInstructionsPerCycle = 1000;
constexpr double kShortestMove = 0.005;   // s
constexpr double kNoStretch = 1e-6;       // share
constexpr double kKickedBall = 0.7;       // m/s
constexpr double kFarthestAnchor = 0.06;  // m, that a curve follows the ball

JointGoal mirroredGoal(const JointGoal& goal) {
  const double sign = mirrorsSign(goal.joint) ? -1.0 : 1.0;
  return {model::mirrored(goal.joint), {sign * goal.angle.constant, sign * goal.angle.per}, goal.after};
}

bool takesTime(Instruction::Kind kind) {
  using Kind = Instruction::Kind;
  return kind == Kind::MoveOver || kind == Kind::MoveAt || kind == Kind::Swing || kind == Kind::Curve ||
         kind == Kind::Wait || kind == Kind::WaitUntil;
}

// The ball in the torso frame. The ball state is level, so the torso's tilt comes in.
Vector3 ballFromTorso(const Vector2& p_RBall, const world::BodyState& body) {
  const Vector3 p_level(p_RBall.x(), p_RBall.y(), kBallRadius - body.torsoHeight);
  const Matrix3 R_LR =
      (Eigen::AngleAxisd(body.pitch, Vector3::UnitY()) * Eigen::AngleAxisd(body.roll, Vector3::UnitX()))
          .toRotationMatrix();
  return R_LR.transpose() * p_level;
}

}  // namespace

SkillPlayer::SkillPlayer(const model::RobotModel& model, const SkillLibrary& library,
                         const model::JointArray& stand)
    : model_(&model), library_(&library), stand_(stand) {}

bool SkillPlayer::start(std::string_view name, bool mirrored, const model::JointArray& commanded,
                        const std::optional<KickAim>& aim) {
  const int skill = library_->find(name);
  if (skill < 0) return false;
  frames_[0] = Frame{skill, 0, mirrored, {}};
  depth_ = 1;
  time_ = 0.0;
  begun_ = false;
  stretch_.reset();
  from_ = commanded;
  ball_ = aim ? std::optional(aim->ball) : std::nullopt;
  const std::optional<KickHead>& kick = library_->skill(skill).kick;
  inputs_ = kick && aim ? kickInputs(*aim, *kick, mirrored) : KickInputs(KickInputs::Zero());
  if (kick && !aim) inputs_(kDistanceInput) = kick->longest;
  return true;
}

SkillPlayer::Place SkillPlayer::statement() const {
  if (depth_ == 0) return {};
  const Frame& frame = frames_[static_cast<std::size_t>(depth_ - 1)];
  const Skill& skill = library_->skill(frame.skill);
  const Instruction& instruction = skill.program[static_cast<std::size_t>(frame.at)];
  // What takes no time is gone past in the next cycle.
  return takesTime(instruction.kind) ? Place{skill.name, instruction.line} : Place{};
}

SkillPlayer::Result SkillPlayer::update(const world::WorldState& world, JointTargets& targets) {
  if (depth_ == 0) return Result::Finished;
  double budget = world.body.cycleTime;
  time_ += budget;
  for (int count = 0; count < kMostInstructionsPerCycle; ++count) {
    Frame& frame = top();
    const Skill& skill = library_->skill(frame.skill);
    const Instruction& instruction = skill.program[static_cast<std::size_t>(frame.at)];
    if (instruction.kind == Instruction::Kind::Call) {
      ++frame.at;  // where to go on afterwards
      const bool mirrored = frame.mirrored != instruction.mirrored;
      frames_[static_cast<std::size_t>(depth_)] = Frame{instruction.callee, 0, mirrored, {}};
      ++depth_;
      continue;
    }
    switch (execute(instruction, skill, world, budget, targets)) {
      case Outcome::Stay:
        return Result::Running;
      case Outcome::Next:
        begun_ = false;
        break;
      case Outcome::Failed:
        depth_ = 0;
        return Result::Failed;
      case Outcome::Ended:
        begun_ = false;
        if (--depth_ == 0) return Result::Finished;
        break;
    }
  }
  depth_ = 0;
  return Result::Failed;
}

SkillPlayer::Outcome SkillPlayer::execute(const Instruction& instruction, const Skill& skill,
                                          const world::WorldState& world, double& budget,
                                          JointTargets& targets) {
  using Kind = Instruction::Kind;
  Frame& frame = top();
  const bool first = !begun_;
  if (first) begin(skill, instruction, frame.mirrored, world, targets);
  if (takesTime(instruction.kind)) return spendTime(instruction, skill, world, budget, targets);
  switch (instruction.kind) {
    case Kind::Branch:
      frame.at =
          holds(skill, instruction.condition, frame.mirrored, world) ? frame.at + 1 : instruction.target;
      return Outcome::Next;
    case Kind::Jump:
      frame.at = instruction.target;
      return Outcome::Next;
    case Kind::Loop: {
      int& done = frame.loops[static_cast<std::size_t>(instruction.slot)];
      if (++done < instruction.count) {
        frame.at = instruction.target;
        return Outcome::Next;
      }
      done = 0;
      break;
    }
    case Kind::Stiffness:
      for (const JointGoal& goal : instruction.joints) {
        const JointId joint = frame.mirrored ? model::mirrored(goal.joint) : goal.joint;
        targets.stiffness[model::index(joint)] = instruction.value;
      }
      break;
    case Kind::End:
      return Outcome::Ended;
    case Kind::Fail:
      return Outcome::Failed;
    default:  // Call: done by the caller
      break;
  }
  ++frame.at;
  return Outcome::Next;
}

SkillPlayer::Outcome SkillPlayer::spendTime(const Instruction& instruction, const Skill& skill,
                                            const world::WorldState& world, double& budget,
                                            JointTargets& targets) {
  using Kind = Instruction::Kind;
  Frame& frame = top();
  const bool over =
      instruction.kind == Kind::WaitUntil && holds(skill, instruction.condition, frame.mirrored, world);
  if (!over) {
    const double used = std::min(budget, duration_ - inInstruction_);
    inInstruction_ += used;
    budget -= used;
    const bool curve = instruction.kind == Kind::Curve;
    if (curve) followBall(instruction, world);
    const double share = curve             ? curve_.shareAt(inInstruction_)
                         : duration_ > 0.0 ? inInstruction_ / duration_
                                           : 1.0;
    if (instruction.kind == Kind::Swing) {
      placeSwing(targets);
    } else if (instruction.kind != Kind::Wait && instruction.kind != Kind::WaitUntil) {
      place(instruction, frame.mirrored, share, targets);
    }
    if (budget <= 1e-9) {
      if (inInstruction_ < duration_ - 1e-9) return Outcome::Stay;
      ++frame.at;  // over exactly with this cycle
      begun_ = false;
      return Outcome::Stay;
    }
  }
  ++frame.at;
  return Outcome::Next;
}

void SkillPlayer::begin(const Skill& skill, const Instruction& instruction, bool mirrored,
                        const world::WorldState& world, const JointTargets& targets) {
  begun_ = true;
  inInstruction_ = 0.0;
  duration_ = instruction.value;
  if (instruction.kind == Instruction::Kind::MoveOver || instruction.kind == Instruction::Kind::Swing) {
    duration_ = std::max(kShortestMove, instruction.duration.at(inputs_));
  }
  from_ = targets.angles;
  // A joint that was let go begins where it is.
  for (std::size_t i = 0; i < model::kJointCount; ++i) {
    if (targets.stiffness[i] == 0.0) from_[i] = world.body.joints[i];
  }
  chooseGoals(instruction, mirrored);
  if (skill.kick && instruction.kind == Instruction::Kind::MoveOver) keepReachable();
  if (instruction.kind == Instruction::Kind::MoveAt) {
    double farthest = 0.0;
    for (std::size_t i = 0; i < model::kJointCount; ++i) {
      if ((moves_ >> i) & 1U) farthest = std::max(farthest, std::abs(to_[i] - from_[i]));
    }
    duration_ = farthest / instruction.value;
  }
  if (instruction.feet.empty() && instruction.points.empty()) return;
  model::BodyPoses bodies;
  model::forwardKinematics(*model_, from_, bodies);
  for (const Side side : {Side::Left, Side::Right}) {
    feetFrom_[index(side)] = model::solePose(*model_, bodies, side);
  }
  if (instruction.kind == Instruction::Kind::Curve) planCurve(instruction, mirrored, world);
}

// A kick tells where it will find the ball, seen from where it begins; whoever sees it knows better by now.
Vector3 SkillPlayer::curveOrigin(const Instruction& instruction, const world::WorldState& world) const {
  if (!instruction.fromBall) return Vector3::Zero();
  const Vector2 ball = world.ball.known || !ball_ ? world.ball.p_RB : *ball_;
  return ballFromTorso(ball, world.body);
}

void SkillPlayer::planCurve(const Instruction& instruction, bool mirrored, const world::WorldState& world) {
  const Side side = instruction.points[0].side;
  curve_.plan(instruction, mirrored, feetFrom_[index(mirrored ? model::other(side) : side)],
              curveOrigin(instruction, world));
  anchor_ = curve_.origin();
  duration_ = curve_.setPace(*model_, instruction.value, from_, to_, moves_);
  if (duration_ > instruction.value * (1.0 + kNoStretch)) {
    stretch_ = Stretch{instruction.line, instruction.value, duration_};
  }
}

// The points go with the ball while it moves, but not with one that has been kicked.
void SkillPlayer::followBall(const Instruction& instruction, const world::WorldState& world) {
  if (!instruction.fromBall || !world.ball.known || world.ball.v_FB.head<2>().norm() > kKickedBall) return;
  const Vector3 origin = curveOrigin(instruction, world);
  if ((origin - anchor_).norm() < kFarthestAnchor) curve_.moveTo(origin);
}

void SkillPlayer::chooseGoals(const Instruction& instruction, bool mirrored) {
  moves_ = 0;
  if (instruction.kind == Instruction::Kind::Stiffness) return;  // its joints have no goals
  if (instruction.stand) {
    for (const model::JointSpec& joint : model_->joints()) moves_ |= 1U << model::index(joint.id);
    to_ = stand_;
  }
  for (const JointGoal& raw : instruction.joints) {
    const JointGoal goal = mirrored ? mirroredGoal(raw) : raw;
    if (!model_->has(goal.joint)) continue;
    const std::size_t i = model::index(goal.joint);
    to_[i] = goal.angle.at(inputs_);
    after_[i] = goal.after.at(inputs_);
    moves_ |= 1U << i;
  }
  for (const FootShift& shift : instruction.shifts) shiftFoot(shift, mirrored);
}

// The leg's joints without a goal of their own go along from where they are.
void SkillPlayer::shiftFoot(const FootShift& shift, bool mirrored) {
  const Side side = mirrored ? model::other(shift.side) : shift.side;
  model::JointArray goals = from_;
  for (std::size_t i = 0; i < model::kJointCount; ++i)
    if ((moves_ >> i) & 1U) goals[i] = to_[i];
  const double left = mirrored ? -1.0 : 1.0;
  const Vector3 way(shift.way[0].at(inputs_), left * shift.way[1].at(inputs_), shift.way[2].at(inputs_));
  model::LegAngles leg = model::legAngles(side, goals);
  model::shiftSole(*model_, side, way, left * shift.yaw.at(inputs_), leg);
  model::setLegAngles(side, leg, to_);
  const std::size_t first = model::index(side == Side::Left ? JointId::LLeg1 : JointId::RLeg1);
  for (std::size_t i = first; i < first + leg.size(); ++i) {
    if (((moves_ >> i) & 1U) == 0) after_[i] = 0.0;
    moves_ |= 1U << i;
  }
}

// What a kick asks of a joint may be too far for its time; the next statement begins where the joint is then.
void SkillPlayer::keepReachable() {
  for (const model::JointSpec& joint : model_->joints()) {
    const std::size_t i = model::index(joint.id);
    if (((moves_ >> i) & 1U) == 0) continue;
    const double way = joint.maxSpeed * duration_;
    to_[i] = from_[i] + std::clamp(to_[i] - from_[i], -way, way);
  }
}

void SkillPlayer::place(const Instruction& instruction, bool mirrored, double share,
                        JointTargets& targets) const {
  for (std::size_t i = 0; i < model::kJointCount; ++i) {
    if (((moves_ >> i) & 1U) == 0) continue;
    targets.angles[i] = from_[i] + share * (to_[i] - from_[i]);
    if (targets.stiffness[i] == 0.0) targets.stiffness[i] = 1.0;
  }
  placeFeet(instruction, mirrored, share, targets);
  if (instruction.kind == Instruction::Kind::Curve) setLeg(curve_.side(), curve_.at(share), targets);
}

// Every joint runs at its full speed from its delay on: what a kick needs, and what moves with one speed over
// their whole time do not give.
void SkillPlayer::placeSwing(JointTargets& targets) const {
  for (const model::JointSpec& joint : model_->joints()) {
    const std::size_t i = model::index(joint.id);
    if (((moves_ >> i) & 1U) == 0) continue;
    const double way = joint.maxSpeed * std::max(0.0, inInstruction_ - after_[i]);
    targets.angles[i] = from_[i] + std::clamp(to_[i] - from_[i], -way, way);
    if (targets.stiffness[i] == 0.0) targets.stiffness[i] = 1.0;
  }
}

void SkillPlayer::placeFeet(const Instruction& instruction, bool mirrored, double share,
                            JointTargets& targets) const {
  for (const FootGoal& raw : instruction.feet) {
    const FootGoal goal = mirrored ? mirroredGoal(raw) : raw;
    const Pose3& from = feetFrom_[index(goal.side)];
    const Vector3 rpyFrom = anglesOf(from.linear());
    Pose3 X_RS = Pose3::Identity();
    X_RS.translation() = from.translation() + share * (goal.position - from.translation());
    X_RS.linear() = rotationOf(rpyFrom + share * (goal.rollPitchYaw - rpyFrom));
    setLeg(goal.side, X_RS, targets);
  }
}

void SkillPlayer::setLeg(Side side, const Pose3& X_RS, JointTargets& targets) const {
  model::LegAngles leg{};
  model::legInverseKinematics(*model_, side, X_RS, leg);
  model::setLegAngles(side, leg, targets.angles);
}

double SkillPlayer::quantity(Quantity quantity, bool mirrored, const world::WorldState& world) const {
  switch (quantity) {
    case Quantity::Time:
      return time_;
    case Quantity::Pitch:
      return world.body.pitch;
    case Quantity::Roll:
      return mirrored ? -world.body.roll : world.body.roll;
    case Quantity::Rate:
      return world.body.gyro.norm();
    case Quantity::Height:
      return world.body.torsoHeight;
    case Quantity::BallDistance:
      return world.ball.p_RB.norm();
    case Quantity::BallX:
      return world.ball.p_RB.x();
    case Quantity::BallY:
      return mirrored ? -world.ball.p_RB.y() : world.ball.p_RB.y();
  }
  return 0.0;
}

bool SkillPlayer::holds(const Skill& skill, int node, bool mirrored, const world::WorldState& world) const {
  using Kind = ConditionNode::Kind;
  using world::Posture;
  const ConditionNode& c = skill.conditions[static_cast<std::size_t>(node)];
  const Posture posture = world.body.posture;
  const auto contact = [&](Side side) {
    return world.body.footContact[index(mirrored ? model::other(side) : side)];
  };
  switch (c.kind) {
    case Kind::Not:
      return !holds(skill, c.first, mirrored, world);
    case Kind::And:
      return holds(skill, c.first, mirrored, world) && holds(skill, c.second, mirrored, world);
    case Kind::Or:
      return holds(skill, c.first, mirrored, world) || holds(skill, c.second, mirrored, world);
    case Kind::Upright:
      return posture == Posture::Upright;
    case Kind::Fallen:
      return world::isFallen(posture);
    case Kind::FallenFront:
      return posture == Posture::FallenFront;
    case Kind::FallenBack:
      return posture == Posture::FallenBack;
    case Kind::FallenLeft:
      return posture == (mirrored ? Posture::FallenRight : Posture::FallenLeft);
    case Kind::FallenRight:
      return posture == (mirrored ? Posture::FallenLeft : Posture::FallenRight);
    case Kind::ContactLeft:
      return contact(Side::Left);
    case Kind::ContactRight:
      return contact(Side::Right);
    case Kind::Less:
      return quantity(c.quantity, mirrored, world) < c.value;
    case Kind::Greater:
      return quantity(c.quantity, mirrored, world) > c.value;
  }
  return false;
}

}  // namespace nonet::motion
