#include "nonet/lab/optimize/curve_measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "nonet/model/ball.h"
#include "nonet/model/kinematics.h"
#include "nonet/motion/limbs.h"

namespace nonet::lab {

using model::BodyId;
using motion::FootCurve;

namespace {

constexpr double kTouches = 1e-5;    // m
constexpr double kTinyShare = 1e-4;  // of the curve, over which the foot's speed is taken
constexpr int kHalvings = 20;        // of a step, to find the contact in it
// What a rough surface that slides past gives a solid ball at rest, as a share of its own speed: 2/7 of it
// turns into speed, the rest into spin.
constexpr double kDragged = 2.0 / 7.0;

struct Nearest {
  double gap = std::numeric_limits<double>::infinity();  // m, from the ball's surface; negative inside
  Vector3 normal = Vector3::Zero();                      // from the foot to the ball's centre, torso frame
  Vector3 p_FPoint = Vector3::Zero();                    // on the box, in its own frame
  BodyId body = BodyId::LFoot;
};

// The place on a box that is nearest to the ball's centre. With the centre in the box there is no normal.
Nearest nearestOf(const model::RobotModel& model, const model::BodyPoses& bodies, BodyId body,
                  const Vector3& p_RBall) {
  const Vector3 half = 0.5 * model.body(body).shape.size;
  const Pose3& X_RF = bodies[model::index(body)];
  const Vector3 p_FBall = X_RF.inverse() * p_RBall;
  Nearest nearest;
  nearest.body = body;
  nearest.p_FPoint = p_FBall.cwiseMax(-half).cwiseMin(half);
  const Vector3 way = p_FBall - nearest.p_FPoint;
  nearest.gap = way.norm() - model::kBallRadius;
  if (way.norm() > 1e-9) nearest.normal = X_RF.linear() * way.normalized();
  return nearest;
}

class Curve {
 public:
  Curve(const model::RobotModel& model, const motion::PlannedCurve& planned)
      : model_(model), planned_(planned), side_(planned.curve.side()) {}

  CurveMeasures measure() {
    CurveMeasures measures;
    measures.steps.resize(FootCurve::kSteps);
    measures.meetsBall = planned_.meetsBall;
    measures.beside = besideSpeed();
    model::LegAngles before = model::legAngles(side_, planned_.posture);
    for (std::size_t i = 0; i < FootCurve::kSteps; ++i) {
      const double share = static_cast<double>(i + 1) / FootCurve::kSteps;
      model::LegAngles leg = before;
      measures.steps[i] = step(share, before, leg);
      before = leg;
    }
    measures.contact = contact(measures);
    return measures;
  }

 private:
  model::JointId legJoint(std::size_t i) const {
    const std::size_t first =
        model::index(side_ == model::Side::Left ? model::JointId::LLeg1 : model::JointId::RLeg1);
    return model::jointAt(first + i);
  }

  double besideSpeed() const {
    double fastest = 0.0;
    for (const motion::JointGoal& goal : planned_.instruction->joints) {
      if (!model_.has(goal.joint)) continue;
      const double way = goal.angle.constant - planned_.posture[model::index(goal.joint)];
      fastest = std::max(fastest,
                         std::abs(way) / (planned_.instruction->value * model_.joint(goal.joint).maxSpeed));
    }
    return fastest;
  }

  CurveStep step(double share, const model::LegAngles& before, model::LegAngles& leg) {
    CurveStep step;
    const Pose3 X_RS = planned_.curve.at(share);
    step.reached = model::legReaches(model_, side_, X_RS, leg);
    if (!step.reached) model::legInverseKinematics(model_, side_, X_RS, leg);
    const double time = planned_.instruction->value / FootCurve::kSteps;
    for (std::size_t i = 0; i < leg.size(); ++i) {
      const model::JointSpec& joint = model_.joint(legJoint(i));
      step.room[i] = std::min(leg[i] - joint.low, joint.high - leg[i]);
      step.speeds[i] = std::abs(leg[i] - before[i]) / (FootCurve::kOfFullSpeed * joint.maxSpeed * time);
    }
    place(leg);
    if (!step.reached) {
      const Pose3 off = model::solePose(model_, bodies_, side_).inverse() * X_RS;
      const double turn = Eigen::AngleAxisd(off.linear()).angle();
      step.miss = std::hypot(off.translation().norm(), model::kOrientationLever * turn);
    }
    step.balance = motion::insideStanceFoot(model_, bodies_);
    step.height = lowest(side_ == model::Side::Left ? BodyId::LFoot : BodyId::RFoot);
    return step;
  }

  // Above the plane of the stance foot's sole, m.
  double lowest(BodyId body) const {
    const Pose3 X_SF =
        model::solePose(model_, bodies_, model::other(side_)).inverse() * bodies_[model::index(body)];
    const Vector3 half = 0.5 * model_.body(body).shape.size;
    return X_SF.translation().z() - X_SF.linear().row(2).cwiseAbs().dot(half);
  }

  void place(const model::LegAngles& leg) {
    model::JointArray joints = planned_.posture;
    model::setLegAngles(side_, leg, joints);
    model::forwardKinematics(model_, joints, bodies_);
  }

  Nearest nearestAt(double share) {
    model::LegAngles leg{};
    model::legInverseKinematics(model_, side_, planned_.curve.at(share), leg);
    place(leg);
    const bool left = side_ == model::Side::Left;
    Nearest nearest =
        nearestOf(model_, bodies_, left ? BodyId::LFoot : BodyId::RFoot, planned_.curve.origin());
    if (model_.hasToes()) {
      const Nearest toe =
          nearestOf(model_, bodies_, left ? BodyId::LToe : BodyId::RToe, planned_.curve.origin());
      if (toe.gap < nearest.gap) nearest = toe;
    }
    return nearest;
  }

  using Gaps =
      std::array<double, FootCurve::kSteps + 1>;  // between foot and ball at the ends of the steps, m

  Gaps gaps() {
    Gaps gaps{};
    for (std::size_t i = 0; i < gaps.size(); ++i)
      gaps[i] = nearestAt(static_cast<double>(i) / FootCurve::kSteps).gap;
    return gaps;
  }

  // The first share at which the foot touches, or the one at which it is nearest.
  double contactShare(const Gaps& gaps) {
    double best = 0.0;
    double least = gaps[0];
    for (std::size_t i = 1; i < gaps.size() && least > 0.0; ++i) {
      if (gaps[i] >= least) continue;
      least = gaps[i];
      best = static_cast<double>(i) / FootCurve::kSteps;
    }
    if (least > 0.0) return best;
    double apart = std::max(0.0, best - 1.0 / FootCurve::kSteps);
    double touching = best;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (apart + touching);
      (nearestAt(middle).gap > 0.0 ? apart : touching) = middle;
    }
    return apart;
  }

  // How long a step truly takes, s.
  double stepTime(const CurveMeasures& measures, double share) const {
    const auto at = static_cast<std::size_t>(std::min(share * FootCurve::kSteps, FootCurve::kSteps - 1.0));
    double slowest = std::max(1.0, measures.beside);
    for (const double speed : measures.steps[at].speeds) slowest = std::max(slowest, speed);
    return slowest * planned_.instruction->value / FootCurve::kSteps;
  }

  CurveContact contact(const CurveMeasures& measures) {
    CurveContact contact;
    const Gaps distances = gaps();
    contact.clearance = distances.front();
    contact.deepest = *std::min_element(distances.begin(), distances.end());
    contact.share = contactShare(distances);
    const Nearest nearest = nearestAt(contact.share);
    contact.gap = nearest.gap < kTouches ? 0.0 : nearest.gap;
    const double before = std::max(0.0, contact.share - kTinyShare);
    const double after = std::min(1.0, contact.share + kTinyShare);
    const auto pointAt = [&](double share) {
      nearestAt(share);
      return Vector3(bodies_[model::index(nearest.body)] * nearest.p_FPoint);
    };
    const Vector3 way = pointAt(after) - pointAt(before);
    const Vector3 velocity = way / ((after - before) * FootCurve::kSteps * stepTime(measures, contact.share));
    contact.speed = velocity.dot(nearest.normal);
    const Vector3 pushed = contact.speed * nearest.normal;
    const Vector3 ball = planned_.R_LR * (pushed + kDragged * (velocity - pushed));
    contact.direction = std::atan2(ball.y(), ball.x());
    return contact;
  }

  const model::RobotModel& model_;
  const motion::PlannedCurve& planned_;
  model::Side side_;
  model::BodyPoses bodies_ = model::identityPoses();
};

template <class Value>
double least(const std::vector<CurveStep>& steps, const Value& value) {
  double result = std::numeric_limits<double>::infinity();
  for (const CurveStep& step : steps) result = std::min(result, value(step));
  return result;
}

}  // namespace

double CurveMeasures::reached() const {
  const auto count =
      std::count_if(steps.begin(), steps.end(), [](const CurveStep& step) { return step.reached; });
  return static_cast<double>(count) / static_cast<double>(steps.size());
}

double CurveMeasures::worstMiss() const {
  return -least(steps, [](const CurveStep& step) { return -step.miss; });
}

double CurveMeasures::leastRoom() const {
  return least(steps,
               [](const CurveStep& step) { return *std::min_element(step.room.begin(), step.room.end()); });
}

double CurveMeasures::worstSpeed() const {
  const double leg = -least(steps, [](const CurveStep& step) {
    return -*std::max_element(step.speeds.begin(), step.speeds.end());
  });
  return std::max(leg, beside);
}

double CurveMeasures::leastBalance() const {
  return least(steps, [](const CurveStep& step) { return step.balance; });
}

double CurveMeasures::leastHeight() const {
  return least(steps, [](const CurveStep& step) { return step.height; });
}

CurveMeasures measureCurve(const model::RobotModel& model, const motion::PlannedCurve& planned) {
  return Curve(model, planned).measure();
}

}  // namespace nonet::lab
