// The three dense kernels in which ODE's exact step spends most of its time, with vectors of four. Every sum
// is taken in the same order as in ODE 0.16 and nothing is fused, so the results are the same bits; only
// several sums advance at once where ODE lets each wait for the one before.
//
// ode_kernels.cpp also defines them under the names that ODE calls them by: libode.so looks its own template
// instances up like any other symbol, and finds the program's first. An ODE without those symbols simply runs
// its own code.
#pragma once

namespace nonet::sim::ode_kernels {

/// Factorizes the symmetric matrix `a` (lower triangle, by rows, `skip` numbers from row to row) into
/// L D L^T, in place: the strict lower triangle becomes L's, `d` the inverse of D.
void factorLdlt(double* a, double* d, unsigned n, unsigned skip);

/// Solves L x = b in place; L is lower triangular with ones on the diagonal.
void solveL1(const double* l, double* b, unsigned n, unsigned skip);

/// Solves L^T x = b in place.
void solveL1Transposed(const double* l, double* b, unsigned n, unsigned skip);

/// Does nothing, but whoever calls it has the linker take this file into the program.
void link();

/// How often ODE has called a kernel of this file, in this thread.
unsigned long callsByOde();

}  // namespace nonet::sim::ode_kernels
