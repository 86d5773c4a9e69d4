#include "nonet/motion/walk/parameters.h"

#include <array>
#include <cstddef>

namespace nonet::motion {

namespace {

// Collects the addresses of all fields without allocating: sets are blended in every cycle.
struct Addresses {
  static constexpr std::size_t kMost = 96;
  std::array<const double*, kMost> fields{};
  std::size_t count = 0;
  void operator()(const config::Declaration&, const double& field) { fields.at(count++) = &field; }
  template <class Group>
  void group(std::string_view /*name*/, const Group& group) {
    Group::describe(group, *this);
  }
};

Addresses addressesOf(const WalkParameters& parameters) {
  Addresses addresses;
  WalkParameters::describe(parameters, addresses);
  return addresses;
}

}  // namespace

WalkParameters blend(const WalkParameters& from, const WalkParameters& to, double share) {
  WalkParameters result = from;
  const Addresses begin = addressesOf(from);
  const Addresses end = addressesOf(to);
  const Addresses out = addressesOf(result);
  for (std::size_t i = 0; i < out.count; ++i) {
    // The addressed object is the local, non-const `result`.
    *const_cast<double*>(out.fields[i]) = (1.0 - share) * *begin.fields[i] + share * *end.fields[i];
  }
  return result;
}

}  // namespace nonet::motion
