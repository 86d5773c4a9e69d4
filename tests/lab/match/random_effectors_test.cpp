#include "nonet/lab/match/random_effectors.h"

#include <gtest/gtest.h>

namespace nonet::lab {
namespace {

// A longer run: nonet soak --effectors 60
TEST(RandomEffectors, NothingWellFormedBreaksThePhysics) {
  for (const std::uint64_t seed : {1U, 2U}) {
    RandomEffectorsChoice choice;
    choice.seed = seed;
    choice.beams = seed == 1U;
    choice.players = 3;
    choice.minutes = 0.4;
    const RandomEffectorsResult result = playRandomEffectors(choice);
    EXPECT_EQ(result.cycles, 1200);
    EXPECT_GT(result.messages, 4000);
    EXPECT_EQ(result.violations, 0U) << "seed " << seed << ": " << result.messagesOfViolations.at(0);
  }
}

TEST(RandomEffectors, TheSeedDecidesAllAndTheThreadsNothing) {
  RandomEffectorsChoice choice;
  choice.players = 2;
  choice.minutes = 0.05;
  const std::uint64_t first = playRandomEffectors(choice).signature;
  choice.threads = 2;
  EXPECT_EQ(playRandomEffectors(choice).signature, first);
  choice.seed = 2;
  EXPECT_NE(playRandomEffectors(choice).signature, first);
}

TEST(RandomEffectors, EndsWhenTold) {
  const RandomEffectorsResult result =
      playRandomEffectors({}, [](const RandomEffectorsResult& soFar) { return soFar.cycles < 10; });
  EXPECT_EQ(result.cycles, 10);
  EXPECT_TRUE(result.stopped);
}

}  // namespace
}  // namespace nonet::lab
