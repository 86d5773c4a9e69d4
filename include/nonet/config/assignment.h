// Single parameters as people set them on a command line: "walk.stepHeight=3cm", "team.ball.kick=false".
#pragma once

#include <string_view>
#include <vector>

#include "nonet/config/parameters.h"

namespace nonet::config {

namespace detail {
void assignText(const std::vector<Field>& fields, std::string_view assignment);
}

/// A switch takes true, false, 1 or 0; other values are numbers in SI units, or carry a unit. ParameterError
/// begins with the text.
template <class Parameters>
void assignParameter(Parameters& parameters, std::string_view assignment) {
  detail::assignText(fieldsOf(parameters), assignment);
}

}  // namespace nonet::config
