// Cubic Hermite curves for numbers and vectors, given by place and velocity at their ends [Bartels 1987,
// chapter 3].
#pragma once

#include <array>
#include <cassert>
#include <cstddef>

namespace nonet {

/// One piece. T: double or an Eigen vector (use a fixed-size one; nothing is allocated).
template <class T>
struct HermiteSegment {
  T from;
  T to;
  T fromVelocity;  // per second, as are the derivatives below
  T toVelocity;
  double duration = 1.0;  // s, > 0

  /// `time` in [0, duration]; outside it the cubic goes on.
  T at(double time) const {
    const double s = time / duration;
    const double s2 = s * s;
    const double s3 = s2 * s;
    return T((2.0 * s3 - 3.0 * s2 + 1.0) * from + (3.0 * s2 - 2.0 * s3) * to +
             duration * ((s3 - 2.0 * s2 + s) * fromVelocity + (s3 - s2) * toVelocity));
  }
  T velocityAt(double time) const {
    const double s = time / duration;
    const double s2 = s * s;
    return T((6.0 * s2 - 6.0 * s) / duration * (from - to) + (3.0 * s2 - 4.0 * s + 1.0) * fromVelocity +
             (3.0 * s2 - 2.0 * s) * toVelocity);
  }
  T accelerationAt(double time) const {
    const double s = time / duration;
    return T((12.0 * s - 6.0) / (duration * duration) * (from - to) +
             ((6.0 * s - 4.0) * fromVelocity + (6.0 * s - 2.0) * toVelocity) / duration);
  }
};

/// A chain of pieces through knots in time; place and velocity are continuous (C1). At most Capacity knots.
template <class T, std::size_t Capacity>
class HermiteSpline {
 public:
  struct Knot {
    double time;  // s
    T position;
    T velocity;
  };

  void clear() { size_ = 0; }
  std::size_t size() const { return size_; }

  /// Times must increase. False, and no change, if they do not or the spline is full.
  bool add(double time, const T& position, const T& velocity) {
    if (size_ == Capacity || (size_ > 0 && !(time > knots_[size_ - 1].time))) return false;
    knots_[size_++] = {time, position, velocity};
    return true;
  }

  /// Chooses the velocities of the knots between the ends: the slope of the parabola through a knot and its
  /// neighbours (for equal times those of [Catmull 1974]).
  void smoothInnerKnots() {
    for (std::size_t i = 1; i + 1 < size_; ++i) {
      const double before = knots_[i].time - knots_[i - 1].time;
      const double after = knots_[i + 1].time - knots_[i].time;
      const T slopeBefore = (knots_[i].position - knots_[i - 1].position) / before;
      const T slopeAfter = (knots_[i + 1].position - knots_[i].position) / after;
      knots_[i].velocity = (after * slopeBefore + before * slopeAfter) / (before + after);
    }
  }

  /// Before the first and after the last knot the ends stand still. At least one knot.
  T at(double time) const {
    assert(size_ > 0);
    if (time <= knots_[0].time) return knots_[0].position;
    if (time >= knots_[size_ - 1].time) return knots_[size_ - 1].position;
    const std::size_t i = pieceAt(time);
    return piece(i).at(time - knots_[i].time);
  }
  /// Before the first and after the last knot this is the velocity of that knot, although the place stands
  /// still there.
  T velocityAt(double time) const {
    assert(size_ > 0);
    if (time <= knots_[0].time) return knots_[0].velocity;
    if (time >= knots_[size_ - 1].time) return knots_[size_ - 1].velocity;
    const std::size_t i = pieceAt(time);
    return piece(i).velocityAt(time - knots_[i].time);
  }

 private:
  std::size_t pieceAt(double time) const {
    std::size_t i = 0;
    while (i + 2 < size_ && time >= knots_[i + 1].time) ++i;
    return i;
  }
  HermiteSegment<T> piece(std::size_t i) const {
    return {knots_[i].position, knots_[i + 1].position, knots_[i].velocity, knots_[i + 1].velocity,
            knots_[i + 1].time - knots_[i].time};
  }

  std::array<Knot, Capacity> knots_{};
  std::size_t size_ = 0;
};

}  // namespace nonet
