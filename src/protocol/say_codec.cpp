#include "nonet/protocol/say_codec.h"

#include <algorithm>
#include <cmath>

#include "nonet/math/angle.h"
#include "nonet/protocol/server_clock.h"

namespace nonet::protocol {

namespace {

// No blank, bracket, quote or comment sign: the server's parser leaves these alone.
constexpr std::string_view kAlphabet = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz+-";
constexpr int kBitsPerCharacter = 6;
constexpr int kCheckBits = 16;
constexpr int kPayloadBits = static_cast<int>(kSayLength) * kBitsPerCharacter - kCheckBits;

constexpr double kReachX = 17.0;      // m
constexpr double kReachY = 12.0;      // m
constexpr double kReachSpeed = 14.0;  // m/s
constexpr double kReachAge = 5.0;     // s
constexpr std::uint32_t kAgeSteps = 14;
constexpr std::uint32_t kNoBall = 15;
constexpr double kTimeStep = 0.4;    // s
constexpr double kFlightStep = 0.2;  // s
constexpr double kPassStep = 0.1;    // s
constexpr std::uint32_t kNoTime = 31;
constexpr std::uint32_t kNoVote = (1U << 22U) - 1U;
constexpr std::array<double, 4> kSigmas{0.1, 0.3, 1.0, 3.0};                     // m
constexpr std::array<double, 4> kSightingAges{0.1, 0.25, 0.5, kOldestSighting};  // s

constexpr double kSpeakers = 11.0;
constexpr double kFirstLongStep = 65536.0;  // s

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

// Places of so many bits; of an odd number of steps, as here, none is exactly 0.
void putPlace(BitWriter& writer, const Vector2& p_F, int bits) {
  const std::uint32_t steps = (1U << static_cast<unsigned>(bits)) - 1U;
  writer.put(quantize(p_F.x(), kReachX, steps), bits);
  writer.put(quantize(p_F.y(), kReachY, steps), bits);
}
Vector2 getPlace(BitReader& reader, int bits) {
  const std::uint32_t steps = (1U << static_cast<unsigned>(bits)) - 1U;
  const double x = restore(reader.get(bits), kReachX, steps);
  return {x, restore(reader.get(bits), kReachY, steps)};
}

// Finer for slow balls: the root of the speed is what has equal steps.
constexpr std::uint32_t kSpeedSteps = 126;
void putSpeed(BitWriter& writer, double speed) {
  const double root = std::copysign(std::sqrt(std::abs(speed) / kReachSpeed), speed);
  writer.put(quantize(root, 1.0, kSpeedSteps), 7);
}
double getSpeed(BitReader& reader) {
  const double root = restore(reader.get(7), 1.0, kSpeedSteps);
  return std::copysign(root * root, root) * kReachSpeed;
}

void putTime(BitWriter& writer, double time, double step, int bits) {
  const double most = (1U << static_cast<unsigned>(bits)) - 1U;
  writer.put(time > 0.0 ? static_cast<std::uint32_t>(std::lround(std::min(time / step, most))) : 0U, bits);
}

constexpr std::uint32_t kHeadings = 64;
void putHeading(BitWriter& writer, double heading) {
  const double turns = std::isfinite(heading) ? wrapAngle(heading) / (2.0 * kPi) : 0.0;
  writer.put(static_cast<std::uint32_t>(std::lround(turns * kHeadings)) % kHeadings, 6);
}
double getHeading(BitReader& reader) {
  return wrapAngle(reader.get(6) * (2.0 * kPi) / kHeadings);
}

/// The first of these that is not smaller; the last one if all are, also for NaN.
std::uint32_t firstNotBelow(double value, const std::array<double, 4>& steps) {
  std::uint32_t code = 0;
  while (code < steps.size() - 1 && !(value <= steps[code])) ++code;
  return code;
}

void putCommon(BitWriter& writer, const SayMessage& message) {
  putPlace(writer, message.X_FR.translation, 9);
  writer.put(message.fallen ? 1 : 0, 1);
  writer.put(firstNotBelow(message.sigma, kSigmas), 2);
  std::uint32_t time = kNoTime;
  if (message.timeToBall && *message.timeToBall >= 0.0)
    time = static_cast<std::uint32_t>(std::lround(std::min(*message.timeToBall / kTimeStep, kNoTime - 1.0)));
  writer.put(time, 5);
  writer.put(message.vote ? permutationRank(*message.vote).value_or(kNoVote) : kNoVote, 22);
}
bool getCommon(BitReader& reader, SayMessage& message) {
  message.X_FR.translation = getPlace(reader, 9);
  message.fallen = reader.get(1) != 0;
  message.sigma = kSigmas[reader.get(2)];
  const std::uint32_t time = reader.get(5);
  if (time != kNoTime) message.timeToBall = time * kTimeStep;
  const std::uint32_t vote = reader.get(22);
  if (vote != kNoVote) message.vote = permutationOfRank(vote);
  return vote == kNoVote || message.vote;
}

void putStatus(BitWriter& writer, const SayMessage& message) {
  putHeading(writer, message.X_FR.rotation);
  const SayBall ball = message.ball.value_or(SayBall{});
  const double age = ball.age > 0.0 ? std::min(ball.age, kReachAge) : 0.0;
  const auto ageCode = static_cast<std::uint32_t>(std::lround(kAgeSteps * std::sqrt(age / kReachAge)));
  writer.put(message.ball ? ageCode : kNoBall, 4);
  putPlace(writer, ball.p_FB, 10);
  putSpeed(writer, ball.v_FB.x());
  putSpeed(writer, ball.v_FB.y());
  // What flies is never told as rolling, however soon it lands.
  putTime(writer, ball.landsIn > 0.0 ? std::max(ball.landsIn, kFlightStep) : 0.0, kFlightStep, 3);
}
bool getStatus(BitReader& reader, SayMessage& message) {
  message.X_FR.rotation = getHeading(reader);
  const std::uint32_t age = reader.get(4);
  SayBall ball;
  ball.age = kReachAge * (age * age) / (kAgeSteps * kAgeSteps);
  ball.p_FB = getPlace(reader, 10);
  ball.v_FB.x() = getSpeed(reader);
  ball.v_FB.y() = getSpeed(reader);
  ball.landsIn = reader.get(3) * kFlightStep;
  if (age != kNoBall) message.ball = ball;
  return true;
}

constexpr int kLastNumber = 11;

void putPass(BitWriter& writer, const SayMessage& message) {
  putHeading(writer, message.X_FR.rotation);
  writer.put(static_cast<std::uint32_t>(std::clamp(message.pass.receiver, 1, kLastNumber)), 4);
  putPlace(writer, message.pass.p_FTarget, 10);
  putTime(writer, message.pass.untilKick, kPassStep, 5);
  putTime(writer, message.pass.untilThere, kPassStep, 6);
  writer.put(0, 6);
}
bool getPass(BitReader& reader, SayMessage& message) {
  message.X_FR.rotation = getHeading(reader);
  message.pass.receiver = static_cast<int>(reader.get(4));
  message.pass.p_FTarget = getPlace(reader, 10);
  message.pass.untilKick = reader.get(5) * kPassStep;
  message.pass.untilThere = reader.get(6) * kPassStep;
  return message.pass.receiver >= 1 && message.pass.receiver <= kLastNumber && reader.get(6) == 0;
}

constexpr int kSightingBits = 23;

void putSightings(BitWriter& writer, const SayMessage& message) {
  std::size_t told = 0;
  for (const SaySighting& sighting : message.sightings) {
    const bool number = sighting.unum >= 1 && sighting.unum <= kLastNumber;
    if (!number || !(sighting.age <= kOldestSighting)) continue;
    ++told;
    writer.put(static_cast<std::uint32_t>(sighting.unum), 4);
    putPlace(writer, sighting.p_FP, 8);
    writer.put(sighting.fallen ? 1 : 0, 1);
    writer.put(firstNotBelow(sighting.age, kSightingAges), 2);
  }
  for (; told < kSaySightings; ++told) writer.put(0, kSightingBits);
  writer.put(0, 1);
}
bool getSightings(BitReader& reader, SayMessage& message) {
  bool ended = false;
  for (SaySighting& sighting : message.sightings) {
    const auto unum = static_cast<int>(reader.get(4));
    if (unum == 0) {
      ended = true;
      if (reader.get(kSightingBits - 4) != 0) return false;
      continue;
    }
    if (ended || unum > kLastNumber) return false;
    sighting.unum = unum;
    sighting.p_FP = getPlace(reader, 8);
    sighting.fallen = reader.get(1) != 0;
    sighting.age = kSightingAges[reader.get(2)];
  }
  return reader.get(1) == 0;
}

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
  writer.put(static_cast<std::uint32_t>(message.kind), 2);
  writer.put(static_cast<std::uint32_t>(std::clamp(message.unum, 0, 15)), 4);
  putCommon(writer, message);
  if (message.kind == SayKind::Status) putStatus(writer, message);
  if (message.kind == SayKind::Pass) putPass(writer, message);
  if (message.kind == SayKind::Sightings) putSightings(writer, message);
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
  const std::uint32_t kind = reader.get(2);
  std::optional<SayMessage> result(std::in_place);
  SayMessage& message = *result;
  message.unum = static_cast<int>(reader.get(4));
  if (kind > static_cast<std::uint32_t>(SayKind::Sightings) || message.unum < 1 || message.unum > kLastNumber)
    return std::nullopt;
  message.kind = static_cast<SayKind>(kind);
  bool good = getCommon(reader, message);
  if (message.kind == SayKind::Status) good = getStatus(reader, message) && good;
  if (message.kind == SayKind::Pass) good = getPass(reader, message) && good;
  if (message.kind == SayKind::Sightings) good = getSightings(reader, message) && good;
  if (!good || reader.get(kCheckBits) != checkSum(writer.bits, team)) return std::nullopt;
  // Codes that are in range but that nobody of us sends, as a speed beyond the largest or a place of no ball.
  if (encodeSay(message, team).view() != text) return std::nullopt;
  return result;
}

// The printed times are hundredths, even ones for some seconds and then odd ones, since the server's clock
// drifts (server facts, conventions): an eighth keeps every one of them off the borders between the slots.
//
// From 65,536 s on the clock's step is so far from 0.02 s that a slot is two of its steps instead (the sum
// that began at 0 gets there so that an eighth does there, too). Where the sum stands still, whoever counts
// on does so by cycles.
int saySlot(double serverTime) {
  const double step = serverTime < kFirstLongStep ? 0.0 : serverStep(serverTime);
  const double time = tellsSum(serverTime) ? static_cast<double>(static_cast<float>(serverTime)) : serverTime;
  const double pair = std::floor(time / (2.0 * (step > 0.0 ? step : kCycleTime)) + 0.125);
  const double rest = std::fmod(pair, kSpeakers);
  return std::isfinite(rest) ? static_cast<int>(rest < 0.0 ? rest + kSpeakers : rest) + 1 : 1;
}

}  // namespace nonet::protocol
