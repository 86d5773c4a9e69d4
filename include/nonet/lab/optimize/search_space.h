// The declared parameters that the optimizer moves, as a vector: coordinate 0..1 spans a parameter's search
// range, the box is its declared range (outside it the code would break).
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "nonet/agent/parameters.h"

namespace nonet::lab {

class SearchSpace {
 public:
  /// All real parameters with a search range whose key begins with one of `prefixes`. Throws
  /// std::runtime_error if a prefix matches none.
  SearchSpace(const agent::AgentParameters& base, const std::vector<std::string>& prefixes);

  int dimension() const { return static_cast<int>(dimensions_.size()); }
  const std::vector<std::string>& keys() const { return keys_; }
  Eigen::VectorXd start() const;  // of the base parameters
  Eigen::VectorXd low() const;
  Eigen::VectorXd high() const;
  double value(int dimension, double coordinate) const;
  agent::AgentParameters apply(const Eigen::VectorXd& point) const;

 private:
  struct Dimension {
    double searchLow, searchHigh, low, high, start;
  };
  agent::AgentParameters base_;
  std::vector<std::string> keys_;
  std::vector<Dimension> dimensions_;
};

}  // namespace nonet::lab
