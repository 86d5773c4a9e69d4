#include "text_writer.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>

#include "nonet/protocol/rounding.h"

namespace nonet::protocol {
namespace {

// The longest: a double in fixed notation has up to 309 digits before the point.
using Buffer = std::array<char, 336>;

void appendSpecial(std::string& text, double value) {
  text += std::signbit(value) ? "-" : "";
  text += std::isnan(value) ? "nan" : "inf";
}

}  // namespace

void appendTwoDecimals(std::string& text, double value) {
  constexpr double kLimit = 1e13;  // 100 * value must stay an exact integer
  if (!std::isfinite(value)) {
    appendSpecial(text, value);
    return;
  }
  Buffer buffer;
  if (std::abs(value) >= kLimit) {
    const auto [end, error] =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, 2);
    text.append(buffer.data(), end);
    return;
  }
  auto hundredths = static_cast<std::uint64_t>(std::nearbyint(std::abs(value) * 100.0));
  char* begin = buffer.data() + buffer.size();
  for (int digits = 0; digits < 3 || hundredths != 0; ++digits) {
    if (digits == 2) {
      *--begin = '.';
    }
    *--begin = static_cast<char>('0' + hundredths % 10);
    hundredths /= 10;
  }
  if (std::signbit(value)) {
    *--begin = '-';
  }
  text.append(begin, buffer.data() + buffer.size());
}

void appendSixDigits(std::string& text, double value) {
  if (!std::isfinite(value)) {
    appendSpecial(text, value);
    return;
  }
  Buffer buffer;
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 6);
  text.append(buffer.data(), end);
}

void appendInteger(std::string& text, int value) {
  Buffer buffer;
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  text.append(buffer.data(), end);
}

namespace {

/// The fast way for numbers of usual size, without any text. The scaled number is wrong by 1e-10 at most, so
/// unless it is next to a tie it is rounded to the right side. The quotient of two exact numbers is then
/// rounded as strtod rounds.
std::optional<double> quicklyToSixDigits(double value) {
  constexpr std::array kBounds{1e5, 1e4, 1e3, 1e2, 1e1, 1e0, 1e-1, 1e-2, 1e-3};
  constexpr std::array kPowers{1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8};
  const double size = std::abs(value);
  if (!(size >= kBounds.back() && size < 1e6)) return std::nullopt;
  std::size_t i = 0;
  while (size < kBounds[i]) ++i;
  const double scaled = size * kPowers[i];
  const double nearest = std::nearbyint(scaled);
  constexpr double kNextToTie = 1e-6;
  if (std::abs(std::abs(scaled - nearest) - 0.5) < kNextToTie) return std::nullopt;
  return std::copysign(nearest / kPowers[i], value);
}

}  // namespace

double roundToSixDigits(double value) {
  if (const auto rounded = quicklyToSixDigits(value)) return *rounded;
  if (std::isnan(value)) {
    return std::copysign(std::numeric_limits<double>::quiet_NaN(), value);
  }
  if (std::isinf(value)) {
    return value;
  }
  Buffer buffer;
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 6);
  double rounded = 0.0;
  std::from_chars(buffer.data(), end, rounded);
  return rounded;
}

}  // namespace nonet::protocol
