// Radio codec: round trip within the stated quantization, refusal of damaged and foreign messages.
#include "nonet/protocol/say_codec.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <vector>

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

Vector2 randomPlace(Random& random) {
  return {random.uniform(-17, 17), random.uniform(-12, 12)};
}

SayMessage randomMessage(Random& random) {
  SayMessage message;
  message.kind = static_cast<SayKind>(random.below(3));
  message.unum = 1 + static_cast<int>(random.below(11));
  message.X_FR = Pose2(randomPlace(random), random.uniform(-kPi, kPi));
  message.sigma = random.uniform(0.0, 2.0);
  message.fallen = random.below(2) == 0;
  if (random.below(4) != 0) {
    SayMessage::Ball ball;
    ball.p_FB = randomPlace(random);
    ball.v_FB = Vector2(random.uniform(-14, 14), random.uniform(-14, 14)) * random.uniform();
    ball.age = random.uniform(0.0, 5.0);
    if (random.below(2) == 0) ball.landsIn = random.uniform(0.1, 1.4);
    message.ball = ball;
  }
  if (random.below(4) != 0) message.timeToBall = random.uniform(0.0, 12.0);
  if (random.below(4) != 0) message.vote = randomVote(random);
  message.pass = {1 + static_cast<int>(random.below(11)), randomPlace(random), random.uniform(0.0, 3.1),
                  random.uniform(0.0, 6.3)};
  for (std::size_t i = random.below(3); i > 0; --i) {
    message.sightings[i - 1] = {1 + static_cast<int>(random.below(11)), randomPlace(random),
                                random.below(2) == 0, random.uniform()};
  }
  return message;
}

void expectPlace(const Vector2& got, const Vector2& sent, double errorX, double errorY) {
  EXPECT_LE(std::abs(got.x() - sent.x()), errorX);
  EXPECT_LE(std::abs(got.y() - sent.y()), errorY);
}

void expectBall(const SayBall& got, const SayBall& sent) {
  expectPlace(got.p_FB, sent.p_FB, 0.017, 0.012);
  for (int i = 0; i < 2; ++i)
    EXPECT_LE(std::abs(got.v_FB[i] - sent.v_FB[i]), std::abs(sent.v_FB[i]) < 1.2 ? 0.07 : 0.23);
  EXPECT_LE(std::abs(got.age - sent.age), sent.age < 1.0 ? 0.17 : 0.36);
  EXPECT_EQ(got.landsIn > 0.0, sent.landsIn > 0.0);
  EXPECT_LE(std::abs(got.landsIn - sent.landsIn), 0.1 + 1e-9);
}

void expectSightings(const SayMessage& got, const SayMessage& sent) {
  for (std::size_t i = 0; i < kSaySightings; ++i) {
    const SaySighting& seen = sent.sightings[i];
    const SaySighting& told = got.sightings[i];
    ASSERT_EQ(told.unum, seen.unum);
    if (seen.unum == 0) continue;
    expectPlace(told.p_FP, seen.p_FP, 0.067, 0.048);
    EXPECT_EQ(told.fallen, seen.fallen);
    EXPECT_GE(told.age, seen.age);  // never told as newer than it is
    EXPECT_LE(told.age, std::max(0.1, 2.5 * seen.age));
  }
}

TEST(SayCodec, RoundTripStaysWithinTheStatedErrors) {
  Random random(1);
  std::map<SayKind, int> kinds;
  for (int i = 0; i < 30000; ++i) {
    const SayMessage sent = randomMessage(random);
    const auto text = encodeSay(sent, "Nonet");
    ASSERT_EQ(text.size(), kSayLength);
    const auto got = decodeSay(text, "Nonet");
    ASSERT_TRUE(got);
    ++kinds[got->kind];
    ASSERT_EQ(got->kind, sent.kind);
    EXPECT_EQ(got->unum, sent.unum);
    EXPECT_EQ(got->fallen, sent.fallen);
    expectPlace(got->X_FR.translation, sent.X_FR.translation, 0.034, 0.024);
    if (sent.sigma < 1.0) {
      EXPECT_LE(sent.sigma, got->sigma);  // never better than it was
    }
    ASSERT_EQ(got->timeToBall.has_value(), sent.timeToBall.has_value());
    if (sent.timeToBall) {
      EXPECT_LE(std::abs(*got->timeToBall - *sent.timeToBall), 0.2 + 1e-9);
    }
    EXPECT_EQ(got->vote, sent.vote);
    const bool status = sent.kind == SayKind::Status;
    if (sent.kind != SayKind::Sightings) {
      EXPECT_LE(std::abs(angleDifference(got->X_FR.rotation, sent.X_FR.rotation)), kPi / 64 + 1e-9);
    }
    ASSERT_EQ(got->ball.has_value(), status && sent.ball);
    if (got->ball) expectBall(*got->ball, *sent.ball);
    EXPECT_EQ(got->pass.receiver, sent.kind == SayKind::Pass ? sent.pass.receiver : 0);
    if (sent.kind == SayKind::Pass) {
      expectPlace(got->pass.p_FTarget, sent.pass.p_FTarget, 0.017, 0.012);
      EXPECT_LE(std::abs(got->pass.untilKick - sent.pass.untilKick), 0.05 + 1e-9);
      EXPECT_LE(std::abs(got->pass.untilThere - sent.pass.untilThere), 0.05 + 1e-9);
    }
    if (sent.kind == SayKind::Sightings) {
      expectSightings(*got, sent);
    } else {
      EXPECT_EQ(got->sightings[0].unum, 0);
    }
  }
  EXPECT_EQ(kinds.size(), 3U);
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
  message.ball->landsIn = 1e9;
  message.timeToBall = 1e9;
  const auto got = decodeSay(encodeSay(message, "A"), "A");
  ASSERT_TRUE(got);
  EXPECT_DOUBLE_EQ(got->X_FR.translation.x(), 17.0);
  EXPECT_DOUBLE_EQ(got->X_FR.translation.y(), -12.0);
  EXPECT_NEAR(got->X_FR.rotation, wrapAngle(7.0), kPi / 64);
  EXPECT_DOUBLE_EQ(got->sigma, 3.0);
  EXPECT_DOUBLE_EQ(got->ball->v_FB.x(), 0.0);
  EXPECT_DOUBLE_EQ(got->ball->v_FB.y(), 14.0);
  EXPECT_DOUBLE_EQ(got->ball->age, 5.0);
  EXPECT_DOUBLE_EQ(got->ball->landsIn, 1.4);
  EXPECT_DOUBLE_EQ(*got->timeToBall, 12.0);
}

TEST(SayCodec, PassesOutOfRangeAreClipped) {
  SayMessage message;
  message.kind = SayKind::Pass;
  message.unum = 1;
  message.pass = {99, Vector2(99.0, std::nan("")), 1e9, -1.0};
  const auto got = decodeSay(encodeSay(message, "A"), "A");
  ASSERT_TRUE(got);
  EXPECT_EQ(got->pass.receiver, 11);
  EXPECT_DOUBLE_EQ(got->pass.p_FTarget.x(), 17.0);
  EXPECT_DOUBLE_EQ(got->pass.untilKick, 3.1);
  EXPECT_DOUBLE_EQ(got->pass.untilThere, 0.0);
}

TEST(SayCodec, LeavesOutSightingsThatCannotBeTold) {
  SayMessage message;
  message.kind = SayKind::Sightings;
  message.unum = 1;
  message.sightings[0] = {4, Vector2(1.0, 1.0), false, 1.01};  // too old
  message.sightings[1] = {12, Vector2(1.0, 1.0), false, 0.0};  // no number
  auto got = decodeSay(encodeSay(message, "A"), "A");
  ASSERT_TRUE(got);
  EXPECT_EQ(got->sightings[0].unum, 0);
  message.sightings[1].unum = 11;  // comes first where nothing is before it
  got = decodeSay(encodeSay(message, "A"), "A");
  ASSERT_TRUE(got);
  EXPECT_EQ(got->sightings[0].unum, 11);
  EXPECT_EQ(got->sightings[1].unum, 0);
}

// The sender is slow or fast, near or far: told as flying is what flies, however short, and nothing else.
TEST(SayCodec, AFlyingBallIsNeverToldAsRolling) {
  SayMessage message;
  message.unum = 1;
  for (const double landsIn : {0.0, 1e-6, 0.09, 0.1, 0.7, 3.0}) {
    message.ball = SayMessage::Ball{Vector2::Zero(), Vector2(9.0, 0.0), 0.0, landsIn};
    const auto got = decodeSay(encodeSay(message, "A"), "A");
    ASSERT_TRUE(got && got->ball);
    EXPECT_EQ(got->ball->landsIn > 0.0, landsIn > 0.0) << landsIn;
  }
}

/// Any 104 bits with the right check behind them, as letters: the layout written down a second time.
std::string lettersOf(const std::array<bool, 104>& payload, std::string_view team) {
  constexpr std::string_view alphabet = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz+-";
  std::uint32_t hash = 2166136261U;
  for (const char c : team) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  std::uint32_t crc = (hash ^ (hash >> 16U)) & 0xFFFFU;
  std::vector<bool> bits(payload.begin(), payload.end());
  for (const bool bit : payload) {
    crc ^= bit ? 0x8000U : 0U;
    crc = ((crc << 1U) ^ ((crc & 0x8000U) != 0 ? 0x1021U : 0U)) & 0xFFFFU;
  }
  for (int i = 15; i >= 0; --i) bits.push_back(((crc >> static_cast<unsigned>(i)) & 1U) != 0);
  std::string text;
  for (std::size_t i = 0; i < bits.size(); i += 6) {
    std::size_t code = 0;
    for (std::size_t k = 0; k < 6; ++k) code = 2 * code + (bits[i + k] ? 1 : 0);
    text += alphabet[code];
  }
  return text;
}

// Whatever bits a sender puts behind a good check: what we ourselves would not send so is no message.
TEST(SayCodec, RefusesCodesThatNobodySends) {
  Random random(5);
  std::map<SayKind, int> accepted;
  int refused = 0;
  for (int i = 0; i < 60000; ++i) {
    std::array<bool, 104> payload{};
    for (bool& bit : payload) bit = random.below(2) == 1;
    payload[0] = payload[2] = false;  // version 2
    payload[1] = true;
    // Fewer of the bits that are zero in a good message.
    const int few = static_cast<int>(random.below(3));
    for (std::size_t k = 97; k < 104 && few > 0; ++k) payload[k] = false;
    for (std::size_t k = 80; k < 97 && few > 1; ++k) payload[k] = false;
    const std::string text = lettersOf(payload, "Nonet");
    const auto got = decodeSay(text, "Nonet");
    if (got) {
      ++accepted[got->kind];
      ASSERT_EQ(encodeSay(*got, "Nonet").view(), text);
    } else {
      ++refused;
    }
  }
  EXPECT_GT(accepted[SayKind::Status], 100);
  EXPECT_GT(accepted[SayKind::Pass], 100);
  EXPECT_GT(accepted[SayKind::Sightings], 100);
  EXPECT_GT(refused, 10000);
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

// The server adds up its time in single precision: the hundredths that it prints are even for a while, then
// odd. A number that begins one cycle after the one before it is heard by nobody (server facts 1.7).
TEST(SayCodec, EachNumberHasTwoCyclesOfItsOwnWhateverTheClockDrifts) {
  for (const float begin : {0.0F, 20.0F, 60.0F, 300.0F, 700.0F}) {
    float time = begin;
    int slot = 0;
    int turns = 0, shortTurns = 0;
    for (int cycle = 0, since = 0; cycle < 30000; ++cycle) {
      const double printed = std::round(static_cast<double>(time) * 100.0) / 100.0;
      if (saySlot(printed) != slot) {
        ++turns;
        if (turns > 2 && cycle - since < 2) ++shortTurns;
        since = cycle;
        slot = saySlot(printed);
      }
      time += 0.02F;
    }
    EXPECT_GT(turns, 14900) << begin;
    EXPECT_LT(shortTurns, 0.003 * turns) << begin;
  }
}

// After a day the steps are 0.0234, 0.0156 or 0.0313 s. The sum began at 0: its times are those that can
// come.
TEST(SayCodec, EachNumberHasTwoCyclesOfItsOwnForDays) {
  float time = 0.0F;
  for (const float day : {65600.0F, 131100.0F, 262200.0F}) {
    while (time < day) time += 0.02F;
    int turns = 0, shortTurns = 0, since = -10;
    int slot = 0;
    for (int cycle = 0; cycle < 30000; ++cycle, time += 0.02F) {
      const double printed = std::round(static_cast<double>(time) * 100.0) / 100.0;
      if (saySlot(printed) == slot) continue;
      EXPECT_TRUE(slot == 0 || saySlot(printed) == slot % 11 + 1) << day << " " << cycle;
      shortTurns += turns++ > 2 && cycle - since < 2 ? 1 : 0;
      since = cycle;
      slot = saySlot(printed);
    }
    EXPECT_NEAR(turns, 15000, 1) << day;
    EXPECT_EQ(shortTurns, 0) << day;
  }
  for (const double strange : {std::nan(""), HUGE_VAL, 1e300, -1e300, -0.04, 524288.0}) {
    EXPECT_GE(saySlot(strange), 1) << strange;
    EXPECT_LE(saySlot(strange), 11) << strange;
  }
}

}  // namespace
}  // namespace nonet::protocol
