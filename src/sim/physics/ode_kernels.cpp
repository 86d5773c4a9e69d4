// The kernels under the names that ODE calls them by.
#include "sim/physics/ode_kernels.h"

namespace nonet::sim::ode_kernels {

namespace {

thread_local unsigned long calls = 0;

/// The factor ODE works on. It appends rows to it and takes such rows away again, but those that the
/// factorization left stay as they are while it solves with it.
thread_local struct {
  const double* l = nullptr;
  unsigned skip = 0;
  Blocks blocks;
} current;

const Blocks& blocksOf(const double* l, unsigned n, unsigned skip) {
  if (l != current.l || skip != current.skip || n < current.blocks.rows()) {
    // Another system, perhaps in the same memory: it starts with fewer rows, or with a factorization.
    current.l = nullptr;
    current.blocks.clear();
  }
  return current.blocks;
}

}  // namespace

void link() {}
unsigned long callsByOde() {
  return calls;
}

}  // namespace nonet::sim::ode_kernels

// ---- ODE's names for them; the template argument is the distance between the numbers of `d` and `b`. All
// else in the modules is hidden from other libraries, these are for ODE to find.

namespace kernels = nonet::sim::ode_kernels;

template <unsigned DStride>
[[gnu::visibility("default")]] void factorMatrixAsLDLT(double* a, double* d, unsigned n, unsigned skip);
template <unsigned BStride>
[[gnu::visibility("default")]] void solveL1Straight(const double* l, double* b, unsigned n, unsigned skip);
template <unsigned BStride>
[[gnu::visibility("default")]] void solveL1Transposed(const double* l, double* b, unsigned n, unsigned skip);

template <>
[[gnu::visibility("default")]] void factorMatrixAsLDLT<1>(double* a, double* d, unsigned n, unsigned skip) {
  ++kernels::calls;
  kernels::factorLdlt(a, d, n, skip);
  kernels::current.l = a;
  kernels::current.skip = skip;
  kernels::current.blocks.read(a, n, skip);
}
template <>
[[gnu::visibility("default")]] void solveL1Straight<1>(const double* l, double* b, unsigned n,
                                                       unsigned skip) {
  ++kernels::calls;
  kernels::solveL1(l, b, n, skip, kernels::blocksOf(l, n, skip));
}
template <>
[[gnu::visibility("default")]] void solveL1Transposed<1>(const double* l, double* b, unsigned n,
                                                         unsigned skip) {
  ++kernels::calls;
  kernels::solveL1Transposed(l, b, n, skip, kernels::blocksOf(l, n, skip));
}
