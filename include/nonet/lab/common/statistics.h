// Means, intervals and quantiles of samples.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace nonet::lab {

double mean(const std::vector<double>& sample);

/// Of the mean; NaN for fewer than two values, which do not tell (null in JSON, "-" in tables: errorText()).
double standardError(const std::vector<double>& sample);

/// Mean, 0 for an empty sample, and half width of the 95 % confidence interval of the mean (Student's t), NaN
/// for fewer than two values.
struct Estimate {
  double mean = 0.0;
  double ci95 = std::numeric_limits<double>::quiet_NaN();
};
Estimate estimate(const std::vector<double>& sample);

/// The same of a share, also where all or none hit: from the share to the farther end of the score interval
/// [Wilson 1927]; 0 and NaN without trials.
Estimate estimateShare(std::size_t hits, std::size_t trials);

/// A standard error or a half width with three digits; "-" for NaN.
std::string errorText(double error);

/// The value of the sample whose place is nearest to this share of the way from the smallest to the largest;
/// 0 for an empty one.
double quantile(std::vector<double> sample, double share);

}  // namespace nonet::lab
