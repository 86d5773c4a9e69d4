#include "nonet/lab/common/statistics.h"

#include <algorithm>
#include <cmath>

#include <boost/math/distributions/students_t.hpp>

namespace nonet::lab {

double mean(const std::vector<double>& sample) {
  double sum = 0.0;
  for (const double value : sample) sum += value;
  return sum / static_cast<double>(sample.size());
}

double standardError(const std::vector<double>& sample) {
  if (sample.size() < 2) return 0.0;
  const double middle = mean(sample);
  double squares = 0.0;
  for (const double value : sample) squares += (value - middle) * (value - middle);
  const auto count = static_cast<double>(sample.size());
  return std::sqrt(squares / (count - 1.0) / count);
}

Estimate estimate(const std::vector<double>& sample) {
  if (sample.empty()) return {};
  if (sample.size() < 2) return {mean(sample), 0.0};
  const boost::math::students_t student(static_cast<double>(sample.size()) - 1.0);
  return {mean(sample), boost::math::quantile(student, 0.975) * standardError(sample)};
}

double quantile(std::vector<double> sample, double share) {
  if (sample.empty()) return 0.0;
  const auto rank = std::lround(share * static_cast<double>(sample.size() - 1));
  const auto place = sample.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(sample.begin(), place, sample.end());
  return *place;
}

}  // namespace nonet::lab
