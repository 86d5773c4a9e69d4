#include "skill_reader.h"

#include <array>

#include <fmt/format.h>

#include "skill_like.h"

namespace nonet::motion {

using config::Unit;
using Kind = SkillToken::Kind;

namespace {

constexpr std::array<std::string_view, kKickInputs> kInputWords{"ballAhead", "ballAside", "turn",
                                                                "paceAhead", "paceAside", "distance"};

}  // namespace

SkillReader::SkillReader(std::string_view text, const std::string& file, const std::vector<SkillText>& others,
                         std::vector<std::string>* errors)
    : file_(file), errors_(errors) {
  tokens_ = writeOutLikes(lexWords(text, file_, errors), file_, others, errors);
}

const SkillToken& SkillReader::take() {
  const SkillToken& token = tokens_[at_];
  if (token.kind != Kind::End) ++at_;
  return token;
}

bool SkillReader::accept(std::string_view text) {
  if (peek().kind == Kind::Number || peek().text != text || peek().kind == Kind::End) return false;
  ++at_;
  return true;
}

void SkillReader::expect(std::string_view text) {
  if (accept(text)) return;
  const std::string_view found = peek().kind == Kind::End ? "the end of the file" : peek().text;
  fail(fmt::format("expected '{}', found '{}'", text, found));
}

std::string SkillReader::word(std::string_view what) {
  if (peek().kind != Kind::Word) fail(fmt::format("expected {}", what));
  return std::string(take().text);
}

void SkillReader::failAt(const SkillToken& token, const std::string& message) const {
  motion::failAt(token, message);
}

void SkillReader::note(const SkillToken& token, const std::string& message) const {
  if (errors_ == nullptr) failAt(token, message);
  errors_->push_back(errorAt(token, message));
}

void SkillReader::part(const std::function<void()>& read,
                       const std::function<bool(const SkillToken&)>& begins) {
  if (errors_ == nullptr) return read();
  const std::size_t begin = at_;
  const int outside = depth_;
  try {
    return read();
  } catch (const SkillError& error) {
    errors_->push_back(error.what());
  }
  depth_ = outside;
  int open = 0;  // brackets of this part
  const auto count = [&open](const SkillToken& token) {
    if (token.kind == Kind::Symbol) open += token.text == "{" ? 1 : token.text == "}" ? -1 : 0;
  };
  for (std::size_t i = begin; i < at_; ++i) count(tokens_[i]);
  for (; peek().kind != Kind::End; ++at_) {
    const bool closes = peek().kind == Kind::Symbol && peek().text == "}";
    if (open <= 0 && (closes || (at_ > begin && begins(peek())))) return;
    count(peek());
    if (open == 0 && closes) {
      ++at_;
      return;
    }
  }
  throw GivenUp{};
}

void SkillReader::enter() {
  constexpr int kDeepest = 32;
  if (++depth_ > kDeepest) fail("nested too deeply");
}

SkillValue SkillReader::primary() {
  const SkillToken& token = peek();
  if (accept("(")) {
    enter();
    SkillValue inner = anyValue();
    leave();
    expect(")");
    return inner;
  }
  if (token.kind == Kind::Number) {
    take();
    return {token.value, token.unit};
  }
  if (token.kind == Kind::Word) {
    for (int i = 0; i < kKickInputs; ++i) {
      if (!accept(kInputWords[static_cast<std::size_t>(i)])) continue;
      inputsNamed_ |= 1U << static_cast<unsigned>(i);
      return {0.0, Unit::None, KickInputs::Unit(i)};
    }
    const auto found = named_.find(token.text);
    if (found == named_.end()) fail(fmt::format("unknown parameter '{}'", token.text));
    take();
    return found->second;
  }
  fail("expected a number or the name of a parameter");
}

SkillValue SkillReader::signedValue() {
  if (!accept("-")) return primary();
  return primary().times(-1.0);
}

SkillValue SkillReader::product() {
  SkillValue left = signedValue();
  for (;;) {
    if (accept("*")) {
      const SkillValue right = signedValue();
      if (left.unit != Unit::None && right.unit != Unit::None) fail("one factor must be a plain number");
      if (left.varies() && right.varies()) fail("only one factor may depend on the ball");
      const Unit unit = left.unit == Unit::None ? right.unit : left.unit;
      left = left.varies() ? left.times(right.number) : right.times(left.number);
      left.unit = unit;
    } else if (accept("/")) {
      const SkillValue right = signedValue();
      if (right.varies()) fail("a divisor must not depend on the ball");
      if (right.isZero()) fail("division by zero");
      if (right.unit != Unit::None && right.unit != left.unit)
        fail("divide by a plain number or the same unit");
      const Unit unit = right.unit == left.unit ? Unit::None : left.unit;
      left = left.times(1.0 / right.number);
      left.unit = unit;
    } else {
      return left;
    }
  }
}

// A sum of products.
SkillValue SkillReader::anyValue() {
  SkillValue left = product();
  while (peek().text == "+" || peek().text == "-") {
    const bool minus = take().text == "-";
    const SkillValue right = product().times(minus ? -1.0 : 1.0);
    if (left.unit != right.unit && !left.isZero() && !right.isZero()) fail("the units of a sum differ");
    left = {left.number + right.number, left.isZero() && left.unit == Unit::None ? right.unit : left.unit,
            left.per + right.per};
  }
  return left;
}

KickValue SkillReader::kickValue(Unit unit) {
  const SkillToken& first = peek();
  const SkillValue result = anyValue();
  if (result.unit != unit && !result.isZero()) {
    failAt(first, unit == Unit::None ? std::string("a plain number is needed here")
                                     : fmt::format("a value in {} is needed here", config::unitName(unit)));
  }
  if (result.varies() && !inputsAllowed_) {
    failAt(first, "only a skill with a 'kick' head knows where the ball should lie");
  }
  return {result.number, result.per};
}

double SkillReader::value(Unit unit) {
  const SkillToken& first = peek();
  const KickValue result = kickValue(unit);
  if (!result.per.isZero(0.0)) failAt(first, "must not depend on the ball here");
  return result.constant;
}

double SkillReader::positive(Unit unit) {
  const SkillToken& first = peek();
  const double result = value(unit);
  if (!(result > 0.0)) failAt(first, "must be more than zero");
  return result;
}

Vector3 SkillReader::vector(Unit unit) {
  Vector3 result;
  expect("(");
  for (int i = 0; i < 3; ++i) {
    if (i > 0) expect(",");
    result[i] = value(unit);
  }
  expect(")");
  return result;
}

Vector2 SkillReader::pair(Unit unit) {
  Vector2 result;
  expect("(");
  result.x() = value(unit);
  expect(",");
  result.y() = value(unit);
  expect(")");
  return result;
}

model::Side SkillReader::side() {
  if (accept("left")) return model::Side::Left;
  if (accept("right")) return model::Side::Right;
  fail("expected 'left' or 'right'");
}

}  // namespace nonet::motion
