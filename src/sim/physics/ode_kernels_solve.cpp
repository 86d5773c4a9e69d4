// L x = b and L^T x = b.
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "sim/physics/ode_kernels.h"
#include "sim/physics/ode_kernels_vectors.h"

namespace nonet::sim::ode_kernels {

namespace {

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

NONET_INLINE void solveL1Body(const double* l, double* b, unsigned n, std::size_t skip,
                              const Blocks& blocks) {
  thread_local std::vector<double> buffer;
  const unsigned whole = n - n % 4;
  double* sums = scratch(buffer, whole);
  std::fill_n(sums, whole, 0.0);
  if (whole > 0) solveBlock(l, skip, 0, sums, b);
  for (unsigned i = 4; i < whole; i += 4) {
    const double* last = b + i - 4;
    const bool zero = last[0] == 0.0 && last[1] == 0.0 && last[2] == 0.0 && last[3] == 0.0;
    const Known known(last);
    const auto below = zero ? std::span<const unsigned>() : blocks.below(i - 4);
    const bool nextToo = !below.empty() && below.front() == i;
    if (nextToo || (!zero && i >= blocks.rows())) addColumns(l, skip, i, i - 4, known, sums);
    solveBlock(l, skip, i, sums, b);
    if (zero) continue;  // the products are zero and change no sum
    for (const unsigned row : below.subspan(nextToo ? 1 : 0)) {
      addColumns(l, skip, row, i - 4, known, sums);
    }
    for (unsigned row = std::max(i + 4, blocks.rows()); row < whole; row += 4) {
      addColumns(l, skip, row, i - 4, known, sums);
    }
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

NONET_INLINE void solveL1TransposedBody(const double* l, double* b, unsigned n, std::size_t skip,
                                        const Blocks& blocks) {
  thread_local std::vector<double> buffer;
  const unsigned whole = n - n % 4;
  double* sums = scratch(buffer, whole);
  std::fill_n(sums, whole, 0.0);
  startTransposed(l, b, n, skip, sums);
  if (whole == 0) return;
  solveBlockTransposed(l, skip, whole - 4, sums, b);
  for (unsigned i = whole - 4; i > 0; i -= 4) {  // the last block solved
    const Known known(b + i);
    if (i >= blocks.rows()) {
      addRows(l, skip, i, i - 4, known, sums);
      solveBlockTransposed(l, skip, i - 4, sums, b);
      for (unsigned column = 0; column + 4 < i; column += 4) addRows(l, skip, i, column, known, sums);
      continue;
    }
    auto left = blocks.left(i);
    if (!left.empty() && left.back() == i - 4) {
      addRows(l, skip, i, i - 4, known, sums);
      left = left.first(left.size() - 1);
    }
    solveBlockTransposed(l, skip, i - 4, sums, b);
    for (const unsigned column : left) addRows(l, skip, i, column, known, sums);
  }
}

[[gnu::target("avx2")]] void solveL1Avx2(const double* l, double* b, unsigned n, unsigned skip,
                                         const Blocks& blocks) {
  solveL1Body(l, b, n, skip, blocks);
}
[[gnu::target("avx2")]] void solveL1TransposedAvx2(const double* l, double* b, unsigned n, unsigned skip,
                                                   const Blocks& blocks) {
  solveL1TransposedBody(l, b, n, skip, blocks);
}

}  // namespace

void Blocks::clear() {
  rows_ = 0;
  inRow_.clear();
  inColumn_.clear();
  rowBegin_.assign(1, 0);
  columnBegin_.assign(1, 0);
}

void Blocks::read(const double* l, unsigned n, unsigned skip) {
  clear();
  rows_ = n - n % 4;
  const unsigned lines = rows_ / 4;
  full_.assign(std::size_t{lines} * lines, 0);
  const auto zero = [l, skip](unsigned row, unsigned column) {
    const double* at = l + std::size_t{row} * skip + column;
    for (unsigned r = 0; r < 4; ++r, at += skip) {
      if (at[0] != 0.0 || at[1] != 0.0 || at[2] != 0.0 || at[3] != 0.0) return false;
    }
    return true;
  };
  for (unsigned row = 0; row < lines; ++row) {
    for (unsigned column = 0; column < row; ++column) {
      if (zero(4 * row, 4 * column)) continue;
      inRow_.push_back(4 * column);
      full_[std::size_t{column} * lines + row] = 1;
    }
    rowBegin_.push_back(static_cast<unsigned>(inRow_.size()));
  }
  for (unsigned column = 0; column < lines; ++column) {
    for (unsigned row = column + 1; row < lines; ++row) {
      if (full_[std::size_t{column} * lines + row] != 0) inColumn_.push_back(4 * row);
    }
    columnBegin_.push_back(static_cast<unsigned>(inColumn_.size()));
  }
}

void solveL1(const double* l, double* b, unsigned n, unsigned skip, const Blocks& blocks) {
  kHasAvx2 ? solveL1Avx2(l, b, n, skip, blocks) : solveL1Body(l, b, n, skip, blocks);
}
void solveL1Transposed(const double* l, double* b, unsigned n, unsigned skip, const Blocks& blocks) {
  kHasAvx2 ? solveL1TransposedAvx2(l, b, n, skip, blocks) : solveL1TransposedBody(l, b, n, skip, blocks);
}

}  // namespace nonet::sim::ode_kernels
