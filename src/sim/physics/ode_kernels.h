// The three dense kernels in which ODE's exact step spends most of its time, with vectors of four. Every sum
// is taken in the same order as in ODE 0.16 and nothing is fused, so the results are the same bits; only
// several sums advance at once where ODE lets each wait for the one before.
//
// ode_kernels.cpp also defines them under the names that ODE calls them by: libode.so looks its own template
// instances up like any other symbol, and finds the program's first. An ODE without those symbols simply runs
// its own code.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace nonet::sim::ode_kernels {

/// Factorizes the symmetric matrix `a` (lower triangle, by rows, `skip` numbers from row to row) into
/// L D L^T, in place: the strict lower triangle becomes L's, `d` the inverse of D.
void factorLdlt(double* a, double* d, unsigned n, unsigned skip);

/// Which blocks of four by four numbers of a factor L are not all zero, in its first rows. Two joints meet in
/// the equations only if they share a body or depend on one that does: most of a robot's L is zero, and all
/// of it where one robot's joints meet another's. A product with zero changes no sum.
class Blocks {
 public:
  Blocks() { clear(); }

  /// Nothing known: all blocks are to be visited.
  void clear();

  /// Looks through the first n rows of `l` (n - n % 4 of them).
  void read(const double* l, unsigned n, unsigned skip);

  /// How many rows are known, a multiple of four.
  [[nodiscard]] unsigned rows() const { return rows_; }

  /// First columns, rising, of the blocks left of the diagonal in the rows `row` ... `row` + 3.
  [[nodiscard]] std::span<const unsigned> left(unsigned row) const { return line(inRow_, rowBegin_, row); }

  /// First rows, rising, of the blocks below the diagonal in the columns `column` ... `column` + 3.
  [[nodiscard]] std::span<const unsigned> below(unsigned column) const {
    return line(inColumn_, columnBegin_, column);
  }

 private:
  [[nodiscard]] std::span<const unsigned> line(const std::vector<unsigned>& blocks,
                                               const std::vector<unsigned>& begin, unsigned first) const {
    if (first >= rows_) return {};
    return std::span(blocks).subspan(begin[first / 4], begin[first / 4 + 1] - begin[first / 4]);
  }

  unsigned rows_ = 0;
  std::vector<unsigned> inRow_;
  std::vector<unsigned> rowBegin_;  // where each row of blocks begins in `inRow_`
  std::vector<unsigned> inColumn_;
  std::vector<unsigned> columnBegin_;
  std::vector<std::uint8_t> full_;  // column by column
};

/// Solves L x = b in place; L is lower triangular with ones on the diagonal. Blocks known to be zero are left
/// out.
void solveL1(const double* l, double* b, unsigned n, unsigned skip, const Blocks& blocks = {});

/// Solves L^T x = b in place.
void solveL1Transposed(const double* l, double* b, unsigned n, unsigned skip, const Blocks& blocks = {});

/// Does nothing, but whoever calls it has the linker take this file into the program.
void link();

/// How often ODE has called a kernel of this file, in this thread.
unsigned long callsByOde();

}  // namespace nonet::sim::ode_kernels
