#include "nonet/math/random.h"

#include <bit>
#include <cmath>

namespace nonet {

namespace {

std::uint64_t splitmix(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

}  // namespace

Random::Random(std::uint64_t seed) {
  for (auto& word : words_) word = splitmix(seed);
}

std::uint64_t Random::next() {
  const std::uint64_t result = std::rotl(words_[0] + words_[3], 23) + words_[0];
  const std::uint64_t t = words_[1] << 17;
  words_[2] ^= words_[0];
  words_[3] ^= words_[1];
  words_[1] ^= words_[2];
  words_[0] ^= words_[3];
  words_[2] ^= t;
  words_[3] = std::rotl(words_[3], 45);
  return result;
}

double Random::uniform() {
  return static_cast<double>(next() >> 11) * 0x1.0p-53;
}

std::uint64_t Random::below(std::uint64_t count) {
  // Rejection keeps every value equally likely.
  const std::uint64_t limit = UINT64_MAX - UINT64_MAX % count;
  std::uint64_t value = next();
  while (value >= limit) value = next();
  return value % count;
}

double Random::normal() {
  if (hasPendingNormal_) {
    hasPendingNormal_ = false;
    return pendingNormal_;
  }
  double u = 0.0;
  double v = 0.0;
  double square = 0.0;
  do {
    u = uniform(-1.0, 1.0);
    v = uniform(-1.0, 1.0);
    square = u * u + v * v;
  } while (square >= 1.0 || square == 0.0);
  const double scale = std::sqrt(-2.0 * std::log(square) / square);
  pendingNormal_ = v * scale;
  hasPendingNormal_ = true;
  return u * scale;
}

Random Random::fork(std::uint64_t stream) const {
  std::uint64_t mix =
      words_[0] ^ std::rotl(words_[3], 17) ^ (stream * 0xd1342543de82ef95ULL + 0x632be59bd9b4e019ULL);
  return Random(splitmix(mix));
}

Random::State Random::state() const {
  return {words_[0],
          words_[1],
          words_[2],
          words_[3],
          hasPendingNormal_ ? 1ULL : 0ULL,
          std::bit_cast<std::uint64_t>(pendingNormal_)};
}

void Random::setState(const State& state) {
  for (int i = 0; i < 4; ++i) words_[i] = state[i];
  hasPendingNormal_ = state[4] != 0;
  pendingNormal_ = std::bit_cast<double>(state[5]);
}

}  // namespace nonet
