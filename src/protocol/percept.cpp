#include "nonet/protocol/percept.h"

#include <cmath>
#include <utility>

namespace nonet::protocol {
namespace {

constexpr std::array<std::string_view, kLandmarkCount> kLandmarkNames = {"F1L", "F2L", "F1R", "F2R",
                                                                         "G1L", "G2L", "G1R", "G2R"};
constexpr std::array<std::string_view, kBodyPartCount> kBodyPartNames = {"head", "rlowerarm", "llowerarm",
                                                                         "rfoot", "lfoot"};

}  // namespace

std::string_view landmarkName(Landmark landmark) {
  return kLandmarkNames[static_cast<std::size_t>(landmark)];
}

std::string_view bodyPartName(BodyPart part) {
  return kBodyPartNames[static_cast<std::size_t>(part)];
}

Vector3 Polar::cartesian() const {
  const double horizontal = distance * std::cos(elevation);
  return {horizontal * std::cos(azimuth), horizontal * std::sin(azimuth), distance * std::sin(elevation)};
}

void Vision::clear() {
  landmarks.clear();
  ball.reset();
  players.clear();
  lines.clear();
  truePosition.reset();
  trueHeading.reset();
  trueBallPosition.reset();
  order.clear();
}

void Percept::clear() {
  time = 0.0;
  game = GameStatus{};
  gyro.setZero();
  accelerometer.setZero();
  joints.fill(0.0);
  jointsPresent = 0;
  forces.fill(std::nullopt);
  if (vision) {
    spareVision_ = std::move(vision);
    vision.reset();
  }
  heard.clear();
  order.clear();
  unknownTokens = 0;
}

Vision& Percept::beginVision() {
  if (!vision && spareVision_) {
    vision = std::move(spareVision_);
    spareVision_.reset();
  }
  if (!vision) {
    vision.emplace();
  }
  vision->clear();
  return *vision;
}

}  // namespace nonet::protocol
