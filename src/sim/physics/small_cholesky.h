// Linear equations with a symmetric, positive definite matrix of six rows, for six right sides at a time.
// Eigen's solver for several right sides is made for large matrices; this one sums in the same order (panels
// of four rows), so its results are the same bits.
#pragma once

#include <cmath>

#include <Eigen/Cholesky>

#include "sim/physics/spatial.h"

namespace nonet::sim {

/// The Cholesky factors L L^T of a positive definite matrix.
class SmallCholesky {
 public:
  explicit SmallCholesky(const Matrix6& matrix) {
    for (int k = 0; k < 6; ++k) {
      double square = 0.0;
      for (int i = 0; i < k; ++i) square += lower_[k][i] * lower_[k][i];
      const double diagonal = std::sqrt(matrix(k, k) - square);
      for (int r = k + 1; r < 6; ++r) {
        double sum = 0.0;
        for (int i = 0; i < k; ++i) sum += lower_[r][i] * lower_[k][i];
        lower_[r][k] = (matrix(r, k) - sum) / diagonal;
      }
      inverse_[k] = 1.0 / diagonal;
    }
  }
  explicit SmallCholesky(const Eigen::LLT<Matrix6>& factors) {
    for (int r = 0; r < 6; ++r) {
      for (int k = 0; k < r; ++k) lower_[r][k] = factors.matrixLLT()(r, k);
      inverse_[r] = 1.0 / factors.matrixLLT()(r, r);
    }
  }

  Matrix6 solve(const Matrix6& right) const { return solved<6>(right); }

  /// solve(identity): on the way down the upper rows have nothing in the last columns.
  Matrix6 inverse() const { return solved<4>(Rows::Identity()); }

 private:
  using Rows = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

  /// Of the right sides x. `Columns`: in the first four rows all later ones are zero.
  template <int Columns>
  Matrix6 solved(Rows x) const {
    forward<0, 4, Columns>(x);
    for (int r = 4; r < 6; ++r) subtract<Columns>(x, r, 0, [this, r](int k) { return lower_[r][k]; });
    forward<4, 6, 6>(x);
    backward<2, 6>(x);
    for (int r = 0; r < 2; ++r) subtract<6>(x, r, 2, [this, r](int k) { return lower_[k][r]; });
    backward<0, 2>(x);
    return x;
  }
  /// Row r minus the sum over four rows from `first` on.
  template <int Columns, typename Factor>
  static void subtract(Rows& x, int r, int first, const Factor& factor) {
    for (int j = 0; j < Columns; ++j) {
      double sum = 0.0;
      for (int k = first; k < first + 4; ++k) sum += factor(k) * x(k, j);
      x(r, j) -= sum;
    }
  }
  template <int Begin, int End, int Columns>
  void forward(Rows& x) const {
    for (int i = Begin; i < End; ++i) {
      for (int j = 0; j < Columns; ++j) x(i, j) *= inverse_[i];
      for (int r = i + 1; r < End; ++r) {
        for (int j = 0; j < Columns; ++j) x(r, j) -= x(i, j) * lower_[r][i];
      }
    }
  }
  template <int Begin, int End>
  void backward(Rows& x) const {
    for (int i = End - 1; i >= Begin; --i) {
      for (int j = 0; j < 6; ++j) {
        double sum = 0.0;
        for (int k = i + 1; k < End; ++k) sum += lower_[k][i] * x(k, j);
        x(i, j) = (x(i, j) - sum) * inverse_[i];
      }
    }
  }

  double lower_[6][6] = {};
  double inverse_[6] = {};
};

}  // namespace nonet::sim
