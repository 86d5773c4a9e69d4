#include "nonet/sim/sensors/vision.h"

#include <cmath>
#include <limits>

#include "nonet/protocol/rounding.h"

#include "sim/physics/scene.h"

namespace nonet::sim {

namespace {

constexpr float kNearest = 0.1F;      // m; what is nearer is not seen
constexpr float kHalfCone = 60.0F;    // degrees
constexpr float kFocalLength = 0.1F;  // m; distance of the plane in which lines are clipped

using Vector2f = Eigen::Vector2f;

double normalizedDegrees(double angle) {
  while (angle > 180.0) angle -= 360.0;
  while (angle < -180.0) angle += 360.0;
  return angle;
}

/// Direction of a point in head axes: azimuth 0 along y, positive to the left (server facts 2.7, step 3).
SeenPoint polar(const Vector3f& u) {
  constexpr double kDegrees = 180.0 / M_PI;
  SeenPoint point;
  point.distance = scene::length(u);
  point.azimuth =
      static_cast<float>(normalizedDegrees(static_cast<double>(std::atan2(u.y(), u.x())) * kDegrees - 90.0));
  float square = u.x() * u.x();
  square += u.y() * u.y();
  point.elevation = static_cast<float>(static_cast<double>(std::atan2(u.z(), std::sqrt(square))) * kDegrees);
  return point;
}

bool inCone(const SeenPoint& point) {
  return std::abs(point.azimuth) <= kHalfCone && std::abs(point.elevation) <= kHalfCone;
}

/// A straight line a y + b x + c = 0 through two points, and the box around them.
struct Segment {
  float a = 0.0F;
  float b = 0.0F;
  float c = 0.0F;
  Vector2f from;
  Vector2f to;

  Segment(const Vector2f& p, const Vector2f& q) : from(p), to(q) {
    const float run = q.x() - p.x();
    if (std::abs(run) < std::numeric_limits<float>::epsilon()) {
      b = 1.0F;
    } else {
      a = 1.0F;
      b = -(q.y() - p.y()) / run;
    }
    c = -a * q.y() - b * q.x();
  }
  float yAt(float x) const { return -(b * x + c) / a; }
  bool boxHolds(const Vector2f& p) const {
    return p.x() <= std::max(from.x(), to.x()) && p.x() >= std::min(from.x(), to.x()) &&
           p.y() <= std::max(from.y(), to.y()) && p.y() >= std::min(from.y(), to.y());
  }
};

std::optional<Vector2f> intersection(const Segment& s, const Segment& t) {
  const float determinant = t.a * s.b - s.a * t.b;
  if (std::abs(determinant) < std::numeric_limits<float>::epsilon()) return std::nullopt;
  Vector2f p;
  if (s.a == 0.0F) {
    p.x() = -s.c / s.b;
    p.y() = t.yAt(p.x());
  } else {
    p.x() = t.a == 0.0F ? -t.c / t.b : (s.a * t.c - t.a * s.c) / determinant;
    p.y() = s.yAt(p.x());
  }
  if (!s.boxHolds(p) || !t.boxHolds(p)) return std::nullopt;
  return p;
}

/// The four sides of the picture in the focal plane, in the server's order: top, bottom, left, right.
const std::array<Segment, 4>& pictureSides() {
  static const std::array<Segment, 4> sides = [] {
    const auto half = static_cast<float>(std::tan(static_cast<double>(kHalfCone) * M_PI / 180.0) *
                                         static_cast<double>(kFocalLength));
    const Vector2f rightTop(half, half);
    const Vector2f rightBottom(half, -half);
    const Vector2f leftTop(-half, half);
    const Vector2f leftBottom(-half, -half);
    return std::array<Segment, 4>{Segment(leftTop, rightTop), Segment(leftBottom, rightBottom),
                                  Segment(leftTop, leftBottom), Segment(rightTop, rightBottom)};
  }();
  return sides;
}

Vector2f projected(const Vector3f& u) {
  return {u.x() * kFocalLength / u.y(), u.z() * kFocalLength / u.y()};
}

/// Finds the point of the segment begin-end (in front of the camera C) that projects onto a hit X_f in the
/// focal plane, by the triangle of camera, end E and point X: the angles at E and at C are known (law of
/// cosines), the side EX follows from the law of sines.
class BackProjection {
 public:
  BackProjection(const Vector3f& begin, const Vector3f& end, const Vector2f& projectedEnd)
      : begin_(begin),
        end_(end),
        focalEnd_(projectedEnd.x(), kFocalLength, projectedEnd.y()),
        toEnd_(scene::length(end)),
        beginToEnd_(scene::length(begin - end)),
        focalToEnd_(scene::length(focalEnd_)) {
    const float toBegin = scene::length(begin);
    angleAtEnd_ = std::acos((beginToEnd_ * beginToEnd_ + toEnd_ * toEnd_ - toBegin * toBegin) /
                            (2.0F * beginToEnd_ * toEnd_));
  }

  Vector3f operator()(const Vector2f& hit) const {
    const Vector3f focalHit(hit.x(), kFocalLength, hit.y());
    const float toHit = scene::length(focalHit);
    const float apart = scene::length(focalHit - focalEnd_);
    const float angleAtCamera =
        std::acos((toHit * toHit + focalToEnd_ * focalToEnd_ - apart * apart) / (2.0F * toHit * focalToEnd_));
    const auto angleAtPoint = static_cast<float>(M_PI - angleAtEnd_ - angleAtCamera);
    const float fromEnd = toEnd_ / std::sin(angleAtPoint) * std::sin(angleAtCamera);
    return end_ + (begin_ - end_) * (fromEnd / beginToEnd_);
  }

 private:
  Vector3f begin_;
  Vector3f end_;
  Vector3f focalEnd_;
  float toEnd_;
  float beginToEnd_;
  float focalToEnd_;
  float angleAtEnd_;
};

/// A line on its way through the clipping.
struct Clipped {
  Vector3f begin;
  Vector3f end;
  bool seesBegin = false;
  bool seesEnd = false;
};

/// Server facts 2.7, lines, step 3.
void clip(Clipped& line) {
  Vector3f begin = line.begin;
  Vector3f end = line.end;
  if (begin.y() < kFocalLength && end.y() >= kFocalLength) {
    begin = end + (begin - end) * ((kFocalLength - end.y()) / (begin.y() - end.y()));
  } else if (end.y() < kFocalLength && begin.y() >= kFocalLength) {
    end = begin + (end - begin) * ((kFocalLength - begin.y()) / (end.y() - begin.y()));
  }
  if (begin.y() <= 0.0F || end.y() <= 0.0F) return;
  const Vector2f projectedEnd = projected(end);
  const Segment segment(projected(begin), projectedEnd);
  const BackProjection carryBack(begin, end, projectedEnd);
  std::array<Vector3f, 2> hits;
  std::size_t count = 0;
  for (const Segment& side : pictureSides()) {
    if (count == hits.size()) break;
    if (const auto hit = intersection(segment, side)) hits[count++] = carryBack(*hit);
  }
  if (count == 2) {
    line = {hits[0], hits[1], true, true};
  } else if (count == 1 && !line.seesBegin) {
    line.begin = hits[0];
    line.seesBegin = true;
  } else if (count == 1) {
    line.end = hits[0];
    line.seesEnd = true;
  }
}

Vector3f point(double x, double y, double z = 0.0) {
  using scene::scriptNumber;
  return {static_cast<float>(scriptNumber(x)), static_cast<float>(scriptNumber(y)),
          static_cast<float>(scriptNumber(z))};
}

}  // namespace

VisionField::VisionField(const Size& size) {
  using protocol::Landmark;
  const double x = size.length / 2.0;
  const double y = size.width / 2.0;
  const auto set = [this](Landmark id, const Vector3f& p) { landmarks[static_cast<std::size_t>(id)] = p; };
  set(Landmark::F1L, point(-x, y));
  set(Landmark::F2L, point(-x, -y));
  set(Landmark::F1R, point(x, y));
  set(Landmark::F2R, point(x, -y));
  // The posts are children of the goals, the right one turned by 180 degrees (in 32 bits).
  const double halfDepth = size.goalDepth / 2.0;
  for (const bool left : {true, false}) {
    ScenePose goal;
    goal.position = point(left ? -(x + halfDepth) : x + halfDepth, 0.0, size.goalHeight / 2.0);
    goal.rotation = scene::rotationZ(scene::toRadians(left ? 0.0F : 180.0F));
    const Vector3f upper = point(halfDepth, size.goalWidth / 2.0, size.goalHeight / 2.0);
    const Vector3f lower = point(halfDepth, -size.goalWidth / 2.0, size.goalHeight / 2.0);
    set(left ? Landmark::G1L : Landmark::G2R, scene::transform(goal, upper));
    set(left ? Landmark::G2L : Landmark::G1R, scene::transform(goal, lower));
  }
  const auto line = [this](double x0, double y0, double x1, double y1) {
    lines.push_back({point(x0, y0), point(x1, y1)});
  };
  const double areaX = x - size.penaltyLength;
  const double areaY = (size.penaltyWidth + size.goalWidth) * 0.5;
  line(0, -y, 0, y);
  line(x, -y, x, y);
  line(-x, -y, -x, y);
  line(x, y, -x, y);
  line(x, -y, -x, -y);
  for (const double side : {1.0, -1.0}) {
    line(side * areaX, areaY, side * areaX, -areaY);
    line(side * areaX, areaY, side * x, areaY);
    line(side * areaX, -areaY, side * x, -areaY);
  }
  constexpr int kCorners = 10;
  const auto corner = [&size](int k) {
    const double angle = 2.0 * M_PI * (k % kCorners) / kCorners;
    return point(size.circleRadius * std::cos(angle), size.circleRadius * std::sin(angle));
  };
  for (int k = 0; k < kCorners; ++k) lines.push_back({corner(k), corner(k + 1)});
}

Vector3f drawCalibration(Random& random) {
  const float limit = VisionNoise{}.calibration;
  Vector3f error;
  for (int i = 0; i < 3; ++i) error[i] = static_cast<float>(random.uniform(-limit, limit));
  return error;
}

protocol::Polar SeenPoint::onWire() const {
  return {protocol::roundToWire(distance), protocol::radiansOnWire(azimuth),
          protocol::radiansOnWire(elevation)};
}

void Camera::addNoise(SeenPoint& seen) {
  if (noise_ == nullptr) return;
  constexpr VisionNoise kNoise;
  seen.distance =
      static_cast<float>(seen.distance + noise_->normal(0.0, kNoise.distance) * seen.distance / 100.0);
  seen.azimuth = static_cast<float>(seen.azimuth + noise_->normal(0.0, kNoise.azimuth));
  seen.elevation = static_cast<float>(seen.elevation + noise_->normal(0.0, kNoise.elevation));
}

std::optional<SeenPoint> Camera::look(const Vector3f& position) {
  const Vector3f away = position - head_.position;
  if (scene::length(away) <= kNearest) return std::nullopt;
  SeenPoint seen = polar(scene::inverseRotate(head_.rotation, away) + calibration_);
  if (!inCone(seen)) return std::nullopt;
  addNoise(seen);
  return seen;
}

std::optional<Camera::SeenSegment> Camera::look(const VisionField::Line& line) {
  const auto inHead = [this](const Vector3f& p) -> Vector3f {
    return scene::inverseRotate(head_.rotation, p - head_.position) + calibration_;
  };
  const auto visible = [](const SeenPoint& p) { return p.distance > kNearest && inCone(p); };
  Clipped clipped{inHead(line.begin), inHead(line.end)};
  SeenSegment seen{polar(clipped.begin), polar(clipped.end)};
  clipped.seesBegin = visible(seen.begin);
  clipped.seesEnd = visible(seen.end);
  if (!clipped.seesBegin || !clipped.seesEnd) {
    clip(clipped);
    if (!clipped.seesBegin || !clipped.seesEnd) return std::nullopt;
    seen = {polar(clipped.begin), polar(clipped.end)};
  }
  addNoise(seen.begin);
  addNoise(seen.end);
  return seen;
}

}  // namespace nonet::sim
