#include "nonet/lab/common/statistics.h"

#include <algorithm>
#include <cmath>

#include <boost/math/distributions/students_t.hpp>
#include <fmt/format.h>

namespace nonet::lab {

double mean(const std::vector<double>& sample) {
  double sum = 0.0;
  for (const double value : sample) sum += value;
  return sum / static_cast<double>(sample.size());
}

double standardError(const std::vector<double>& sample) {
  if (sample.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  const double middle = mean(sample);
  double squares = 0.0;
  for (const double value : sample) squares += (value - middle) * (value - middle);
  const auto count = static_cast<double>(sample.size());
  return std::sqrt(squares / (count - 1.0) / count);
}

Estimate estimate(const std::vector<double>& sample) {
  if (sample.empty()) return {};
  if (sample.size() < 2) return {mean(sample), standardError(sample)};
  const boost::math::students_t student(static_cast<double>(sample.size()) - 1.0);
  return {mean(sample), boost::math::quantile(student, 0.975) * standardError(sample)};
}

Estimate estimateShare(std::size_t hits, std::size_t trials) {
  if (trials == 0) return {};
  constexpr double kZ = 1.959964;  // 97.5 % point of the normal distribution
  const auto n = static_cast<double>(trials);
  const double share = static_cast<double>(hits) / n;
  const double scale = 1.0 / (1.0 + kZ * kZ / n);
  const double centre = scale * (share + kZ * kZ / (2.0 * n));
  const double half = scale * kZ * std::sqrt(share * (1.0 - share) / n + kZ * kZ / (4.0 * n * n));
  return {share, half + std::abs(centre - share)};
}

std::string errorText(double error) {
  return std::isnan(error) ? "-" : fmt::format("{:.3f}", error);
}

double quantile(std::vector<double> sample, double share) {
  if (sample.empty()) return 0.0;
  const auto rank = std::lround(share * static_cast<double>(sample.size() - 1));
  const auto place = sample.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(sample.begin(), place, sample.end());
  return *place;
}

}  // namespace nonet::lab
