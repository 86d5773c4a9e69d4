#include "sim/ode_kernels.h"

#include <algorithm>
#include <cstddef>
#include <vector>

// The work is written once, with GCC's vector types, and compiled twice: for every processor, and for those
// with AVX2, which are the ones it pays off on.
#define NONET_INLINE [[gnu::always_inline]] inline

namespace nonet::sim::ode_kernels {

namespace {

// Numbers side by side. (No function returns them by value: how that is done depends on the processor.)
struct Pair {
  using Numbers = double __attribute__((vector_size(16)));
  Numbers v;

  NONET_INLINE explicit Pair(const double* p) { __builtin_memcpy(&v, p, sizeof(v)); }
};

struct Quad {
  using Numbers = double __attribute__((vector_size(32)));
  Numbers v;

  NONET_INLINE explicit Quad(double all) : v(Numbers{} + all) {}
  NONET_INLINE explicit Quad(const double* p) { __builtin_memcpy(&v, p, sizeof(v)); }
  NONET_INLINE void store(double* p) const { __builtin_memcpy(p, &v, sizeof(v)); }
  NONET_INLINE void addProduct(const Quad& a, const Quad& b) { v += a.v * b.v; }
};

/// Memory that stays with the thread.
double* scratch(std::vector<double>& buffer, std::size_t size) {
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

/// Four known unknowns, each in all places of a vector.
struct Known {
  Quad x[4];
  NONET_INLINE explicit Known(const double* b) : x{Quad(b[0]), Quad(b[1]), Quad(b[2]), Quad(b[3])} {}
};

// Both solutions go block by block of four unknowns. ODE sums up each row when its turn comes; here, as soon
// as a block is known, its products go to the sums of all rows that are still to come: the same products in
// the same order. The next block's rows come first, and that block is solved before the others, because the
// four unknowns of a block have to wait for each other while the others' sums can go on.

// ---- L x = b

/// Adds the products of columns `column` ... `column` + 3 to the sums of rows `row` ... `row` + 3.
NONET_INLINE void addColumns(const double* l, std::size_t skip, unsigned row, unsigned column,
                             const Known& known, double* sums) {
  const double* at = l + row * skip + column;
  Quad sum(sums + row);
  Quad first(0.0);
  Quad second(0.0);
  loadColumns(at, skip, first, second);
  sum.addProduct(first, known.x[0]);
  sum.addProduct(second, known.x[1]);
  loadColumns(at + 2, skip, first, second);
  sum.addProduct(first, known.x[2]);
  sum.addProduct(second, known.x[3]);
  sum.store(sums + row);
}

NONET_INLINE void solveBlock(const double* l, std::size_t skip, unsigned i, const double* sums, double* b) {
  const double* row = l + i * skip + i;
  b[i] -= sums[i];
  b[i + 1] = b[i + 1] - sums[i + 1] - row[skip] * b[i];
  b[i + 2] = b[i + 2] - sums[i + 2] - row[2 * skip] * b[i] - row[2 * skip + 1] * b[i + 1];
  b[i + 3] = b[i + 3] - sums[i + 3] - row[3 * skip] * b[i] - row[3 * skip + 1] * b[i + 1] -
             row[3 * skip + 2] * b[i + 2];
}

/// The last n % 4 rows: ODE sums even and odd columns apart.
template <unsigned Rows>
NONET_INLINE void solveLastRows(const double* l, double* b, unsigned n, std::size_t skip) {
  const unsigned first = n - Rows;
  const double* rows = l + first * skip;
  Pair::Numbers sums[Rows] = {};
  for (unsigned k = 0; k < first; k += 2) {
    for (unsigned r = 0; r < Rows; ++r) sums[r] += Pair(rows + r * skip + k).v * Pair(b + k).v;
  }
  for (unsigned r = 0; r < Rows; ++r) {
    for (unsigned k = 0; k < r; ++k) sums[r][k % 2] += rows[r * skip + first + k] * b[first + k];
    b[first + r] -= sums[r][0] + sums[r][1];
  }
}

NONET_INLINE void solveL1Body(const double* l, double* b, unsigned n, std::size_t skip) {
  thread_local std::vector<double> buffer;
  const unsigned whole = n - n % 4;
  double* sums = scratch(buffer, whole);
  std::fill_n(sums, whole, 0.0);
  if (whole > 0) solveBlock(l, skip, 0, sums, b);
  for (unsigned i = 4; i < whole; i += 4) {
    const double* last = b + i - 4;
    const bool zero = last[0] == 0.0 && last[1] == 0.0 && last[2] == 0.0 && last[3] == 0.0;
    const Known known(last);
    if (!zero) addColumns(l, skip, i, i - 4, known, sums);
    solveBlock(l, skip, i, sums, b);
    if (zero) continue;  // the products are zero and change no sum
    for (unsigned row = i + 4; row < whole; row += 4) addColumns(l, skip, row, i - 4, known, sums);
  }
  if (n % 4 == 1) solveLastRows<1>(l, b, n, skip);
  if (n % 4 == 2) solveLastRows<2>(l, b, n, skip);
  if (n % 4 == 3) solveLastRows<3>(l, b, n, skip);
}

// ---- L^T x = b: from the last row upwards

/// Adds the products of rows `row` ... `row` + 3 to the sums of columns `column` ... `column` + 3.
NONET_INLINE void addRows(const double* l, std::size_t skip, unsigned row, unsigned column,
                          const Known& known, double* sums) {
  const double* at = l + row * skip + column;
  Quad sum(sums + column);
  sum.addProduct(Quad(at + 3 * skip), known.x[3]);
  sum.addProduct(Quad(at + 2 * skip), known.x[2]);
  sum.addProduct(Quad(at + skip), known.x[1]);
  sum.addProduct(Quad(at), known.x[0]);
  sum.store(sums + column);
}

NONET_INLINE void solveBlockTransposed(const double* l, std::size_t skip, unsigned i, const double* sums,
                                       double* b) {
  const double* row = l + i * skip + i;
  b[i + 3] -= sums[i + 3];
  b[i + 2] = b[i + 2] - sums[i + 2] - row[3 * skip + 2] * b[i + 3];
  b[i + 1] = b[i + 1] - sums[i + 1] - row[3 * skip + 1] * b[i + 3] - row[2 * skip + 1] * b[i + 2];
  b[i] = b[i] - sums[i] - row[3 * skip] * b[i + 3] - row[2 * skip] * b[i + 2] - row[skip] * b[i + 1];
}

/// The last n % 4 rows, which make a block of their own.
NONET_INLINE void startTransposed(const double* l, double* b, unsigned n, std::size_t skip, double* sums) {
  const unsigned whole = n - n % 4;
  for (unsigned i = n; i-- > whole;) {
    for (unsigned k = n; k-- > i + 1;) b[i] -= l[k * skip + i] * b[k];
  }
  for (unsigned i = n; i-- > whole;) {
    const Quad x(b[i]);
    for (unsigned column = 0; column < whole; column += 4) {
      Quad sum(sums + column);
      sum.addProduct(Quad(l + i * skip + column), x);
      sum.store(sums + column);
    }
  }
}

NONET_INLINE void solveL1TransposedBody(const double* l, double* b, unsigned n, std::size_t skip) {
  thread_local std::vector<double> buffer;
  const unsigned whole = n - n % 4;
  double* sums = scratch(buffer, whole);
  std::fill_n(sums, whole, 0.0);
  startTransposed(l, b, n, skip, sums);
  if (whole == 0) return;
  solveBlockTransposed(l, skip, whole - 4, sums, b);
  for (unsigned i = whole - 4; i > 0; i -= 4) {  // the last block solved
    const Known known(b + i);
    addRows(l, skip, i, i - 4, known, sums);
    solveBlockTransposed(l, skip, i - 4, sums, b);
    for (unsigned column = 0; column + 4 < i; column += 4) addRows(l, skip, i, column, known, sums);
  }
}

// ---- L D L^T
// ODE goes row pair by row pair; here it goes by pairs of columns, so that the sums of many rows advance
// together. `columns` holds X = L D by columns.

/// The columns k in which the rows i and i + 1 of L are not both zero, and what they hold. A product with
/// zero changes no sum, so the others need not be looked at; a robot's joints leave most of them zero.
struct RowPair {
  std::vector<unsigned> k;
  std::vector<double> first;
  std::vector<double> second;
  unsigned count = 0;

  NONET_INLINE void read(const double* row, unsigned skip, unsigned length) {
    if (k.size() < length) {
      k.resize(length);
      first.resize(length);
      second.resize(length);
    }
    count = 0;
    for (unsigned column = 0; column < length; ++column) {
      k[count] = column;
      first[count] = row[column];
      second[count] = row[column + skip];
      if (first[count] != 0.0 || second[count] != 0.0) ++count;
    }
  }
};

/// Columns i and i + 1 of X for the rows r ... r + 4 Quads - 1: what the columns hold minus the sums.
template <int Quads>
NONET_INLINE void subtractSums(const RowPair& rows, double* columns, std::size_t stride, unsigned i,
                               unsigned r) {
  Quad::Numbers first[Quads] = {};
  Quad::Numbers second[Quads] = {};
  for (unsigned index = 0; index < rows.count; ++index) {
    const double* column = columns + rows.k[index] * stride + r;
    const Quad l1(rows.first[index]);
    const Quad l2(rows.second[index]);
    for (int q = 0; q < Quads; ++q) {
      const Quad x(column + 4 * q);
      first[q] += l1.v * x.v;
      second[q] += l2.v * x.v;
    }
  }
  double* target = columns + i * stride + r;
  for (int q = 0; q < Quads; ++q, target += 4) {
    Quad x1(target);
    Quad x2(target + stride);
    x1.v -= first[q];
    x2.v -= second[q];
    x1.store(target);
    x2.store(target + stride);
  }
}

/// The last row of an odd number: ODE sums its diagonal's even and odd columns apart.
NONET_INLINE void factorLastRow(double* row, double* d, const double* columns, std::size_t stride,
                                unsigned i) {
  double even = 0.0;
  double odd = 0.0;
  for (unsigned k = 0; k < i; k += 2) {
    even += columns[k * stride + i] * row[k];
    odd += columns[(k + 1) * stride + i] * row[k + 1];
  }
  d[i] = 1.0 / (row[i] - (even + odd));
}

NONET_INLINE void factorBody(double* a, double* d, unsigned n, unsigned skip) {
  thread_local std::vector<double> buffer;
  thread_local RowPair rows;
  const std::size_t stride = n + 16 - n % 4;  // up to 16 rows are handled at once, the last ones in vain
  double* columns = scratch(buffer, stride * (n + 1));
  for (unsigned r = 0; r < n; ++r) {
    for (unsigned k = 0; k <= r; ++k) columns[k * stride + r] = a[std::size_t{r} * skip + k];
  }
  for (unsigned i = 0; i + 1 < n; i += 2) {
    double* row = a + std::size_t{i} * skip;
    // Rows i and i + 1 of L are complete up to column i.
    rows.read(row, skip, i);
    unsigned r = i - i % 4;
    for (; r + 8 < n; r += 16) subtractSums<4>(rows, columns, stride, i, r);
    for (; r < n; r += 8) subtractSums<2>(rows, columns, stride, i, r);
    double* first = columns + i * stride;
    double* second = first + stride;
    d[i] = 1.0 / first[i];
    const double coupling = first[i + 1] * d[i];
    for (r = i + 1; r < n; ++r) second[r] -= coupling * first[r];
    d[i + 1] = 1.0 / second[i + 1];
    row[skip + i] = coupling;
    for (r = i + 2; r < n; ++r) {
      a[std::size_t{r} * skip + i] = first[r] * d[i];
      a[std::size_t{r} * skip + i + 1] = second[r] * d[i + 1];
    }
  }
  if (n % 2 != 0) factorLastRow(a + std::size_t{n - 1} * skip, d, columns, stride, n - 1);
}

// ---- both instances

[[gnu::target("avx2")]] void solveL1Avx2(const double* l, double* b, unsigned n, unsigned skip) {
  solveL1Body(l, b, n, skip);
}
[[gnu::target("avx2")]] void solveL1TransposedAvx2(const double* l, double* b, unsigned n, unsigned skip) {
  solveL1TransposedBody(l, b, n, skip);
}
[[gnu::target("avx2")]] void factorAvx2(double* a, double* d, unsigned n, unsigned skip) {
  factorBody(a, d, n, skip);
}

const bool hasAvx2 = __builtin_cpu_supports("avx2");
thread_local unsigned long calls = 0;

}  // namespace

void factorLdlt(double* a, double* d, unsigned n, unsigned skip) {
  hasAvx2 ? factorAvx2(a, d, n, skip) : factorBody(a, d, n, skip);
}
void solveL1(const double* l, double* b, unsigned n, unsigned skip) {
  hasAvx2 ? solveL1Avx2(l, b, n, skip) : solveL1Body(l, b, n, skip);
}
void solveL1Transposed(const double* l, double* b, unsigned n, unsigned skip) {
  hasAvx2 ? solveL1TransposedAvx2(l, b, n, skip) : solveL1TransposedBody(l, b, n, skip);
}
void link() {}
unsigned long callsByOde() {
  return calls;
}

}  // namespace nonet::sim::ode_kernels

// ---- ODE's names for them; the template argument is the distance between the numbers of `d` and `b`.

namespace kernels = nonet::sim::ode_kernels;

template <unsigned DStride>
void factorMatrixAsLDLT(double* a, double* d, unsigned n, unsigned skip);
template <unsigned BStride>
void solveL1Straight(const double* l, double* b, unsigned n, unsigned skip);
template <unsigned BStride>
void solveL1Transposed(const double* l, double* b, unsigned n, unsigned skip);

template <>
void factorMatrixAsLDLT<1>(double* a, double* d, unsigned n, unsigned skip) {
  ++kernels::calls;
  kernels::factorLdlt(a, d, n, skip);
}
template <>
void solveL1Straight<1>(const double* l, double* b, unsigned n, unsigned skip) {
  ++kernels::calls;
  kernels::solveL1(l, b, n, skip);
}
template <>
void solveL1Transposed<1>(const double* l, double* b, unsigned n, unsigned skip) {
  ++kernels::calls;
  kernels::solveL1Transposed(l, b, n, skip);
}
