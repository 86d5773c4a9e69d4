#include "nonet/lab/reports/localization_report.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <fmt/format.h>

#include "nonet/lab/common/statistics.h"
#include "nonet/math/angle.h"
#include "nonet/math/rotation.h"

namespace nonet::lab {

namespace {

constexpr double kQuantile95 = 5.991;                  // chi-squared, two degrees of freedom
constexpr double kPrintedVariance = 0.01 * 0.01 / 12;  // m^2, uniform rounding to 0.01 m

LocalizationReport::ErrorQuantiles quantilesOf(const std::vector<double>& sample) {
  LocalizationReport::ErrorQuantiles result;
  if (sample.empty()) return result;
  result.median = quantile(sample, 0.5);
  result.p95 = quantile(sample, 0.95);
  result.largest = *std::max_element(sample.begin(), sample.end());
  result.mean = mean(sample);
  return result;
}

nlohmann::ordered_json toJson(const LocalizationReport::ErrorQuantiles& error, double unit) {
  return {{"median", error.median / unit},
          {"p95", error.p95 / unit},
          {"mean", error.mean / unit},
          {"max", error.largest / unit}};
}

}  // namespace

double LocalizationReport::Frame::positionError() const {
  return (believed - truth).head<2>().norm();
}

double LocalizationReport::Frame::headingError() const {
  return std::abs(angleDifference(believedHeading, trueHeading));
}

bool LocalizationReport::Frame::inside() const {
  const Vector2 error = (believed - truth).head<2>();
  if (!rounded) return error.dot(covariance.inverse() * error) < kQuantile95;
  // The difference from a rounded truth is the error plus a uniform one. Where the rounding is the larger
  // part the sum is far from Gaussian: its 95 % quantile is smaller, down to 4.30 for rounding alone
  // (fitted to a simulation to within 0.03).
  const Matrix2 sum = covariance + kPrintedVariance * Matrix2::Identity();
  const double share = kPrintedVariance / std::sqrt(sum.determinant());
  const double quantile = kQuantile95 - 1.69 * std::pow(share, 2.5);
  return error.dot(sum.inverse() * error) < quantile;
}

void LocalizationReport::add(const protocol::Percept& percept, const world::WorldState& world) {
  if (!percept.vision || !percept.vision->truePosition || !percept.vision->trueHeading) return;
  record(world, *percept.vision->truePosition, *percept.vision->trueHeading, true);
}

void LocalizationReport::add(const world::WorldState& world, const Vector3& p_FC, double heading) {
  record(world, p_FC, heading, false);
}

void LocalizationReport::record(const world::WorldState& world, const Vector3& p_FC, double heading,
                                bool rounded) {
  field_ = world.field;
  Frame& frame = frames_.emplace_back();
  frame.time = world.time;
  frame.believed = world.self.X_FC.translation();
  frame.truth = p_FC;
  const Matrix3 R_FC = world.self.X_FC.linear();
  frame.believedHeading = yawOf(R_FC);
  frame.trueHeading = heading;
  frame.covariance = world.self.cameraCovariance.topLeftCorner<2, 2>();
  frame.rounded = rounded;
  frame.localized = world.self.localized;
}

void LocalizationReport::sharpen(std::string_view json) {
  if (frames_.empty() || !frames_.back().rounded) return;
  const auto line = nlohmann::json::parse(json, nullptr, false);
  if (!line.is_object() || !line.contains("me") || !line["me"].contains("head")) return;
  const auto& m = line["me"]["head"];  // 4 x 4, column major; the server's head looks along y
  if (!m.is_array() || m.size() != 16) return;
  const Vector3 p_WC(m[12].get<double>(), m[13].get<double>(), m[14].get<double>());
  const double heading = std::atan2(m[5].get<double>(), m[4].get<double>());
  Frame& frame = frames_.back();
  const Vector3 p_turned(-p_WC.x(), -p_WC.y(), p_WC.z());
  constexpr double kSameMoment = 0.02;  // m
  if ((p_WC - frame.truth).norm() < kSameMoment) {
    frame.truth = p_WC;
    frame.trueHeading = heading;
  } else if ((p_turned - frame.truth).norm() < kSameMoment) {
    frame.truth = p_turned;
    frame.trueHeading = wrapAngle(heading + kPi);
  } else {
    return;
  }
  frame.rounded = false;
}

LocalizationReport::Summary LocalizationReport::summary() const {
  Summary summary;
  summary.frames = frames_.size();
  if (frames_.empty()) return summary;
  std::vector<double> position;
  std::vector<double> height;
  std::vector<double> heading;
  std::vector<double> localized;
  std::size_t inside = 0;
  for (const Frame& frame : frames_) {
    position.push_back(frame.positionError());
    height.push_back(std::abs(frame.believed.z() - frame.truth.z()));
    heading.push_back(frame.headingError());
    if (frame.localized) localized.push_back(position.back());
    inside += frame.inside() ? 1 : 0;
  }
  const auto count = static_cast<double>(frames_.size());
  summary.position = quantilesOf(position);
  summary.height = quantilesOf(height);
  summary.heading = quantilesOf(heading);
  summary.coverage95 = static_cast<double>(inside) / count;
  summary.localizedShare = static_cast<double>(localized.size()) / count;
  summary.localizedPosition = quantilesOf(localized);
  return summary;
}

nlohmann::ordered_json LocalizationReport::toJson() const {
  const Summary s = summary();
  return {{"frames", s.frames},
          {"position_error_m", lab::toJson(s.position, 1.0)},
          {"height_error_m", lab::toJson(s.height, 1.0)},
          {"heading_error_deg", lab::toJson(s.heading, toRadians(1.0))},
          {"coverage95", s.coverage95},
          {"localized_share", s.localizedShare}};
}

std::string LocalizationReport::toText() const {
  const Summary s = summary();
  if (s.frames == 0) return "localization: no ground truth in this log\n";
  std::string text = fmt::format("localization over {} vision messages\n", s.frames);
  const auto row = [&](std::string_view name, const ErrorQuantiles& error, double unit,
                       std::string_view suffix) {
    text +=
        fmt::format("  {:<9} median {:7.4f}  95% {:7.4f}  mean {:7.4f}  max {:8.4f} {}\n", name,
                    error.median / unit, error.p95 / unit, error.mean / unit, error.largest / unit, suffix);
  };
  row("position", s.position, 1.0, "m");
  row("height", s.height, 1.0, "m");
  row("heading", s.heading, toRadians(1.0), "deg");
  text += fmt::format("  truth inside the stated 95% region in {:.1f}% of all frames; localized in {:.1f}%\n",
                      100.0 * s.coverage95, 100.0 * s.localizedShare);
  return text;
}

}  // namespace nonet::lab
