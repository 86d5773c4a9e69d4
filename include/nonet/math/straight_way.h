// The straight way from one point to another, and where others are beside it.
#pragma once

#include <algorithm>
#include <cmath>

#include "nonet/math/types.h"

namespace nonet {

class StraightWay {
 public:
  StraightWay(const Vector2& from, const Vector2& to) : from_(from), length_((to - from).norm()) {
    if (length_ > 0.0) along_ = (to - from) / length_;
  }

  /// m.
  double length() const { return length_; }

  struct Place {
    double ahead = 0.0;  // m along the way from its beginning, also before it and past its end
    double aside = 0.0;  // m, left positive
  };
  Place placeOf(const Vector2& point) const {
    const Vector2 offset = point - from_;
    return {offset.dot(along_), along_.x() * offset.y() - along_.y() * offset.x()};
  }
  /// The part of the way's length that is passed where a point is nearest, m.
  double nearestTo(const Vector2& point) const { return std::clamp(placeOf(point).ahead, 0.0, length_); }
  /// Between the point and what is nearest to it on the way, m.
  double distanceTo(const Vector2& point) const {
    const Place place = placeOf(point);
    return std::hypot(place.ahead - std::clamp(place.ahead, 0.0, length_), place.aside);
  }

 private:
  Vector2 from_;
  double length_;
  Vector2 along_ = Vector2::UnitX();  // of a way without a length as well
};

}  // namespace nonet
