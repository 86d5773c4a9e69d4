// Three against three around the ball: fair to equals, and won by who can walk.
#include "nonet/lab/trial/scrum_trial.h"

#include <gtest/gtest.h>

#include "lab/trial_setup.h"

namespace nonet::lab {
namespace {

// Both sides have each begin once, so equals gain nothing, to the last digit.
TEST(ScrumTrial, EqualsGainNothing) {
  const agent::AgentSettings agent = agentOfType(2);
  bool moved = false;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Scrum scrum = scrumOnce(ScrumBall::Contested, agent, agent, quick(), seed);
    EXPECT_NEAR(scrum.gained, 0.0, 1e-9);
    EXPECT_NEAR(scrum.territory, 0.0, 1e-9);
    EXPECT_EQ(scrum.falls, scrum.opponentFalls);
    EXPECT_EQ(scrum.charges, scrum.opponentCharges);
    EXPECT_LE(scrum.charges, 3.0);
    EXPECT_GT(scrum.simulated, 2.0);
    EXPECT_LE(scrum.simulated, 24.1);
    moved = moved || scrum.falls > 0.0 || scrum.simulated < 23.0;
  }
  EXPECT_TRUE(moved);
}

TEST(ScrumTrial, ALooseBallIsFairToo) {
  const agent::AgentSettings agent = agentOfType(2);
  const Scrum scrum = scrumOnce(ScrumBall::Loose, agent, agent, quick(), 4);
  EXPECT_NEAR(scrum.gained, 0.0, 1e-9);
  EXPECT_EQ(scrum.falls, scrum.opponentFalls);
  EXPECT_GT(scrum.simulated, 2.0);
}

TEST(ScrumTrial, WhoCannotWalkLosesGround) {
  const agent::AgentSettings lame = lameAgent(2);
  const agent::AgentSettings agent = agentOfType(2);
  double gained = 0.0;
  double lost = 0.0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    gained += 0.25 * scrumOnce(ScrumBall::Contested, agent, lame, quick(), seed).gained;
    lost += 0.25 * scrumOnce(ScrumBall::Contested, lame, agent, quick(), seed).gained;
  }
  EXPECT_GT(gained, 2.0);
  EXPECT_NEAR(lost, -gained, 1e-9);  // the same scrums, seen from the other side
}

}  // namespace
}  // namespace nonet::lab
