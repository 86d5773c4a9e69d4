#include "nonet/world/pose_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

#include "nonet/math/rotation.h"

namespace nonet::world {

namespace {

using Jacobian = Eigen::Matrix<double, 3, 9>;
using MeasuredMatrix = Eigen::Matrix<double, 9, 9>;
using MeasuredVector = Eigen::Matrix<double, 9, 1>;

constexpr double kEndGate = 25.0;   // squared sigmas of one line end
constexpr double kAmbiguity = 9.0;  // a second candidate within this of the best: not used
constexpr int kHalvings = 4;

/// Squared sigmas between a seen line and a line of the map in camera axes, both ends together; far more than
/// the gate if one end does not fit.
double matchCost(const ObservedLine& seen, const std::array<Matrix3, 2>& whiteners, const Vector3& begin,
                 const Vector3& end, double length) {
  const Vector3 direction = (end - begin) / length;
  double cost = 0.0;
  for (std::size_t side = 0; side < 2 && cost < 2.0 * kEndGate; ++side) {
    const Vector3& p_CP = seen.ends[side].p_CP;
    double squared = 0.0;
    if (seen.clipped[side]) {
      // Nearest point of the line in units of the noise; it must lie on the painted part.
      const Vector3 along = whiteners[side] * direction;
      const Vector3 fromBegin = whiteners[side] * (p_CP - begin);
      const double share = std::clamp(along.dot(fromBegin) / along.squaredNorm(), 0.0, length);
      squared = (fromBegin - share * along).squaredNorm();
    } else {
      squared = (whiteners[side] * (p_CP - (side == 0 ? begin : end))).squaredNorm();
    }
    cost += squared > kEndGate ? 4.0 * kEndGate : squared;
  }
  return cost;
}

}  // namespace

Pose3 PoseBelief::pose() const {
  Pose3 X_WR = Pose3::Identity();
  X_WR.linear() = R_WR;
  X_WR.translation() = p_WR;
  return X_WR;
}

Pose2 PoseBelief::ground() const {
  return {p_WR.x(), p_WR.y(), yawOf(R_WR)};
}

/// Everything one update works on.
struct PoseFit::Problem {
  const PoseBelief& prior;
  BeliefMatrix information;  // of the prior
  PoseBelief now;
  const Pose3& X_RC;
  const VisionFrame& frame;
  const FieldMap& map;
  bool useLandmarks = true;
  bool useLines = false;

  // Result of linearise().
  MeasuredMatrix normal = MeasuredMatrix::Zero();  // add() knows its lower half only
  MeasuredVector gradient = MeasuredVector::Zero();
  int residuals = 0;
  double measurementCost = 0.0;

  Matrix3 R_WC() const { return now.R_WR * X_RC.linear(); }
  Vector3 p_WC() const { return now.p_WR + now.R_WR * X_RC.translation(); }

  BeliefMatrix posteriorInformation() const {
    BeliefMatrix sum = information;
    sum.topLeftCorner<9, 9>() += normal;
    return sum;
  }

  BeliefVector distance() const {
    BeliefVector d;
    d << now.p_WR - prior.p_WR, logarithm(now.R_WR * prior.R_WR.transpose()), now.offset - prior.offset,
        now.drift - prior.drift;
    return d;
  }

  PoseBelief moved(const BeliefVector& step) const {
    PoseBelief next = now;
    next.p_WR += step.segment<3>(kPositionState);
    next.R_WR = exponential(step.segment<3>(kRotationState)) * now.R_WR;
    next.offset += step.segment<3>(kOffsetState);
    next.drift += step.segment<3>(kDriftState);
    return next;
  }

  void add(const Jacobian& J, const Vector3& r, int rows) {
    // Eigen would take its way for large matrices, and reckon the upper half as well.
    for (int column = 0; column < J.cols(); ++column) {
      for (int row = column; row < J.cols(); ++row) normal(row, column) += J.col(row).dot(J.col(column));
    }
    gradient.noalias() += J.transpose() * r;
    measurementCost += r.squaredNorm();
    residuals += rows;
  }
};

double PoseFit::linearise(Problem& problem) const {
  problem.normal.setZero();
  problem.gradient.setZero();
  problem.residuals = 0;
  problem.measurementCost = 0.0;
  const Matrix3 R_CW = problem.R_WC().transpose();
  const Vector3 p_WC = problem.p_WC();
  const auto predict = [&](const Vector3& p_WP) -> Vector3 {
    return R_CW * (p_WP - p_WC) + problem.now.offset;
  };
  const auto jacobian = [&](const Matrix3& S, const Vector3& p_WP) {
    Jacobian J;
    const Matrix3 SR = S * R_CW;
    J.leftCols<3>() = -SR;
    // Row by row s [d]x = (s x d)^T, with d from the torso to the point.
    const Vector3 d = p_WP - problem.now.p_WR;
    for (int i = 0; i < 3; ++i) J.block<1, 3>(i, 3) = Vector3(SR.row(i)).cross(d).transpose();
    J.rightCols<3>() = S;
    return J;
  };

  if (problem.useLandmarks) {
    for (const ObservedLandmark& seen : problem.frame.landmarks()) {
      const Vector3& p_WP = problem.map.landmark(seen.id);
      const Vector3 r = seen.at.whitener * (seen.at.p_CP - predict(p_WP));
      problem.add(jacobian(seen.at.whitener, p_WP), r, 3);
    }
  }
  if (problem.useLines) {
    const auto lines = problem.frame.lines();
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (matches_[i] < 0) continue;
      const FieldLine& line = problem.map.lines()[static_cast<std::size_t>(matches_[i])];
      for (std::size_t side = 0; side < 2; ++side) {
        const ObservedPoint& seen = lines[i].ends[side];
        if (!lines[i].clipped[side]) {
          const Vector3& p_WP = side == 0 ? line.begin : line.end;
          const Vector3 r = seen.whitener * (seen.p_CP - predict(p_WP));
          problem.add(jacobian(seen.whitener, p_WP), r, 3);
          continue;
        }
        // Only what lies across the line counts: project on the plane normal to the whitened direction.
        const Vector3 along = seen.whitener * (R_CW * line.direction);
        const Vector3 fromBegin = seen.whitener * (seen.p_CP - predict(line.begin));
        const double share = along.dot(fromBegin) / along.squaredNorm();
        const Vector3 p_WP = line.begin + share * line.direction;
        const Vector3 t = along.normalized();
        const Matrix3 across = Matrix3::Identity() - t * t.transpose();
        const Vector3 r = across * (fromBegin - share * along);
        problem.add(across * jacobian(seen.whitener, p_WP), r, 2);
      }
    }
  }
  problem.normal.triangularView<Eigen::StrictlyUpper>() = problem.normal.transpose();
  const BeliefVector d = problem.distance();
  return problem.measurementCost + d.dot(problem.information * d);
}

void PoseFit::matchLines(const Problem& problem) {
  const auto lines = problem.frame.lines();
  const auto fieldLines = problem.map.lines();
  const Matrix3 R_CW = problem.R_WC().transpose();
  const Vector3 p_WC = problem.p_WC();
  std::array<Vector3, kFieldLineCount> begins;
  std::array<Vector3, kFieldLineCount> ends;
  for (std::size_t k = 0; k < kFieldLineCount; ++k) {
    begins[k] = R_CW * (fieldLines[k].begin - p_WC) + problem.now.offset;
    ends[k] = R_CW * (fieldLines[k].end - p_WC) + problem.now.offset;
  }
  // What the belief itself may be wrong by, added to the noise: position in all directions, orientation
  // across the line of sight.
  const BeliefMatrix& P = problem.now.covariance;
  const double positionVariance = P.block<3, 3>(kPositionState, kPositionState).diagonal().maxCoeff();
  const double angleVariance = P.block<3, 3>(kRotationState, kRotationState).diagonal().maxCoeff();

  for (std::size_t i = 0; i < lines.size(); ++i) {
    const ObservedLine& seen = lines[i];
    std::array<Matrix3, 2> whiteners;
    double lengthSigma = 0.01;
    for (std::size_t side = 0; side < 2; ++side) {
      whiteners[side] = seen.ends[side].whitener;
      const double distance = seen.ends[side].p_CP.norm();
      lengthSigma += distance * VisionNoise::kAzimuthSigma;
      for (int row = 0; row < 3; ++row) {
        const double information = whiteners[side].row(row).squaredNorm();
        double extra = positionVariance;
        if (row > 0) extra += distance * distance * angleVariance;
        whiteners[side].row(row) /= std::sqrt(1.0 + information * extra);
      }
    }
    double best = std::numeric_limits<double>::max();
    double second = best;
    int bestLine = -1;
    const bool whole = !seen.clipped[0] && !seen.clipped[1];
    for (std::size_t k = 0; k < kFieldLineCount; ++k) {
      // A part cannot be longer than the line, and a line seen whole has its length.
      const double excess = seen.length - fieldLines[k].length;
      if (excess > 4.0 * lengthSigma || (whole && excess < -4.0 * lengthSigma)) continue;
      const double cost = matchCost(seen, whiteners, begins[k], ends[k], fieldLines[k].length);
      if (cost < best) {
        second = best;
        best = cost;
        bestLine = static_cast<int>(k);
      } else if (cost < second) {
        second = cost;
      }
    }
    matches_[i] = best < 2.0 * kEndGate && second > best + kAmbiguity ? bestLine : -1;
  }
}

double PoseFit::solve(Problem& problem, int iterations) const {
  double cost = linearise(problem);
  for (int i = 0; i < iterations; ++i) {
    BeliefVector gradient = -problem.information * problem.distance();
    gradient.head<9>() += problem.gradient;
    BeliefVector step = problem.posteriorInformation().llt().solve(gradient);
    const PoseBelief start = problem.now;
    const double before = cost;
    for (int half = 0; half <= kHalvings; ++half) {
      problem.now = problem.moved(step);
      cost = linearise(problem);
      if (cost <= before + 1e-9) break;
      problem.now = start;
      if (half == kHalvings) cost = linearise(problem);
      step *= 0.5;
    }
    if (before - cost < 1e-3 * (1.0 + cost) && i > 0) break;
  }
  return cost;
}

FitReport PoseFit::update(PoseBelief& belief, const Pose3& X_RC, const VisionFrame& frame,
                          const FieldMap& map, const FitSettings& settings) {
  FitReport report;
  matches_.fill(-1);
  const PoseBelief prior = belief;
  Problem problem{prior, prior.covariance.llt().solve(BeliefMatrix::Identity()), prior, X_RC, frame, map};
  problem.useLandmarks = settings.useLandmarks;

  report.landmarks = settings.useLandmarks ? static_cast<int>(frame.landmarks().size()) : 0;
  double cost = 0.0;
  if (report.landmarks > 0) {
    cost = solve(problem, settings.iterations);
    problem.now.covariance = problem.posteriorInformation().llt().solve(BeliefMatrix::Identity());
  }
  if (settings.useLines && !frame.lines().empty()) {
    matchLines(problem);
    problem.useLines = true;
    cost = solve(problem, settings.iterations);
    for (std::size_t i = 0; i < frame.lines().size(); ++i) report.lines += matches_[i] >= 0 ? 1 : 0;
  }
  report.residuals = problem.residuals;
  report.cost = cost;
  report.measurementCost = problem.measurementCost;
  if (report.residuals == 0) return report;
  const auto factor = problem.posteriorInformation().llt();
  const auto priorFactor = problem.information.llt();
  for (int i = 0; i < kBeliefStates; ++i) {
    report.logVolume += std::log(factor.matrixLLT()(i, i)) - std::log(priorFactor.matrixLLT()(i, i));
  }
  problem.now.covariance = factor.solve(BeliefMatrix::Identity());
  report.ok = std::isfinite(cost) && problem.now.p_WR.allFinite() && problem.now.covariance.allFinite();
  if (report.ok) belief = problem.now;
  return report;
}

}  // namespace nonet::world
