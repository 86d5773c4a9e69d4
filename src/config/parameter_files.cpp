// Reads parameters from TOML.
#include <stdexcept>
#include <string>

#include "nonet/config/parameters.h"
#include "nonet/config/toml.h"

#include "fields.h"
#include "units.h"

namespace nonet::config::detail {

namespace {

std::string kindOf(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "a text";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a real number";
    case toml::node_type::boolean:
      return "a switch";
    default:
      return "a date or time";
  }
}

class Reader {
 public:
  Reader(const std::vector<Field>& fields, const std::string& name) : fields_(fields), name_(name) {}

  void read(const toml::table& table, const std::string& prefix) const {
    for (const auto& [key, node] : table) {
      const std::string full = prefix + std::string(key.str());
      if (full == "provenance" && node.is_table()) continue;
      // The line of the key, since a table that comes from a dotted key has no line of its own.
      const std::string where = at(key.source().begin.line);
      if (const Field* field = find(full)) {
        readValue(*field, node, where);
      } else if (isGroup(full)) {
        if (!node.is_table()) {
          throw ParameterError(
              fmt::format("{}'{}' is a group of parameters, not {}: write [{}] and its keys below", where,
                          full, kindOf(node), full));
        }
        read(*node.as_table(), full + ".");
      } else {
        throw ParameterError(fmt::format("{}unknown {} '{}': did you mean '{}'?", where,
                                         node.is_table() ? "table" : "key", full,
                                         nearestName(fields_, full)));
      }
    }
  }

  std::string at(toml::source_index line) const { return fmt::format("{}:{}: ", name_, line); }

 private:
  const Field* find(const std::string& key) const {
    for (const Field& field : fields_) {
      if (field.key == key) return &field;
    }
    return nullptr;
  }

  bool isGroup(const std::string& name) const {
    for (const Field& field : fields_) {
      if (field.key.rfind(name + ".", 0) == 0) return true;
    }
    return false;
  }

  static void readValue(const Field& field, const toml::node& node, const std::string& where) {
    const Unit unit = field.declaration.unit;
    if (field.text != nullptr) {
      if (!node.is_string()) throw wrongType(field, node, where, "a text in quotes");
      *field.text = node.as_string()->get();
      return;
    }
    if (field.boolean != nullptr) {
      if (!node.is_boolean()) throw wrongType(field, node, where, "true or false");
      return assign(field, node.as_boolean()->get() ? 1.0 : 0.0, where);
    }
    if (node.is_integer()) return assign(field, static_cast<double>(node.as_integer()->get()), where);
    if (node.is_floating_point() && field.integer == nullptr) {
      return assign(field, node.as_floating_point()->get(), where);
    }
    if (node.is_string() && field.integer == nullptr && unit != Unit::None) {
      const std::string& text = node.as_string()->get();
      if (const auto value = parseQuantity(text, unit)) return assign(field, *value, where);
      throw ParameterError(
          fmt::format("{}{} = \"{}\" has no unit that fits: use a number in {}, or a text with one of "
                      "{}, as \"{}{}\"",
                      where, field.key, text, unitName(unit), acceptedUnits(unit),
                      field.declaration.range.high, unitName(unit)));
    }
    std::string wanted = field.integer != nullptr ? "a whole number" : "a number";
    if (field.integer == nullptr && unit != Unit::None)
      wanted += fmt::format(" in {}, or a text with unit", unitName(unit));
    throw wrongType(field, node, where, wanted);
  }

  static ParameterError wrongType(const Field& field, const toml::node& node, const std::string& where,
                                  const std::string& wanted) {
    return ParameterError(fmt::format("{}{} is {}: use {}", where, field.key, kindOf(node), wanted));
  }

  const std::vector<Field>& fields_;
  const std::string& name_;
};

}  // namespace

void overlayText(const std::vector<Field>& fields, std::string_view toml, const std::string& nameForErrors) {
  const Reader reader(fields, nameForErrors);
  toml::table table;
  try {
    table = parseToml(toml);
  } catch (const TomlError& error) {
    throw ParameterError(fmt::format("{}not TOML: {}", reader.at(error.line()), error.what()));
  }
  reader.read(table, "");
}

void overlayFile(const std::vector<Field>& fields, const std::string& path) {
  std::string text;
  try {
    text = readText(path, "parameter file");
  } catch (const std::runtime_error& error) {
    throw ParameterError(error.what());
  }
  overlayText(fields, text, path);
}

}  // namespace nonet::config::detail
