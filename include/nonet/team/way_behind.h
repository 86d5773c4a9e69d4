// The way around a ball to the place behind it: one law from afar until the robot stands there.
//
// Everything in the ball's frame, m: the origin is the ball, x the way that it should go, so that the place
// behind it is (-behind, 0). Nobody knows here who else is on the field.
#pragma once

#include "nonet/math/pose2.h"

namespace nonet::team {

/// A curve around the ball that the robot stays outside of: `beside` from it, and behind it within the angle
/// `open` in a straight line down to `behind`.
struct BallCurve {
  double behind = 0.18;
  double beside = 0.3;
  double open = 1.2;  // rad, from straight behind the ball

  /// Distance from the ball at this angle from straight behind it, rad.
  double radius(double angle) const;
};

struct WayBehind {
  Vector2 next = Vector2::Zero();  // as far along the shortest way as it is straight
  double length = 0.0;             // m, of the whole way
  bool straight = true;            // nothing is in the way to the place itself
};

/// The shortest way from here to the place behind the ball that stays outside of the curve but for 3 cm, by
/// which it cuts corners, with the ball on the right hand (side 1: over positive y) or on the left (-1). A
/// robot inside of it comes no nearer to the ball, again but for 3 cm. A robot that asks for its way in each
/// cycle cuts a new corner each time, so it may come nearer by more.
WayBehind wayBehind(const Vector2& from, const BallCurve& curve, double side);

}  // namespace nonet::team
