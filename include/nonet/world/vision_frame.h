// One vision message prepared for localization: cartesian observations with the server's noise (server facts
// 2.7).
#pragma once

#include <array>
#include <span>

#include "nonet/math/types.h"
#include "nonet/protocol/percept.h"

namespace nonet::world {

/// The server's noise: a share of the distance, and two angles. Printing with two decimals adds a uniform
/// error of +-0.005 (sigma 0.0029) in metres and degrees.
struct VisionNoise {
  static double distanceSigma(double distance);                      // m
  static constexpr double kAzimuthSigma = 0.148028 * kPi / 180.0;    // rad, printing included
  static constexpr double kElevationSigma = 0.122534 * kPi / 180.0;  // rad, printing included
  static constexpr double kOffsetBound =
      0.005;  // m: constant offset per robot, uniform per axis, camera axes
};

/// An observed point in camera axes. `whitener` turns an error in camera axes into units of the noise: its
/// rows are the directions of distance, azimuth and elevation, each divided by its sigma.
struct ObservedPoint {
  Vector3 p_CP = Vector3::Zero();
  Matrix3 whitener = Matrix3::Identity();

  ObservedPoint() = default;
  explicit ObservedPoint(const protocol::Polar& polar);
};

/// Comfortably inside the view, with all that is within `room` (m) of it: there it must be seen, since
/// nothing hides anything (server facts 2.7).
bool clearlyInView(const Vector3& p_CP, double room);
/// What was so often in a row clearly in view and not seen is not there any more.
inline constexpr int kAbsencesToForget = 3;

struct ObservedLandmark {
  protocol::Landmark id = protocol::Landmark::F1L;
  ObservedPoint at;
};

struct ObservedLine {
  std::array<ObservedPoint, 2> ends;  // begin, end
  std::array<bool, 2> clipped{};      // the end lies on the border of the view: not the end of the line
  double length = 0.0;                // m
};

class VisionFrame {
 public:
  static constexpr std::size_t kMaximumLandmarks = 16;
  static constexpr std::size_t kMaximumLines = 32;

  void assign(const protocol::Vision& vision);
  void clear() { landmarkCount_ = lineCount_ = 0; }

  std::span<const ObservedLandmark> landmarks() const { return {landmarks_.data(), landmarkCount_}; }
  std::span<const ObservedLine> lines() const { return {lines_.data(), lineCount_}; }

 private:
  std::array<ObservedLandmark, kMaximumLandmarks> landmarks_;
  std::array<ObservedLine, kMaximumLines> lines_;
  std::size_t landmarkCount_ = 0;
  std::size_t lineCount_ = 0;
};

}  // namespace nonet::world
