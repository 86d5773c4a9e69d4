// Oracles: shares reckoned by hand, and matches whose end is known: three robots alone that kick, and the
// same match without the measurement.
#include "nonet/lab/reports/match_kicks.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace nonet::lab {
namespace {

MatchKick kickOf(double intended, double carried, double went) {
  MatchKick kick;
  kick.intended = intended;
  kick.carried = carried;
  kick.went = went;
  kick.contact = carried > 0.0;
  return kick;
}

TEST(KickShares, AreMediansOfAll) {
  EXPECT_EQ(kickShares({}).kicks, 0);
  const KickShares shares =
      kickShares({kickOf(10.0, 9.0, 3.0), kickOf(4.0, 0.0, 0.0), kickOf(8.0, 8.8, 8.0)});
  EXPECT_EQ(shares.kicks, 3);
  EXPECT_NEAR(shares.missed, 1.0 / 3.0, 1e-12);
  EXPECT_DOUBLE_EQ(shares.intended, 8.0);
  EXPECT_DOUBLE_EQ(shares.carriedShare, 0.9);
  EXPECT_DOUBLE_EQ(shares.wentShare, 0.3);
  EXPECT_NEAR(shares.underHalf, 1.0 / 3.0, 1e-12);
}

TEST(KickShares, JudgeTheDirectionOfThoseThatHit) {
  std::vector<MatchKick> kicks;
  for (int i = 0; i <= 10; ++i) {
    kicks.push_back(kickOf(10.0, 9.0, 9.0));
    kicks.back().direction = (i % 2 == 0 ? 0.01 : -0.01) * i;  // to either side
  }
  kicks.push_back(kickOf(10.0, 0.0, 0.0));  // no contact: has no direction
  const KickShares shares = kickShares(kicks);
  EXPECT_NEAR(shares.directionError, 0.05, 1e-12);
  EXPECT_NEAR(shares.directionErrorTenth, 0.09, 1e-12);
  EXPECT_EQ(kickShares({kickOf(10.0, 0.0, 0.0)}).directionError, 0.0);
}

struct Played {
  MatchKicks kicks;
  MatchResult result;
};
Played played(bool watched) {
  MatchSettings match;
  match.left.players = 3;
  match.right.players = 0;
  match.minutes = 1.0;
  match.kickOffWait = 2.0;
  match.settings.quickSolver = true;
  Played played;
  MatchObservers observers;
  if (watched) {
    observers.afterThought = [&](const Thought& thought) { played.kicks.afterThought(thought); };
    observers.afterCycle = [&](const sim::Simulation& simulation, const MatchWatcher&) {
      played.kicks.afterCycle(simulation);
      return true;
    };
  }
  played.result = playInProcess(match, NONET_SOURCE_DIR, 1, observers);
  return played;
}

TEST(MatchKicks, GoAsFarAsMeantWhereNobodyIsInTheWay) {
  const Played alone = played(true);
  const KickShares shares = kickShares(alone.kicks.kicks());
  ASSERT_GE(shares.kicks, 3);
  EXPECT_GE(shares.intended, 2.0);
  EXPECT_GE(shares.carriedShare, 0.8);
  EXPECT_LE(shares.carriedShare, 1.6);
  for (const MatchKick& kick : alone.kicks.kicks()) {
    EXPECT_GE(kick.unum, 1);
    EXPECT_LE(kick.unum, 3);
    EXPECT_GE(kick.time, 0.0);
    EXPECT_LE(kick.time, 60.0);
    EXPECT_FALSE(kick.name.empty());
    if (!kick.contact) {
      EXPECT_EQ(kick.carried, 0.0);
      EXPECT_EQ(kick.direction, 0.0);
    }
    EXPECT_LT(std::abs(kick.direction), 0.5) << kick.name << " at " << kick.time;
  }
  EXPECT_EQ(played(false).result.signature, alone.result.signature);
}

}  // namespace
}  // namespace nonet::lab
