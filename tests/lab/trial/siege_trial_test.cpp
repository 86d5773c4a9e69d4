// Four against a goalie and six: who can walk scores, who cannot does not, and each attack ends in one way.
#include "nonet/lab/trial/siege_trial.h"

#include <gtest/gtest.h>

#include "lab/trial_setup.h"

namespace nonet::lab {
namespace {

constexpr double kLongest = 25.0;  // s
constexpr int kSieges = 6;

Defence lameDefence() {
  return {lameAgent(0), lameAgent(2)};
}

int endsOf(const Siege& siege) {
  return (siege.goal ? 1 : 0) + (siege.corner ? 1 : 0) + (siege.out ? 1 : 0) + (siege.lost ? 1 : 0);
}

int goalsOf(const agent::AgentSettings& agent, const Defence& defence) {
  int goals = 0;
  for (std::uint64_t seed = 1; seed <= kSieges; ++seed) {
    const Siege siege = siegeOnce(agent, defence, quick(), seed);
    EXPECT_LE(endsOf(siege), 1);
    EXPECT_LE(siege.simulated, kLongest + 0.1);
    // Without an end it lasts as long as it may.
    EXPECT_TRUE(endsOf(siege) == 1 || siege.simulated > kLongest - 0.1);
    goals += siege.goal ? 1 : 0;
  }
  return goals;
}

TEST(SiegeTrial, WhoCanWalkScoresAgainstWhoCannot) {
  EXPECT_GE(goalsOf(agentOfType(2), lameDefence()), 4);
}

// One goal at most, by those who defend.
TEST(SiegeTrial, WhoCannotWalkScoresHardlyEver) {
  EXPECT_LE(goalsOf(lameAgent(2), {agentOfType(0), agentOfType(2)}), 1);
}

TEST(SiegeTrial, IsTheSameForTheSameSeed) {
  const agent::AgentSettings agent = agentOfType(2);
  const Siege first = siegeOnce(agent, lameDefence(), quick(), 3);
  const Siege again = siegeOnce(agent, lameDefence(), quick(), 3);
  const Siege other = siegeOnce(agent, lameDefence(), quick(), 4);
  EXPECT_EQ(first.simulated, again.simulated);
  EXPECT_EQ(first.goal, again.goal);
  EXPECT_NE(first.simulated, other.simulated);
}

}  // namespace
}  // namespace nonet::lab
