#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "nonet/math/angle.h"
#include "nonet/model/robot_model.h"
#include "nonet/motion/limbs.h"
#include "nonet/motion/skill_language.h"

#include "skill_condition.h"
#include "skill_kick_head.h"
#include "skill_reader.h"

namespace nonet::motion {

namespace {

using config::Unit;
using model::JointId;
using model::Side;
using Kind = SkillToken::Kind;

struct JointWord {
  std::string_view name;
  JointId left;
};
constexpr std::array<JointWord, 11> kLimbJoints{{{"shoulderPitch", JointId::LArm1},
                                                 {"shoulderYaw", JointId::LArm2},
                                                 {"armRoll", JointId::LArm3},
                                                 {"elbow", JointId::LArm4},
                                                 {"hipYawPitch", JointId::LLeg1},
                                                 {"hipRoll", JointId::LLeg2},
                                                 {"hipPitch", JointId::LLeg3},
                                                 {"knee", JointId::LLeg4},
                                                 {"anklePitch", JointId::LLeg5},
                                                 {"ankleRoll", JointId::LLeg6},
                                                 {"toe", JointId::LLeg7}}};

bool isRight(JointId joint) {
  return (joint >= JointId::RArm1 && joint <= JointId::RArm4) ||
         (joint >= JointId::RLeg1 && joint <= JointId::RLeg7);
}

KickValue negated(const KickValue& value) {
  return {-value.constant, -value.per};
}

class Parser : private SkillReader {
 public:
  Parser(std::string_view text, const std::string& file, const ParameterLookup& lookup,
         std::vector<std::string>* errors = nullptr)
      : SkillReader(text, file, errors), lookup_(lookup) {}

  std::vector<Skill> run() {
    std::vector<Skill> skills;
    const auto begins = [](const SkillToken& token) { return token.text == "skill"; };
    try {
      while (peek().kind != Kind::End) {
        bool whole = false;
        part(
            [&] {
              skills.push_back(parseSkill());
              whole = true;
            },
            begins);
        if (!collects() || peek().kind == Kind::End || begins(peek())) continue;
        // A bracket too many: an error of its own, unless it follows from one that was told.
        if (whole) note(peek(), fmt::format("expected 'skill', found '{}'", peek().text));
        take();
      }
    } catch (const GivenUp&) {
      return skills;
    }
    return skills;
  }

 private:
  // -- skills
  Skill parseSkill() {
    expect("skill");
    skill_ = Skill{};
    forgetNames();
    skill_.file = file();
    skill_.name = word("the name of the skill");
    expect("{");
    const auto begins = [](const SkillToken& token) {
      return token.text == "parameter" || token.text == "kick" || isStatement(token);
    };
    while (accept("parameter")) part([this] { parseParameter(); }, begins);
    if (accept("kick")) part([this] { skill_.kick = readKickHead(*this); }, begins);
    allowInputs(skill_.kick.has_value());
    block();
    allowInputs(false);
    emit(Instruction::Kind::End);
    return std::move(skill_);
  }

  void parseParameter() {
    const SkillToken nameToken = peek();
    SkillParameter parameter;
    parameter.name = word("the name of the parameter");
    if (isNamed(parameter.name)) failAt(nameToken, "this parameter exists already");
    if (collects()) nameValue(parameter.name, {});  // known, even if what follows makes no sense
    expect("=");
    const SkillValue initial = anyValue();
    parameter.value = initial.number;
    parameter.unit = initial.unit;
    if (accept("in")) {
      config::Range range;
      range.low = value(parameter.unit);
      expect("..");
      range.high = value(parameter.unit);
      if (!(range.low < range.high)) failAt(nameToken, "the range is empty");
      if (parameter.value < range.low || parameter.value > range.high) {
        failAt(nameToken, "the default lies outside the range");
      }
      parameter.range = range;
    }
    if (lookup_) parameter.value = lookup_(skill_.name, parameter.name).value_or(parameter.value);
    nameValue(parameter.name, {parameter.value, parameter.unit});
    skill_.parameters.push_back(std::move(parameter));
  }

  Instruction& emit(Instruction::Kind kind) {
    Instruction& instruction = skill_.program.emplace_back();
    instruction.kind = kind;
    instruction.line = peek().line;
    instruction.column = peek().column;
    return instruction;
  }
  int here() const { return static_cast<int>(skill_.program.size()); }

  // Statements up to and including the closing bracket.
  void block() {
    enter();
    while (!accept("}")) part([this] { statement(); }, isStatement);
    leave();
  }

  static bool isStatement(const SkillToken& token) {
    static constexpr std::array<std::string_view, 10> kWords{"move",   "swing", "curve",     "wait", "if",
                                                             "repeat", "call",  "stiffness", "end",  "fail"};
    return token.kind == Kind::Word && std::find(kWords.begin(), kWords.end(), token.text) != kWords.end();
  }
  static bool isTarget(const SkillToken& token) {
    static constexpr std::array<std::string_view, 8> kWords{"left", "right", "both",  "head",
                                                            "foot", "stand", "point", "shift"};
    return token.kind == Kind::Word && std::find(kWords.begin(), kWords.end(), token.text) != kWords.end();
  }

  void statement() {
    if (accept("move")) return move();
    if (accept("swing")) return swing();
    if (accept("curve")) return curve();
    if (accept("wait")) return wait();
    if (accept("if")) return branch();
    if (accept("repeat")) return repeat();
    if (accept("call")) return call();
    if (accept("stiffness")) return stiffness();
    if (accept("end")) return static_cast<void>(emit(Instruction::Kind::End));
    if (accept("fail")) return static_cast<void>(emit(Instruction::Kind::Fail));
    if (peek().kind == Kind::End) fail("the file ends inside a skill: '}' is missing");
    if (peek().text == "parameter") fail("parameters stand at the begin of a skill");
    fail(fmt::format("'{}' is no statement (move swing curve wait if repeat call stiffness end fail)",
                     peek().text));
  }

  void move() {
    Instruction& instruction = emit(Instruction::Kind::MoveOver);
    if (accept("at")) {
      instruction.kind = Instruction::Kind::MoveAt;
      instruction.value = positive(Unit::RadianPerSecond);
    } else {
      expect("over");
      instruction.duration = duration();
    }
    expect("{");
    while (!accept("}")) {
      if (accept("stand")) {
        instruction.stand = true;
      } else {
        part([&] { target(instruction); }, isTarget);
      }
    }
  }

  KickValue duration() {
    const SkillToken& first = peek();
    KickValue result = kickValue(Unit::Second);
    if (!(result.constant > 0.0)) failAt(first, "must be more than zero");
    return result;
  }

  void swing() {
    Instruction& instruction = emit(Instruction::Kind::Swing);
    expect("over");
    instruction.duration = duration();
    expect("{");
    while (!accept("}")) {
      if (accept("shift")) {
        shift(instruction);
        continue;
      }
      const std::size_t before = instruction.joints.size();
      joints(instruction, true);
      if (!accept("after")) continue;
      const KickValue after = kickValue(Unit::Second);
      for (std::size_t i = before; i < instruction.joints.size(); ++i) instruction.joints[i].after = after;
    }
  }

  void curve() {
    Instruction& instruction = emit(Instruction::Kind::Curve);
    const Side foot = side();
    expect("foot");
    expect("over");
    instruction.value = positive(Unit::Second);
    if (accept("from")) {
      instruction.fromBall = accept("ball");
      if (!instruction.fromBall) expect("torso");
    }
    expect("{");
    while (!accept("}")) part([&] { pointOrTarget(instruction, foot); }, isTarget);
    const std::size_t count = instruction.points.size();
    if (count == 0 || count > Instruction::kMostPoints) {
      fail(fmt::format("a curve has 1 to {} points", Instruction::kMostPoints));
    }
  }

  void pointOrTarget(Instruction& instruction, Side foot) {
    const SkillToken first = peek();
    if (accept("point")) {
      instruction.points.push_back(pose(foot));
    } else {
      target(instruction);
    }
    if (!instruction.feet.empty() && instruction.feet.back().side == foot) {
      failAt(first, "this foot follows the curve; only the other one may have a target");
    }
  }

  // Where a joint or a foot is to be at the end of a move or curve.
  void target(Instruction& instruction) {
    if (accept("shift")) return shift(instruction);
    if (!accept("foot")) return joints(instruction, true);
    const Side foot = side();
    expect("at");
    instruction.feet.push_back(pose(foot));
  }

  // "shift left foot by (1m * ballAhead, 1m * ballAside, 0)"
  void shift(Instruction& instruction) {
    FootShift& shift = instruction.shifts.emplace_back();
    shift.side = side();
    expect("foot");
    expect("by");
    expect("(");
    for (std::size_t i = 0; i < shift.way.size(); ++i) {
      if (i > 0) expect(",");
      shift.way[i] = kickValue(Unit::Metre);
    }
    expect(")");
  }

  FootGoal pose(Side side) {
    FootGoal goal;
    goal.side = side;
    goal.position = vector(Unit::Metre);
    if (accept("rpy")) goal.rollPitchYaw = vector(Unit::Radian);
    return goal;
  }

  // "left.knee -30deg"; without a value the joints are only named.
  void joints(Instruction& instruction, bool withAngle) {
    const SkillToken first = peek();
    const std::string group = word("a joint (left.knee, both.elbow, head.pan), 'foot' or '}'");
    if (group != "left" && group != "right" && group != "both" && group != "head") {
      failAt(first, fmt::format("'{}' is no side (left right both head)", group));
    }
    expect(".");
    const SkillToken nameToken = peek();
    const std::string name = word("the name of a joint");
    if (group == "head") {
      if (name != "pan" && name != "tilt") failAt(nameToken, "the head has the joints pan and tilt");
      const SkillToken angleToken = peek();
      const KickValue angle = withAngle ? kickValue(Unit::Radian) : KickValue{};
      if (withAngle)
        checkLimits(angleToken, name == "pan" ? JointId::Head1 : JointId::Head2,
                    name == "pan" ? angle.constant : -angle.constant);
      // Tilt is positive downwards here as in a head request; the joint is positive upwards.
      if (name == "pan") instruction.joints.push_back({JointId::Head1, angle, {}});
      if (name == "tilt") instruction.joints.push_back({JointId::Head2, negated(angle), {}});
      return;
    }
    const auto found = std::find_if(kLimbJoints.begin(), kLimbJoints.end(),
                                    [&](const JointWord& joint) { return joint.name == name; });
    if (found == kLimbJoints.end()) failAt(nameToken, fmt::format("unknown joint '{}'", name));
    const SkillToken angleToken = peek();
    const KickValue angle = withAngle ? kickValue(Unit::Radian) : KickValue{};
    if (withAngle) checkLimits(angleToken, found->left, angle.constant);
    const JointId right = model::mirrored(found->left);
    if (group != "right") instruction.joints.push_back({found->left, angle, {}});
    if (group != "left")
      instruction.joints.push_back({right, mirrorsSign(right) ? negated(angle) : angle, {}});
  }

  // Only when errors are collected: learned values of parameters may lie outside, and the joint then stops at
  // its limit.
  void checkLimits(const SkillToken& token, JointId joint, double angle) const {
    if (!collects()) return;
    config::Range widest{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (int type = 0; type <= 4; ++type) {
      const model::RobotModel& robot = model::robotModel(type);
      if (!robot.has(joint)) continue;
      widest.low = std::min(widest.low, robot.joint(joint).low);
      widest.high = std::max(widest.high, robot.joint(joint).high);
    }
    constexpr double kRounding = 1e-6;
    if (angle >= widest.low - kRounding && angle <= widest.high + kRounding) return;
    // As it stands in the file: tilt is turned round there.
    const double sign = joint == JointId::Head2 ? -1.0 : 1.0;
    const double a = toDegrees(sign * widest.low);
    const double b = toDegrees(sign * widest.high);
    note(token, fmt::format("{:.4g} deg is out of the joint's reach, {:.4g} .. {:.4g} deg",
                            toDegrees(sign * angle), std::min(a, b), std::max(a, b)));
  }

  void wait() {
    Instruction& instruction = emit(Instruction::Kind::Wait);
    if (!accept("until")) {
      instruction.value = positive(Unit::Second);
      return;
    }
    instruction.kind = Instruction::Kind::WaitUntil;
    instruction.condition = readCondition(*this, skill_.conditions);
    expect("within");
    instruction.value = positive(Unit::Second);
  }

  void branch() {
    const int test = here();
    emit(Instruction::Kind::Branch);
    const int tested = readCondition(*this, skill_.conditions);
    skill_.program[test].condition = tested;
    expect("{");
    block();
    if (accept("else")) {
      const int jump = here();
      emit(Instruction::Kind::Jump);
      skill_.program[test].target = here();
      expect("{");
      block();
      skill_.program[jump].target = here();
    } else {
      skill_.program[test].target = here();
    }
  }

  void repeat() {
    const SkillToken first = peek();
    const double count = value(Unit::None);
    if (count < 1.0 || count > 1000.0 || count != static_cast<int>(count)) {
      failAt(first, "repeat needs a whole number from 1 to 1000");
    }
    const int begin = here();
    const int slot = skill_.loopSlots++;
    if (skill_.loopSlots > 8) failAt(first, "at most 8 repetitions in one skill");
    expect("{");
    block();
    Instruction& loop = emit(Instruction::Kind::Loop);
    loop.target = begin;
    loop.count = static_cast<int>(count);
    loop.slot = slot;
  }

  void call() {
    Instruction& instruction = emit(Instruction::Kind::Call);
    instruction.calleeName = word("the name of a skill");
    instruction.mirrored = accept("mirrored");
  }

  void stiffness() {
    Instruction& instruction = emit(Instruction::Kind::Stiffness);
    const SkillToken first = peek();
    instruction.value = value(Unit::None);
    if (instruction.value < 0.0 || instruction.value > 1.0) failAt(first, "stiffness lies between 0 and 1");
    if (accept("{")) {
      while (!accept("}")) joints(instruction, false);
      return;
    }
    for (std::size_t i = 0; i < model::kJointCount; ++i)
      instruction.joints.push_back({model::jointAt(i), {}, {}});
  }

  const ParameterLookup& lookup_;
  Skill skill_;
};

}  // namespace

bool mirrorsSign(JointId joint) {
  switch (joint) {
    case JointId::Head1:
    case JointId::LArm2:
    case JointId::LArm3:
    case JointId::LArm4:
    case JointId::LLeg2:
    case JointId::LLeg6:
    case JointId::RArm2:
    case JointId::RArm3:
    case JointId::RArm4:
    case JointId::RLeg2:
    case JointId::RLeg6:
      return true;
    default:
      return false;
  }
}

std::vector<Skill> parseSkills(std::string_view text, const std::string& file,
                               const ParameterLookup& lookup) {
  return Parser(text, file, lookup).run();
}

SkillCheck checkSkills(std::string_view text, const std::string& file) {
  SkillCheck check;
  const ParameterLookup none;
  check.skills = Parser(text, file, none, &check.errors).run();
  return check;
}

std::string jointWord(JointId joint) {
  if (joint == JointId::Head1) return "head.pan";
  if (joint == JointId::Head2) return "head.tilt";
  const JointId left = isRight(joint) ? model::mirrored(joint) : joint;
  const auto found = std::find_if(kLimbJoints.begin(), kLimbJoints.end(),
                                  [&](const JointWord& word) { return word.left == left; });
  return fmt::format("{}.{}", isRight(joint) ? "right" : "left", found->name);
}

bool countsBackwards(JointId joint) {
  return joint == JointId::Head2 || (isRight(joint) && mirrorsSign(joint));
}

}  // namespace nonet::motion
