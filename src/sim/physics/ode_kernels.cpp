#include "sim/physics/ode_kernels.h"

#include <algorithm>
#include <cstddef>
#include <span>
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

  NONET_INLINE explicit Quad(double all) : v(Numbers{all, all, all, all}) {}
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

// ---- L D L^T
// ODE sums up each row when its turn comes; here the products of a finished pair of columns go to the sums of
// all columns that are still to come: the same products in the same order. Blocks of rows in which the pair
// is zero are left out.

/// The lower triangle, column by column with `stride` numbers from one to the next.
struct Columns {
  std::size_t stride;
  double* x;             // X = L D; what `a` holds before it is a column's turn
  double* sums;          // what X's numbers are still to lose
  unsigned char* given;  // by blocks of rows and columns: not all zero in `a`
  unsigned* rows;        // first rows of the blocks that matter in the pair of columns in hand
  unsigned count = 0;    // of those rows

  struct Memory {
    std::vector<double> x;
    std::vector<double> sums;
    std::vector<unsigned char> given;
    std::vector<unsigned> rows;
  };

  NONET_INLINE Columns(unsigned n, Memory& memory) : stride(n + 8 - n % 4) {
    x = scratch(memory.x, stride * (n + 4));
    sums = scratch(memory.sums, stride * (n + 4));
    memory.given.assign((stride / 4) * (stride / 4), 0);
    given = memory.given.data();
    if (memory.rows.size() < stride / 4) memory.rows.resize(stride / 4);
    rows = memory.rows.data();
    for (unsigned k = 0; k < n; ++k) {
      const std::size_t begin = k * stride + k - k % 4;
      std::fill_n(x + begin, stride - k + k % 4, 0.0);
      std::fill_n(sums + begin, stride - k + k % 4, 0.0);
    }
  }

  NONET_INLINE void read(const double* a, unsigned n, unsigned skip) const {
    for (unsigned row = 0; row < n; row += 4) {
      for (unsigned column = 0; column < row; column += 4) {
        if (row + 4 <= n) {
          readBlock(a, skip, row, column);
        } else {
          readNumbers(a, skip, row, n, column);
        }
      }
      readNumbers(a, skip, row, std::min(row + 4, n), row);
    }
  }

 private:
  NONET_INLINE void readBlock(const double* a, unsigned skip, unsigned row, unsigned column) const {
    using Bits = long long __attribute__((vector_size(32)));
    const double* at = a + std::size_t{row} * skip + column;
    Bits lines[4];
    for (int r = 0; r < 4; ++r) __builtin_memcpy(&lines[r], at + r * std::size_t{skip}, sizeof(Bits));
    const Bits any = lines[0] | lines[1] | lines[2] | lines[3];
    if ((any[0] | any[1] | any[2] | any[3]) == 0) return;
    given[(row / 4) * (stride / 4) + column / 4] = 1;
    Quad first(0.0);
    Quad second(0.0);
    for (unsigned k = 0; k < 4; k += 2) {
      loadColumns(at + k, skip, first, second);
      first.store(x + (column + k) * stride + row);
      second.store(x + (column + k + 1) * stride + row);
    }
  }

  /// The last rows, and the blocks on the diagonal.
  NONET_INLINE void readNumbers(const double* a, unsigned skip, unsigned row, unsigned end,
                                unsigned column) const {
    given[(row / 4) * (stride / 4) + column / 4] = 1;
    for (unsigned r = row; r < end; ++r) {
      for (unsigned k = column; k < column + 4 && k <= r; ++k) {
        x[k * stride + r] = a[std::size_t{r} * skip + k];
      }
    }
  }
};

/// Takes their sums from the columns i and i + 1 and lists the blocks of rows that matter in them.
NONET_INLINE double finishPair(Columns& columns, double* d, unsigned i, unsigned n) {
  double* first = columns.x + i * columns.stride;
  double* second = first + columns.stride;
  const double* firstSums = columns.sums + i * columns.stride;
  const double* secondSums = firstSums + columns.stride;
  d[i] = 1.0 / (first[i] - firstSums[i]);
  const double coupling = (first[i + 1] - firstSums[i + 1]) * d[i];
  const Quad share(coupling);
  columns.count = 0;
  for (unsigned r = i - i % 4; r < n; r += 4) {
    Quad x1(first + r);
    Quad x2(second + r);
    x1.v -= Quad(firstSums + r).v;
    x2.v -= Quad(secondSums + r).v;
    x2.v -= share.v * x1.v;
    x1.store(first + r);
    x2.store(second + r);
    const auto filled = (x1.v != 0.0) | (x2.v != 0.0);
    if ((filled[0] | filled[1] | filled[2] | filled[3]) != 0 ||
        columns.given[(r / 4) * (columns.stride / 4) + i / 4] != 0) {
      columns.rows[columns.count++] = r;
    }
  }
  d[i + 1] = 1.0 / second[i + 1];
  return coupling;
}

/// Adds the products of the finished columns i and i + 1 with row j of L to the sums of column j.
NONET_INLINE void addPair(const Columns& columns, unsigned i, unsigned j, double l1, double l2,
                          std::span<const unsigned> rows) {
  const double* first = columns.x + i * columns.stride;
  const double* second = first + columns.stride;
  double* sums = columns.sums + j * columns.stride;
  const Quad factor1(l1);
  const Quad factor2(l2);
  for (const unsigned r : rows) {
    Quad sum(sums + r);
    sum.addProduct(factor1, Quad(first + r));
    sum.addProduct(factor2, Quad(second + r));
    sum.store(sums + r);
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
  thread_local Columns::Memory memory;
  Columns columns(n, memory);
  columns.read(a, n, skip);
  for (unsigned i = 0; i + 1 < n; i += 2) {
    a[std::size_t{i + 1} * skip + i] = finishPair(columns, d, i, n);
    const double* first = columns.x + i * columns.stride;
    const double* second = first + columns.stride;
    for (unsigned block = 0; block < columns.count; ++block) {
      const auto rows = std::span<const unsigned>(columns.rows, columns.count).subspan(block);
      const unsigned end = std::min(rows.front() + 4, n);
      for (unsigned j = std::max(rows.front(), i + 2); j < end; ++j) {
        double* row = a + std::size_t{j} * skip + i;
        row[0] = first[j] * d[i];
        row[1] = second[j] * d[i + 1];
        if (row[0] != 0.0 || row[1] != 0.0) addPair(columns, i, j, row[0], row[1], rows);
      }
    }
  }
  if (n % 2 != 0) factorLastRow(a + std::size_t{n - 1} * skip, d, columns.x, columns.stride, n - 1);
}

// ---- both instances

[[gnu::target("avx2")]] void solveL1Avx2(const double* l, double* b, unsigned n, unsigned skip,
                                         const Blocks& blocks) {
  solveL1Body(l, b, n, skip, blocks);
}
[[gnu::target("avx2")]] void solveL1TransposedAvx2(const double* l, double* b, unsigned n, unsigned skip,
                                                   const Blocks& blocks) {
  solveL1TransposedBody(l, b, n, skip, blocks);
}
[[gnu::target("avx2")]] void factorAvx2(double* a, double* d, unsigned n, unsigned skip) {
  factorBody(a, d, n, skip);
}

const bool hasAvx2 = __builtin_cpu_supports("avx2");
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

void factorLdlt(double* a, double* d, unsigned n, unsigned skip) {
  hasAvx2 ? factorAvx2(a, d, n, skip) : factorBody(a, d, n, skip);
}
void solveL1(const double* l, double* b, unsigned n, unsigned skip, const Blocks& blocks) {
  hasAvx2 ? solveL1Avx2(l, b, n, skip, blocks) : solveL1Body(l, b, n, skip, blocks);
}
void solveL1Transposed(const double* l, double* b, unsigned n, unsigned skip, const Blocks& blocks) {
  hasAvx2 ? solveL1TransposedAvx2(l, b, n, skip, blocks) : solveL1TransposedBody(l, b, n, skip, blocks);
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
  kernels::current.l = a;
  kernels::current.skip = skip;
  kernels::current.blocks.read(a, n, skip);
}
template <>
void solveL1Straight<1>(const double* l, double* b, unsigned n, unsigned skip) {
  ++kernels::calls;
  kernels::solveL1(l, b, n, skip, kernels::blocksOf(l, n, skip));
}
template <>
void solveL1Transposed<1>(const double* l, double* b, unsigned n, unsigned skip) {
  ++kernels::calls;
  kernels::solveL1Transposed(l, b, n, skip, kernels::blocksOf(l, n, skip));
}
