// Oracle: the listener's decoder and the capacity rule of the server.
#include "nonet/team/radio.h"

#include <map>

#include <gtest/gtest.h>

#include "nonet/protocol/say_codec.h"

namespace nonet::team {
namespace {

world::WorldState stateOf(int unum) {
  world::WorldState world;
  world.game.unum = unum;
  world.game.team.assign("Nonet");
  world.self.localized = true;
  world.self.covariance = Matrix3::Identity() * 1e-4;
  world.self.X_FR = Pose2(-3.0 + unum, 2.0, 0.5);
  world.ball.known = true;
  world.ball.p_FB = Vector3(1.0, -2.0, 0.04);
  world.ball.p_RB = Vector2(1.0, 0.0);
  return world;
}

TEST(Radio, EveryPlayerIsHeardOncePerRoundAndNobodyCollides) {
  std::array<Radio, 12> radios;
  std::map<int, int> spoken;
  int previousCycle = -10;
  const int rounds = 20;
  for (int cycle = 0; cycle < rounds * 22; ++cycle) {
    int speakers = 0;
    for (int unum = 1; unum <= 11; ++unum) {
      world::WorldState world = stateOf(unum);
      world.time = 100.0 + 0.02 * cycle;
      world.ball.lastSeen = world.time - 0.06;
      const auto say = radios[unum].update(world, {});
      if (!say) continue;
      ++speakers;
      ++spoken[unum];
      const auto heard = protocol::decodeSay(say->view(), "Nonet");
      ASSERT_TRUE(heard.has_value());
      EXPECT_EQ(heard->unum, unum);
      EXPECT_NEAR(heard->X_FR.translation.x(), -3.0 + unum, 0.02);
      ASSERT_TRUE(heard->ball.has_value());
      EXPECT_NEAR(heard->ball->p_FB.y(), -2.0, 0.02);
    }
    ASSERT_LE(speakers, 1);
    if (speakers == 1) {
      EXPECT_GE(cycle - previousCycle, 2) << "a listener hears one team mate in two cycles";
      previousCycle = cycle;
    }
  }
  for (int unum = 1; unum <= 11; ++unum) EXPECT_NEAR(spoken[unum], rounds, 1) << unum;
}

TEST(Radio, SaysNothingOfABallThatIsNotKnown) {
  Radio radio;
  world::WorldState world = stateOf(4);
  world.ball.known = false;
  for (int cycle = 0; cycle < 30; ++cycle) {
    world.time = 7.0 + 0.02 * cycle;
    const auto say = radio.update(world, {2.0, std::nullopt});
    if (!say) continue;
    const auto heard = protocol::decodeSay(say->view(), "Nonet");
    ASSERT_TRUE(heard.has_value());
    EXPECT_FALSE(heard->ball.has_value());
    EXPECT_FALSE(heard->timeToBall.has_value());
  }
}

}  // namespace
}  // namespace nonet::team
