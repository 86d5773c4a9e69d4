// Single parameters as people set them on a command line: "walk.stepHeight=3cm", "team.ball.kick=false".
#pragma once

#include <string_view>
#include <vector>

#include "nonet/config/parameters.h"

namespace nonet::config {

namespace detail {
void assignText(const std::vector<Field>& fields, std::string_view assignment);
}

/// Without the blanks and tabs around it.
inline std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// A switch takes true, false, on, off, 1 or 0; other values are numbers in SI units, or carry a unit, or are
/// texts. ParameterError begins with the text.
template <class Parameters>
void assignParameter(Parameters& parameters, std::string_view assignment) {
  detail::assignText(fieldsOf(parameters), assignment);
}

}  // namespace nonet::config
