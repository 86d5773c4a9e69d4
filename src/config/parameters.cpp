#include "nonet/config/parameters.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cctype>
#include <cmath>
#include <limits>
#include <set>

#include "nonet/config/nearest.h"

#include "fields.h"
#include "units.h"

namespace nonet::config::detail {

namespace {

std::string_view groupOf(std::string_view key) {
  const auto dot = key.rfind('.');
  return dot == std::string_view::npos ? std::string_view() : key.substr(0, dot);
}

std::string_view lastPart(std::string_view key) {
  const auto dot = key.rfind('.');
  return dot == std::string_view::npos ? key : key.substr(dot + 1);
}

bool isBareKey(std::string_view key) {
  return !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

std::string quoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20) {
      quoted += fmt::format("\\u{:04x}", c);
      continue;
    }
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

std::string tomlValue(const Field& field) {
  if (field.text != nullptr) return quoted(*field.text);
  return field.real != nullptr ? realText(*field.real) : valueText(field);
}

void appendField(const Field& field, std::string& toml) {
  const Declaration& declaration = field.declaration;
  if (!declaration.text.empty()) {
    toml += fmt::format("# {}", declaration.text);
    if (field.boolean == nullptr && field.text == nullptr) {
      toml += fmt::format(" ({} .. {})", quantityText(declaration.range.low, declaration.unit),
                          quantityText(declaration.range.high, declaration.unit));
    }
    toml += '\n';
  }
  toml += fmt::format("{} = {}\n", lastPart(field.key), tomlValue(field));
}

std::string notANumber(const Field& field, std::string_view text) {
  const Unit unit = field.declaration.unit;
  const std::string units =
      unit == Unit::None ? ""
                         : fmt::format(" in {}, or one with a unit: {}", unitName(unit), acceptedUnits(unit));
  return fmt::format("{} = '{}' is not a number: use one{}", field.key, text, units);
}

const Field& fieldNamed(const std::vector<Field>& fields, std::string_view key) {
  for (const Field& field : fields) {
    if (field.key == key) return field;
  }
  throw ParameterError(
      fmt::format("unknown parameter '{}': did you mean '{}'?", key, nearestName(fields, key)));
}

}  // namespace

double valueOf(const Field& field) {
  if (field.boolean != nullptr) return *field.boolean ? 1.0 : 0.0;
  if (field.integer != nullptr) return *field.integer;
  return field.real != nullptr ? *field.real : 0.0;
}

bool sameValue(const Field& a, const Field& b) {
  if (a.text != nullptr) return *a.text == *b.text;
  return std::bit_cast<std::uint64_t>(valueOf(a)) == std::bit_cast<std::uint64_t>(valueOf(b));
}

std::optional<double> numberFrom(const Field& field, std::string_view text) {
  if (field.boolean != nullptr) {
    if (text == "true" || text == "on") return 1.0;
    if (text == "false" || text == "off") return 0.0;
  }
  if (const auto plain = parseQuantity(text, Unit::None)) return plain;
  return parseQuantity(text, field.declaration.unit);
}

std::string valueText(const Field& field) {
  if (field.text != nullptr) return *field.text;
  if (field.boolean != nullptr) return *field.boolean ? "true" : "false";
  return fmt::format("{}", valueOf(field));
}

std::string realText(double value) {
  std::string text = fmt::format("{}", value);
  // TOML tells real numbers from whole ones by the point or the exponent.
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string quantityText(double value, Unit unit) {
  std::string text = fmt::format("{}", value);
  if (unit != Unit::None) text += fmt::format(" {}", unitName(unit));
  return text;
}

std::string nearestName(const std::vector<Field>& fields, std::string_view name) {
  std::set<std::string> names;
  for (const Field& field : fields) {
    names.insert(field.key);
    for (std::string_view group = groupOf(field.key); !group.empty(); group = groupOf(group)) {
      names.insert(std::string(group));
    }
  }
  std::string best;
  std::size_t bestDistance = std::numeric_limits<std::size_t>::max();
  for (const std::string& candidate : names) {
    // Who left the group out meant a key with the same last part.
    const std::size_t distance =
        std::min(editDistance(name, candidate), editDistance(lastPart(name), lastPart(candidate)) + 1);
    if (distance < bestDistance) {
      bestDistance = distance;
      best = candidate;
    }
  }
  return best;
}

void assign(const Field& field, double value, const std::string& where) {
  const Declaration& declaration = field.declaration;
  if (field.boolean != nullptr) {
    if (value != 0.0 && value != 1.0) {
      throw ParameterError(fmt::format("{}{} is a switch: use true or false", where, field.key));
    }
    *field.boolean = value != 0.0;
    return;
  }
  if (field.text != nullptr) {
    throw ParameterError(fmt::format("{}{} is a text, not {}", where, field.key, value));
  }
  // Written so that "not a number" is outside too.
  if (!(value >= declaration.range.low && value <= declaration.range.high)) {
    throw ParameterError(fmt::format(
        "{}{} = {} is out of range: use {} .. {} ({})", where, field.key,
        quantityText(value, declaration.unit), quantityText(declaration.range.low, declaration.unit),
        quantityText(declaration.range.high, declaration.unit), declaration.text));
  }
  if (field.integer != nullptr) {
    if (value != std::floor(value)) {
      throw ParameterError(fmt::format("{}{} = {} must be a whole number", where, field.key, value));
    }
    *field.integer = static_cast<int>(value);
    return;
  }
  *field.real = value;
}

std::vector<ParameterView> views(const std::vector<Field>& fields) {
  std::vector<ParameterView> list;
  list.reserve(fields.size());
  for (const Field& field : fields) {
    ParameterView view;
    view.key = field.key;
    view.declaration = field.declaration;
    if (field.integer != nullptr) view.kind = ParameterView::Kind::Integer;
    if (field.boolean != nullptr) view.kind = ParameterView::Kind::Boolean;
    if (field.text != nullptr) view.kind = ParameterView::Kind::Text;
    view.value = valueOf(field);
    view.text = valueText(field);
    list.push_back(std::move(view));
  }
  return list;
}

void set(const std::vector<Field>& fields, std::string_view key, double value) {
  assign(fieldNamed(fields, key), value, "");
}

void set(const std::vector<Field>& fields, std::span<const std::string> keys,
         std::span<const double> values) {
  assert(keys.size() == values.size());
  std::size_t next = 0;  // keys in the order of the fields are found at once
  for (std::size_t i = 0; i < keys.size(); ++i) {
    while (next < fields.size() && fields[next].key != keys[i]) ++next;
    const Field& field = next < fields.size() ? fields[next] : fieldNamed(fields, keys[i]);
    assign(field, values[i], "");
    next = static_cast<std::size_t>(&field - fields.data()) + 1;
  }
}

void setText(const std::vector<Field>& fields, std::string_view key, std::string_view text) {
  const Field& field = fieldNamed(fields, key);
  if (field.text != nullptr) {
    *field.text = text;
    return;
  }
  const std::optional<double> value = numberFrom(field, text);
  if (field.boolean != nullptr && value != 0.0 && value != 1.0)
    throw ParameterError(fmt::format("{} = '{}' is neither true nor false", key, text));
  if (!value) throw ParameterError(notANumber(field, text));
  assign(field, *value, "");
}

std::string toToml(const std::vector<Field>& fields, const std::vector<Field>* unlessEqualTo) {
  assert(unlessEqualTo == nullptr || unlessEqualTo->size() == fields.size());
  // TOML wants each table once and plain keys first, whatever the order of the declarations.
  std::vector<std::string> groups{""};
  for (const Field& field : fields) {
    const std::string group(groupOf(field.key));
    if (std::find(groups.begin(), groups.end(), group) == groups.end()) groups.push_back(group);
  }
  std::string toml;
  for (const std::string& group : groups) {
    std::string body;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (groupOf(fields[i].key) != group) continue;
      if (unlessEqualTo != nullptr && sameValue(fields[i], (*unlessEqualTo)[i])) continue;
      appendField(fields[i], body);
    }
    if (body.empty()) continue;
    if (!toml.empty()) toml += '\n';
    if (!group.empty()) toml += fmt::format("[{}]\n", group);
    toml += body;
  }
  return toml;
}

std::vector<std::string> declarationFaults(const std::vector<Field>& fields) {
  std::vector<std::string> faults;
  const auto fault = [&](const Field& field, std::string_view what) {
    faults.push_back(fmt::format("{}: {}", field.key, what));
  };
  std::set<std::string> keys;
  std::set<std::string> groups;
  for (const Field& field : fields) groups.insert(std::string(groupOf(field.key)));
  for (const Field& field : fields) {
    const Range& range = field.declaration.range;
    if (!keys.insert(field.key).second) fault(field, "declared twice");
    if (groups.count(field.key) != 0) fault(field, "is the name of a group too");
    if (field.key.rfind("provenance", 0) == 0)
      fault(field, "the name is kept for the origin of learned values");
    if (!isBareKey(lastPart(field.key))) fault(field, "the key needs letters, digits, '_' or '-' only");
    const std::string_view text = field.declaration.text;
    if (text.empty()) fault(field, "has no sentence");
    if (!text.empty() && std::islower(static_cast<unsigned char>(text.front())))
      fault(field, "the sentence goes on where another one ended");
    if (field.boolean != nullptr || field.text != nullptr) continue;
    if (!(range.low <= range.high)) fault(field, "the range is empty");
    const double value = valueOf(field);
    if (!(value >= range.low && value <= range.high)) fault(field, "the default is out of range");
    if (const auto& wanted = field.declaration.searchRange) {
      if (!(wanted->low < wanted->high)) fault(field, "the search range is empty");
      if (wanted->low < range.low || wanted->high > range.high)
        fault(field, "the search range leaves the range");
    }
  }
  return faults;
}

}  // namespace nonet::config::detail
