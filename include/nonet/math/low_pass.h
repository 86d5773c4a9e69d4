// First-order low-pass filter: the exact solution of y' = (x - y) / timeConstant for an input that is
// constant between samples, so that lost messages (a longer interval) do not change its character.
#pragma once

#include <cmath>

namespace nonet {

/// T: double or a fixed-size Eigen vector.
template <class T>
class LowPass {
 public:
  /// timeConstant in s, > 0: after it a step is followed by 63 %. The cut-off is 1 / (2 pi timeConstant) Hz.
  explicit LowPass(double timeConstant) : timeConstant_(timeConstant) {}

  /// `interval` since the last sample, s. The first sample is taken as it is.
  const T& update(const T& sample, double interval) {
    if (!started_) {
      value_ = sample;
      started_ = true;
    } else {
      value_ += -std::expm1(-interval / timeConstant_) * (sample - value_);
    }
    return value_;
  }
  const T& value() const { return value_; }
  void reset() { started_ = false; }

 private:
  double timeConstant_;
  T value_{};
  bool started_ = false;
};

}  // namespace nonet
