// The error of a replayed recording over time, as a picture.
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "nonet/sim/fidelity/fidelity.h"

namespace nonet::sim {

namespace {

constexpr double kWidth = 720.0;
constexpr double kHeight = 320.0;
constexpr double kLeft = 80.0;
constexpr double kTop = 50.0;
constexpr double kRight = kLeft + kWidth;
constexpr double kBottom = kTop + kHeight;
constexpr double kLowest = 1e-7;  // m, the recordings' last digit is 1e-6
constexpr double kDecades = 8.0;

double heightOf(double error) {
  const double decade = std::log10(std::max(error, kLowest) / kLowest);
  return kTop + kHeight * (1.0 - std::min(decade, kDecades) / kDecades);
}

/// From a time in seconds, where the recording lasts that long.
double placeOf(double time, double duration) {
  return kLeft + kWidth * time / duration;
}

std::string grid(double duration) {
  std::string svg;
  for (double level = 1e-7; level < 11.0; level *= 10.0) {
    svg += fmt::format(
        "<line x1='{0}' x2='{1}' y1='{2:.1f}' y2='{2:.1f}' stroke='#ddd'/><text x='{3}' y='{4:.1f}' "
        "text-anchor='end'>{5:.0e}</text>\n",
        kLeft, kRight, heightOf(level), kLeft - 6, heightOf(level) + 4, level);
  }
  const int seconds = static_cast<int>(duration);
  const int step = std::max(1, (seconds + 11) / 12);
  for (int second = 0; second <= seconds; second += step) {
    svg += fmt::format(
        "<line x1='{0:.1f}' x2='{0:.1f}' y1='{1}' y2='{2}' stroke='#666'/><text x='{0:.1f}' y='{3}' "
        "text-anchor='middle'>{4}</text>\n",
        placeOf(second, duration), kBottom, kBottom + 5, kBottom + 19, second);
  }
  return svg + fmt::format(
                   "<rect x='{0}' y='{1}' width='{2}' height='{3}' fill='none' stroke='#999'/>"
                   "<text x='{4}' y='{5}' text-anchor='middle'>time, s</text>"
                   "<text x='18' y='{6}' text-anchor='middle' transform='rotate(-90 18 {6})'>position error, "
                   "m</text>\n",
                   kLeft, kTop, kWidth, kHeight, kLeft + kWidth / 2, kBottom + 38, kTop + kHeight / 2);
}

/// With the time at which each was first passed.
std::string limits(const FidelityResult& result, double duration) {
  constexpr std::array<const char*, kFidelityLimits.size()> kNames = {"0.1 mm", "1 mm", "1 cm"};
  std::string svg;
  for (std::size_t i = 0; i < kFidelityLimits.size(); ++i) {
    const double y = heightOf(kFidelityLimits[i]);
    svg += fmt::format(
        "<line x1='{0}' x2='{1}' y1='{2:.1f}' y2='{2:.1f}' stroke='#c33' stroke-dasharray='4 3'/>"
        "<text x='{3}' y='{4:.1f}' fill='#c33'>{5}</text>\n",
        kLeft, kRight, y, kRight + 6, y + 4, kNames[i]);
    if (!result.firstOver[i]) continue;
    const double x = placeOf(*result.firstOver[i], duration);
    svg += fmt::format(
        "<circle cx='{0:.1f}' cy='{1:.1f}' r='4' fill='none' stroke='#c33'/><text x='{2:.1f}' y='{3:.1f}' "
        "fill='#c33'>{4:.2f} s</text>\n",
        x, y, x + 7, y - 5, *result.firstOver[i]);
  }
  return svg;
}

std::string curve(const FidelityResult& result, double duration, double CycleError::*member,
                  std::string_view colour) {
  std::string svg = fmt::format("<polyline fill='none' stroke='{}' points='", colour);
  for (std::size_t k = 0; k < result.cycles.size(); ++k) {
    svg += fmt::format("{:.1f},{:.1f} ", placeOf(static_cast<double>(k) * kCycleTime, duration),
                       heightOf(result.cycles[k].*member));
  }
  return svg + "'/>\n";
}

}  // namespace

std::string drawFidelity(const FidelityResult& result) {
  const double cycles = static_cast<double>(std::max<std::size_t>(result.cycles.size(), 2) - 1);
  const double duration = cycles * kCycleTime;
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{:.0f}' height='{:.0f}' font-family='sans-serif' "
      "font-size='12'>\n<rect width='100%' height='100%' fill='white'/>\n"
      "<text x='{}' y='20' font-size='14' font-weight='bold'>{}: distance of the simulation from the "
      "recorded server{}</text>\n",
      kRight + 90, kBottom + 60, kLeft, result.scenario,
      result.knownHistory ? "" : " (start taken from the recording)");
  svg += fmt::format(
      "<g class='legend'><text x='{}' y='42' fill='#d60'>ball</text><text x='{}' y='42' fill='#26c'>the body "
      "of a robot that is farthest off</text><text x='{}' y='42' fill='#c33'>dashed: the limits of `nonet "
      "fidelity`; circles: first passed</text></g>\n",
      kLeft, kLeft + 50, kLeft + 290);
  svg += grid(duration) + limits(result, duration);
  svg += curve(result, duration, &CycleError::ball, "#d60");
  svg += curve(result, duration, &CycleError::bodies, "#26c");
  return svg + "</svg>\n";
}

}  // namespace nonet::sim
