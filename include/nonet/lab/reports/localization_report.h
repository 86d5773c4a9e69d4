// How well the world stage knows where the robot is: its belief against the ground truth that a server can be
// told to send (mypos, myorien), over every vision message that holds it, none left out.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "nonet/world/world_state.h"

namespace nonet::lab {

class LocalizationReport {
 public:
  struct ErrorQuantiles {
    double median = 0.0;
    double p95 = 0.0;
    double mean = 0.0;
    double largest = 0.0;
  };
  struct Summary {
    std::size_t frames = 0;            // vision messages with truth
    ErrorQuantiles position;           // m, of the camera in the plane
    ErrorQuantiles height;             // m, of the camera
    ErrorQuantiles heading;            // rad, of the camera
    double coverage95 = 0.0;           // share of frames with the truth inside the stated 95 % ellipse
    double localizedShare = 0.0;       // share of frames in which the robot says that it knows its place
    ErrorQuantiles localizedPosition;  // m, over those frames alone
  };

  /// After each world update; messages without vision or truth are passed over. The printed truth is rounded
  /// to 0.01 m, which the test of coverage allows for.
  void add(const protocol::Percept& percept, const world::WorldState& world);

  /// With exact truth: camera position in the own field frame (m) and heading of the camera (rad).
  void add(const world::WorldState& world, const Vector3& p_FC, double heading);

  /// The exact truth of the frame added last, whose printed truth is rounded: the matrix of "me"."head" in a
  /// recording's line of ground truth (`json`), in world axes. The printed position tells whether the field
  /// frame is turned. Lines without that matrix, or of another moment, change nothing.
  void sharpen(std::string_view json);

  Summary summary() const;
  /// {"frames", "position_error_m": {"median", "p95", "mean", "max"}, "height_error_m", "heading_error_deg",
  /// "coverage95", "localized_share"}
  nlohmann::ordered_json toJson() const;
  std::string toText() const;
  /// Map of the field with the truth (red) and the belief (blue), start and times; the errors over time
  /// below.
  std::string toSvg() const;

 private:
  struct Frame {
    double time = 0.0;                         // of the server, s
    Vector3 believed = Vector3::Zero();        // p_FC, m
    Vector3 truth = Vector3::Zero();           // m
    double believedHeading = 0.0;              // rad
    double trueHeading = 0.0;                  // rad
    Matrix2 covariance = Matrix2::Identity();  // stated, of the camera's x and y, m^2
    bool rounded = false;                      // the truth is printed with two decimals
    bool localized = false;

    double positionError() const;  // m
    double headingError() const;   // rad
    bool inside() const;           // the truth lies in the stated 95 % region
  };
  void record(const world::WorldState& world, const Vector3& p_FC, double heading, bool rounded);

  std::vector<Frame> frames_;
  world::FieldGeometry field_;
};

}  // namespace nonet::lab
