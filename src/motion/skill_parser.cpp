#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "nonet/model/robot_model.h"
#include "nonet/motion/limbs.h"
#include "nonet/motion/skill_language.h"

#include "skill_condition.h"
#include "skill_joints.h"
#include "skill_kick_head.h"
#include "skill_reader.h"

namespace nonet::motion {

namespace {

using config::Unit;
using model::Side;
using Kind = SkillToken::Kind;

class Parser : private SkillReader {
 public:
  Parser(std::string_view text, const std::string& file, const std::vector<SkillText>& others,
         const ParameterLookup& lookup, std::vector<std::string>* errors = nullptr)
      : SkillReader(text, file, others, errors), lookup_(lookup) {}

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
    if (accept("like")) fail("expected the name of the skill that this one is like, and '{'");
    expect("{");
    const auto begins = [](const SkillToken& token) {
      return token.text == "parameter" || token.text == "kick" || isStatement(token);
    };
    while (peek().text == "parameter") part([this] { parseParameter(); }, begins);
    if (accept("kick")) part([this] { skill_.kick = readKickHead(*this); }, begins);
    skill_.textFile = peek().file;
    allowInputs(skill_.kick.has_value());
    block();
    allowInputs(false);
    if (skill_.kick) skill_.kick->scales = namesInput(kDistanceInput);
    emit(Instruction::Kind::End);
    return std::move(skill_);
  }

  // One that restates another skill's follows right behind that (skill_like.h).
  void parseParameter() {
    const bool restates = take().restates;
    const SkillToken nameToken = peek();
    const std::string name = word("the name of the parameter");
    SkillParameter* known = restates ? parameterOf(name) : nullptr;
    if (isNamed(name) && !restates) failAt(nameToken, "this parameter exists already");
    try {
      defineParameter(nameToken, name, known);
    } catch (const SkillError&) {
      if (!isNamed(name)) nameValue(name, {});  // those who name it are not wrong for that
      throw;
    }
  }

  void defineParameter(const SkillToken& nameToken, const std::string& name, SkillParameter* known) {
    expect("=");
    SkillParameter parameter = known != nullptr ? *known : SkillParameter{};
    parameter.name = name;
    if (known != nullptr) {
      parameter.value = value(known->unit);
    } else {
      const SkillValue initial = anyValue();
      parameter.value = initial.number;
      parameter.unit = initial.unit;
    }
    if (accept("in")) parameter.range = range(parameter.unit, nameToken);
    if (!peek().restates) finish(parameter, nameToken);
    nameValue(name, {parameter.value, parameter.unit});
    if (known == nullptr) {
      skill_.parameters.push_back(std::move(parameter));
    } else {
      *known = std::move(parameter);
    }
  }

  SkillParameter* parameterOf(const std::string& name) {
    const auto found = std::find_if(skill_.parameters.begin(), skill_.parameters.end(),
                                    [&](const SkillParameter& parameter) { return parameter.name == name; });
    return found == skill_.parameters.end() ? nullptr : &*found;
  }

  config::Range range(Unit unit, const SkillToken& nameToken) {
    config::Range range;
    range.low = value(unit);
    expect("..");
    range.high = value(unit);
    if (!(range.low < range.high)) failAt(nameToken, "the range is empty");
    return range;
  }

  // Nothing restates it any more.
  void finish(SkillParameter& parameter, const SkillToken& nameToken) const {
    if (parameter.range &&
        (parameter.value < parameter.range->low || parameter.value > parameter.range->high)) {
      failAt(nameToken, "the default lies outside the range");
    }
    if (lookup_) parameter.value = lookup_(skill_.name, parameter.name).value_or(parameter.value);
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
    // What varies is bounded where it is played; its constant alone says nothing.
    const bool varies = !result.per.isZero(0.0);
    if (!varies && !(result.constant > 0.0)) failAt(first, "must be more than zero");
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
      readJoints(*this, instruction.joints, true);
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
    if (!accept("foot")) return readJoints(*this, instruction.joints, true);
    const Side foot = side();
    expect("at");
    instruction.feet.push_back(pose(foot));
  }

  // "shift left foot by (1m * ballAhead, 1m * ballAside, 0) turned 0.5rad * turn"
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
    if (accept("turned")) shift.yaw = kickValue(Unit::Radian);
  }

  FootGoal pose(Side side) {
    FootGoal goal;
    goal.side = side;
    goal.position = vector(Unit::Metre);
    if (accept("rpy")) goal.rollPitchYaw = vector(Unit::Radian);
    return goal;
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
      while (!accept("}")) readJoints(*this, instruction.joints, false);
      return;
    }
    for (std::size_t i = 0; i < model::kJointCount; ++i)
      instruction.joints.push_back({model::jointAt(i), {}, {}});
  }

  const ParameterLookup& lookup_;
  Skill skill_;
};

}  // namespace

std::vector<Skill> parseSkills(std::string_view text, const std::string& file, const ParameterLookup& lookup,
                               const std::vector<SkillText>& others) {
  return Parser(text, file, others, lookup).run();
}

SkillCheck checkSkills(std::string_view text, const std::string& file, const std::vector<SkillText>& others) {
  SkillCheck check;
  const ParameterLookup none;
  check.skills = Parser(text, file, others, none, &check.errors).run();
  return check;
}

}  // namespace nonet::motion
