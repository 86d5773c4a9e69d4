// Means, intervals and quantiles of samples.
#pragma once

#include <cstddef>
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

/// The same of a share, also where all or none hit: from the share to the farther end of the score interval
/// [Wilson 1927]; 0 without trials.
Estimate estimateShare(std::size_t hits, std::size_t trials);

/// The value of the sample whose place is nearest to this share of the way from the smallest to the largest;
/// 0 for an empty one.
double quantile(std::vector<double> sample, double share);

}  // namespace nonet::lab
