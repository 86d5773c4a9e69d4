// CMA-ES: covariance matrix adaptation evolution strategy [Hansen 2016], with active (negative) recombination
// weights. Ask for a population, tell the fitness of each member, repeat. Minimises. The whole state can be
// written and read back: a resumed run continues to the last bit.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include "nonet/math/random.h"

namespace nonet::lab {

struct CmaEsSettings {
  int population = 0;  // 0: 4 + floor(3 ln n)
  double sigma = 0.3;  // initial step size, in units of the search coordinates
  bool active = true;  // negative weights for the worse half
  std::uint64_t seed = 1;
  Eigen::VectorXd low;  // box, empty: unbounded. Samples outside are reflected into it.
  Eigen::VectorXd high;
  double leastStep = 1e-12;  // share of sigma: a run ends when no coordinate deviates by more
  Eigen::VectorXd startLow;  // where restarts begin; empty: anywhere in the box
  Eigen::VectorXd startHigh;
};

/// Why a run should end; None while it goes on.
enum class CmaEsStop : std::uint8_t { None, SmallStep, FlatFitness, IllConditioned, NoEffect };

class CmaEs {
 public:
  CmaEs(const Eigen::VectorXd& start, const CmaEsSettings& settings);

  int dimension() const { return static_cast<int>(mean_.size()); }
  int population() const { return population_; }
  int generation() const { return generation_; }
  std::int64_t evaluations() const { return evaluations_; }
  double sigma() const { return sigma_; }
  const Eigen::VectorXd& mean() const { return mean_; }
  /// Standard deviation of each coordinate of the present distribution.
  Eigen::VectorXd deviations() const;
  /// The mean, reflected into the box: what to evaluate or store.
  Eigen::VectorXd meanInBox() const { return intoBox(mean_); }
  const Eigen::VectorXd& best() const { return best_; }
  double bestFitness() const { return bestFitness_; }

  /// n x population: the points to evaluate, in the box. The same until tell() is called.
  const Eigen::MatrixXd& ask();
  /// fitness[k] of column k. NaN counts as the worst possible.
  void tell(const Eigen::VectorXd& fitness);

  CmaEsStop stop() const { return stop_; }

  nlohmann::json save() const;
  static CmaEs restore(const nlohmann::json& state);

 private:
  CmaEs() : random_(1) {}
  void setWeights();
  void decompose();
  void updateCovariance(const Eigen::MatrixXd& steps, bool pathStalled);
  void checkStop(const Eigen::VectorXd& sortedFitness);
  Eigen::VectorXd intoBox(const Eigen::VectorXd& x) const;

  CmaEsSettings settings_;
  int population_ = 0;
  Eigen::VectorXd weights_;    // all of them, best first; negative ones only if active
  int parents_ = 0;            // mu: number of positive weights
  double effective_ = 0.0;     // mu_eff
  double sigmaRate_ = 0.0;     // c_sigma
  double sigmaDamping_ = 0.0;  // d_sigma
  double pathRate_ = 0.0;      // c_c
  double rankOneRate_ = 0.0;   // c_1
  double rankMuRate_ = 0.0;    // c_mu
  double expectedNorm_ = 0.0;  // E||N(0, I)||

  Eigen::VectorXd mean_;
  double sigma_ = 0.0;
  Eigen::MatrixXd covariance_;
  Eigen::MatrixXd basis_;      // eigenvectors of the covariance
  Eigen::VectorXd scales_;     // square roots of its eigenvalues
  Eigen::VectorXd path_;       // p_c
  Eigen::VectorXd sigmaPath_;  // p_sigma
  Eigen::MatrixXd samples_;    // as drawn, not reflected
  Eigen::MatrixXd inBox_;
  bool asked_ = false;
  int generation_ = 0;
  int decomposedAt_ = 0;
  std::int64_t evaluations_ = 0;
  Eigen::VectorXd best_;
  double bestFitness_ = 0.0;
  std::vector<double> recentBest_;  // of the last generations, newest last
  CmaEsStop stop_ = CmaEsStop::None;
  Random random_;
};

/// Restarts with growing populations. IPOP [Auger 2005] doubles the population each time. BIPOP [Hansen 2009]
/// alternates that with short runs of small, random population and step size, and gives both kinds equal
/// budgets.
enum class RestartScheme : std::uint8_t { None, Ipop, Bipop };

class RestartingCmaEs {
 public:
  /// Restarts begin at a uniform point of [startLow, startHigh] of the settings, or else of their box, or
  /// else at `start` plus a normal step of the initial sigma.
  RestartingCmaEs(const Eigen::VectorXd& start, const CmaEsSettings& settings, RestartScheme scheme);

  /// Begins the next run if the last tell() ended one: until then run() is the one that was told.
  const Eigen::MatrixXd& ask();
  void tell(const Eigen::VectorXd& fitness);

  const CmaEs& run() const { return run_; }
  int restarts() const { return restarts_; }
  std::int64_t evaluations() const { return finishedEvaluations_ + run_.evaluations(); }
  const Eigen::VectorXd& best() const { return best_; }
  double bestFitness() const { return bestFitness_; }
  bool finished() const { return scheme_ == RestartScheme::None && run_.stop() != CmaEsStop::None; }

  nlohmann::json save() const;
  static RestartingCmaEs restore(const nlohmann::json& state);

 private:
  RestartingCmaEs(CmaEs run) : run_(std::move(run)), random_(1) {}  // for restore
  void restart();

  Eigen::VectorXd start_;
  CmaEsSettings settings_;
  RestartScheme scheme_ = RestartScheme::None;
  CmaEs run_;
  Random random_;
  int restarts_ = 0;
  int largePopulation_ = 0;
  bool smallRegime_ = false;
  std::int64_t largeBudget_ = 0;
  std::int64_t smallBudget_ = 0;
  std::int64_t finishedEvaluations_ = 0;
  Eigen::VectorXd best_;
  double bestFitness_ = 0.0;
};

}  // namespace nonet::lab
