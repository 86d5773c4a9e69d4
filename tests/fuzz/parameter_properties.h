// What must hold for any text that is read as a parameter file. Returns what is wrong, or nothing.
#pragma once

#include <cmath>
#include <string>

#include "nonet/config/assignment.h"
#include "nonet/config/parameters.h"
#include "nonet/motion/parameters.h"
#include "nonet/world/parameters.h"

namespace nonet::fuzz {

/// Of every kind of field some: the whole set makes a fuzzer slow.
struct FuzzedParameters {
  world::WorldParameters world;
  motion::ControlParameters control;
  motion::KickParameters kick;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit.group("world", self.world);
    visit.group("motion.control", self.control);
    visit.group("motion.kick", self.kick);
  }
};

inline std::string checkRanges(const FuzzedParameters& parameters) {
  for (const config::ParameterView& view : config::listParameters(parameters)) {
    if (view.kind == config::ParameterView::Kind::Text) continue;
    const config::Range& range = view.declaration.range;
    if (!(view.value >= range.low && view.value <= range.high)) return view.key + " is out of range";
  }
  return {};
}

/// What was accepted is within its range, and comes back to the last bit from what we write ourselves.
inline std::string checkRoundTrip(const FuzzedParameters& parameters) {
  const std::string problem = checkRanges(parameters);
  if (!problem.empty()) return problem;
  const std::string written = config::toTomlDifference(parameters, FuzzedParameters{});
  FuzzedParameters again;
  config::overlayText(again, written, "again");
  return config::toTomlDifference(again, FuzzedParameters{}) == written ? "" : "written and read it differs";
}

/// The first line is also tried as `name=value`, as on a command line.
inline std::string checkParameterText(std::string_view text) {
  FuzzedParameters parameters;
  try {
    config::assignParameter(parameters, text.substr(0, text.find('\n')));
    const std::string problem = checkRoundTrip(parameters);
    if (!problem.empty()) return problem;
  } catch (const config::ParameterError&) {
  }
  static const std::string kName = "fuzz.toml";
  try {
    config::overlayText(parameters, text, kName);
  } catch (const config::ParameterError& error) {
    return std::string_view(error.what()).starts_with(kName + ":") ? ""
                                                                   : std::string("no place: ") + error.what();
  }
  return checkRoundTrip(parameters);
}

}  // namespace nonet::fuzz
