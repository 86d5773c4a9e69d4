// The report and the parameter file of nonet kick fit.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "nonet/lab/optimize/kick_fit.h"
#include "nonet/math/angle.h"

namespace nonet::lab {

namespace {

std::string row(const char* what, const std::string& before, const std::string& after, const char* limit) {
  return fmt::format("{:<38} {:>10} {:>10}   {}\n", what, before, after, limit);
}

std::string met(const CurveContact& contact, const std::string& text) {
  return contact.gap > 0.0 ? fmt::format("{:.0f} mm off", 1000.0 * contact.gap) : text;
}

}  // namespace

std::string kickFitTable(const KickFit& fit) {
  const CurveMeasures& a = fit.before;
  const CurveMeasures& b = fit.after;
  const bool meets = b.meetsBall;
  const std::string asked =
      meets ? fmt::format("asked: {:.0f}", toDegrees(fit.direction)) : "the swing after it decides";
  const auto number = [](double value, int digits) { return fmt::format("{:.{}f}", value, digits); };
  const auto direction = [](const CurveMeasures& m) {
    return met(m.contact, fmt::format("{:.1f}", toDegrees(m.contact.direction)));
  };
  const auto speed = [](const CurveMeasures& m) {
    return met(m.contact, fmt::format("{:.2f}", m.contact.speed));
  };
  std::string text = fmt::format("{}, robot type {}\n", fit.kick, fit.robotType);
  text += row("", "before", "after", "limit");
  text += row("fastest joint, of what it can", number(a.worstSpeed(), 2), number(b.worstSpeed(), 2),
              "1: else the curve takes longer");
  text += row("poses of the curve in reach", fmt::format("{:.0f}%", 100.0 * a.reached()),
              fmt::format("{:.0f}%", 100.0 * b.reached()), "100%; more than 90% to begin");
  text += row("farthest off a pose, mm", number(1000.0 * a.worstMiss(), 1), number(1000.0 * b.worstMiss(), 1),
              "0");
  text += row("nearest joint limit, deg", number(toDegrees(a.leastRoom()), 1),
              number(toDegrees(b.leastRoom()), 1), "0");
  text += row("centre of mass inside the foot, mm", number(1000.0 * a.leastBalance(), 1),
              number(1000.0 * b.leastBalance(), 1),
              fmt::format("{:.0f}", 1000.0 * motion::CurveCheck::kInsideFoot).c_str());
  text += row("foot above the ground, mm", number(1000.0 * a.leastHeight(), 1),
              number(1000.0 * b.leastHeight(), 1), "0");
  text += row("foot towards the ball at contact, m/s", speed(a), speed(b),
              meets ? "the more the better" : "the swing after it meets the ball");
  text += row("the ball's direction, deg", direction(a), direction(b), asked.c_str());
  const auto changed =
      std::count_if(fit.parameters.begin(), fit.parameters.end(),
                    [](const FittedParameter& parameter) { return parameter.before != parameter.after; });
  text += fit.kept    ? "kept as it was: within its limits, and none near by is faster\n"
          : fit.holds ? fmt::format("within its limits; {} of {} parameters changed\n", changed,
                                    fit.parameters.size())
                      : std::string("no curve within the limits was found\n");
  return text;
}

std::string kickFitToml(const KickFit& fit) {
  return fmt::format("# Fitted by nonet kick fit {} --type {}\n", fit.kick, fit.robotType) +
         skillOverlay(fit.kick, fit.parameters);
}

std::string skillOverlay(const std::string& skill, const std::vector<FittedParameter>& parameters) {
  std::string text = fmt::format("[motion.skills.{}]\n", skill);
  for (const FittedParameter& parameter : parameters) {
    const std::string_view unit = config::unitName(parameter.unit);
    const std::string number = fmt::format("{}", parameter.after);
    // Without a point TOML would read an integer.
    const bool whole = number.find_first_of(".en") == std::string::npos;
    text += fmt::format("{} = {}{}{}{}\n", parameter.name, number, whole ? ".0" : "",
                        unit.empty() ? "" : "  # ", unit);
  }
  return text;
}

}  // namespace nonet::lab
