#include "nonet/lab/optimize/kick_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>

#include <ceres/cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <fmt/format.h>

#include "nonet/math/angle.h"
#include "nonet/math/random.h"
#include "nonet/motion/skill_language.h"
#include "nonet/motion/walk/engine.h"

namespace nonet::lab {

using motion::CurveCheck;
using motion::FootCurve;

bool withinLimits(const CurveMeasures& measures) {
  constexpr double kRounding = 1e-9;
  return measures.reached() == 1.0 && (measures.contact.gap == 0.0) == measures.meetsBall &&
         measures.contact.clearance > 0.0 && measures.worstSpeed() <= 1.0 + kRounding &&
         measures.leastBalance() > CurveCheck::kInsideFoot && measures.leastHeight() > 0.0;
}

namespace {

constexpr int kRounds = 5;            // in each the limits weigh more,
constexpr double kRoundWeight = 3.0;  // by this factor
// A residual of 1 each: so far outside its limit.
constexpr double kMiss = 0.005;                // m
constexpr double kRoom = toRadians(2.0);       // rad, of a joint: also what is to stay free
constexpr double kBalance = 0.01;              // m
constexpr double kHeight = 0.005;              // m: also what is to stay free
constexpr double kBalanceSpare = 0.002;        // m, more than the check wants
constexpr double kSpeed = 0.1;                 // share
constexpr double kSpeedSpare = 0.02;           // share
constexpr double kDirection = toRadians(2.0);  // rad
constexpr double kGap = 0.01;                  // m
constexpr double kWish = 8.0;                  // m/s at contact, that no curve reaches,
constexpr double kWishUnit = 2.0;              // m/s
constexpr double kClear = 0.01;                // m between foot and ball where the curve begins
constexpr double kUntouched = 0.004;           // m, from a curve that only leads to the ball
constexpr double kLeadsTo = 0.015;             // m, so near it comes
constexpr double kEarliest = 0.3;             // share of the curve at contact: the foot needs way to speed up
constexpr double kEarly = 0.1;                // share
constexpr double kStay = 0.1;                 // a parameter's way through its range
constexpr double kAround = 0.2;               // of a range: how far off other starts are
constexpr double kStep = 1e-4;                // of a range, for the derivatives
constexpr double kGain = 0.02;                // share of the foot's speed for which a good curve is changed
constexpr double kOnCourse = toRadians(3.0);  // rad
constexpr double kCorner = 0.7;               // share of the tolerances: the ball may lie there as well
const std::array<Vector2, 5> kPlaces{Vector2(0, 0), Vector2(1, 1), Vector2(1, -1), Vector2(-1, 1),
                                     Vector2(-1, -1)};
constexpr std::size_t kPerStep = 9;  // residuals: miss, balance, height, six joints
constexpr std::size_t kLeg = 6;

/// A kick with certain values of its parameters. Its parts refer to each other, so it stays where it is.
class CurveKick {
 public:
  CurveKick(const model::RobotModel& model, std::vector<motion::Skill> skills, const std::string& kick,
            const model::JointArray& stand)
      : library_(std::move(skills)), catalogue_(library_, model.type()), check_(model, library_, stand) {
    for (const motion::KickOption& option : catalogue_.options())
      if (option.name == kick && option.foot == model::Side::Left) option_ = &option;
  }
  CurveKick(const CurveKick&) = delete;
  CurveKick& operator=(const CurveKick&) = delete;

  bool serves() const { return option_ != nullptr; }
  const motion::KickHead& head() const { return option_->head; }
  std::optional<motion::PlannedCurve> plan(const Vector2& offPlace) const {
    return check_.plan(*option_, option_->head.p_RBall + offPlace);
  }

 private:
  motion::SkillLibrary library_;
  motion::KickCatalogue catalogue_;
  CurveCheck check_;
  const motion::KickOption* option_ = nullptr;
};

/// The skill's text, read anew with other values.
class KickText {
 public:
  explicit KickText(const KickFitSettings& settings)
      : model_(model::robotModel(settings.agent.robotType)),
        kick_(settings.kick),
        texts_(motion::skillTexts(settings.agent.skillFolder)),
        stand_(motion::WalkEngine::standAngles(model_,
                                               settings.agent.parameters.motion.sets.of(
                                                   settings.agent.parameters.motion.selection.standSet()))) {
    const motion::SkillParameters& values = settings.agent.parameters.motion.skills;
    const auto lookup = [&](std::string_view skill, std::string_view name) {
      return values.find(skill, name);
    };
    for (std::size_t i = 0; i < texts_.size(); ++i) {
      for (motion::Skill& skill : motion::parseSkills(texts_[i].text, texts_[i].file, lookup, texts_)) {
        if (skill.name != kick_) continue;
        file_ = i;
        parameters_ = std::move(skill.parameters);
      }
    }
  }

  const model::RobotModel& model() const { return model_; }
  const std::vector<motion::SkillParameter>& parameters() const { return parameters_; }

  std::unique_ptr<CurveKick> with(const std::vector<double>& values) const {
    const auto lookup = [&](std::string_view skill, std::string_view name) -> std::optional<double> {
      if (skill != kick_) return std::nullopt;
      for (std::size_t i = 0; i < parameters_.size(); ++i)
        if (parameters_[i].name == name) return values[i];
      return std::nullopt;
    };
    std::vector<motion::Skill> skills =
        motion::parseSkills(texts_[file_].text, texts_[file_].file, lookup, texts_);
    return std::make_unique<CurveKick>(model_, std::move(skills), kick_, stand_);
  }

 private:
  const model::RobotModel& model_;
  std::string kick_;
  std::vector<motion::SkillText> texts_;
  model::JointArray stand_;
  std::size_t file_ = 0;
  std::vector<motion::SkillParameter> parameters_;
};

/// Which parameters move the curve, and between their values and numbers from 0 to 1.
class Unknowns {
 public:
  explicit Unknowns(const KickText& text) : text_(&text) {
    for (const motion::SkillParameter& parameter : text.parameters()) start_.push_back(parameter.value);
    const std::vector<double> before = places(start_);
    for (std::size_t i = 0; i < start_.size(); ++i) {
      const std::optional<config::Range>& range = text.parameters()[i].range;
      if (!range) continue;
      std::vector<double> moved = start_;
      const double middle = 0.5 * (range->low + range->high);
      moved[i] += (start_[i] < middle ? 0.01 : -0.01) * (range->high - range->low);
      if (places(moved) != before) moving_.push_back(i);
    }
  }

  std::size_t size() const { return moving_.size(); }
  const std::vector<double>& start() const { return start_; }

  std::vector<double> scaled(const std::vector<double>& values) const {
    std::vector<double> x;
    for (const std::size_t i : moving_) {
      const config::Range& range = *text_->parameters()[i].range;
      x.push_back((values[i] - range.low) / (range.high - range.low));
    }
    return x;
  }
  std::vector<double> values(const double* x) const {
    std::vector<double> values = start_;
    for (std::size_t k = 0; k < moving_.size(); ++k) {
      const config::Range& range = *text_->parameters()[moving_[k]].range;
      values[moving_[k]] = std::clamp(range.low + x[k] * (range.high - range.low), range.low, range.high);
    }
    return values;
  }

 private:
  // All that the text says of the curve: what no parameter changes is not to be fitted.
  std::vector<double> places(const std::vector<double>& values) const {
    const std::unique_ptr<CurveKick> kick = text_->with(values);
    const std::optional<motion::PlannedCurve> planned = kick->plan(Vector2::Zero());
    std::vector<double> numbers{planned->instruction->value, kick->head().direction};
    numbers.insert(numbers.end(), planned->posture.begin(), planned->posture.end());
    for (const double share : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}) {
      const Pose3 pose = planned->curve.at(share);
      numbers.insert(numbers.end(), pose.matrix().data(), pose.matrix().data() + 16);
    }
    for (const motion::JointGoal& goal : planned->instruction->joints) numbers.push_back(goal.angle.constant);
    return numbers;
  }

  const KickText* text_;
  std::vector<double> start_;
  std::vector<std::size_t> moving_;
};

class FitCost final : public ceres::CostFunction {
 public:
  FitCost(const KickText& text, const Unknowns& unknowns, const std::vector<double>& origin, double weight)
      : text_(text), unknowns_(unknowns), origin_(unknowns.scaled(origin)), weight_(weight) {
    const std::size_t perCurve = FootCurve::kSteps * kPerStep;
    set_num_residuals(
        static_cast<int>(kPlaces.size() * perCurve + FootCurve::kSteps * kLeg + 6 + unknowns.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(unknowns.size()));
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const double* x = parameters[0];
    if (!residualsAt(x, residuals)) return false;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    const auto rows = static_cast<std::size_t>(num_residuals());
    const std::size_t columns = unknowns_.size();
    std::vector<double> moved(x, x + columns);
    std::vector<double> there(rows);
    for (std::size_t column = 0; column < columns; ++column) {
      const double step = x[column] < 0.5 ? kStep : -kStep;
      moved[column] = x[column] + step;
      if (!residualsAt(moved.data(), there.data())) return false;
      moved[column] = x[column];
      for (std::size_t row = 0; row < rows; ++row)
        jacobians[0][row * columns + column] = (there[row] - residuals[row]) / step;
    }
    return true;
  }

 private:
  static double beyond(double value, double limit, double scale) {
    return std::max(0.0, value - limit) / scale;
  }

  bool residualsAt(const double* x, double* residuals) const {
    try {
      const std::unique_ptr<CurveKick> kick = text_.with(unknowns_.values(x));
      double* next = residuals;
      for (const Vector2& place : kPlaces) {
        const Vector2 off = kCorner * place.cwiseProduct(kick->head().tolerance);
        const CurveMeasures measures = measureCurve(text_.model(), *kick->plan(off));
        next = addLimits(measures, next);
        if (&place == kPlaces.data()) next = addSpeeds(measures, kick->head(), next);
      }
      for (std::size_t i = 0; i < origin_.size(); ++i) *next++ = kStay * (x[i] - origin_[i]);
      return true;
    } catch (const motion::SkillError&) {
      return false;  // the text makes no sense with these values
    }
  }

  double* addLimits(const CurveMeasures& measures, double* next) const {
    for (const CurveStep& step : measures.steps) {
      *next++ = weight_ * step.miss / kMiss;
      *next++ = weight_ * beyond(CurveCheck::kInsideFoot + kBalanceSpare, step.balance, kBalance);
      *next++ = weight_ * beyond(kHeight, step.height, kHeight);
      for (const double room : step.room) *next++ = weight_ * beyond(kRoom, room, kRoom);
    }
    return next;
  }

  double* addSpeeds(const CurveMeasures& measures, const motion::KickHead& head, double* next) const {
    for (const CurveStep& step : measures.steps)
      for (const double speed : step.speeds) *next++ = weight_ * beyond(speed, 1.0 - kSpeedSpare, kSpeed);
    *next++ = weight_ * beyond(measures.beside, 1.0 - kSpeedSpare, kSpeed);
    const CurveContact& contact = measures.contact;
    *next++ = weight_ * beyond(kClear, contact.clearance, kGap);
    if (!measures.meetsBall) {  // it comes up to the ball and does not touch it
      *next++ = weight_ * beyond(kUntouched, contact.deepest, kGap);
      *next++ = weight_ * beyond(contact.gap, kLeadsTo, kGap);
      return std::fill_n(next, 2, 0.0);
    }
    *next++ = weight_ * contact.gap / kGap;
    *next++ = weight_ * beyond(kEarliest, contact.share, kEarly);
    *next++ = angleDifference(contact.direction, head.direction) / kDirection;
    *next++ = (kWish - contact.speed) / kWishUnit;
    return next;
  }

  const KickText& text_;
  const Unknowns& unknowns_;
  std::vector<double> origin_;
  double weight_;
};

std::vector<double> solve(const KickText& text, const Unknowns& unknowns, const std::vector<double>& from,
                          double weight, int iterations) {
  std::vector<double> x = unknowns.scaled(from);
  ceres::Problem problem;
  // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): the problem owns it
  problem.AddResidualBlock(new FitCost(text, unknowns, unknowns.start(), weight), nullptr, x.data());
  for (std::size_t i = 0; i < x.size(); ++i) {
    problem.SetParameterLowerBound(x.data(), static_cast<int>(i), 0.0);
    problem.SetParameterUpperBound(x.data(), static_cast<int>(i), 1.0);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;  // the same bits whatever the machine
  options.max_num_iterations = iterations;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return unknowns.values(x.data());
}

struct Fitted {
  std::vector<double> values;
  CurveMeasures measures;
  bool holds = false;
};

CurveMeasures measuresOf(const KickText& text, const std::vector<double>& values) {
  return measureCurve(text.model(), *text.with(values)->plan(Vector2::Zero()));
}

// The limits weigh more from round to round, until they hold.
Fitted fitFrom(const KickText& text, const Unknowns& unknowns, std::vector<double> values, int iterations) {
  Fitted fitted;
  double weight = 1.0;
  for (int round = 0; round < kRounds && !fitted.holds; ++round, weight *= kRoundWeight) {
    values = solve(text, unknowns, values, weight, iterations);
    fitted.measures = measuresOf(text, values);
    fitted.holds = withinLimits(fitted.measures);
  }
  fitted.values = std::move(values);
  return fitted;
}

double offCourse(const CurveMeasures& measures, double direction) {
  return std::abs(angleDifference(measures.contact.direction, direction));
}

// Limits first, then the direction, then the foot's speed.
bool isBetter(const Fitted& a, const Fitted& b, double direction) {
  if (a.holds != b.holds) return a.holds;
  if (!a.measures.meetsBall) return false;  // the first: it stays nearest to the kick's own values
  const bool onCourse = offCourse(a.measures, direction) < kOnCourse;
  if (onCourse != (offCourse(b.measures, direction) < kOnCourse)) return onCourse;
  return a.measures.contact.speed > b.measures.contact.speed;
}

// Least squares find the nearest valley: so from here, and from places around.
Fitted bestFit(const KickText& text, const Unknowns& unknowns, const KickFitSettings& settings,
               double direction) {
  Fitted best = fitFrom(text, unknowns, unknowns.start(), settings.iterations);
  const Random seeds(settings.agent.seed);
  for (int i = 1; i < settings.starts; ++i) {
    Random random = seeds.fork(static_cast<std::uint64_t>(i));
    std::vector<double> x = unknowns.scaled(unknowns.start());
    for (double& number : x) number = std::clamp(number + random.uniform(-kAround, kAround), 0.0, 1.0);
    Fitted fitted = fitFrom(text, unknowns, unknowns.values(x.data()), settings.iterations);
    if (isBetter(fitted, best, direction)) best = std::move(fitted);
  }
  return best;
}

void requireCurve(const KickText& text, const KickFitSettings& settings) {
  std::vector<double> values;
  for (const motion::SkillParameter& parameter : text.parameters()) values.push_back(parameter.value);
  const std::unique_ptr<CurveKick> kick = text.with(values);
  if (!kick->serves()) {
    throw std::runtime_error(fmt::format("type {} has no kick '{}' in {}", settings.agent.robotType,
                                         settings.kick, settings.agent.skillFolder));
  }
  if (!kick->plan(Vector2::Zero())) {
    throw std::runtime_error(fmt::format(
        "'{}' has no curve from ball: only such kicks can be fitted (skills/README.md)", settings.kick));
  }
}

}  // namespace

KickFit fitKick(const KickFitSettings& settings) {
  const KickText text(settings);
  requireCurve(text, settings);
  const Unknowns unknowns(text);
  if (unknowns.size() == 0) {
    throw std::runtime_error(fmt::format(
        "no parameter of '{}' that moves its curve has a range in which to search", settings.kick));
  }
  KickFit fit;
  fit.kick = settings.kick;
  fit.robotType = settings.agent.robotType;
  fit.direction = text.with(unknowns.start())->head().direction;
  fit.before = measuresOf(text, unknowns.start());
  fit.heldBefore = withinLimits(fit.before);
  Fitted best = bestFit(text, unknowns, settings, fit.direction);
  const Fitted start{unknowns.start(), fit.before, fit.heldBefore};
  const double gained = best.measures.contact.speed / std::max(fit.before.contact.speed, 1e-9) - 1.0;
  const bool onCourse = offCourse(fit.before, fit.direction) < kOnCourse;
  fit.kept = fit.heldBefore && (!isBetter(best, start, fit.direction) || (onCourse && gained < kGain));
  if (fit.kept) best = start;
  fit.after = best.measures;
  fit.holds = best.holds;
  const std::vector<double>& values = best.values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const motion::SkillParameter& parameter = text.parameters()[i];
    fit.parameters.push_back({parameter.name, parameter.unit, unknowns.start()[i], values[i]});
  }
  return fit;
}

}  // namespace nonet::lab
