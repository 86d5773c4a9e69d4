#include "nonet/protocol/say_codec.h"

#include <algorithm>
#include <cmath>

#include "nonet/math/angle.h"

namespace nonet::protocol {

namespace {

// No blank, bracket, quote or comment sign: the server's parser leaves these alone.
constexpr std::string_view kAlphabet = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz+-";
constexpr int kBitsPerCharacter = 6;
constexpr int kCheckBits = 16;
constexpr int kPayloadBits = static_cast<int>(kSayLength) * kBitsPerCharacter - kCheckBits;

constexpr double kReachX = 17.0;     // m
constexpr double kReachY = 12.0;     // m
constexpr double kReachSpeed = 8.0;  // m/s
constexpr double kReachAge = 10.0;   // s
constexpr double kTimeStep = 0.4;    // s
constexpr std::uint32_t kNoTime = 31;
constexpr std::uint32_t kNoVote = (1U << 22U) - 1U;
constexpr std::array<double, 4> kSigmas{0.1, 0.3, 1.0, 3.0};

using Bits = std::array<bool, kSayLength * kBitsPerCharacter>;

class BitWriter {
 public:
  void put(std::uint32_t value, int count) {
    for (int i = count - 1; i >= 0; --i) bits[next_++] = ((value >> static_cast<unsigned>(i)) & 1U) != 0;
  }
  Bits bits{};

 private:
  std::size_t next_ = 0;
};

class BitReader {
 public:
  explicit BitReader(const Bits& bits) : bits_(bits) {}
  std::uint32_t get(int count) {
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i) value = value << 1U | (bits_[next_++] ? 1U : 0U);
    return value;
  }

 private:
  const Bits& bits_;
  std::size_t next_ = 0;
};

/// [-reach, reach] in 2^bits - 1 steps; `steps` even keeps 0 exact.
std::uint32_t quantize(double value, double reach, std::uint32_t steps) {
  if (std::isnan(value)) value = 0.0;
  const double share = std::clamp((value + reach) / (2.0 * reach), 0.0, 1.0);
  return static_cast<std::uint32_t>(std::lround(share * steps));
}
double restore(std::uint32_t code, double reach, std::uint32_t steps) {
  return std::min(code, steps) * (2.0 * reach) / steps - reach;
}
constexpr std::uint32_t kPlaceSteps = 1023;
constexpr std::uint32_t kSpeedSteps = 126;

std::uint16_t checkSum(const Bits& bits, std::string_view team) {
  // The start value mixes the team's name (FNV-1a), so that other teams with the same code are refused.
  std::uint32_t hash = 2166136261U;
  for (const char c : team) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  auto crc = static_cast<std::uint16_t>(hash ^ (hash >> 16U));
  for (int i = 0; i < kPayloadBits; ++i) {
    const bool top = (crc & 0x8000U) != 0;
    crc = static_cast<std::uint16_t>(crc << 1U);
    if (top != bits[static_cast<std::size_t>(i)]) crc ^= 0x1021U;
  }
  return crc;
}

constexpr std::uint32_t kPermutations = 3628800;  // 10!

std::array<std::uint32_t, kVoteSize> factorials() {
  std::array<std::uint32_t, kVoteSize> result{};
  result[0] = 1;
  for (std::uint32_t i = 1; i < kVoteSize; ++i) result[i] = result[i - 1] * i;
  return result;
}

}  // namespace

std::optional<std::uint32_t> permutationRank(const RoleVote& vote) {
  const auto factorial = factorials();
  std::uint32_t rank = 0;
  std::uint32_t used = 0;
  for (std::size_t i = 0; i < kVoteSize; ++i) {
    if (vote[i] >= kVoteSize || ((used >> vote[i]) & 1U) != 0) return std::nullopt;
    std::uint32_t smaller = 0;
    for (std::uint32_t value = 0; value < vote[i]; ++value) smaller += ((used >> value) & 1U) == 0 ? 1U : 0U;
    rank += smaller * factorial[kVoteSize - 1 - i];
    used |= 1U << vote[i];
  }
  return rank;
}

std::optional<RoleVote> permutationOfRank(std::uint32_t rank) {
  if (rank >= kPermutations) return std::nullopt;
  const auto factorial = factorials();
  RoleVote vote{};
  std::uint32_t used = 0;
  for (std::size_t i = 0; i < kVoteSize; ++i) {
    std::uint32_t skip = rank / factorial[kVoteSize - 1 - i];
    rank %= factorial[kVoteSize - 1 - i];
    std::uint8_t value = 0;
    while (((used >> value) & 1U) != 0 || skip-- > 0) ++value;
    vote[i] = value;
    used |= 1U << value;
  }
  return vote;
}

InlineString<64> encodeSay(const SayMessage& message, std::string_view team) {
  BitWriter writer;
  writer.put(kSayVersion, 3);
  writer.put(static_cast<std::uint32_t>(std::clamp(message.unum, 0, 15)), 4);
  writer.put(quantize(message.X_FR.translation.x(), kReachX, kPlaceSteps), 10);
  writer.put(quantize(message.X_FR.translation.y(), kReachY, kPlaceSteps), 10);
  const double heading = std::isfinite(message.X_FR.rotation) ? message.X_FR.rotation : 0.0;
  writer.put(static_cast<std::uint32_t>(std::lround(wrapAngle(heading) / (2.0 * kPi) * 128.0) & 127), 7);
  writer.put(message.fallen ? 1 : 0, 1);
  std::uint32_t accuracy = 0;
  while (accuracy < 3 && !(message.sigma <= kSigmas[accuracy])) ++accuracy;
  writer.put(accuracy, 2);
  const SayMessage::Ball ball = message.ball.value_or(SayMessage::Ball{});
  writer.put(message.ball ? 1 : 0, 1);
  writer.put(quantize(ball.p_FB.x(), kReachX, kPlaceSteps), 10);
  writer.put(quantize(ball.p_FB.y(), kReachY, kPlaceSteps), 10);
  writer.put(quantize(ball.v_FB.x(), kReachSpeed, kSpeedSteps), 7);
  writer.put(quantize(ball.v_FB.y(), kReachSpeed, kSpeedSteps), 7);
  const double age = ball.age > 0.0 ? std::min(ball.age, kReachAge) : 0.0;
  writer.put(static_cast<std::uint32_t>(std::lround(31.0 * std::sqrt(age / kReachAge))), 5);
  std::uint32_t time = kNoTime;
  if (message.timeToBall && *message.timeToBall >= 0.0) {
    time = static_cast<std::uint32_t>(std::lround(std::min(*message.timeToBall / kTimeStep, kNoTime - 1.0)));
  }
  writer.put(time, 5);
  writer.put(message.vote ? permutationRank(*message.vote).value_or(kNoVote) : kNoVote, 22);
  writer.put(checkSum(writer.bits, team), kCheckBits);

  std::array<char, kSayLength> text{};
  BitReader reader(writer.bits);
  for (char& c : text) c = kAlphabet[reader.get(kBitsPerCharacter)];
  return {std::string_view(text.data(), text.size())};
}

std::optional<SayMessage> decodeSay(std::string_view text, std::string_view team) {
  if (text.size() != kSayLength) return std::nullopt;
  BitWriter writer;
  for (const char c : text) {
    const std::size_t code = kAlphabet.find(c);
    if (code == std::string_view::npos) return std::nullopt;
    writer.put(static_cast<std::uint32_t>(code), kBitsPerCharacter);
  }
  BitReader reader(writer.bits);
  if (reader.get(3) != kSayVersion) return std::nullopt;
  std::optional<SayMessage> result(std::in_place);
  SayMessage& message = *result;
  message.unum = static_cast<int>(reader.get(4));
  message.X_FR.translation.x() = restore(reader.get(10), kReachX, kPlaceSteps);
  message.X_FR.translation.y() = restore(reader.get(10), kReachY, kPlaceSteps);
  message.X_FR.rotation = wrapAngle(reader.get(7) * (2.0 * kPi) / 128.0);
  message.fallen = reader.get(1) != 0;
  message.sigma = kSigmas[reader.get(2)];
  const bool ballKnown = reader.get(1) != 0;
  SayMessage::Ball& ball = message.ball.emplace();
  ball.p_FB.x() = restore(reader.get(10), kReachX, kPlaceSteps);
  ball.p_FB.y() = restore(reader.get(10), kReachY, kPlaceSteps);
  ball.v_FB.x() = restore(reader.get(7), kReachSpeed, kSpeedSteps);
  ball.v_FB.y() = restore(reader.get(7), kReachSpeed, kSpeedSteps);
  const double share = reader.get(5) / 31.0;
  ball.age = kReachAge * share * share;
  if (!ballKnown) message.ball.reset();
  const std::uint32_t time = reader.get(5);
  if (time != kNoTime) message.timeToBall = time * kTimeStep;
  const std::uint32_t vote = reader.get(22);
  if (vote != kNoVote) {
    message.vote = permutationOfRank(vote);
    if (!message.vote) return std::nullopt;
  }
  if (reader.get(kCheckBits) != checkSum(writer.bits, team)) return std::nullopt;
  if (message.unum < 1 || message.unum > 11) return std::nullopt;
  return result;
}

int saySlot(double serverTime) {
  const auto pair = static_cast<long long>(std::floor(serverTime / 0.04 + 0.25));
  return static_cast<int>(((pair % 11) + 11) % 11) + 1;
}

}  // namespace nonet::protocol
