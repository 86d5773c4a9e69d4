// Saving and restoring plain values as they lie in memory. A saved state is for the same build of the
// program.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace nonet::sim {

// Eigen's fixed-size vectors are plain values although their copy constructors are written out, so "trivially
// copyable" would be too strict; whatever owns memory has a destructor.
template <class T>
inline constexpr bool kIsPlain = std::is_trivially_destructible_v<T> && !std::is_pointer_v<T>;

template <class T>
void put(std::vector<std::uint8_t>& out, const T& value) {
  static_assert(kIsPlain<T>);
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(&value);
  out.insert(out.end(), bytes, bytes + sizeof(T));
}

template <class T>
void take(std::span<const std::uint8_t>& in, T& value) {
  static_assert(kIsPlain<T>);
  if (in.size() < sizeof(T)) throw std::runtime_error("saved simulation state is too short");
  std::copy_n(in.data(), sizeof(T), reinterpret_cast<std::uint8_t*>(&value));
  in = in.subspan(sizeof(T));
}

/// The next value. Names its type: `taken<int>(in)`.
template <class T>
T taken(std::span<const std::uint8_t>& in) {
  T value{};
  take(in, value);
  return value;
}

template <class T>
void putArray(std::vector<std::uint8_t>& out, const T* values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) put(out, values[i]);
}

template <class T>
void takeArray(std::span<const std::uint8_t>& in, T* values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) take(in, values[i]);
}

/// With their number.
template <class T>
void putAll(std::vector<std::uint8_t>& out, const std::vector<T>& values) {
  put(out, values.size());
  for (const T& value : values) put(out, value);
}

template <class T>
void takeAll(std::span<const std::uint8_t>& in, std::vector<T>& values) {
  std::size_t count = 0;
  take(in, count);
  if (count > in.size() / sizeof(T)) throw std::runtime_error("saved simulation state is damaged");
  values.resize(count);
  for (T& value : values) take(in, value);
}

}  // namespace nonet::sim
