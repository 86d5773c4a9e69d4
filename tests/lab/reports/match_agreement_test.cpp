// Oracles: assignments written by hand, and matches in which the radio works or does not.
#include "nonet/lab/reports/match_agreement.h"

#include <gtest/gtest.h>

namespace nonet::lab {
namespace {

constexpr protocol::RoleVote kFirst = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};

TEST(Unity, SaysWhatPlayersHaveInCommon) {
  Unity unity = unityOf({{2, kFirst}, {3, kFirst}, {4, kFirst}});
  EXPECT_TRUE(unity.assignment && unity.onBall && unity.distinct);

  // Only those who are there count: 5 and 6 are not.
  unity = unityOf({{2, kFirst}, {3, protocol::RoleVote{0, 1, 2, 4, 3, 5, 6, 7, 8, 9}}});
  EXPECT_TRUE(unity.assignment && unity.onBall && unity.distinct);

  // 3 believes that 4 and it stand the other way round: the ball is undisputed, but 3 goes where 4 goes.
  unity = unityOf({{2, kFirst}, {3, protocol::RoleVote{0, 2, 1, 3, 4, 5, 6, 7, 8, 9}}, {4, kFirst}});
  EXPECT_FALSE(unity.assignment);
  EXPECT_TRUE(unity.onBall);
  EXPECT_FALSE(unity.distinct);

  // Two believe in different assignments that give both of them what they would have anyway.
  unity = unityOf({{2, protocol::RoleVote{0, 1, 3, 2, 4, 5, 6, 7, 8, 9}}, {3, kFirst}, {4, kFirst}});
  EXPECT_FALSE(unity.assignment);
  EXPECT_TRUE(unity.distinct);

  // Both go to the ball.
  unity = unityOf({{2, kFirst}, {3, protocol::RoleVote{1, 0, 2, 3, 4, 5, 6, 7, 8, 9}}});
  EXPECT_FALSE(unity.assignment || unity.onBall || unity.distinct);

  unity = unityOf({{2, kFirst}, {3, std::nullopt}});
  EXPECT_FALSE(unity.assignment || unity.onBall || unity.distinct);
}

MatchAgreement played(double lossShare) {
  MatchSettings match;
  match.left.players = match.right.players = 6;
  match.minutes = 0.25;
  match.kickOffWait = 2.0;
  match.settings.sayLossShare = lossShare;
  match.settings.quickSolver = true;
  MatchAgreement agreement;
  MatchObservers observers;
  observers.afterThought = [&](const Thought& thought) { agreement.afterThought(thought); };
  observers.afterCycle = [&](const sim::Simulation& simulation, const MatchWatcher&) {
    agreement.afterCycle(simulation);
    return true;
  };
  playInProcess(match, NONET_SOURCE_DIR, 1, observers);
  return agreement;
}

TEST(MatchAgreement, IsWhatTheRadioMakesOfIt) {
  const MatchAgreement with = played(0.0);
  ASSERT_EQ(with.teams().size(), 2U);
  for (const auto& [team, count] : with.teams()) EXPECT_GE(count.cycles, 600) << team;
  const MatchAgreement::Count heard = with.all();
  EXPECT_GE(heard.share(heard.assignment), 0.95);
  EXPECT_GE(heard.onBall, heard.assignment);
  EXPECT_GE(heard.distinct, heard.assignment);
  const MatchAgreement::Count deaf = played(1.0).all();
  EXPECT_LT(deaf.share(deaf.assignment), heard.share(heard.assignment) - 0.1);
}

}  // namespace
}  // namespace nonet::lab
