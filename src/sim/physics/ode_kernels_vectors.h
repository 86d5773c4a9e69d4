// Vectors of two and four numbers. The kernels are written once, with GCC's vector types, and compiled twice:
// for every processor, and for those with AVX2, which are the ones it pays off on.
#pragma once

#include <cstddef>
#include <vector>

#define NONET_INLINE [[gnu::always_inline]] inline

namespace nonet::sim::ode_kernels {

inline const bool kHasAvx2 = __builtin_cpu_supports("avx2");

// Numbers side by side. (No function returns them by value: how that is done depends on the processor.)
struct Pair {
  using Numbers = double __attribute__((vector_size(16)));
  Numbers v;

  NONET_INLINE explicit Pair(const double* p) { __builtin_memcpy(&v, p, sizeof(v)); }
};

struct Quad {
  using Numbers = double __attribute__((vector_size(32)));
  Numbers v;

  NONET_INLINE explicit Quad(double all) : v(Numbers{all, all, all, all}) {}
  NONET_INLINE explicit Quad(const double* p) { __builtin_memcpy(&v, p, sizeof(v)); }
  NONET_INLINE void store(double* p) const { __builtin_memcpy(p, &v, sizeof(v)); }
  NONET_INLINE void addProduct(const Quad& a, const Quad& b) { v += a.v * b.v; }
};

/// Memory that stays with the thread.
inline double* scratch(std::vector<double>& buffer, std::size_t size) {
  if (buffer.size() < size) buffer.resize(size);
  return buffer.data();
}

/// Two columns, `p` on, of four rows.
NONET_INLINE void loadColumns(const double* p, std::size_t skip, Quad& first, Quad& second) {
  const Pair rows[4] = {Pair(p), Pair(p + skip), Pair(p + 2 * skip), Pair(p + 3 * skip)};
  const Quad::Numbers even = __builtin_shufflevector(rows[0].v, rows[2].v, 0, 1, 2, 3);
  const Quad::Numbers odd = __builtin_shufflevector(rows[1].v, rows[3].v, 0, 1, 2, 3);
  first.v = __builtin_shufflevector(even, odd, 0, 4, 2, 6);
  second.v = __builtin_shufflevector(even, odd, 1, 5, 3, 7);
}

}  // namespace nonet::sim::ode_kernels
