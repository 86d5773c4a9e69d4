#include "nonet/config/assignment.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "fields.h"
#include "units.h"

namespace nonet::config::detail {

namespace {

std::string wantedForm(const Field& field) {
  if (field.boolean != nullptr) return "use true or false";
  const Unit unit = field.declaration.unit;
  if (unit == Unit::None) return "use a number";
  return fmt::format("use a number in {}, or one with a unit: {}", unitName(unit), acceptedUnits(unit));
}

}  // namespace

void assignText(const std::vector<Field>& fields, std::string_view assignment) {
  const std::size_t sign = assignment.find('=');
  const std::string where = fmt::format("{}: ", assignment);
  if (sign == std::string_view::npos) throw ParameterError(where + "give it as name=value");
  const std::string_view key = assignment.substr(0, sign);
  const std::string_view text = assignment.substr(sign + 1);
  const auto field =
      std::find_if(fields.begin(), fields.end(), [key](const Field& f) { return f.key == key; });
  if (field == fields.end()) {
    throw ParameterError(
        fmt::format("{}unknown parameter '{}': did you mean '{}'?", where, key, nearestName(fields, key)));
  }
  if (field->text != nullptr) {
    *field->text = text;
    return;
  }
  const std::optional<double> value = numberFrom(*field, text);
  if (!value) throw ParameterError(where + wantedForm(*field));
  assign(*field, *value, where);
}

}  // namespace nonet::config::detail
