// Nonlinear least squares with bounds for a handful of unknowns: projected Levenberg-Marquardt on fixed-size
// matrices, no allocation. After [Kanzow 2004], the projected variant.
#pragma once

#include <algorithm>
#include <array>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace nonet::model {

/// The step s that lowers gradient . s + s . hessian s / 2 within low <= s <= high. Unknowns that leave their
/// range are put on its border and held there, one group after another. None is let go again in this step;
/// the next iteration begins anew.
template <int N>
Eigen::Matrix<double, N, 1> boundedStep(const Eigen::Matrix<double, N, N>& hessian,
                                        const Eigen::Matrix<double, N, 1>& gradient,
                                        const Eigen::Matrix<double, N, 1>& low,
                                        const Eigen::Matrix<double, N, 1>& high) {
  std::array<bool, N> held{};
  Eigen::Matrix<double, N, 1> step = Eigen::Matrix<double, N, 1>::Zero();
  for (int i = 0; i < N; ++i) {
    // An unknown on its border stays there if going down would lead out.
    held[i] = (low[i] >= 0.0 && gradient[i] > 0.0) || (high[i] <= 0.0 && gradient[i] < 0.0);
  }
  for (int round = 0; round < N; ++round) {
    Eigen::Matrix<double, N, N> matrix = hessian;
    Eigen::Matrix<double, N, 1> right = -gradient;
    for (int i = 0; i < N; ++i) {
      if (held[i]) right -= step[i] * hessian.col(i);
    }
    for (int i = 0; i < N; ++i) {
      if (!held[i]) continue;
      matrix.row(i).setZero();
      matrix.col(i).setZero();
      matrix(i, i) = 1.0;
      right[i] = step[i];
    }
    step = matrix.ldlt().solve(right);
    bool inside = true;
    for (int i = 0; i < N; ++i) {
      if (held[i] || (step[i] >= low[i] && step[i] <= high[i])) continue;
      step[i] = step[i] < low[i] ? low[i] : high[i];
      held[i] = true;
      inside = false;
    }
    if (inside) break;
  }
  return step.cwiseMax(low).cwiseMin(high);
}

/// Lowers |r(x)|^2 / 2 within [low, high], from `x`; returns it. `evaluate(x, residual, derivative)` fills
/// r and, if the pointer is not null, dr/dx. Stops when a step no longer changes x, or after `maxIterations`.
template <int N, int M, class Evaluate>
double boundedFit(const Evaluate& evaluate, const Eigen::Matrix<double, N, 1>& low,
                  const Eigen::Matrix<double, N, 1>& high, Eigen::Matrix<double, N, 1>& x,
                  int maxIterations) {
  Eigen::Matrix<double, M, 1> residual;
  Eigen::Matrix<double, M, N> derivative;
  constexpr Eigen::Matrix<double, M, N>* kNoDerivative = nullptr;
  x = x.cwiseMax(low).cwiseMin(high);
  evaluate(x, residual, &derivative);
  double cost = 0.5 * residual.squaredNorm();
  double damping = 1e-3;
  for (int iteration = 0; iteration < maxIterations; ++iteration) {
    const Eigen::Matrix<double, N, 1> gradient = derivative.transpose() * residual;
    Eigen::Matrix<double, N, N> hessian = derivative.transpose() * derivative;
    hessian.diagonal().array() += damping * hessian.trace() / N;
    const Eigen::Matrix<double, N, 1> step = boundedStep<N>(hessian, gradient, low - x, high - x);
    if (step.cwiseAbs().maxCoeff() < 1e-10) break;
    const Eigen::Matrix<double, N, 1> candidate = (x + step).cwiseMax(low).cwiseMin(high);
    Eigen::Matrix<double, M, 1> newResidual;
    evaluate(candidate, newResidual, kNoDerivative);
    const double newCost = 0.5 * newResidual.squaredNorm();
    if (newCost < cost) {
      x = candidate;
      cost = newCost;
      evaluate(x, residual, &derivative);
      damping = std::max(damping * 0.2, 1e-12);
    } else {
      damping *= 5.0;
      if (damping > 1e9) break;
    }
  }
  return cost;
}

}  // namespace nonet::model
