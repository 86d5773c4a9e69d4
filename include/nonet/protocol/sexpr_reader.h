// A zero-copy reader of S-expressions: a cursor over the text that hands out atoms as views. It never throws,
// allocates or recurses, so any garbage and any nesting depth cost no more than their length.
//
// Use: ask for what the grammar expects next (open(), atom(), number(), close()); each either consumes it and
// returns true, or returns false and leaves the cursor where it was (behind blanks). After a surprise,
// leaveTo(depth) goes on behind the list in question.
#pragma once

#include <array>
#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <system_error>

namespace nonet::protocol {

/// Plain: blanks and brackets only, the language of sense messages. Commands: also comments (`;`), quoted
/// strings (`"`) and quoted expressions (`'`), the language in which the server reads agents (server facts
/// 1.8).
enum class SexprDialect : std::uint8_t { Plain, Commands };

template <SexprDialect kDialect>
class BasicSexprReader {
 public:
  explicit BasicSexprReader(std::string_view text) : at_(text.data()), end_(text.data() + text.size()) {}

  /// How many lists are open around the cursor.
  int depth() const { return depth_; }

  /// True if nothing but blanks (and comments) is left.
  bool atEnd() {
    skipBlanks();
    return at_ == end_;
  }

  bool open() {
    skipBlanks();
    if (at_ == end_ || *at_ != '(') {
      return false;
    }
    ++at_;
    ++depth_;
    return true;
  }

  /// Consumes the bracket that ends the current list. At depth 0 a stray ')' is not consumed.
  bool close() {
    skipBlanks();
    if (at_ == end_ || *at_ != ')' || depth_ == 0) {
      return false;
    }
    ++at_;
    --depth_;
    return true;
  }

  /// Consumes one atom; `value` points into the text.
  bool atom(std::string_view& value) {
    skipBlanks();
    if constexpr (kDialect == SexprDialect::Commands) {
      if (at_ != end_ && (*at_ == '"' || *at_ == '\'')) {
        return quoted(value);
      }
    }
    const char* begin = at_;
    while (at_ != end_ && !endsAtom(*at_)) {
      ++at_;
    }
    value = {begin, static_cast<std::size_t>(at_ - begin)};
    return at_ != begin;
  }

  /// Consumes one atom if it is exactly `expected`.
  bool literal(std::string_view expected) {
    skipBlanks();
    const char* begin = at_;
    std::string_view value;
    if (atom(value) && value == expected) {
      return true;
    }
    at_ = begin;
    return false;
  }

  /// Opens a list if its name is `name`: open() and literal(name) in one.
  template <std::size_t kSize>
  bool openNamed(const char (&name)[kSize]) {
    constexpr std::size_t kLength = kSize - 1;  // without the terminating zero
    skipBlanks();
    const char* begin = at_;
    // As programs write it, "(name " is there byte for byte: one comparison of constant length.
    if (static_cast<std::size_t>(end_ - at_) >= kLength + 2 && at_[0] == '(' &&
        std::memcmp(at_ + 1, name, kLength) == 0 && at_[kLength + 1] == ' ') {
      at_ += kLength + 2;
      ++depth_;
      return true;
    }
    if (open() && literal({name, kLength})) {
      return true;
    }
    depth_ -= at_ != begin ? 1 : 0;
    at_ = begin;
    return false;
  }

  /// Consumes one atom if all of it is a number ("-0.00", "nan", "-inf" and exponents included).
  bool number(double& value) {
    skipBlanks();
    return twoDecimals(at_, end_, value) || anyNumber(value);
  }

  /// Consumes a whole list of a name and as many numbers as `values` has places: "(pol 1.00 2.00 3.00)".
  template <std::size_t kSize, std::size_t kCount>
  bool numberList(const char (&name)[kSize], std::array<double, kCount>& values) {
    skipBlanks();
    if (exactNumberList(name, values)) {
      return true;
    }
    const BasicSexprReader begin = *this;
    bool complete = openNamed(name);
    for (std::size_t i = 0; i < kCount && complete; ++i) {
      complete = number(values[i]);
    }
    if (complete && close()) {
      return true;
    }
    *this = begin;
    return false;
  }

  /// Consumes one atom if all of it is an integer.
  bool integer(int& value) {
    skipBlanks();
    const char* begin = at_;
    std::string_view text;
    if (atom(text)) {
      const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      if (error == std::errc() && rest == text.data() + text.size()) {
        return true;
      }
    }
    at_ = begin;
    return false;
  }

  /// Skips the rest of all lists deeper than `depth`. False if the text ends first.
  bool leaveTo(int depth) {
    while (depth_ > depth) {
      if (!skipOne()) {
        return false;
      }
    }
    return true;
  }

  /// Skips one token, whatever it is: a bracket (following it in or out) or an atom. False at the end.
  bool skipOne() {
    if (atEnd()) {
      return false;
    }
    if (*at_ == '(') {
      ++at_;
      ++depth_;
    } else if (*at_ == ')') {
      ++at_;
      depth_ -= depth_ > 0 ? 1 : 0;
    } else {
      std::string_view ignored;
      atom(ignored);
    }
    return true;
  }

 private:
  static bool isBlank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
  static bool endsAtom(char c) {
    if constexpr (kDialect == SexprDialect::Commands) {
      if (c == '\'') {
        return true;
      }
    }
    return isBlank(c) || c == '(' || c == ')';
  }

  void skipBlanks() {
    while (at_ != end_ && isBlank(*at_)) {
      ++at_;
    }
    if constexpr (kDialect == SexprDialect::Commands) {
      while (at_ != end_ && *at_ == ';') {
        while (at_ != end_ && *at_ != '\n') {
          ++at_;
        }
        while (at_ != end_ && isBlank(*at_)) {
          ++at_;
        }
      }
    }
  }

  // A string gives its inside; a quoted expression gives its text (up to the end of its atom or list). What
  // is not terminated reaches to the end.
  bool quoted(std::string_view& value) {
    const char mark = *at_++;
    const char* begin = at_;
    if (mark == '"') {
      while (at_ != end_ && *at_ != '"') {
        at_ += *at_ == '\\' && at_ + 1 != end_ ? 2 : 1;
      }
      value = {begin, static_cast<std::size_t>(at_ - begin)};
      at_ += at_ != end_ ? 1 : 0;
      return true;
    }
    int nested = 0;
    while (at_ != end_ && !(nested == 0 && (isBlank(*at_) || *at_ == ')'))) {
      nested += *at_ == '(' ? 1 : 0;
      nested -= *at_ == ')' ? 1 : 0;
      ++at_;
    }
    value = {begin, static_cast<std::size_t>(at_ - begin)};
    return true;
  }

  // The list as the server prints it, byte for byte: nine of ten numbers are read here, with the cursor in a
  // register. Nothing is consumed if there is any difference.
  template <std::size_t kSize, std::size_t kCount>
  bool exactNumberList(const char (&name)[kSize], std::array<double, kCount>& values) {
    constexpr std::size_t kLength = kSize - 1;  // without the terminating zero
    const char* p = at_;
    if (static_cast<std::size_t>(end_ - p) < kLength + 2 || *p != '(' ||
        std::memcmp(p + 1, name, kLength) != 0) {
      return false;
    }
    p += kLength + 1;
    for (double& value : values) {
      if (*p != ' ' || !twoDecimals(++p, end_, value)) {
        return false;
      }
    }
    if (*p != ')') {
      return false;
    }
    at_ = p + 1;
    return true;
  }

  // The server's numbers, d.dd to dddd.dd and -d.dd to -ddd.dd, eight bytes at a time and without a branch on
  // the number of digits, which no predictor could guess. Same value as below: integer divided by power of
  // ten. If true, `at` has moved to the end of the atom and is still below `end`.
  [[gnu::always_inline]] static bool twoDecimals(const char*& at, const char* end, double& value) {
    if constexpr (std::endian::native != std::endian::little) {
      return false;
    }
    constexpr std::uint64_t kOnes = 0x0101010101010101U;
    constexpr std::uint64_t kMinus = '-' ^ '0';
    constexpr std::uint64_t kPoint = '.' ^ '0';
    std::uint64_t bytes = 0;
    if (end - at <= static_cast<std::ptrdiff_t>(sizeof bytes)) {
      return false;
    }
    std::memcpy(&bytes, at, sizeof bytes);
    bytes ^= kOnes * '0';  // digits become their values
    // The lowest byte that is a point (the borrow of the subtraction reaches only bytes above it).
    const std::uint64_t unlikePoint = bytes ^ (kOnes * kPoint);
    const std::uint64_t points = (unlikePoint - kOnes) & ~unlikePoint & (kOnes * 0x80U);
    const auto place = static_cast<unsigned>(std::countr_zero(points)) / 8;  // 8 if there is none
    const char* behind = at + place + 3;
    const std::uint64_t negative = (bytes & 0xFFU) == kMinus ? 1 : 0;
    if (place - 1 - negative > 3 - negative || !endsAtom(*behind)) {
      return false;
    }
    // Align to 0dddd.dd: what is shifted in are zeros, as digits.
    bytes = (bytes ^ negative * kMinus) << (8 * (5 - place)) ^ kPoint << 40U;
    if (((bytes | (bytes + kOnes * 6U)) & (kOnes * 0xF0U)) != 0) {
      return false;
    }
    // Pairs of digits: 0d, dd, d0 (the point), dd.
    bytes = (bytes * 10 + (bytes >> 8U)) & 0x00FF00FF00FF00FFU;
    const std::uint64_t hundredths = (bytes & 0xFFU) * 100000 + (bytes >> 16U & 0xFFU) * 1000 +
                                     (bytes >> 32U & 0xFFU) * 10 + (bytes >> 48U);
    const double magnitude = static_cast<double>(static_cast<std::int32_t>(hundredths)) / 100.0;
    value = std::bit_cast<double>(std::bit_cast<std::uint64_t>(magnitude) | (negative << 63U));
    at = behind;
    return true;
  }

  // All other numbers; out of line, so that what calls number() stays small.
  [[gnu::noinline]] bool anyNumber(double& value) {
    const char* begin = at_;
    if (shortDecimal(value)) {
      return true;
    }
    std::string_view text;
    if (atom(text)) {
      const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      if (error == std::errc() && rest == text.data() + text.size()) {
        return true;
      }
    }
    at_ = begin;
    return false;
  }

  // [-]digits[.digits] with at most 15 digits and followed by the end of the atom, which is nearly every
  // number on the wire. Mantissa and power of ten are exact in double, so one division gives the correctly
  // rounded value [Clinger 1990, the fast path]: the same bits as std::from_chars, in a fraction of the time.
  bool shortDecimal(double& value) {
    constexpr std::array<double, 16> kPowers = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
    constexpr std::ptrdiff_t kMaxDigits = 15;
    const char* p = at_;
    const bool negative = p != end_ && *p == '-';
    p += negative ? 1 : 0;
    std::uint64_t mantissa = 0;
    const char* first = p;
    while (p != end_ && isDigit(*p)) {
      mantissa = mantissa * 10 + static_cast<std::uint64_t>(*p++ - '0');  // wraps for garbage, refused below
    }
    std::ptrdiff_t digits = p - first;
    std::ptrdiff_t decimals = 0;
    if (p != end_ && *p == '.') {
      const char* point = ++p;
      while (p != end_ && isDigit(*p)) {
        mantissa = mantissa * 10 + static_cast<std::uint64_t>(*p++ - '0');
      }
      decimals = p - point;
      digits += decimals;
    }
    if (digits == 0 || digits > kMaxDigits || (p != end_ && !endsAtom(*p))) {
      return false;
    }
    const double magnitude = static_cast<double>(mantissa) / kPowers[static_cast<std::size_t>(decimals)];
    value = negative ? -magnitude : magnitude;
    at_ = p;
    return true;
  }

  static bool isDigit(char c) { return c >= '0' && c <= '9'; }

  const char* at_;
  const char* end_;
  int depth_ = 0;
};

using SexprReader = BasicSexprReader<SexprDialect::Plain>;
using CommandReader = BasicSexprReader<SexprDialect::Commands>;

}  // namespace nonet::protocol
