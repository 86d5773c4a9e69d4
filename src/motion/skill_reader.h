// What a parser of the skill language reads from its words: expected symbols, names, and values with units,
// which are arithmetic over numbers and parameters.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "nonet/config/parameters.h"
#include "nonet/math/types.h"
#include "nonet/motion/skill.h"
#include "nonet/motion/skill_language.h"

#include "skill_lexer.h"

namespace nonet::motion {

/// A number in SI units, or a sum of one and of multiples of what a kick suits itself to (ballAhead, ...). A
/// zero fits every unit.
struct SkillValue {
  double number = 0.0;
  config::Unit unit = config::Unit::None;
  KickInputs per = KickInputs::Zero();
  bool varies() const { return !per.isZero(0.0); }
  bool isZero() const { return number == 0.0 && !varies(); }
  SkillValue times(double factor) const { return {number * factor, unit, per * factor}; }
};

/// All members throw SkillError where the text is not what they read.
class SkillReader {
 public:
  /// Skips comments and line ends; a skill that is `like` another one, here or in `others`, is read as if it
  /// were written out. The texts must outlive the reader. With `errors`, those that can be passed over are
  /// put there, and reading goes on.
  SkillReader(std::string_view text, const std::string& file, const std::vector<SkillText>& others,
              std::vector<std::string>* errors = nullptr);

  const std::string& file() const { return file_; }
  const SkillToken& peek() const { return tokens_[at_]; }
  const SkillToken& take();
  /// Takes the next word if it is this one.
  bool accept(std::string_view text);
  void expect(std::string_view text);
  /// A name; `what` says in the message which one is missing.
  std::string word(std::string_view what);
  [[noreturn]] void fail(const std::string& message) const { failAt(peek(), message); }
  [[noreturn]] void failAt(const SkillToken& token, const std::string& message) const;

  /// Passes over what is wrong without losing the place: notes the error, or throws it if errors are not
  /// collected.
  void note(const SkillToken& token, const std::string& message) const;
  bool collects() const { return errors_ != nullptr; }
  /// Reads one part of a list. If it does not make sense and errors are collected, they get it, and all is
  /// skipped up to the next word that `begins` such a part, or the bracket that ends the list.
  void part(const std::function<void()>& read, const std::function<bool(const SkillToken&)>& begins);
  /// Thrown by part() at the end of the text, when nothing can be skipped any more; the error is noted.
  struct GivenUp {};

  /// Blocks, brackets and negations nest only so deep.
  void enter();
  void leave() { --depth_; }

  SkillValue anyValue();
  double value(config::Unit unit);
  double positive(config::Unit unit);
  /// May suit itself to the ball, in skills whose head says where the ball should lie.
  KickValue kickValue(config::Unit unit);
  void allowInputs(bool allowed) { inputsAllowed_ = allowed; }
  /// The text has named this input since the names were forgotten, even if only times nothing.
  bool namesInput(int input) const { return ((inputsNamed_ >> static_cast<unsigned>(input)) & 1U) != 0; }
  /// "(x, y, z)"
  Vector3 vector(config::Unit unit);
  /// "(x, y)"
  Vector2 pair(config::Unit unit);
  /// "left" or "right".
  model::Side side();

  /// Parameters stand for their values from here on.
  void nameValue(const std::string& name, const SkillValue& value) { named_[name] = value; }
  bool isNamed(const std::string& name) const { return named_.count(name) > 0; }
  void forgetNames() {
    named_.clear();
    inputsNamed_ = 0;
  }

 private:
  SkillValue primary();
  SkillValue signedValue();
  SkillValue product();

  std::string file_;
  std::vector<std::string>* errors_;
  std::vector<SkillToken> tokens_;
  std::size_t at_ = 0;
  int depth_ = 0;
  bool inputsAllowed_ = false;
  std::uint32_t inputsNamed_ = 0;
  std::map<std::string, SkillValue, std::less<>> named_;
};

}  // namespace nonet::motion
