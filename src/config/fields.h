// Shared by the writer (parameters.cpp) and the reader (parameter_files.cpp) of parameters.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "nonet/config/parameters.h"

namespace nonet::config::detail {

/// The present value; booleans as 0 or 1, texts as 0.
double valueOf(const Field& field);

/// Stores a value after checking its range; ParameterError that begins with `where` ("file:line: ").
void assign(const Field& field, double value, const std::string& where);

/// What `text` means for this field: a word of a switch, a number in the declared unit, or one with a unit of
/// its own. Nothing for other texts.
std::optional<double> numberFrom(const Field& field, std::string_view text);

/// Shortest text that reads back to the same bits, as a TOML real.
std::string realText(double value);

/// The value as people write it, without unit.
std::string valueText(const Field& field);

/// "0.03 m".
std::string quantityText(double value, Unit unit);

/// The known key or group that is spelled most like `name`.
std::string nearestName(const std::vector<Field>& fields, std::string_view name);

}  // namespace nonet::config::detail
