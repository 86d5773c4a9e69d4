// The server's vision for tests, written after the server facts 2.7 and independent of the code under test:
// offset, view cone, clipping of lines, noise, two printed decimals.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "nonet/math/angle.h"
#include "nonet/math/random.h"
#include "nonet/math/types.h"
#include "nonet/protocol/percept.h"

namespace nonet::world::test {

struct SimulatedField {
  double length = 30.0;
  double width = 20.0;
};

class VisionSimulator {
 public:
  VisionSimulator(std::uint64_t seed, const SimulatedField& field) : random_(seed), field_(field) {
    for (int i = 0; i < 3; ++i) offset[i] = random_.uniform(-0.005, 0.005);
  }

  Vector3 offset = Vector3::Zero();  // camera axes, m
  bool noise = true;

  protocol::Vision see(const Pose3& X_WC) {
    protocol::Vision vision;
    const double x = 0.5 * field_.length;
    const double y = 0.5 * field_.width;
    const std::array<std::pair<protocol::Landmark, Vector3>, 8> landmarks{{
        {protocol::Landmark::G1L, {-x, 1.05, 0.8}},
        {protocol::Landmark::G2L, {-x, -1.05, 0.8}},
        {protocol::Landmark::G2R, {x, -1.05, 0.8}},
        {protocol::Landmark::G1R, {x, 1.05, 0.8}},
        {protocol::Landmark::F1L, {-x, y, 0.0}},
        {protocol::Landmark::F2L, {-x, -y, 0.0}},
        {protocol::Landmark::F1R, {x, y, 0.0}},
        {protocol::Landmark::F2R, {x, -y, 0.0}},
    }};
    for (const auto& [id, p] : landmarks) {
      if (const auto polar = point(X_WC, p)) vision.landmarks.push_back({id, *polar});
    }
    const double f = x - 1.8;
    const std::array<std::array<double, 4>, 11> lines{{{0, -y, 0, y},
                                                       {x, -y, x, y},
                                                       {-x, -y, -x, y},
                                                       {x, y, -x, y},
                                                       {x, -y, -x, -y},
                                                       {f, 3, f, -3},
                                                       {f, 3, x, 3},
                                                       {f, -3, x, -3},
                                                       {-f, 3, -f, -3},
                                                       {-f, 3, -x, 3},
                                                       {-f, -3, -x, -3}}};
    for (const auto& l : lines) line(X_WC, {l[0], l[1], 0.0}, {l[2], l[3], 0.0}, vision);
    for (int k = 0; k < 10; ++k) {
      const double a = k * kPi / 5;
      const double b = (k + 1) * kPi / 5;
      line(X_WC, {2 * std::cos(a), 2 * std::sin(a), 0.0}, {2 * std::cos(b), 2 * std::sin(b), 0.0}, vision);
    }
    return vision;
  }

  std::optional<protocol::Polar> point(const Pose3& X_WC, const Vector3& p_WP) {
    const Vector3 d = X_WC.inverse() * p_WP;
    if (d.norm() <= 0.1) return std::nullopt;
    const Vector3 u = d + offset;
    if (!inView(u)) return std::nullopt;
    return disturbed(u);
  }

 private:
  static double azimuth(const Vector3& u) { return std::atan2(u.y(), u.x()); }
  static double elevation(const Vector3& u) { return std::atan2(u.z(), std::hypot(u.x(), u.y())); }
  static bool inView(const Vector3& u) {
    return u.norm() > 0.1 && std::abs(azimuth(u)) <= kPi / 3 && std::abs(elevation(u)) <= kPi / 3;
  }
  static double print(double value) { return std::round(value * 100.0) / 100.0; }

  protocol::Polar disturbed(const Vector3& u) {
    const double scale = noise ? 1.0 : 0.0;
    const double distance = u.norm() * (1.0 + scale * random_.normal(0.0, 0.000965));
    const double horizontal = toDegrees(azimuth(u)) + scale * random_.normal(0.0, 0.1480);
    const double vertical = toDegrees(elevation(u)) + scale * random_.normal(0.0, 0.1225);
    return {print(distance), toRadians(print(horizontal)), toRadians(print(vertical))};
  }

  void line(const Pose3& X_WC, const Vector3& begin, const Vector3& end, protocol::Vision& vision) {
    Vector3 a = X_WC.inverse() * begin + offset;
    Vector3 b = X_WC.inverse() * end + offset;
    bool seeA = inView(a);
    bool seeB = inView(b);
    if (!seeA || !seeB) {
      constexpr double kNear = 0.1;
      const Vector3 a0 = a;
      const Vector3 b0 = b;
      if (a0.x() < kNear && b0.x() >= kNear) a = a0 + (kNear - a0.x()) / (b0.x() - a0.x()) * (b0 - a0);
      if (b0.x() < kNear && a0.x() >= kNear) b = b0 + (kNear - b0.x()) / (a0.x() - b0.x()) * (a0 - b0);
      if (a.x() <= 0.0 || b.x() <= 0.0) return;
      // Perspective on the plane x = 1; the sides of the square are at +-tan 60.
      const Vector2 pa(a.y() / a.x(), a.z() / a.x());
      const Vector2 pb(b.y() / b.x(), b.z() / b.x());
      const double edge = std::tan(kPi / 3);
      std::array<Vector3, 2> hits;
      int count = 0;
      for (int side = 0; side < 4 && count < 2; ++side) {
        const int axis = side < 2 ? 1 : 0;
        const double level = side == 0 || side == 2 ? edge : -edge;
        const double along = pb[axis] - pa[axis];
        if (along == 0.0) continue;
        const double s = (level - pa[axis]) / along;
        if (s < 0.0 || s > 1.0) continue;
        if (std::abs((pa + s * (pb - pa))[1 - axis]) > edge) continue;
        const double share = s * a.x() / (b.x() + s * (a.x() - b.x()));
        hits[static_cast<std::size_t>(count++)] = a + share * (b - a);
      }
      if (count == 0) return;
      if (count == 2) {
        a = hits[0];
        b = hits[1];
      } else if (!seeA) {
        if (!seeB) return;
        a = hits[0];
      } else {
        b = hits[0];
      }
    }
    vision.lines.push_back({disturbed(a), disturbed(b)});
  }

  Random random_;
  SimulatedField field_;
};

}  // namespace nonet::world::test
