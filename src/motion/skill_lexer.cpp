#include "skill_lexer.h"

#include <array>
#include <charconv>

#include <fmt/format.h>

#include "nonet/math/angle.h"
#include "nonet/motion/skill_language.h"

namespace nonet::motion {

namespace {

using config::Unit;

struct UnitWord {
  std::string_view text;
  Unit unit;
  double factor;
};
constexpr std::array<UnitWord, 11> kUnits{{{"deg/s", Unit::RadianPerSecond, kPi / 180.0},
                                           {"rad/s", Unit::RadianPerSecond, 1.0},
                                           {"m/s", Unit::MetrePerSecond, 1.0},
                                           {"deg", Unit::Radian, kPi / 180.0},
                                           {"rad", Unit::Radian, 1.0},
                                           {"ms", Unit::Second, 1e-3},
                                           {"mm", Unit::Metre, 1e-3},
                                           {"cm", Unit::Metre, 1e-2},
                                           {"s", Unit::Second, 1.0},
                                           {"m", Unit::Metre, 1.0},
                                           {"", Unit::None, 1.0}}};

bool isLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

class Lexer {
 public:
  Lexer(std::string_view text, const std::string& file, std::vector<std::string>* errors)
      : text_(text), file_(file), errors_(errors) {}

  std::vector<SkillToken> run() {
    constexpr std::size_t kCharactersPerToken = 4;  // about
    tokens_.reserve(text_.size() / kCharactersPerToken);
    while (at_ < text_.size()) next();
    add(SkillToken::Kind::End, 0);
    return std::move(tokens_);
  }

 private:
  char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }

  SkillToken& add(SkillToken::Kind kind, std::size_t length) {
    SkillToken token;
    token.kind = kind;
    token.text = text_.substr(at_, length);
    token.file = file_;
    token.line = line_;
    token.column = static_cast<int>(at_ - lineBegin_) + 1;
    at_ += length;
    return tokens_.emplace_back(token);
  }

  void next() {
    const char c = peek();
    if (c == '\n') {
      add(SkillToken::Kind::NewLine, 1);
      ++line_;
      lineBegin_ = at_;
    } else if (c == ' ' || c == '\t' || c == '\r') {
      ++at_;
    } else if (c == '#') {
      std::size_t end = text_.find('\n', at_);
      if (end == std::string_view::npos) end = text_.size();
      while (end > at_ && (text_[end - 1] == ' ' || text_[end - 1] == '\r' || text_[end - 1] == '\t')) --end;
      add(SkillToken::Kind::Comment, end - at_);
    } else if (isLetter(c)) {
      std::size_t length = 1;
      while (isLetter(peek(length)) || isDigit(peek(length))) ++length;
      add(SkillToken::Kind::Word, length);
    } else if (isDigit(c) || (c == '.' && isDigit(peek(1)))) {
      number();
    } else if (c == '.' && peek(1) == '.') {
      add(SkillToken::Kind::Symbol, 2);
    } else if (std::string_view("{}(),=<>+-*/.").find(c) != std::string_view::npos) {
      add(SkillToken::Kind::Symbol, 1);
    } else {
      fail(add(SkillToken::Kind::Symbol, 1), "this character means nothing here");
      tokens_.pop_back();
    }
  }

  // "0.2s", "-" is a symbol of its own; "1..2" is a range of two numbers.
  void number() {
    std::size_t length = 0;
    while (isDigit(peek(length))) ++length;
    if (peek(length) == '.' && peek(length + 1) != '.') {
      ++length;
      while (isDigit(peek(length))) ++length;
    }
    double value = 0.0;
    std::from_chars(text_.data() + at_, text_.data() + at_ + length, value);
    std::size_t unitLength = 0;
    while (isLetter(peek(length + unitLength))) ++unitLength;
    if (unitLength > 0 && peek(length + unitLength) == '/' && peek(length + unitLength + 1) == 's' &&
        !isLetter(peek(length + unitLength + 2))) {
      unitLength += 2;
    }
    const std::string_view unitText = text_.substr(at_ + length, unitLength);
    SkillToken& token = add(SkillToken::Kind::Number, length + unitLength);
    for (const UnitWord& unit : kUnits) {
      if (unit.text != unitText) continue;
      token.unit = unit.unit;
      token.value = value * unit.factor;
      return;
    }
    fail(token, fmt::format("unknown unit '{}' (deg rad s ms m cm mm deg/s rad/s m/s)", unitText));
    token.value = 0.0;  // fits every unit, so that nothing follows from this error
  }

  void fail(const SkillToken& token, const std::string& message) const {
    if (errors_ == nullptr) failAt(token, message);
    errors_->push_back(errorAt(token, message));
  }

  std::string_view text_;
  const std::string& file_;
  std::vector<std::string>* errors_;
  std::size_t at_ = 0;
  std::size_t lineBegin_ = 0;
  int line_ = 1;
  std::vector<SkillToken> tokens_;
};

}  // namespace

std::string errorAt(const SkillToken& token, const std::string& message) {
  const std::string heir = token.heir.empty() ? "" : fmt::format(" (in {})", token.heir);
  return fmt::format("{}:{}:{}: {}{}", token.file, token.line, token.column, message, heir);
}

void failAt(const SkillToken& token, const std::string& message) {
  throw SkillError(errorAt(token, message));
}

std::vector<SkillToken> lexSkills(std::string_view text, const std::string& file,
                                  std::vector<std::string>* errors) {
  return Lexer(text, file, errors).run();
}

std::vector<SkillToken> lexWords(std::string_view text, const std::string& file,
                                 std::vector<std::string>* errors) {
  std::vector<SkillToken> words = lexSkills(text, file, errors);
  std::erase_if(words, [](const SkillToken& token) {
    return token.kind == SkillToken::Kind::Comment || token.kind == SkillToken::Kind::NewLine;
  });
  return words;
}

}  // namespace nonet::motion
