#include "nonet/lab/optimize/search_space.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace nonet::lab {

SearchSpace::SearchSpace(const agent::AgentParameters& base, const std::vector<std::string>& prefixes)
    : base_(base) {
  const std::vector<config::ParameterView> all = config::listParameters(base);
  for (const std::string& prefix : prefixes) {
    const bool used = std::any_of(all.begin(), all.end(), [&](const config::ParameterView& parameter) {
      return parameter.key.starts_with(prefix) && parameter.declaration.searchRange;
    });
    if (!used)
      throw std::runtime_error(fmt::format(
          "no parameter that the optimizer may move begins with \"{}\"; `nonet optimize --list` shows them",
          prefix));
  }
  for (const config::ParameterView& parameter : all) {
    const auto& declaration = parameter.declaration;
    if (parameter.kind != config::ParameterView::Kind::Real || !declaration.searchRange) continue;
    const bool wanted = std::any_of(prefixes.begin(), prefixes.end(), [&](const std::string& prefix) {
      return parameter.key.starts_with(prefix);
    });
    if (!wanted) continue;
    keys_.push_back(parameter.key);
    dimensions_.push_back({declaration.searchRange->low, declaration.searchRange->high, declaration.range.low,
                           declaration.range.high, parameter.value});
  }
}

Eigen::VectorXd SearchSpace::start() const {
  Eigen::VectorXd point(dimension());
  for (int i = 0; i < dimension(); ++i) {
    const Dimension& d = dimensions_[i];
    point[i] = (d.start - d.searchLow) / (d.searchHigh - d.searchLow);
  }
  return point;
}

Eigen::VectorXd SearchSpace::low() const {
  Eigen::VectorXd point(dimension());
  for (int i = 0; i < dimension(); ++i) {
    const Dimension& d = dimensions_[i];
    point[i] = (d.low - d.searchLow) / (d.searchHigh - d.searchLow);
  }
  return point;
}

Eigen::VectorXd SearchSpace::high() const {
  Eigen::VectorXd point(dimension());
  for (int i = 0; i < dimension(); ++i) {
    const Dimension& d = dimensions_[i];
    point[i] = (d.high - d.searchLow) / (d.searchHigh - d.searchLow);
  }
  return point;
}

double SearchSpace::value(int dimension, double coordinate) const {
  const Dimension& d = dimensions_[dimension];
  // The clamp only undoes rounding at the border of the box.
  return std::clamp(d.searchLow + coordinate * (d.searchHigh - d.searchLow), d.low, d.high);
}

agent::AgentParameters SearchSpace::apply(const Eigen::VectorXd& point) const {
  std::vector<double> values(keys_.size());
  for (int i = 0; i < dimension(); ++i) values[static_cast<std::size_t>(i)] = value(i, point[i]);
  agent::AgentParameters parameters = base_;
  config::setParameters(parameters, keys_, values);
  return parameters;
}

}  // namespace nonet::lab
