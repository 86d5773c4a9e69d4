// Means, intervals and quantiles of samples.
#pragma once

#include <vector>

namespace nonet::lab {

double mean(const std::vector<double>& sample);

/// Of the mean; 0 for fewer than two values.
double standardError(const std::vector<double>& sample);

/// Mean and half width of the 95 % confidence interval of the mean (Student's t); 0 for an empty sample.
struct Estimate {
  double mean = 0.0;
  double ci95 = 0.0;
};
Estimate estimate(const std::vector<double>& sample);

/// The value of the sample that this share of it does not exceed (nearest rank); 0 for an empty one.
double quantile(std::vector<double> sample, double share);

}  // namespace nonet::lab
