// The report against errors of known size: quantiles, the share in the stated region with exact and with
// printed truth, exact truth of recordings.
#include "nonet/lab/reports/localization_report.h"

#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "nonet/lab/reports/match_localization.h"
#include "nonet/lab/reports/replay.h"
#include "nonet/math/angle.h"
#include "nonet/math/random.h"

namespace nonet::lab {
namespace {

/// A belief about the camera's place with the given standard deviation in x and y.
world::WorldState believe(const Vector3& p_FC, double heading, double sigma) {
  world::WorldState world;
  world.self.X_FC.translation() = p_FC;
  world.self.X_FC.linear() = Eigen::AngleAxisd(heading, Vector3::UnitZ()).toRotationMatrix();
  world.self.cameraCovariance = Matrix3::Identity() * sigma * sigma;
  world.self.localized = true;
  return world;
}

protocol::Percept printed(const Vector3& p_FC, double heading) {
  protocol::Percept percept;
  protocol::Vision& vision = percept.beginVision();
  vision.truePosition = (p_FC * 100.0).array().round().matrix() / 100.0;
  vision.trueHeading = heading;
  return percept;
}

TEST(LocalizationReport, GivesTheQuantilesOfKnownErrors) {
  LocalizationReport report;
  for (int i = 1; i <= 1001; ++i) {
    const double error = 0.001 * (i - 1);
    report.add(believe({3.0 + 0.6 * error, 1.0 - 0.8 * error, 0.5 + 2.0 * error}, 0.2 + 0.1 * error, 0.1),
               {3.0, 1.0, 0.5}, 0.2);
  }
  const LocalizationReport::Summary summary = report.summary();
  EXPECT_EQ(summary.frames, 1001U);
  EXPECT_NEAR(summary.position.median, 0.5, 1e-9);
  EXPECT_NEAR(summary.position.p95, 0.95, 1e-9);
  EXPECT_NEAR(summary.position.mean, 0.5, 1e-9);
  EXPECT_NEAR(summary.height.p95, 1.9, 1e-9);
  EXPECT_NEAR(summary.heading.median, 0.05, 1e-9);
  EXPECT_NEAR(report.toJson()["heading_error_deg"]["p95"].get<double>(), toDegrees(0.095), 1e-9);
  EXPECT_NEAR(summary.coverage95, 0.1 * std::sqrt(5.991), 0.002);
}

TEST(LocalizationReport, HonestBeliefsCover95PercentHoweverTheTruthIsRounded) {
  // Gaussian errors as large as stated, from far below the rounding of 0.01 m to far above it.
  for (const double sigma : {0.0003, 0.001, 0.002, 0.003, 0.006, 0.03}) {
    Random random(5);
    LocalizationReport exact;
    LocalizationReport rounded;
    for (int i = 0; i < 20000; ++i) {
      const Vector3 truth(random.uniform(-10.0, 10.0), random.uniform(-8.0, 8.0), 0.5);
      const Vector3 error(random.normal(0.0, sigma), random.normal(0.0, sigma), 0.0);
      const world::WorldState world = believe(truth + error, 0.0, sigma);
      exact.add(world, truth, 0.0);
      rounded.add(printed(truth, 0.0), world);
    }
    // Three standard deviations of 20,000 draws are 0.0046; the fitted quantile is off by less than 0.003.
    EXPECT_NEAR(exact.summary().coverage95, 0.95, 0.005) << sigma;
    EXPECT_NEAR(rounded.summary().coverage95, 0.95, 0.008) << sigma;
  }
}

TEST(LocalizationReport, TakesTheExactTruthOfARecording) {
  const Vector3 truth(-3.12345, 2.54321, 0.53333);
  for (const bool fromRight : {false, true}) {
    LocalizationReport report;
    report.add(printed(truth, 0.3), believe(truth, 0.3, 0.001));
    EXPECT_GT(report.summary().position.median, 0.003);  // what rounding takes
    // The recording speaks in world axes. Its head looks along its y axis.
    const double sign = fromRight ? -1.0 : 1.0;
    const double heading = 0.3 + (fromRight ? kPi : 0.0);
    report.sharpen(fmt::format(
        R"({{"t":1.0,"me":{{"head":[{0},{1},0,0,{2},{0},0,0,0,0,1,0,{3},{4},{5},1]}}}})", std::sin(heading),
        -std::cos(heading), std::cos(heading), sign * truth.x(), sign * truth.y(), truth.z()));
    EXPECT_LT(report.summary().position.median, 1e-9);
    EXPECT_LT(report.summary().heading.median, 1e-9);
    EXPECT_EQ(report.summary().frames, 1U);
  }
}

TEST(LocalizationReport, TruthOfAnotherMomentChangesNothing) {
  LocalizationReport report;
  report.sharpen("{}");  // no frame yet
  report.add(printed({1.0, 2.0, 0.5}, 0.0), believe({1.1, 2.0, 0.5}, 0.0, 0.1));
  for (const char* line :
       {"", "[1,2]", "{\"me\":{}}", "1 0 0 0", R"({"me":{"head":[1,0,0,0,0,1,0,0,0,0,1,0,5,5,0.5,1]}})"}) {
    report.sharpen(line);
    EXPECT_NEAR(report.summary().position.median, 0.1, 1e-9) << line;
  }
}

TEST(LocalizationReport, EveryVisionMessageOfALogCounts) {
  LocalizationReport report;
  ReplaySettings settings;
  settings.dataFolder = NONET_SOURCE_DIR;
  settings.observer = [&](const agent::Session& session) {
    report.add(session.percept(), session.agent().world());
  };
  const ReplayReport replayed = replay(NONET_TEST_DATA "/replay/match_start.log.gz", settings);
  EXPECT_EQ(report.summary().frames, static_cast<std::size_t>(replayed.perceptors.at("See")));
  EXPECT_NEAR(report.summary().position.median, replayed.positionError->median, 1e-9);
  EXPECT_LT(report.summary().position.median, 0.01);
  const std::string svg = report.toSvg();
  EXPECT_EQ(svg.substr(0, 4), "<svg");
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  for (const char* text : {">truth, with the time in seconds<", ">belief<", ">start<", ">end<", ">own goal<",
                           ">error of the position (dotted: 95 % lie below 0.00", ">error of the heading (",
                           ">m<", ">deg<", ">time since the first message of the map, s<"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
}

}  // namespace
}  // namespace nonet::lab
