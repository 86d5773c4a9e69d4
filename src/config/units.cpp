#include "units.h"

#include <array>
#include <charconv>
#include <span>

#include "nonet/math/angle.h"

namespace nonet::config {

namespace {

// SI value = number / divisor. Dividing by 1000 gives the nearest double; a product with 0.001 may miss it,
// since 0.001 is rounded itself.
struct Spelling {
  std::string_view text;
  double divisor;
  bool degrees = false;
};

constexpr std::array<Spelling, 1> kPlain{{{"", 1.0}}};
constexpr std::array<Spelling, 3> kLengths{{{"m", 1.0}, {"cm", 100.0}, {"mm", 1000.0}}};
constexpr std::array<Spelling, 2> kAngles{{{"rad", 1.0}, {"deg", 1.0, true}}};
constexpr std::array<Spelling, 1> kDegrees{{{"deg", 1.0}}};
constexpr std::array<Spelling, 2> kTimes{{{"s", 1.0}, {"ms", 1000.0}}};
constexpr std::array<Spelling, 3> kSpeeds{{{"m/s", 1.0}, {"cm/s", 100.0}, {"mm/s", 1000.0}}};
constexpr std::array<Spelling, 2> kAngularSpeeds{{{"rad/s", 1.0}, {"deg/s", 1.0, true}}};
constexpr std::array<Spelling, 2> kAccelerations{{{"m/s^2", 1.0}, {"m/s2", 1.0}}};
constexpr std::array<Spelling, 1> kForces{{{"N", 1.0}}};
constexpr std::array<Spelling, 2> kMasses{{{"kg", 1.0}, {"g", 1000.0}}};
constexpr std::array<Spelling, 1> kFrequencies{{{"Hz", 1.0}}};

std::span<const Spelling> spellings(Unit unit) {
  switch (unit) {
    case Unit::None:
      return kPlain;
    case Unit::Metre:
      return kLengths;
    case Unit::Radian:
      return kAngles;
    case Unit::Degree:
      return kDegrees;
    case Unit::Second:
      return kTimes;
    case Unit::MetrePerSecond:
      return kSpeeds;
    case Unit::RadianPerSecond:
      return kAngularSpeeds;
    case Unit::MetrePerSecondSquared:
      return kAccelerations;
    case Unit::Newton:
      return kForces;
    case Unit::Kilogram:
      return kMasses;
    case Unit::Hertz:
      return kFrequencies;
  }
  return {};
}

}  // namespace

std::string_view unitName(Unit unit) {
  const auto all = spellings(unit);
  return all.empty() ? std::string_view() : all.front().text;
}

std::optional<double> parseQuantity(std::string_view text, Unit unit) {
  const char* end = text.data() + text.size();
  // from_chars knows no plus sign.
  const char* begin = text.data() + (text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0);
  double number = 0.0;
  const auto [rest, error] = std::from_chars(begin, end, number);
  if (error != std::errc()) return std::nullopt;
  std::string_view name(rest, static_cast<std::size_t>(end - rest));
  while (!name.empty() && name.front() == ' ') name.remove_prefix(1);
  for (const Spelling& spelling : spellings(unit)) {
    if (spelling.text == name) return spelling.degrees ? toRadians(number) : number / spelling.divisor;
  }
  return std::nullopt;
}

std::string acceptedUnits(Unit unit) {
  std::string list;
  for (const Spelling& spelling : spellings(unit)) {
    if (!list.empty()) list += ", ";
    list += spelling.text;
  }
  return list;
}

}  // namespace nonet::config
