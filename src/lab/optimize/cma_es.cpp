#include "nonet/lab/optimize/cma_es.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Eigenvalues>

namespace nonet::lab {

namespace {

constexpr double kWorst = std::numeric_limits<double>::infinity();

// Mirrors x into [low, high], periodically: continuous, and the identity inside.
double reflect(double x, double low, double high) {
  const double width = high - low;
  if (!(width > 0.0)) return low;
  double offset = std::fmod(x - low, 2.0 * width);
  if (offset < 0.0) offset += 2.0 * width;
  return low + (offset <= width ? offset : 2.0 * width - offset);
}

}  // namespace

CmaEs::CmaEs(const Eigen::VectorXd& start, const CmaEsSettings& settings)
    : settings_(settings), mean_(start), sigma_(settings.sigma), random_(settings.seed) {
  assert(start.size() > 0 && settings.sigma > 0.0);
  const Eigen::Index n = start.size();
  population_ = settings.population > 0 ? settings.population
                                        : 4 + static_cast<int>(3.0 * std::log(static_cast<double>(n)));
  population_ = std::max(population_, 2);
  setWeights();
  covariance_ = Eigen::MatrixXd::Identity(n, n);
  basis_ = Eigen::MatrixXd::Identity(n, n);
  scales_ = Eigen::VectorXd::Ones(n);
  path_ = Eigen::VectorXd::Zero(n);
  sigmaPath_ = Eigen::VectorXd::Zero(n);
  best_ = intoBox(start);
  bestFitness_ = kWorst;
}

// [Hansen 2016, table 1 and equations (49)-(58)].
void CmaEs::setWeights() {
  const double n = static_cast<double>(mean_.size());
  Eigen::VectorXd raw(population_);
  for (int i = 0; i < population_; ++i) raw[i] = std::log((population_ + 1) / 2.0) - std::log(i + 1.0);
  parents_ = static_cast<int>((raw.array() > 0.0).count());
  const double positive = raw.head(parents_).sum();
  effective_ = positive * positive / raw.head(parents_).squaredNorm();

  sigmaRate_ = (effective_ + 2.0) / (n + effective_ + 5.0);
  sigmaDamping_ = 1.0 + 2.0 * std::max(0.0, std::sqrt((effective_ - 1.0) / (n + 1.0)) - 1.0) + sigmaRate_;
  pathRate_ = (4.0 + effective_ / n) / (n + 4.0 + 2.0 * effective_ / n);
  rankOneRate_ = 2.0 / ((n + 1.3) * (n + 1.3) + effective_);
  rankMuRate_ = std::min(1.0 - rankOneRate_, 2.0 * (0.25 + effective_ + 1.0 / effective_ - 2.0) /
                                                 ((n + 2.0) * (n + 2.0) + effective_));
  expectedNorm_ = std::sqrt(n) * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n * n));

  weights_ = raw / positive;
  const int negatives = population_ - parents_;
  if (!settings_.active || negatives == 0) {
    weights_.tail(negatives).setZero();
    return;
  }
  const double negative = -raw.tail(negatives).sum();
  const double negativeEffective =
      raw.tail(negatives).squaredNorm() > 0.0 ? negative * negative / raw.tail(negatives).squaredNorm() : 0.0;
  const double alphaMu = 1.0 + rankOneRate_ / rankMuRate_;
  const double alphaEffective = 1.0 + 2.0 * negativeEffective / (effective_ + 2.0);
  const double alphaDefinite = (1.0 - rankOneRate_ - rankMuRate_) / (n * rankMuRate_);
  const double scale = std::min({alphaMu, alphaEffective, alphaDefinite});
  if (negative > 0.0) weights_.tail(negatives) = raw.tail(negatives) * (scale / negative);
}

Eigen::VectorXd CmaEs::intoBox(const Eigen::VectorXd& x) const {
  if (settings_.low.size() == 0) return x;
  Eigen::VectorXd inside(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) inside[i] = reflect(x[i], settings_.low[i], settings_.high[i]);
  return inside;
}

Eigen::VectorXd CmaEs::deviations() const {
  // The covariance of a run that ended as ill-conditioned may have lost its sign.
  return sigma_ * covariance_.diagonal().cwiseMax(0.0).cwiseSqrt();
}

const Eigen::MatrixXd& CmaEs::ask() {
  if (asked_) return inBox_;
  const Eigen::Index n = mean_.size();
  samples_.resize(n, population_);
  inBox_.resize(n, population_);
  Eigen::VectorXd z(n);
  for (int k = 0; k < population_; ++k) {
    for (Eigen::Index i = 0; i < n; ++i) z[i] = random_.normal();
    samples_.col(k) = mean_ + sigma_ * (basis_ * scales_.cwiseProduct(z));
    inBox_.col(k) = intoBox(samples_.col(k));
  }
  asked_ = true;
  return inBox_;
}

void CmaEs::tell(const Eigen::VectorXd& fitness) {
  assert(asked_ && fitness.size() == population_);
  const double n = static_cast<double>(mean_.size());
  std::vector<int> order(static_cast<std::size_t>(population_));
  std::iota(order.begin(), order.end(), 0);
  const auto value = [&](int k) { return std::isnan(fitness[k]) ? kWorst : fitness[k]; };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return value(a) < value(b); });
  if (value(order[0]) < bestFitness_) {
    bestFitness_ = value(order[0]);
    best_ = inBox_.col(order[0]);
  }

  Eigen::MatrixXd steps(mean_.size(), population_);  // y_i, best first
  Eigen::VectorXd sorted(population_);
  for (int i = 0; i < population_; ++i) {
    steps.col(i) = (samples_.col(order[i]) - mean_) / sigma_;
    sorted[i] = value(order[i]);
  }
  const Eigen::VectorXd meanStep = steps.leftCols(parents_) * weights_.head(parents_);
  mean_ += sigma_ * meanStep;

  // Step-size path: the mean's step in the coordinates in which the distribution is round (equation 31).
  const Eigen::VectorXd round = basis_ * (basis_.transpose() * meanStep).cwiseQuotient(scales_);
  sigmaPath_ =
      (1.0 - sigmaRate_) * sigmaPath_ + std::sqrt(sigmaRate_ * (2.0 - sigmaRate_) * effective_) * round;
  ++generation_;
  evaluations_ += population_;
  const double unbiased = std::sqrt(1.0 - std::pow(1.0 - sigmaRate_, 2.0 * generation_));
  const bool stalled = sigmaPath_.norm() / unbiased >= (1.4 + 2.0 / (n + 1.0)) * expectedNorm_;
  path_ *= 1.0 - pathRate_;
  if (!stalled) path_ += std::sqrt(pathRate_ * (2.0 - pathRate_) * effective_) * meanStep;

  updateCovariance(steps, stalled);
  // The exponent is bounded so that a degenerate fitness cannot blow the step size up in one generation.
  sigma_ *= std::exp(std::min(1.0, sigmaRate_ / sigmaDamping_ * (sigmaPath_.norm() / expectedNorm_ - 1.0)));
  asked_ = false;

  const double lazyGap = 1.0 / ((rankOneRate_ + rankMuRate_) * n * 10.0);
  if (generation_ - decomposedAt_ >= lazyGap) decompose();
  checkStop(sorted);
}

// Equations (43)-(47): rank one, rank mu, negative weights scaled to keep the matrix positive definite.
void CmaEs::updateCovariance(const Eigen::MatrixXd& steps, bool pathStalled) {
  const double n = static_cast<double>(mean_.size());
  const double lost = pathStalled ? pathRate_ * (2.0 - pathRate_) : 0.0;
  covariance_ *= 1.0 + rankOneRate_ * lost - rankOneRate_ - rankMuRate_ * weights_.sum();
  covariance_ += rankOneRate_ * path_ * path_.transpose();
  for (int i = 0; i < population_; ++i) {
    double weight = weights_[i];
    if (weight == 0.0) continue;
    if (weight < 0.0) {
      const double length = (basis_.transpose() * steps.col(i)).cwiseQuotient(scales_).squaredNorm();
      weight *= n / std::max(length, 1e-300);
    }
    covariance_ += rankMuRate_ * weight * steps.col(i) * steps.col(i).transpose();
  }
}

void CmaEs::decompose() {
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance_);
  const double largest = std::max(solver.eigenvalues().maxCoeff(), 1e-300);
  if (solver.info() != Eigen::Success || solver.eigenvalues().minCoeff() < 1e-15 * largest) {
    stop_ = CmaEsStop::IllConditioned;
  }
  basis_ = solver.eigenvectors();
  scales_ = solver.eigenvalues().cwiseMax(1e-15 * largest).cwiseSqrt();
  decomposedAt_ = generation_;
}

void CmaEs::checkStop(const Eigen::VectorXd& sortedFitness) {
  if (stop_ != CmaEsStop::None) return;
  const std::size_t window =
      10 + static_cast<std::size_t>(30.0 * static_cast<double>(mean_.size()) / population_);
  recentBest_.push_back(sortedFitness[0]);
  if (recentBest_.size() > window) recentBest_.erase(recentBest_.begin());
  if (recentBest_.size() == window) {
    const auto [low, high] = std::minmax_element(recentBest_.begin(), recentBest_.end());
    const double spread = std::max(*high - *low, sortedFitness[population_ - 1] - sortedFitness[0]);
    if (spread < 1e-12) stop_ = CmaEsStop::FlatFitness;
  }
  if ((sigma_ * covariance_.diagonal().cwiseSqrt()).maxCoeff() < settings_.leastStep * settings_.sigma)
    stop_ = CmaEsStop::SmallStep;
  if ((mean_ + 0.2 * deviations()).isApprox(mean_, 0.0)) stop_ = CmaEsStop::NoEffect;
}

RestartingCmaEs::RestartingCmaEs(const Eigen::VectorXd& start, const CmaEsSettings& settings,
                                 RestartScheme scheme)
    : start_(start),
      settings_(settings),
      scheme_(scheme),
      run_(start, settings),
      random_(Random(settings.seed).fork(1)),
      largePopulation_(run_.population()),
      best_(run_.best()),
      bestFitness_(kWorst) {
  settings_.population = run_.population();
}

void RestartingCmaEs::tell(const Eigen::VectorXd& fitness) {
  run_.tell(fitness);
  (smallRegime_ ? smallBudget_ : largeBudget_) += run_.population();
  if (run_.bestFitness() < bestFitness_) {
    bestFitness_ = run_.bestFitness();
    best_ = run_.best();
  }
}

const Eigen::MatrixXd& RestartingCmaEs::ask() {
  if (run_.stop() != CmaEsStop::None && scheme_ != RestartScheme::None) restart();
  return run_.ask();
}

void RestartingCmaEs::restart() {
  finishedEvaluations_ += run_.evaluations();
  ++restarts_;
  CmaEsSettings settings = settings_;
  settings.seed = random_.next();
  smallRegime_ = scheme_ == RestartScheme::Bipop && restarts_ > 1 && smallBudget_ < largeBudget_;
  if (smallRegime_) {
    const double u = random_.uniform();
    const double ratio = 0.5 * largePopulation_ / settings_.population;
    settings.population = std::max(2, static_cast<int>(settings_.population * std::pow(ratio, u * u)));
    settings.sigma = settings_.sigma * std::pow(10.0, -2.0 * random_.uniform());
  } else {
    largePopulation_ *= 2;
    settings.population = largePopulation_;
  }
  const bool narrow = settings_.startLow.size() > 0;
  const Eigen::VectorXd& low = narrow ? settings_.startLow : settings_.low;
  const Eigen::VectorXd& high = narrow ? settings_.startHigh : settings_.high;
  Eigen::VectorXd start = start_;
  for (Eigen::Index i = 0; i < start.size(); ++i) {
    start[i] =
        low.size() > 0 ? random_.uniform(low[i], high[i]) : start_[i] + settings_.sigma * random_.normal();
  }
  run_ = CmaEs(start, settings);
}

}  // namespace nonet::lab
