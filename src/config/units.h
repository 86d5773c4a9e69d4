// Numbers with units, as people write them in parameter files.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "nonet/config/parameters.h"

namespace nonet::config {

/// "17deg" for an angle -> 0.2967 (SI). Nothing if it is not a number followed by a unit of this kind; blanks
/// between them are allowed.
std::optional<double> parseQuantity(std::string_view text, Unit unit);

/// The units that parseQuantity() takes, for messages: "rad, deg".
std::string acceptedUnits(Unit unit);

}  // namespace nonet::config
