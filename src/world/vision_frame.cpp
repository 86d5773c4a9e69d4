#include "nonet/world/vision_frame.h"

#include <cmath>

namespace nonet::world {

namespace {

// The view is a cone of +-60 degrees in both angles, and lines are cut at the square it makes at x = 1. What
// ends nearer than 1.5 degrees (ten sigma) to that border may have been cut there.
const double kInnerBorder = std::tan(58.5 * kPi / 180.0);
constexpr double kNearPlane = 0.15;  // m; lines are also cut at x = 0.1

bool onBorder(const Vector3& p_CP) {
  return p_CP.x() < kNearPlane || std::abs(p_CP.y()) > kInnerBorder * p_CP.x() ||
         std::abs(p_CP.z()) > kInnerBorder * p_CP.x();
}

}  // namespace

double VisionNoise::distanceSigma(double distance) {
  constexpr double kShare = 0.000965;
  constexpr double kPrinting = 0.01 / 3.4641016151377544;  // uniform over 0.01 m
  return std::sqrt(kShare * kShare * distance * distance + kPrinting * kPrinting);
}

bool clearlyInView(const Vector3& p_CP, double room) {
  constexpr double kSide = 50.0 * kPi / 180.0;  // of the 60 degrees that the view reaches to each side
  constexpr double kNear = 0.3;                 // m
  const double distance = p_CP.norm();
  if (distance < kNear + room) return false;
  const double side = kSide - std::asin(room / distance);
  const double azimuth = std::atan2(p_CP.y(), p_CP.x());
  const double elevation = std::atan2(p_CP.z(), p_CP.head<2>().norm());
  return std::abs(azimuth) < side && std::abs(elevation) < side;
}

ObservedPoint::ObservedPoint(const protocol::Polar& polar) {
  const double cosAzimuth = std::cos(polar.azimuth);
  const double sinAzimuth = std::sin(polar.azimuth);
  const double cosElevation = std::cos(polar.elevation);
  const double sinElevation = std::sin(polar.elevation);
  const Vector3 radial(cosElevation * cosAzimuth, cosElevation * sinAzimuth, sinElevation);
  p_CP = polar.distance * radial;
  const double distance = std::max(polar.distance, 0.05);
  whitener.row(0) = radial.transpose() / VisionNoise::distanceSigma(distance);
  whitener.row(1) = Eigen::RowVector3d(-sinAzimuth, cosAzimuth, 0.0) /
                    (distance * std::max(cosElevation, 0.1) * VisionNoise::kAzimuthSigma);
  whitener.row(2) = Eigen::RowVector3d(-sinElevation * cosAzimuth, -sinElevation * sinAzimuth, cosElevation) /
                    (distance * VisionNoise::kElevationSigma);
}

void VisionFrame::assign(const protocol::Vision& vision) {
  clear();
  for (const protocol::SeenLandmark& seen : vision.landmarks) {
    if (landmarkCount_ == kMaximumLandmarks) break;
    if (!seen.at.isFinite()) continue;
    landmarks_[landmarkCount_++] = {seen.id, ObservedPoint(seen.at)};
  }
  for (const protocol::SeenLine& seen : vision.lines) {
    if (lineCount_ == kMaximumLines) break;
    if (!seen.begin.isFinite() || !seen.end.isFinite()) continue;
    ObservedLine& line = lines_[lineCount_++];
    line.ends = {ObservedPoint(seen.begin), ObservedPoint(seen.end)};
    for (std::size_t i = 0; i < 2; ++i) line.clipped[i] = onBorder(line.ends[i].p_CP);
    line.length = (line.ends[0].p_CP - line.ends[1].p_CP).norm();
  }
}

}  // namespace nonet::world
