#include "nonet/lab/reports/kick_straighten.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string_view>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "nonet/lab/common/statistics.h"
#include "nonet/math/angle.h"

namespace nonet::lab {

namespace {

constexpr double kFootTurned = 0.08;  // rad, of the foot: to see how far the ball's way turns with it
constexpr double kLeastAuthority = 0.2;
constexpr double kStumbled = 0.1;  // rad
constexpr std::size_t kLeastSamples = 20;
constexpr double kRidge = 0.02;                     // of the samples
constexpr std::array<double, 2> kShares{0.8, 0.6};  // of what is missing, set in each round
constexpr double kLeastVeer = toRadians(0.3);       // less is noise
constexpr double kMayCost = 0.95;                   // share of the distance that it may cost
constexpr double kWorse = 0.02;                     // share of kicks that may fall or fail more than before
constexpr std::array<std::string_view, 2 + kTurningInputs> kNames{
    "veer", "yaw", "yawAhead", "yawAside", "yawTurn", "yawPaceAhead", "yawPaceAside"};
constexpr std::size_t kFirstSlope = 2;  // of the names, then in the order of the inputs

std::vector<double> directionsOf(const std::vector<DirectionSample>& samples) {
  std::vector<double> directions(samples.size());
  std::transform(samples.begin(), samples.end(), directions.begin(),
                 [](const DirectionSample& sample) { return sample.direction; });
  return directions;
}

std::vector<DirectionSample> samplesOf(const KickMeasures& measures, const motion::KickHead& head) {
  std::vector<DirectionSample> samples;
  for (const Kick& kick : measures.kicks) {
    if (!kick.begin || kick.missed()) continue;
    const bool right = kick.begin->foot == model::Side::Right;
    const motion::KickInputs inputs = motion::kickInputs(kick.begin->aim, head, right);
    samples.push_back({inputs.head<kTurningInputs>(), right ? -kick.direction() : kick.direction()});
  }
  return samples;
}

DirectionFigures figuresOf(const std::vector<DirectionSample>& samples) {
  if (samples.empty()) return {};
  const auto beyond = std::count_if(samples.begin(), samples.end(), [](const DirectionSample& sample) {
    return std::abs(sample.direction) > toRadians(5.0);
  });
  return {quantile(directionsOf(samples), 0.5),
          static_cast<double>(beyond) / static_cast<double>(samples.size())};
}

// The kick with values of its parameters that change.
class Straightening {
 public:
  explicit Straightening(const KickReportSettings& settings)
      : settings_(settings), head_(kickHead(settings.agent, settings.kick)) {
    if (!has("yaw") && !has("veer")) {
      throw std::runtime_error(
          fmt::format("{} has neither the parameter 'yaw' nor 'veer', by which kicks are straightened: see "
                      "'turned' in skills/README.md",
                      settings.kick));
    }
  }

  bool has(std::string_view parameter) const { return indexOf(parameter).has_value(); }
  double value(std::string_view parameter) const {
    return has(parameter) ? values()[*indexOf(parameter)] : 0.0;
  }
  void add(std::string_view parameter, double change) {
    if (!has(parameter)) return;
    const std::size_t i = *indexOf(parameter);
    const config::Range& range = skills().names->at(i).range;
    values()[i] = std::clamp(values()[i] + change, range.low, range.high);
  }
  config::Unit unit(std::string_view parameter) const { return skills().names->at(*indexOf(parameter)).unit; }

  KickMeasures measure(std::uint64_t seed) {
    KickReportSettings settings = settings_;
    settings.seed = seed;
    KickMeasures measures = measureKicks(settings).front();
    samples_ = samplesOf(measures, head_);
    return measures;
  }
  /// Of the kicks that were measured last.
  const std::vector<DirectionSample>& samples() const { return samples_; }
  double median() const { return quantile(directionsOf(samples_), 0.5); }

 private:
  const motion::SkillParameters& skills() const { return settings_.agent.parameters.motion.skills; }
  std::vector<double>& values() { return settings_.agent.parameters.motion.skills.values; }
  const std::vector<double>& values() const { return skills().values; }
  std::optional<std::size_t> indexOf(std::string_view parameter) const {
    const std::size_t i = skills().indexOf(settings_.kick, parameter);
    return i < values().size() ? std::optional(i) : std::nullopt;
  }

  KickReportSettings settings_;
  motion::KickHead head_;
  std::vector<DirectionSample> samples_;
};

// The turn of the foot on average stays what it was, so that the posture it was learned with does.
void turnBack(Straightening& kick, const DirectionFit& fit, double share, double authority) {
  for (int i = 0; i < kTurningInputs; ++i) {
    const std::string_view name = kNames[kFirstSlope + static_cast<std::size_t>(i)];
    const double before = kick.value(name);
    kick.add(name, -share * fit.slopes[i] / authority);
    kick.add("yaw", -(kick.value(name) - before) * fit.mean[i]);
  }
}

double authorityOf(Straightening& kick, std::uint64_t seed) {
  if (!kick.has("yaw")) return 0.0;
  const double before = kick.value("yaw");
  std::array<double, 2> medians{};
  for (const int side : {0, 1}) {
    kick.add("yaw", (side == 0 ? -1.0 : 1.0) * kFootTurned);
    kick.measure(seed);
    medians[static_cast<std::size_t>(side)] = kick.median();
    kick.add("yaw", before - kick.value("yaw"));
  }
  return (medians[1] - medians[0]) / (2.0 * kFootTurned);
}

void aimAnew(Straightening& kick) {
  if (std::abs(kick.median()) > kLeastVeer) kick.add("veer", kick.median());
}

void turnInRounds(Straightening& kick, std::uint64_t seed, double authority) {
  for (const double share : kShares) {
    turnBack(kick, fitDirection(kick.samples()), share, authority);
    kick.measure(seed);
    aimAnew(kick);
  }
}

bool isBetter(const StraightenedKick& r) {
  return r.after.directionError.mean < r.before.directionError.mean &&
         r.after.distance.mean > kMayCost * r.before.distance.mean &&
         r.after.falls < r.before.falls + kWorse && r.after.under2m < r.before.under2m + kWorse &&
         r.after.selfCollisions < r.before.selfCollisions + kWorse;
}

}  // namespace

DirectionFit fitDirection(const std::vector<DirectionSample>& samples) {
  const double median = quantile(directionsOf(samples), 0.5);
  std::vector<DirectionSample> kept;
  std::copy_if(samples.begin(), samples.end(), std::back_inserter(kept), [&](const DirectionSample& sample) {
    return std::abs(sample.direction - median) < kStumbled;
  });
  if (kept.size() < kLeastSamples) {
    throw std::runtime_error(
        fmt::format("only {} kicks of {} went about where the others did: too few, ask for more --trials",
                    kept.size(), samples.size()));
  }
  const auto n = static_cast<Eigen::Index>(kept.size());
  Eigen::MatrixXd inputs(n, kTurningInputs);
  Eigen::VectorXd directions(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    inputs.row(i) = kept[static_cast<std::size_t>(i)].inputs.transpose();
    directions[i] = kept[static_cast<std::size_t>(i)].direction;
  }
  DirectionFit fit;
  fit.mean = inputs.colwise().mean().transpose();
  inputs.rowwise() -= fit.mean.transpose();
  directions.array() -= directions.mean();
  // In their own deviations, so that the ridge weighs all alike.
  constexpr double kNone = 1e-9;
  const TurningInputs scale =
      (inputs.colwise().norm().transpose() / std::sqrt(static_cast<double>(n))).array() + kNone;
  inputs = inputs * scale.cwiseInverse().asDiagonal();
  Eigen::MatrixXd normal = inputs.transpose() * inputs;
  normal.diagonal().array() += kRidge * static_cast<double>(n);
  const Eigen::VectorXd slopes = normal.ldlt().solve(inputs.transpose() * directions);
  fit.slopes = slopes.cwiseQuotient(scale);
  fit.deviation = directions.norm() / std::sqrt(static_cast<double>(n));
  fit.rest = (directions - inputs * slopes).norm() / std::sqrt(static_cast<double>(n));
  return fit;
}

StraightenedKick straightenKick(const KickReportSettings& settings) {
  Straightening kick(settings);
  StraightenedKick result;
  result.kick = settings.kick;
  result.robotType = settings.agent.robotType;
  for (const std::string_view name : kNames)
    if (kick.has(name)) result.parameters.push_back({std::string(name), kick.unit(name), kick.value(name)});
  const std::uint64_t fresh = settings.seed + 1;
  result.before = kick.measure(fresh);
  result.directionBefore = figuresOf(kick.samples());
  result.authority = authorityOf(kick, settings.seed);
  result.turns = std::abs(result.authority) > kLeastAuthority;
  kick.measure(settings.seed);
  result.fit = fitDirection(kick.samples());
  if (result.turns) {
    turnInRounds(kick, settings.seed, result.authority);
  } else {
    aimAnew(kick);
  }
  result.after = kick.measure(fresh);
  result.directionAfter = figuresOf(kick.samples());
  for (FittedParameter& parameter : result.parameters) parameter.after = kick.value(parameter.name);
  result.better = isBetter(result);
  return result;
}

std::string straightenedTable(const StraightenedKick& r) {
  std::string text = fmt::format("{}, robot type {}\n", r.kick, r.robotType);
  text += fmt::format("{:<8} {:>7} {:>8} {:>11} {:>11} | {:>6} {:>6} {:>8} {:>6} {:>6} {:>6}\n", "", "trials",
                      "off deg", "median left", "beyond five", "mean m", "p10", "under 2m", "falls", "fouls",
                      "time s");
  const auto addRow = [&](const char* when, const KickMeasures& kicks, const DirectionFigures& off) {
    text += fmt::format(
        "{:<8} {:>7} {:>8.2f} {:>11.2f} {:>10.1f}% | {:>6.2f} {:>6.2f} {:>7.1f}% {:>5.1f}% {:>5.1f}% "
        "{:>6.2f}\n",
        when, kicks.trials, toDegrees(kicks.directionError.mean), toDegrees(off.median),
        100.0 * off.beyondFive, kicks.distance.mean, kicks.distance.p10, 100.0 * kicks.under2m,
        100.0 * kicks.falls, 100.0 * kicks.selfCollisions, kicks.time.mean);
  };
  addRow("before", r.before, r.directionBefore);
  addRow("after", r.after, r.directionAfter);
  text += fmt::format("the foot turned by a degree turns the ball's way by {:.2f} degrees{}\n", r.authority,
                      r.turns ? "" : ": too little, so that only 'veer' was set");
  text += fmt::format("of a deviation of {:.2f} degrees before, {:.2f} do not follow what the kick is told\n",
                      toDegrees(r.fit.deviation), toDegrees(r.fit.rest));
  text += r.better ? "straighter, and as good in all else\n"
                   : "not better: keep the values before, or try more --trials\n";
  return text;
}

std::string straightenedToml(const StraightenedKick& result) {
  return fmt::format("# Set by nonet kick straighten {} --type {}\n", result.kick, result.robotType) +
         skillOverlay(result.kick, result.parameters);
}

}  // namespace nonet::lab
