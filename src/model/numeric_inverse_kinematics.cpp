#include "nonet/model/numeric_inverse_kinematics.h"

#include <algorithm>
#include <cmath>

#include <ceres/cost_function.h>
#include <ceres/problem.h>
#include <ceres/sized_cost_function.h>
#include <ceres/solver.h>

#include "limb.h"

namespace nonet::model {

namespace {

class LegCost : public ceres::SizedCostFunction<6, 6> {
 public:
  LegCost(const Limb<6>& limb, const Pose3& target) : limb_(limb), target_(target) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const Limb<6>::Angles angles = Eigen::Map<const Limb<6>::Angles>(parameters[0]);
    Eigen::Matrix<double, 6, 1> residual;
    Eigen::Matrix<double, 6, 6> derivative;
    const bool wanted = jacobians != nullptr && jacobians[0] != nullptr;
    PoseResidual::evaluate<6>(limb_, angles, target_, residual, wanted ? &derivative : nullptr);
    Eigen::Map<Eigen::Matrix<double, 6, 1>>(residuals, 6, 1) = residual;
    if (wanted) Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(jacobians[0], 6, 6) = derivative;
    return true;
  }

 private:
  Limb<6> limb_;
  Pose3 target_;
};

class ArmCost : public ceres::SizedCostFunction<3, 4> {
 public:
  ArmCost(const Limb<4>& limb, const Vector3& target) : limb_(limb), target_(target) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const Limb<4>::Angles angles = Eigen::Map<const Limb<4>::Angles>(parameters[0]);
    Limb<4>::Jacobian jacobian;
    Eigen::Map<Vector3>(residuals, 3, 1) = limb_.evaluate(angles, &jacobian).translation() - target_;
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(jacobians[0], 3, 4) = jacobian.topRows<3>();
    }
    return true;
  }

 private:
  Limb<4> limb_;
  Vector3 target_;
};

template <int N>
bool solve(ceres::CostFunction* cost, const Limb<N>& limb, std::array<double, N>& angles) {
  ceres::Problem problem;
  for (int i = 0; i < N; ++i) angles[i] = std::clamp(angles[i], limb.low()[i], limb.high()[i]);
  problem.AddResidualBlock(cost, nullptr, angles.data());
  for (int i = 0; i < N; ++i) {
    problem.SetParameterLowerBound(angles.data(), i, limb.low()[i]);
    problem.SetParameterUpperBound(angles.data(), i, limb.high()[i]);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;  // the same bits whatever the machine
  options.max_num_iterations = 500;
  options.function_tolerance = 1e-16;
  options.gradient_tolerance = 1e-16;
  options.parameter_tolerance = 1e-14;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return summary.termination_type == ceres::CONVERGENCE;
}

}  // namespace

NumericSolution numericLegInverseKinematics(const RobotModel& model, Side side, const Pose3& X_RS,
                                            LegAngles& angles) {
  const Limb<6> limb = legLimb(model, side);
  NumericSolution solution;
  solution.converged = solve<6>(new LegCost(limb, X_RS), limb, angles);  // NOLINT: the problem owns it
  const Limb<6>::Angles x = Eigen::Map<const Limb<6>::Angles>(angles.data());
  Eigen::Matrix<double, 6, 1> residual;
  PoseResidual::evaluate<6>(limb, x, X_RS, residual, nullptr);
  solution.distance = residual.norm();
  solution.positionError = residual.head<3>().norm();
  solution.orientationError =
      2.0 * std::asin(std::min(1.0, residual.tail<3>().norm() / (2.0 * kOrientationLever)));
  return solution;
}

NumericSolution numericArmInverseKinematics(const RobotModel& model, Side side, const Vector3& p_RH,
                                            ArmAngles& angles) {
  const Limb<4> limb = armLimb(model, side);
  NumericSolution solution;
  solution.converged = solve<4>(new ArmCost(limb, p_RH), limb, angles);  // NOLINT: the problem owns it
  const Limb<4>::Angles x = Eigen::Map<const Limb<4>::Angles>(angles.data());
  solution.positionError = (limb.evaluate(x, nullptr).translation() - p_RH).norm();
  solution.distance = solution.positionError;
  return solution;
}

}  // namespace nonet::model
