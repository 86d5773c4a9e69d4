// Kicks on the physics, at reduced counts: `nonet kick-report` measures fifty with each foot.
#include <cmath>

#include <gtest/gtest.h>

#include "nonet/lab/reports/kick_report.h"
#include "nonet/math/angle.h"

#include "motion/trial_setup.h"

namespace nonet::lab {
namespace {

class Kicking : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Types, Kicking, testing::Range(0, model::kRobotTypeCount));

TEST_P(Kicking, GoesFarAndStraightWithEitherFoot) {
  const TrialSetup setup = agentTrialSetup(GetParam());
  constexpr int kKicks = 6;
  int good = 0;
  for (int i = 0; i < kKicks; ++i) {
    const auto side = static_cast<model::Side>(i % 2);
    const Kick kick = kickOnce(setup, side, KickFrom::Stand, static_cast<std::uint64_t>(i + 1));
    EXPECT_LT(kick.duration, 1.0);
    const bool straight = std::abs(kick.direction()) < toRadians(10.0);
    if (!kick.fell && straight && kick.forward > 2.5) ++good;
  }
  EXPECT_GE(good, kKicks - 1);
}

TEST(KickReport, DoesNotDependOnTheNumberOfThreads) {
  KickReportSettings settings;
  settings.setup = agentTrialSetup(0);
  settings.kicks = 2;
  settings.threads = 1;
  const std::string alone = kickReportJson(measureKicks(settings));
  settings.threads = 3;
  EXPECT_EQ(kickReportJson(measureKicks(settings)), alone);
}

}  // namespace
}  // namespace nonet::lab
