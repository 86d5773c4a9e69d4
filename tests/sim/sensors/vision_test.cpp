// The camera model against recordings of the real server with ground truth: the same objects and lines are
// seen, and what is measured differs from the truth by noise of the same distribution.
#include "nonet/sim/sensors/vision.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include "nonet/math/angle.h"
#include "nonet/protocol/percept_text.h"

namespace nonet::sim {
namespace {

using nlohmann::json;
using protocol::BodyPart;
using protocol::Polar;

struct Frame {
  protocol::Percept percept;
  ScenePose head;
  Vector3f ball;
  struct Player {
    bool left = true;
    int unum = 0;
    std::array<Vector3f, protocol::kBodyPartCount> parts;
  };
  std::vector<Player> players;
};

Vector3f vectorFrom(const json& numbers, std::size_t from = 0) {
  return {numbers.at(from).get<float>(), numbers.at(from + 1).get<float>(),
          numbers.at(from + 2).get<float>()};
}

Frame frameFrom(const std::string& line) {
  const json row = json::parse(line);
  Frame frame;
  protocol::parsePercept(row["see"].get<std::string>(), frame.percept);
  for (int column = 0; column < 3; ++column) {
    frame.head.rotation.col(column) = vectorFrom(row["head"], static_cast<std::size_t>(4 * column));
  }
  frame.head.position = vectorFrom(row["head"], 12);
  frame.ball = vectorFrom(row["ball"]);
  for (const auto& [name, parts] : row["players"].items()) {
    Frame::Player player;
    player.left = name.starts_with("left");
    player.unum = std::stoi(name.substr(player.left ? 4 : 5));
    for (std::size_t i = 0; i < protocol::kBodyPartCount; ++i) {
      player.parts[i] = vectorFrom(parts[std::string(protocol::bodyPartName(static_cast<BodyPart>(i)))]);
    }
    frame.players.push_back(player);
  }
  return frame;
}

const std::vector<Frame>& framesOf(const std::string& log) {
  static std::map<std::string, std::vector<Frame>> cache;
  std::vector<Frame>& frames = cache[log];
  if (!frames.empty()) return frames;
  const auto file = std::filesystem::path(NONET_TEST_DATA) / "vision" / (log + ".jsonl.gz");
  const gzFile in = gzopen(file.c_str(), "rb");
  EXPECT_NE(in, nullptr) << file;
  std::vector<char> buffer(1 << 18);
  while (in != nullptr && gzgets(in, buffer.data(), static_cast<int>(buffer.size())) != nullptr) {
    frames.push_back(frameFrom(buffer.data()));
  }
  gzclose(in);
  return frames;
}

/// In the server's head axes (x right, y forward).
Vector3f cartesian(const Polar& polar) {
  const Vector3 p = polar.cartesian();
  return Vector3(-p.y(), p.x(), p.z()).cast<float>();
}

/// Every fixed object, the ball and every part of every player: where it is, and what the log says of it.
struct Sighting {
  Vector3f position;
  const Polar* seen = nullptr;
};

std::vector<Sighting> sightingsOf(const Frame& frame, const VisionField& field) {
  const protocol::Vision& vision = *frame.percept.vision;
  std::vector<Sighting> all;
  for (std::size_t i = 0; i < protocol::kLandmarkCount; ++i) {
    Sighting sighting{field.landmarks[i]};
    for (const auto& landmark : vision.landmarks) {
      if (static_cast<std::size_t>(landmark.id) == i) sighting.seen = &landmark.at;
    }
    all.push_back(sighting);
  }
  all.push_back({frame.ball, vision.ball ? &*vision.ball : nullptr});
  for (const Frame::Player& player : frame.players) {
    for (std::size_t i = 0; i < protocol::kBodyPartCount; ++i) {
      Sighting sighting{player.parts[i]};
      for (const auto& other : vision.players) {
        const bool same = other.unum == player.unum && (other.team == "Probe") == player.left;
        if (same && other.parts[i]) sighting.seen = &*other.parts[i];
      }
      all.push_back(sighting);
    }
  }
  return all;
}

/// The constant offset of this log's camera, by weighted least squares: the noise grows with the distance.
Vector3f estimateCalibration(const std::vector<Frame>& frames, const VisionField& field) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weights = 0.0;
  for (const Frame& frame : frames) {
    for (const Sighting& sighting : sightingsOf(frame, field)) {
      if (sighting.seen == nullptr) continue;
      const Vector3f truth = frame.head.rotation.transpose() * (sighting.position - frame.head.position);
      const double weight = 1.0 / (truth.squaredNorm() + 0.5);
      sum += weight * (cartesian(*sighting.seen) - truth).cast<double>();
      weights += weight;
    }
  }
  return (sum / weights).cast<float>();
}

struct Residuals {
  std::vector<double> distance;  // in units of the expected standard deviation
  std::vector<double> azimuth;
  std::vector<double> elevation;

  void add(double trueDistance, double trueAzimuth, double trueElevation, const Polar& seen) {
    constexpr double kRounding = 0.01 / 3.4641016;  // standard deviation of rounding to two decimals
    const VisionNoise noise;
    const double sigma = std::hypot(trueDistance * noise.distance / 100.0, kRounding);
    distance.push_back((seen.distance - trueDistance) / sigma);
    azimuth.push_back((toDegrees(seen.azimuth) - trueAzimuth) / std::hypot(noise.azimuth, kRounding));
    elevation.push_back((toDegrees(seen.elevation) - trueElevation) / std::hypot(noise.elevation, kRounding));
  }
};

void expectStandardNormal(const std::vector<double>& values, const std::string& name) {
  const auto n = static_cast<double>(values.size());
  double sum = 0.0;
  double squares = 0.0;
  for (const double v : values) {
    sum += v;
    squares += v * v;
  }
  const double mean = sum / n;
  const double deviation = std::sqrt(squares / n - mean * mean);
  // Four standard errors, and half a percent for the calibration, which is estimated from the same data.
  EXPECT_NEAR(mean, 0.0, 4.0 / std::sqrt(n) + 0.01) << name << ", n = " << n;
  EXPECT_NEAR(deviation, 1.0, 4.0 / std::sqrt(2.0 * n) + 0.005) << name << ", n = " << n;
}

/// Two-sample Kolmogorov-Smirnov statistic times sqrt(n m / (n + m)): beyond 2.2 with probability 0.0001.
double kolmogorovSmirnov(std::vector<double> a, std::vector<double> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  double largest = 0.0;
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    (a[i] <= b[j] ? i : j) += 1;
    largest = std::max(largest, std::abs(static_cast<double>(i) / static_cast<double>(a.size()) -
                                         static_cast<double>(j) / static_cast<double>(b.size())));
  }
  const auto n = static_cast<double>(a.size());
  const auto m = static_cast<double>(b.size());
  return largest * std::sqrt(n * m / (n + m));
}

class VisionLog : public testing::TestWithParam<std::string> {
 protected:
  VisionField field;
};

TEST_P(VisionLog, CalibrationErrorIsWithinItsBounds) {
  const Vector3f calibration = estimateCalibration(framesOf(GetParam()), field);
  EXPECT_LT(calibration.cwiseAbs().maxCoeff(), 0.0055F) << calibration.transpose();
}

TEST_P(VisionLog, TheSameObjectsAreSeen) {
  const auto& frames = framesOf(GetParam());
  const Vector3f calibration = estimateCalibration(frames, field);
  int seenByBoth = 0;
  int differing = 0;
  for (const Frame& frame : frames) {
    Camera camera(frame.head, calibration, nullptr);
    for (const Sighting& sighting : sightingsOf(frame, field)) {
      const bool seen = camera.look(sighting.position).has_value();
      const bool recorded = sighting.seen != nullptr;
      seenByBoth += seen && recorded;
      differing += seen != recorded;
    }
  }
  EXPECT_GT(seenByBoth, 1000);
  // Only what lies on the very edge of the view: poses have six digits, and the calibration is an estimate.
  EXPECT_LE(differing, 3 + seenByBoth / 2000);
}

TEST_P(VisionLog, NoiseHasTheSameDistribution) {
  const auto& frames = framesOf(GetParam());
  const Vector3f calibration = estimateCalibration(frames, field);
  Random random(1);
  Residuals recorded;
  Residuals ours;
  for (const Frame& frame : frames) {
    Camera ideal(frame.head, calibration, nullptr);
    Camera noisy(frame.head, calibration, &random);
    for (const Sighting& sighting : sightingsOf(frame, field)) {
      const auto truth = ideal.look(sighting.position);
      const auto seen = noisy.look(sighting.position);
      ASSERT_EQ(truth.has_value(), seen.has_value());
      if (!truth || truth->distance < 1.0F) continue;  // near things: the calibration's own error dominates
      ours.add(truth->distance, truth->azimuth, truth->elevation, seen->onWire());
      if (sighting.seen != nullptr) {
        recorded.add(truth->distance, truth->azimuth, truth->elevation, *sighting.seen);
      }
    }
  }
  ASSERT_GT(recorded.distance.size(), 1000U);
  for (const Residuals* residuals : {&recorded, &ours}) {
    const std::string whose = residuals == &recorded ? "recorded " : "ours ";
    expectStandardNormal(residuals->distance, whose + "distance");
    expectStandardNormal(residuals->azimuth, whose + "azimuth");
    expectStandardNormal(residuals->elevation, whose + "elevation");
  }
  EXPECT_LT(kolmogorovSmirnov(recorded.distance, ours.distance), 2.2);
  EXPECT_LT(kolmogorovSmirnov(recorded.azimuth, ours.azimuth), 2.2);
  EXPECT_LT(kolmogorovSmirnov(recorded.elevation, ours.elevation), 2.2);
}

// Every recorded line is ours at the same place of the list, its ends within the noise.
TEST_P(VisionLog, LinesAreClippedAlike) {
  const auto& frames = framesOf(GetParam());
  const Vector3f calibration = estimateCalibration(frames, field);
  int same = 0;
  int framesWithOtherLines = 0;
  Residuals ends;
  for (const Frame& frame : frames) {
    Camera camera(frame.head, calibration, nullptr);
    std::vector<Camera::SeenSegment> ours;
    for (const VisionField::Line& line : field.lines) {
      if (const auto seen = camera.look(line)) ours.push_back(*seen);
    }
    const auto& recorded = frame.percept.vision->lines;
    if (recorded.size() != ours.size()) {
      ++framesWithOtherLines;
      continue;
    }
    for (std::size_t i = 0; i < ours.size(); ++i) {
      const SeenPoint& begin = ours[i].begin;
      const SeenPoint& end = ours[i].end;
      ends.add(begin.distance, begin.azimuth, begin.elevation, recorded[i].begin);
      ends.add(end.distance, end.azimuth, end.elevation, recorded[i].end);
      ++same;
    }
  }
  EXPECT_GT(same, 2000);
  // Pieces of almost no length come and go with the last digits of pose and calibration.
  EXPECT_LE(framesWithOtherLines, 1 + static_cast<int>(frames.size()) / 50);
  std::size_t beyond = 0;
  for (const auto* values : {&ends.distance, &ends.azimuth, &ends.elevation}) {
    for (const double v : *values) beyond += std::abs(v) > 5.0;
  }
  EXPECT_LE(beyond, ends.distance.size() * 3 / 500);
}

INSTANTIATE_TEST_SUITE_P(Recorded, VisionLog, testing::Values("poses_1", "crowd_1", "wander_1", "wander_3"),
                         [](const auto& info) { return info.param; });

// ------------------------------------------------------------------------------- the model by itself

TEST(VisionField, LandmarksAndLinesOfTheStandardField) {
  const VisionField field;
  using protocol::Landmark;
  const auto at = [&field](Landmark id) { return field.landmarks[static_cast<std::size_t>(id)]; };
  EXPECT_LT((at(Landmark::F1L) - Vector3f(-15, 10, 0)).norm(), 1e-6F);
  EXPECT_LT((at(Landmark::F2R) - Vector3f(15, -10, 0)).norm(), 1e-6F);
  EXPECT_LT((at(Landmark::G1L) - Vector3f(-15, 1.05F, 0.8F)).norm(), 2e-6F);
  EXPECT_LT((at(Landmark::G2L) - Vector3f(-15, -1.05F, 0.8F)).norm(), 2e-6F);
  EXPECT_LT((at(Landmark::G1R) - Vector3f(15, 1.05F, 0.8F)).norm(), 2e-6F);
  EXPECT_LT((at(Landmark::G2R) - Vector3f(15, -1.05F, 0.8F)).norm(), 2e-6F);
  ASSERT_EQ(field.lines.size(), 21U);
  EXPECT_LT((field.lines[5].begin - Vector3f(13.2F, 3, 0)).norm(), 1e-6F);
  for (std::size_t i = 11; i < 21; ++i) {
    EXPECT_NEAR(field.lines[i].begin.norm(), 2.0F, 1e-5F);
    EXPECT_EQ(field.lines[i].end, field.lines[11 + (i - 10) % 10].begin);
  }
}

ScenePose levelHead() {
  ScenePose head;
  head.position = {0.0F, 0.0F, 0.5F};
  return head;  // looks along +y
}

TEST(Camera, AnglesFollowTheConvention) {
  const ScenePose head = levelHead();
  Camera camera(head, Vector3f::Zero(), nullptr);
  const auto left = camera.look(Vector3f(-3.0F, 3.0F, 0.5F));
  ASSERT_TRUE(left);
  EXPECT_NEAR(left->azimuth, 45.0F, 1e-4F);
  EXPECT_NEAR(left->elevation, 0.0F, 1e-4F);
  EXPECT_NEAR(left->distance, 3.0F * std::sqrt(2.0F), 1e-5F);
  const auto up = camera.look(Vector3f(0.0F, 1.0F, 1.5F));
  ASSERT_TRUE(up);
  EXPECT_NEAR(up->elevation, 45.0F, 1e-4F);
  EXPECT_FALSE(camera.look(Vector3f(-2.0F, 1.0F, 0.5F)));  // 63 degrees to the left
  EXPECT_FALSE(camera.look(Vector3f(0.0F, 0.09F, 0.5F)));  // too near
  EXPECT_FALSE(camera.look(Vector3f(0.0F, -1.0F, 0.5F)));  // behind
}

// Where only the sides of the picture cut, the clipped end lies on the line and on the picture's border.
TEST(Camera, ClippedEndsLieOnLineAndBorder) {
  const ScenePose head = levelHead();
  Camera camera(head, Vector3f::Zero(), nullptr);
  Random random(3);
  int clipped = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto coordinate = [&random] { return static_cast<float>(random.uniform(-15.0, 15.0)); };
    const VisionField::Line line{{coordinate(), coordinate(), 0.0F}, {coordinate(), coordinate(), 0.0F}};
    const auto seen = camera.look(line);
    if (!seen) continue;
    for (const auto& [point, original] :
         {std::pair{seen->begin, line.begin}, std::pair{seen->end, line.end}}) {
      const Polar polar{point.distance, toRadians(point.azimuth), toRadians(point.elevation)};
      const Vector3f world = cartesian(polar) + head.position;
      const Vector3f direction = (line.end - line.begin).normalized();
      const float along = (world - line.begin).dot(direction);
      const float away = (world - line.begin - along * direction).norm();
      if (point.distance < 10.0F) {
        EXPECT_LT(away, 0.05F);
      }
      if ((world - original).norm() < 0.05F) continue;
      ++clipped;
      // In the plane y = 1 the border is the square of half size tan 60.
      const Vector3f u = cartesian(polar) / cartesian(polar).y();
      EXPECT_NEAR(std::max(std::abs(u.x()), std::abs(u.z())), std::tan(toRadians(60.0)), 0.05);
    }
  }
  EXPECT_GT(clipped, 100);
}

TEST(Camera, CalibrationIsUniformWithinFiveMillimetres) {
  Random random(11);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  constexpr int kDraws = 20000;
  for (int i = 0; i < kDraws; ++i) {
    const Eigen::Vector3d e = drawCalibration(random).cast<double>();
    ASSERT_LE(e.cwiseAbs().maxCoeff(), 0.005 + 1e-9);
    sum += e;
    squares += e.cwiseAbs2();
  }
  const double sigma = 0.005 / std::sqrt(3.0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(sum[i] / kDraws, 0.0, 4.0 * sigma / std::sqrt(kDraws));
    EXPECT_NEAR(std::sqrt(squares[i] / kDraws) / sigma, 1.0, 0.02);
  }
}

}  // namespace
}  // namespace nonet::sim
