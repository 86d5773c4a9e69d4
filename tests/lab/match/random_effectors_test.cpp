#include "nonet/lab/match/random_effectors.h"

#include <gtest/gtest.h>

namespace nonet::lab {
namespace {

// A longer run: nonet soak --effectors 60
TEST(RandomEffectors, NothingWellFormedBreaksThePhysics) {
  for (const std::uint64_t seed : {1U, 2U}) {
    RandomEffectorsSettings settings;
    settings.seed = seed;
    settings.beams = seed == 1U;
    settings.players = 3;
    settings.minutes = 0.4;
    const RandomEffectorsResult result = playRandomEffectors(settings);
    EXPECT_EQ(result.cycles, 1200);
    EXPECT_GT(result.messages, 4000);
    EXPECT_EQ(result.placed > 0, settings.beams);
    EXPECT_EQ(result.violations, 0U) << "seed " << seed << ": " << result.messagesOfViolations.at(0);
  }
}

TEST(RandomEffectors, TheSeedDecidesAllAndTheThreadsNothing) {
  RandomEffectorsSettings settings;
  settings.players = 2;
  settings.minutes = 0.05;
  const std::uint64_t first = playRandomEffectors(settings).signature;
  settings.threads = 2;
  EXPECT_EQ(playRandomEffectors(settings).signature, first);
  settings.seed = 2;
  EXPECT_NE(playRandomEffectors(settings).signature, first);
}

TEST(RandomEffectors, EndsWhenTold) {
  const RandomEffectorsResult result =
      playRandomEffectors({}, [](const RandomEffectorsResult& soFar) { return soFar.cycles < 10; });
  EXPECT_EQ(result.cycles, 10);
  EXPECT_TRUE(result.stopped);
}

}  // namespace
}  // namespace nonet::lab
