#include "text_writer.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

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

double roundToSixDigits(double value) {
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
