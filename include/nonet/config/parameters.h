// Declared parameters. A group of parameters is a struct. Its static member template `describe` names every
// field once, with key, unit, range, search range and a sentence; the field's initialiser is the default.
// Files in params/ overlay the defaults, first that of the robot type, then further ones. The optimizer moves
// those parameters that declare a search range.
//
//   struct WalkParameters {
//     double stepHeight = 0.03;
//     template <class Self, class Visitor>
//     static void describe(Self& self, Visitor&& visit) {
//       visit({"stepHeight", Unit::Metre, {0.0, 0.2}, search(0.01, 0.1), "Lift of the swing foot"},
//       self.stepHeight);
//     }
//   };
//
// Groups nest: `visit.group("walk", self.walk);` gives keys like "walk.stepHeight" (a TOML table).
// Fields are double, int, bool or std::string. Values in files are SI numbers or texts with a unit: "17deg",
// "97mm", "20ms", "1.5m/s", "30deg/s", "9.81m/s^2", "2N", "350g", "50Hz". Decimal units lose nothing: "97mm"
// is the same double as 0.097. "17deg" is the double toRadians(17).
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace nonet::config {

enum class Unit : std::uint8_t {
  None,
  Metre,
  Radian,
  Degree,  // for the server's own variables; all else counts in radians
  Second,
  MetrePerSecond,
  RadianPerSecond,
  MetrePerSecondSquared,
  Newton,
  Kilogram,
  Hertz,
};
/// "m", "rad", "s", ...; "" for None.
std::string_view unitName(Unit unit);

struct Range {
  double low = 0.0;
  double high = 0.0;
};
inline std::optional<Range> search(double low, double high) {
  return Range{low, high};
}
inline constexpr std::optional<Range> fixed = std::nullopt;

struct Declaration {
  std::string_view key;
  Unit unit = Unit::None;
  Range range;                       // outside it the code breaks
  std::optional<Range> searchRange;  // a search starts within it; absent: no search moves it
  std::string_view text;
};

/// A value of a parameter struct, found by its full key ("walk.stepHeight").
struct ParameterView {
  std::string key;
  Declaration declaration;
  enum class Kind : std::uint8_t { Real, Integer, Boolean, Text } kind = Kind::Real;
  double value = 0.0;  // 0 for texts
  std::string text;    // the value as people write it, without unit
};

/// what() names file and line, and says what to do.
class ParameterError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

namespace detail {

// Type-erased access to one field, so that the file reader needs no template.
struct Field {
  std::string key;
  Declaration declaration;
  double* real = nullptr;
  int* integer = nullptr;
  bool* boolean = nullptr;
  std::string* text = nullptr;
};

class Collector {
 public:
  void operator()(const Declaration& declaration, double& field) { add(declaration).real = &field; }
  void operator()(const Declaration& declaration, int& field) { add(declaration).integer = &field; }
  void operator()(const Declaration& declaration, bool& field) { add(declaration).boolean = &field; }
  void operator()(const Declaration& declaration, std::string& field) { add(declaration).text = &field; }
  template <class Group>
  void group(std::string_view name, Group& group) {
    const std::string outer = prefix_;
    prefix_ += std::string(name) + ".";
    Group::describe(group, *this);
    prefix_ = outer;
  }
  std::vector<Field> fields;

 private:
  Field& add(const Declaration& declaration) {
    fields.push_back({prefix_ + std::string(declaration.key), declaration});
    return fields.back();
  }
  std::string prefix_;
};

/// To the last bit.
bool sameValue(const Field& a, const Field& b);
std::vector<ParameterView> views(const std::vector<Field>& fields);
void overlayFile(const std::vector<Field>& fields, const std::string& path);
void overlayText(const std::vector<Field>& fields, std::string_view toml, const std::string& nameForErrors);
void set(const std::vector<Field>& fields, std::string_view key, double value);
void set(const std::vector<Field>& fields, std::span<const std::string> keys, std::span<const double> values);
void setText(const std::vector<Field>& fields, std::string_view key, std::string_view text);
std::string toToml(const std::vector<Field>& fields, const std::vector<Field>* unlessEqualTo);
std::vector<std::string> declarationFaults(const std::vector<Field>& fields);

}  // namespace detail

template <class Parameters>
std::vector<detail::Field> fieldsOf(Parameters& parameters) {
  detail::Collector collector;
  Parameters::describe(parameters, collector);
  return std::move(collector.fields);
}

/// All parameters with their present values, for listings and for the optimizer.
template <class Parameters>
std::vector<ParameterView> listParameters(Parameters parameters) {
  return detail::views(fieldsOf(parameters));
}

/// Overlays a TOML file. Unknown key, value out of range, wrong unit or type: ParameterError naming file and
/// line, and `parameters` is left unchanged. A [provenance] table is allowed and ignored here.
template <class Parameters>
void overlayFile(Parameters& parameters, const std::string& path) {
  Parameters copy = parameters;
  detail::overlayFile(fieldsOf(copy), path);
  parameters = copy;
}
template <class Parameters>
void overlayText(Parameters& parameters, std::string_view toml, const std::string& nameForErrors) {
  Parameters copy = parameters;
  detail::overlayText(fieldsOf(copy), toml, nameForErrors);
  parameters = copy;
}

/// Sets one value by its full key. Range checked; an int needs a whole number, a bool 0 or 1. Otherwise, and
/// for an unknown key, ParameterError and no change.
template <class Parameters>
void setParameter(Parameters& parameters, std::string_view key, double value) {
  detail::set(fieldsOf(parameters), key, value);
}

/// The same for many at once, key by key; quickest in the order of listParameters().
template <class Parameters>
void setParameters(Parameters& parameters, std::span<const std::string> keys,
                   std::span<const double> values) {
  detail::set(fieldsOf(parameters), keys, values);
}

/// The same with a value as people type it: "0.03", "3cm", "true" (also "on" and "1"), or a text.
template <class Parameters>
void setParameterText(Parameters& parameters, std::string_view key, std::string_view text) {
  detail::setText(fieldsOf(parameters), key, text);
}

/// What is wrong with the declarations themselves, one line each, for tests: a key used twice or not usable
/// in TOML, a default or a search range outside the range, an empty sentence.
template <class Parameters>
std::vector<std::string> declarationFaults(Parameters parameters) {
  return detail::declarationFaults(fieldsOf(parameters));
}

/// TOML of all values, or only of those that differ from `base`, with the sentence of each as a comment.
/// Reading it gives the same bits.
template <class Parameters>
std::string toToml(Parameters parameters) {
  return detail::toToml(fieldsOf(parameters), nullptr);
}
template <class Parameters>
std::string toTomlDifference(Parameters parameters, Parameters base) {
  const auto baseFields = fieldsOf(base);
  return detail::toToml(fieldsOf(parameters), &baseFields);
}

}  // namespace nonet::config
