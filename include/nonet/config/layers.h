// Which file says what: the values of parameters with the place that each comes from.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "nonet/config/parameters.h"

namespace nonet::config {

namespace detail {

/// Another value in every field, whatever its range.
inline void disturb(const std::vector<Field>& fields) {
  for (const Field& field : fields) {
    if (field.real != nullptr)
      *field.real = std::nextafter(*field.real, std::numeric_limits<double>::infinity());
    if (field.integer != nullptr) *field.integer ^= 1;
    if (field.boolean != nullptr) *field.boolean = !*field.boolean;
    if (field.text != nullptr) *field.text += '?';
  }
}

}  // namespace detail

/// Parameters that are overlaid step by step, each value with the name of the last step that set it, be it to
/// the value that it had.
template <class Parameters>
class Layers {
 public:
  Layers(const Parameters& parameters, const std::string& origin) : parameters_(parameters) {
    origins_.assign(fieldsOf(parameters_).size(), origin);
  }

  /// `overlay(Parameters&)` sets some values. A field was set if two different values in it have become one.
  template <class Overlay>
  void add(const std::string& origin, const Overlay& overlay) {
    Parameters other = parameters_;
    detail::disturb(fieldsOf(other));
    overlay(parameters_);
    overlay(other);
    const auto fields = fieldsOf(parameters_);
    const auto others = fieldsOf(other);
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (detail::sameValue(fields[i], others[i])) origins_[i] = origin;
    }
  }

  const Parameters& parameters() const { return parameters_; }
  /// In the order of listParameters().
  const std::vector<std::string>& origins() const { return origins_; }

 private:
  Parameters parameters_;
  std::vector<std::string> origins_;
};

}  // namespace nonet::config
