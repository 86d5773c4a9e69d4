#include "nonet/lab/match/pair_statistics.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include <boost/math/distributions/students_t.hpp>
#include <fmt/format.h>

namespace nonet::lab {

PairSummary summarizePairs(std::span<const double> values, double resolution) {
  PairSummary summary;
  summary.pairs = static_cast<int>(values.size());
  if (values.empty()) return summary;
  const auto count = static_cast<double>(values.size());
  for (const double value : values) summary.mean += value / count;
  summary.low = summary.high = summary.mean;
  if (values.size() < 2) return summary;
  double squares = 0.0;
  for (const double value : values) squares += (value - summary.mean) * (value - summary.mean);
  squares = std::max(squares, resolution * resolution * (count - 1.0) / count);
  summary.standardError = std::sqrt(squares / (count - 1.0) / count);
  const boost::math::students_t student(count - 1.0);
  const double half = boost::math::quantile(student, 0.975) * summary.standardError;
  summary.low -= half;
  summary.high += half;
  return summary;
}

SequentialBounds parseSequentialBounds(std::string_view text) {
  const auto fail = [&]() -> SequentialBounds {
    throw std::runtime_error(fmt::format(
        "'{}': expected two goal differences per ten minutes, the lower first, such as 0,0.5", text));
  };
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return fail();
  const auto number = [&](std::string_view part, double& value) {
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    return error == std::errc() && end == part.data() + part.size() && std::isfinite(value);
  };
  SequentialBounds bounds;
  if (!number(text.substr(0, comma), bounds.low) || !number(text.substr(comma + 1), bounds.high))
    return fail();
  if (bounds.low >= bounds.high) return fail();
  return bounds;
}

std::string_view verdictName(Verdict verdict) {
  if (verdict == Verdict::Open) return "open";
  return verdict == Verdict::Low ? "low" : "high";
}

SequentialTest::SequentialTest(const SequentialBounds& bounds, double resolution)
    : bounds_(bounds), squares_(resolution * resolution) {}

double SequentialTest::bound() {
  return std::log((1.0 - kError) / kError);
}

Verdict SequentialTest::add(double value) {
  if (verdict_ != Verdict::Open) return verdict_;
  // Welford's update.
  ++pairs_;
  const double before = value - mean_;
  mean_ += before / pairs_;
  squares_ += before * (value - mean_);
  const double count = pairs_;
  const auto spread = [&](double claim) { return squares_ + count * (mean_ - claim) * (mean_ - claim); };
  const bool beyond = mean_ < bounds_.low || mean_ > bounds_.high;
  ratio_ = (count - 1.0) / 2.0 *
           std::log(spread(std::min(mean_, bounds_.low)) / spread(std::max(mean_, bounds_.high)));
  if (beyond) ratio_ = std::copysign(std::max(0.0, std::abs(ratio_) - kPrice), ratio_);
  if (pairs_ < kFewestPairs) return verdict_;
  if (ratio_ >= bound()) verdict_ = Verdict::High;
  if (ratio_ <= -bound()) verdict_ = Verdict::Low;
  return verdict_;
}

}  // namespace nonet::lab
