// L D L^T.
//
// ODE sums up each row when its turn comes; here the products of a finished pair of columns go to the sums of
// all columns that are still to come: the same products in the same order. Blocks of rows in which the pair
// is zero are left out.
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "sim/physics/ode_kernels.h"
#include "sim/physics/ode_kernels_vectors.h"

namespace nonet::sim::ode_kernels {

namespace {

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

[[gnu::target("avx2")]] void factorAvx2(double* a, double* d, unsigned n, unsigned skip) {
  factorBody(a, d, n, skip);
}

}  // namespace

void factorLdlt(double* a, double* d, unsigned n, unsigned skip) {
  kHasAvx2 ? factorAvx2(a, d, n, skip) : factorBody(a, d, n, skip);
}

}  // namespace nonet::sim::ode_kernels
