// The camera model of the server (server facts 1.6, 2.7), apart from the physics so that it can be compared
// with recordings: head pose and object positions in, See out.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "nonet/math/random.h"
#include "nonet/protocol/percept.h"
#include "nonet/sim/physics/world.h"

namespace nonet::sim {

/// Landmarks and lines of a field, in the order of the server's messages. World frame, m.
struct VisionField {
  struct Line {
    Vector3f begin;
    Vector3f end;
  };
  struct Size {
    double length = 30.0;
    double width = 20.0;
    double goalWidth = 2.1;
    double goalDepth = 0.6;
    double goalHeight = 0.8;
    double penaltyLength = 1.8;
    double penaltyWidth = 3.9;  // added to the goal's width
    double circleRadius = 2.0;
  };

  VisionField() : VisionField(Size{}) {}
  explicit VisionField(const Size& size);

  std::array<Vector3f, protocol::kLandmarkCount> landmarks;  // indexed by Landmark
  std::vector<Line> lines;
};

/// Standard deviations of the noise (server facts 2.7).
struct VisionNoise {
  double distance = 0.0965F;   // percent
  double azimuth = 0.1480F;    // degrees
  double elevation = 0.1225F;  // degrees
  float calibration = 0.005F;  // m, largest offset per axis
};

/// The constant error of one robot's camera: uniform per axis, head axes.
Vector3f drawCalibration(Random& random);

/// One sighting as the server holds it, in 32 bits.
struct SeenPoint {
  float distance = 0.0F;   // m
  float azimuth = 0.0F;    // degrees, left positive
  float elevation = 0.0F;  // degrees, up positive

  protocol::Polar onWire() const;  // rounded as the text does
};

/// A look from one head pose.
class Camera {
 public:
  /// `calibration` is added to every position in head axes; `noise` null: none is added. (A server without
  /// noise has no calibration error either.)
  Camera(const ScenePose& head, const Vector3f& calibration, Random* noise)
      : head_(head), calibration_(calibration), noise_(noise) {}

  /// What is seen of an object with its centre at `position` (world), or nothing if it is out of view.
  std::optional<SeenPoint> look(const Vector3f& position);
  /// The visible part of a line, noise added.
  struct SeenSegment {
    SeenPoint begin;
    SeenPoint end;
  };
  std::optional<SeenSegment> look(const VisionField::Line& line);

 private:
  void addNoise(SeenPoint& point);

  const ScenePose& head_;
  Vector3f calibration_;
  Random* noise_;
};

}  // namespace nonet::sim
