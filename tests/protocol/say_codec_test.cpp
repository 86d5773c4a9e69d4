// Radio codec: round trip within the stated quantization, refusal of damaged and foreign messages.
#include "nonet/protocol/say_codec.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include <gtest/gtest.h>

#include "nonet/math/angle.h"
#include "nonet/math/random.h"

namespace nonet::protocol {
namespace {

RoleVote randomVote(Random& random) {
  RoleVote vote{};
  std::iota(vote.begin(), vote.end(), std::uint8_t{0});
  for (std::size_t i = vote.size(); i > 1; --i) std::swap(vote[i - 1], vote[random.below(i)]);
  return vote;
}

SayMessage randomMessage(Random& random) {
  SayMessage message;
  message.unum = 1 + static_cast<int>(random.below(11));
  message.X_FR = Pose2(random.uniform(-17, 17), random.uniform(-12, 12), random.uniform(-kPi, kPi));
  message.sigma = random.uniform(0.0, 2.0);
  message.fallen = random.below(2) == 0;
  if (random.below(4) != 0) {
    SayMessage::Ball ball;
    ball.p_FB = Vector2(random.uniform(-17, 17), random.uniform(-12, 12));
    ball.v_FB = Vector2(random.uniform(-8, 8), random.uniform(-8, 8));
    ball.age = random.uniform(0.0, 10.0);
    message.ball = ball;
  }
  if (random.below(4) != 0) message.timeToBall = random.uniform(0.0, 12.0);
  if (random.below(4) != 0) message.vote = randomVote(random);
  return message;
}

TEST(SayCodec, RoundTripStaysWithinTheStatedErrors) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const SayMessage sent = randomMessage(random);
    const auto text = encodeSay(sent, "Nonet");
    ASSERT_EQ(text.size(), kSayLength);
    const auto got = decodeSay(text, "Nonet");
    ASSERT_TRUE(got);
    EXPECT_EQ(got->unum, sent.unum);
    EXPECT_EQ(got->fallen, sent.fallen);
    EXPECT_LE(std::abs(got->X_FR.translation.x() - sent.X_FR.translation.x()), 0.017);
    EXPECT_LE(std::abs(got->X_FR.translation.y() - sent.X_FR.translation.y()), 0.012);
    EXPECT_LE(std::abs(angleDifference(got->X_FR.rotation, sent.X_FR.rotation)), kPi / 128 + 1e-9);
    if (sent.sigma < 1.0) {
      EXPECT_LE(sent.sigma, got->sigma);  // never better than it was
    }
    ASSERT_EQ(got->ball.has_value(), sent.ball.has_value());
    if (sent.ball) {
      EXPECT_LE(std::abs(got->ball->p_FB.x() - sent.ball->p_FB.x()), 0.017);
      EXPECT_LE(std::abs(got->ball->p_FB.y() - sent.ball->p_FB.y()), 0.012);
      EXPECT_LE((got->ball->v_FB - sent.ball->v_FB).cwiseAbs().maxCoeff(), 0.064);
      EXPECT_LE(std::abs(got->ball->age - sent.ball->age), 0.33);
      if (sent.ball->age < 1.0) {
        EXPECT_LE(std::abs(got->ball->age - sent.ball->age), 0.11);
      }
    }
    ASSERT_EQ(got->timeToBall.has_value(), sent.timeToBall.has_value());
    if (sent.timeToBall) {
      EXPECT_LE(std::abs(*got->timeToBall - *sent.timeToBall), 0.2 + 1e-9);
    }
    EXPECT_EQ(got->vote, sent.vote);
  }
}

TEST(SayCodec, UsesOnlyCharactersTheServerPassesOn) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const auto text = encodeSay(randomMessage(random), "Nonet");
    for (const char c : text.view()) {
      EXPECT_TRUE(c > 0x20 && c < 0x7F);
      EXPECT_EQ(std::string_view("()'\";").find(c), std::string_view::npos);
    }
  }
}

TEST(SayCodec, EveryChangeOfOneCharacterIsRefused) {
  Random random(3);
  for (int i = 0; i < 40; ++i) {
    const auto text = encodeSay(randomMessage(random), "Nonet");
    for (std::size_t place = 0; place < kSayLength; ++place) {
      for (int value = 0; value < 256; ++value) {
        std::string damaged(text.view());
        if (damaged[place] == static_cast<char>(value)) continue;
        damaged[place] = static_cast<char>(value);
        ASSERT_FALSE(decodeSay(damaged, "Nonet")) << damaged;
      }
    }
  }
}

TEST(SayCodec, RefusesOtherTeamsLengthsAndNoise) {
  Random random(4);
  const auto text = encodeSay(randomMessage(random), "Nonet");
  EXPECT_FALSE(decodeSay(text, "Other"));
  EXPECT_FALSE(decodeSay(text, ""));
  EXPECT_FALSE(decodeSay(text.view().substr(1), "Nonet"));
  EXPECT_FALSE(decodeSay(std::string(text.view()) + "0", "Nonet"));
  EXPECT_FALSE(decodeSay("", "Nonet"));
  int accepted = 0;
  for (int i = 0; i < 200000; ++i) {
    std::string noise;
    for (std::size_t k = 0; k < kSayLength; ++k) noise += text.view()[random.below(kSayLength)];
    if (noise != text.view() && decodeSay(noise, "Nonet")) ++accepted;
  }
  EXPECT_LE(accepted, 12);  // about 200000 / 65536 / 8 (version) are expected
}

TEST(SayCodec, ValuesOutOfRangeAreClipped) {
  SayMessage message;
  message.unum = 11;
  message.X_FR = Pose2(99.0, -99.0, 7.0);
  message.sigma = std::numeric_limits<double>::quiet_NaN();
  message.ball = SayMessage::Ball{Vector2(-99.0, 99.0), Vector2(std::nan(""), 50.0), 1e9};
  message.timeToBall = 1e9;
  const auto got = decodeSay(encodeSay(message, "A"), "A");
  ASSERT_TRUE(got);
  EXPECT_DOUBLE_EQ(got->X_FR.translation.x(), 17.0);
  EXPECT_DOUBLE_EQ(got->X_FR.translation.y(), -12.0);
  EXPECT_NEAR(got->X_FR.rotation, wrapAngle(7.0), kPi / 128);
  EXPECT_DOUBLE_EQ(got->sigma, 3.0);
  EXPECT_DOUBLE_EQ(got->ball->v_FB.x(), 0.0);
  EXPECT_DOUBLE_EQ(got->ball->v_FB.y(), 8.0);
  EXPECT_DOUBLE_EQ(got->ball->age, 10.0);
  EXPECT_DOUBLE_EQ(*got->timeToBall, 12.0);
}

TEST(SayCodec, RanksArePermutationsInOrder) {
  // Oracle: std::next_permutation runs through them in the same order.
  RoleVote vote{};
  std::iota(vote.begin(), vote.end(), std::uint8_t{0});
  for (std::uint32_t rank = 0; rank < 5000; ++rank) {
    ASSERT_EQ(permutationRank(vote), rank);
    ASSERT_EQ(permutationOfRank(rank), vote);
    std::next_permutation(vote.begin(), vote.end());
  }
  std::sort(vote.rbegin(), vote.rend());
  EXPECT_EQ(permutationRank(vote), 3628799U);
  EXPECT_FALSE(permutationOfRank(3628800));
  EXPECT_FALSE(permutationRank({0, 0, 1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_FALSE(permutationRank({0, 1, 2, 3, 4, 5, 6, 7, 8, 10}));
}

TEST(SayCodec, EachNumberHasTwoCyclesOfItsOwn) {
  // With the printed, rounded times of the server, over many rounds.
  std::map<int, int> counts;
  for (int cycle = 0; cycle < 22 * 500; ++cycle) {
    const double printed = std::round((3.0 + cycle * 0.02) * 100.0) / 100.0;
    const int slot = saySlot(printed);
    ASSERT_GE(slot, 1);
    ASSERT_LE(slot, 11);
    ++counts[slot];
    ASSERT_EQ(slot, saySlot(3.0 + (cycle - cycle % 2) * 0.02)) << cycle;
  }
  for (const auto& [slot, count] : counts) EXPECT_EQ(count, 1000) << slot;
}

}  // namespace
}  // namespace nonet::protocol
