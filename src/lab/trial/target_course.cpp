#include "nonet/lab/trial/target_course.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>

#include "nonet/lab/trial/push.h"
#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/math/random.h"

#include "lab/common/parallel.h"

namespace nonet::lab {

namespace {

using Kind = CourseLeg::Kind;
using motion::MotionRequest;

constexpr double kFarthest = 100.0;         // m, nobody walks there
constexpr double kReached = 0.15;           // m
constexpr double kTurned = 0.1745;          // rad
constexpr double kPlaced = 0.35;            // rad
constexpr double kTurnWorth = 0.4;          // m per rad: a turn of half a circle counts as 1.26 m
constexpr double kNoiseHold = 0.2;          // s between new noise
constexpr double kHeadingGain = 4.0;        // 1/s, of held headings
constexpr double kPushEvery = 2.0;          // s, on average
constexpr double kChangeEvery = 1.0;        // s, on average
constexpr double kNearFall = 0.3;           // rad
constexpr double kSurelyFalling = 0.6;      // rad; what comes then tells nothing more
constexpr double kLongestLeg = 30.0;        // s, of courses without time limits
constexpr double kFastest = 3.0;            // m/s; the walk clamps it to what it can do
constexpr double kFastestTurn = 2.0 * kPi;  // rad/s

Vector2 polar(double radius, double angle) {
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

CourseLeg walk(const Vector2& target, double time) {
  return {.kind = Kind::Walk, .target = target, .time = time};
}
CourseLeg shift(const Vector2& target, double time) {
  return {.kind = Kind::Shift, .target = target, .time = time};
}
CourseLeg chained(const Vector2& target, double time) {
  return {.kind = Kind::Walk, .target = target, .time = time, .chained = true};
}
CourseLeg place(const Vector2& target, double heading, double time) {
  return {.kind = Kind::Place, .target = target, .turn = heading, .time = time};
}
CourseLeg turn(double angle, double time) {
  return {.kind = Kind::Turn, .turn = angle, .time = time};
}
CourseLeg stop(double time) {
  return {.kind = Kind::Stop, .time = time};
}

CourseItem longWalks(Random& random, double side) {
  return {"long walks",
          {walk({4.0 + random.uniform(0.0, 1.0), 0.0}, 6.0), walk({-2.5, 0.3 * side}, 5.0),
           walk({0.0, 2.5 * side}, 4.5), walk({0.0, -2.5 * side}, 4.5), stop(0.6)}};
}

CourseItem curve(Random& random, double side) {
  CourseItem item{"curve", {}};
  const double radius = random.uniform(0.8, 1.6);
  for (int i = 1; i <= 4; ++i) {
    const double angle = i * kPi / 5.0;
    item.legs.push_back(
        chained({radius * std::sin(angle), side * radius * (1.0 - std::cos(angle))}, 2.0 * radius));
  }
  return item;
}

CourseItem stopAndGo(Random& random, double side) {
  CourseItem item{"stop and go", {}};
  for (const double angle : {0.0, kPi, 0.5 * kPi * side, -0.5 * kPi * side}) {
    item.legs.push_back(walk(polar(3.0, angle), random.uniform(0.8, 1.4)));
    item.legs.push_back(stop(random.uniform(0.4, 0.9)));
  }
  return item;
}

CourseItem leftAndRight(Random& random, double side) {
  CourseItem item{"left and right", {}};
  for (int i = 0; i < 4; ++i) {
    const double sign = i % 2 == 0 ? side : -side;
    item.legs.push_back(shift({0.0, 2.0 * sign}, random.uniform(0.5, 1.2)));
  }
  return item;
}

CourseItem noisyTarget(Random& random, double side) {
  CourseLeg leg = walk({2.5, side * random.uniform(0.3, 1.5)}, 4.5);
  leg.noise = 0.35;
  return {"noisy target", {leg}};
}

CourseItem weave(Random& random, double side) {
  CourseItem item{"weave", {}};
  Vector2 at = Vector2::Zero();
  const double length = random.uniform(0.7, 1.1);
  for (int i = 0; i < 4; ++i) {
    at += polar(length, (i % 2 == 0 ? side : -side) * 0.25 * kPi);
    item.legs.push_back(chained(at, 1.7));
  }
  return item;
}

CourseItem extremeChanges(Random& random, double side) {
  CourseItem item{"extreme changes", {}};
  for (int i = 0; i < 5; ++i) {
    const double time = random.uniform(0.35, 0.8);
    item.legs.push_back(walk(polar(3.0, side * random.uniform(1.5, kPi)), time));
  }
  item.legs.push_back(stop(0.6));
  return item;
}

CourseItem quickMoves(Random& random, double side) {
  CourseItem item{"quick moves and stops", {}};
  for (int i = 0; i < 3; ++i) {
    const double time = random.uniform(0.3, 0.6);
    item.legs.push_back(walk(polar(3.0, side * random.uniform(-kPi, kPi)), time));
    item.legs.push_back(stop(random.uniform(0.2, 0.5)));
  }
  return item;
}

CourseItem spiral(Random& random, double side) {
  CourseItem item{"spiral", {}};
  const bool inwards = random.uniform() < 0.5;
  for (int i = 1; i <= 5; ++i) {
    const double radius = inwards ? 1.5 - 0.2 * i : 0.4 + 0.2 * i;
    const double angle = i * kPi / 3.0;
    item.legs.push_back(chained({radius * std::sin(angle), side * radius * (1.0 - std::cos(angle))}, 1.8));
  }
  return item;
}

CourseItem heldHeading(Random& random, double side) {
  return {"held heading",
          {shift({-1.5 - random.uniform(0.0, 0.5), 0.0}, 3.5), shift({0.0, 1.2 * side}, 3.0),
           shift({0.0, -1.2 * side}, 3.0), shift(polar(0.8, side * 2.3), 2.0)}};
}

CourseItem turns(Random& random, double side) {
  return {
      "turns",
      {turn(side * random.uniform(2.0, kPi), 2.5), turn(-side * random.uniform(1.2, kPi), 2.5), stop(0.4)}};
}

CourseItem places(Random& random, double side) {
  CourseItem item{"places", {}};
  for (int i = 0; i < 4; ++i) {
    const double bearing = random.uniform(-kPi, kPi);
    const Vector2 target = polar(random.uniform(0.4, 2.5), bearing);
    item.legs.push_back(place(target, side * random.uniform(-kPi, kPi), 1.5 + 2.0 * target.norm()));
    if (i % 2 == 1) item.legs.push_back(stop(0.3));
  }
  return item;
}

// One robot on the course, which wanders off by more than half a field. After a fall a fresh one stands where
// the old one fell.
class Walker {
 public:
  Walker(const TrialSettings& setup, std::uint64_t seed, const CourseSettings& settings)
      : setup_(onOpenGround(setup)), settings_(settings), random_(Random(seed).fork(2)) {
    // As in a game: no two starts are alike.
    stand({random_.uniform(-1.0, 1.0), random_.uniform(-1.0, 1.0), random_.uniform(-kPi, kPi)});
  }

  CourseResult run(const std::vector<CourseItem>& course) {
    for (const CourseItem& item : course) {
      X_FItem_ = trial_->pose();
      for (const CourseLeg& leg : item.legs) {
        if (result_.falls >= settings_.mostFalls) return result_;
        walkLeg(leg);
      }
    }
    return result_;
  }

 private:
  void stand(const Pose2& X_FR) {
    trial_ = std::make_unique<RobotTrial>(setup_);
    trial_->settle(X_FR);
  }

  Vector2 anyWay() {
    const double y = random_.normal();
    return {random_.normal(), y};
  }

  void walkLeg(const CourseLeg& leg) {
    const Pose2 start = trial_->pose();
    const Pose2 origin = leg.chained ? X_FItem_ : start;
    const Vector2 target = (origin * Pose2(leg.target, 0.0)).translation;
    const double heading = start.rotation + leg.turn;
    const double whole = left(leg, start, target, heading);
    const bool open = settings_.untilReached && leg.kind != Kind::Stop;
    const double allowed = open ? kLongestLeg : leg.time;
    const int cycles = std::max(1, static_cast<int>(std::lround(allowed / kCycleTime)));
    Vector2 noise = Vector2::Zero();
    int used = cycles;
    bool reached = false;
    double drift = 0.0;
    Pose2 at = start;
    for (int i = 0; i < cycles && !reached; ++i) {
      if (leg.noise > 0.0 && i % std::lround(kNoiseHold / kCycleTime) == 0) noise = leg.noise * anyWay();
      if (settings_.push > 0.0 && random_.uniform() < kCycleTime / kPushEvery) push();
      if (settings_.changeSets && random_.uniform() < kCycleTime / kChangeEvery) changeSet();
      trial_->step(request(leg, at, target + noise, start.rotation, heading));
      if (exploded()) return giveUp();
      const Pose2 now = trial_->pose();
      drift += (now.translation - at.translation).norm();
      at = now;
      result_.unsteadiness += kCycleTime * std::pow(std::min(trial_->tilt(), kSurelyFalling) / kNearFall, 4);
      if (trial_->down()) return fall(at, i + 1);
      reached = isReached(leg, at, left(leg, at, target, heading), heading);
      if (reached) used = i + 1;
    }
    result_.time += used * kCycleTime;
    if (leg.kind == Kind::Stop) {
      result_.stopDrift += drift;
      result_.reward -= drift;
      return;
    }
    const double made = whole - left(leg, at, target, heading);
    result_.targets += 1;
    result_.reached += reached ? 1 : 0;
    result_.distance += made;
    result_.reward += made * leg.time / (used * kCycleTime);
  }

  // What is still to go, m.
  static double left(const CourseLeg& leg, const Pose2& at, const Vector2& target, double heading) {
    if (leg.kind == Kind::Turn) return kTurnWorth * std::abs(wrapAngle(heading - at.rotation));
    return (target - at.translation).norm();
  }

  static bool isReached(const CourseLeg& leg, const Pose2& at, double gap, double heading) {
    if (leg.kind == Kind::Stop) return false;
    if (leg.kind == Kind::Turn) return gap < kTurned * kTurnWorth;
    return gap < kReached &&
           (leg.kind != Kind::Place || std::abs(wrapAngle(heading - at.rotation)) < kPlaced);
  }

  MotionRequest request(const CourseLeg& leg, const Pose2& at, const Vector2& target, double held,
                        double heading) const {
    const Vector2 p_RT = (at.inverse() * Pose2(target, 0.0)).translation;
    switch (leg.kind) {
      case Kind::Stop:
        break;
      case Kind::Walk:
        return motion::WalkTo{Pose2(p_RT, directionOf(p_RT)), false, settings_.set};
      case Kind::Place:
        return motion::WalkTo{Pose2(p_RT, wrapAngle(heading - at.rotation)), true, settings_.set};
      case Kind::Shift: {
        const double turn = kHeadingGain * wrapAngle(held - at.rotation);
        return motion::WalkVelocity{Pose2(kFastest * p_RT.normalized(), turn), settings_.set};
      }
      case Kind::Turn: {
        const double turn = kHeadingGain * 2.0 * wrapAngle(heading - at.rotation);
        return motion::WalkVelocity{Pose2(0.0, 0.0, std::clamp(turn, -kFastestTurn, kFastestTurn)),
                                    settings_.set};
      }
    }
    return motion::Stand{settings_.set};
  }

  void changeSet() {
    using motion::WalkSet;
    settings_.set = settings_.set == WalkSet::Positioning ? WalkSet::GoToTarget : WalkSet::Positioning;
  }

  void push() { pushRobot(trial_->physics(), trial_->robot(), settings_.push, random_); }

  void fall(const Pose2& at, int cycles) {
    result_.time += cycles * kCycleTime;
    result_.falls += 1;
    result_.reward -= settings_.fallCost;
    if (result_.falls < settings_.mostFalls) stand(at);
  }

  // Absurd parameters can drive the solver to numbers that are none; ODE would end the process on the next
  // collision check.
  bool exploded() const {
    const Vector3 torso = trial_->torsoPosition();
    return !torso.allFinite() || torso.norm() > kFarthest;
  }
  void giveUp() {
    result_.reward -= settings_.fallCost * (settings_.mostFalls - result_.falls);
    result_.falls = settings_.mostFalls;
  }

  TrialSettings setup_;
  CourseSettings settings_;
  Random random_;
  std::unique_ptr<RobotTrial> trial_;
  Pose2 X_FItem_;
  CourseResult result_;
};

}  // namespace

std::vector<CourseItem> makeCourse(std::uint64_t seed) {
  Random random = Random(seed).fork(1);
  std::vector<CourseItem> course;
  for (const auto make : {longWalks, curve, stopAndGo, leftAndRight, noisyTarget, weave, extremeChanges,
                          quickMoves, spiral, heldHeading, turns, places}) {
    const double side = random.uniform() < 0.5 ? -1.0 : 1.0;
    course.push_back(make(random, side));
  }
  for (std::size_t i = course.size(); i > 1; --i) std::swap(course[i - 1], course[random.below(i)]);
  return course;
}

CourseResult runCourse(const TrialSettings& setup, std::uint64_t seed, const CourseSettings& settings) {
  std::vector<CourseItem> course = makeCourse(seed);
  if (settings.items == CourseSettings::Items::HeldHeading) {
    std::erase_if(course, [](const CourseItem& item) {
      return std::any_of(item.legs.begin(), item.legs.end(),
                         [](const CourseLeg& leg) { return leg.kind != Kind::Shift; });
    });
  }
  course.resize(std::min(course.size(), static_cast<std::size_t>(settings.mostItems)));
  return Walker(setup, seed, settings).run(course);
}

CourseSummary measureCourses(const TrialSettings& setup, std::uint64_t seed, int courses, int threads,
                             const TrialProgress& progress) {
  constexpr int kWays = 3;  // in time, until every target is reached, with changing sets
  std::array<std::vector<CourseResult>, kWays> results;
  for (auto& way : results) way.resize(static_cast<std::size_t>(courses));
  inParallel(kWays * courses, threads, progress, "courses", [&](int i) {
    const int course = i / kWays;
    const std::uint64_t courseSeed = Random(seed).fork(static_cast<std::uint64_t>(course)).next();
    TrialSettings own = setup;
    own.seed = courseSeed;
    CourseSettings settings;
    settings.untilReached = i % kWays == 1;
    settings.changeSets = i % kWays == 2;
    results[static_cast<std::size_t>(i % kWays)][static_cast<std::size_t>(course)] =
        runCourse(own, courseSeed, settings);
  });
  CourseSummary summary;
  summary.courses = courses;
  for (const CourseResult& result : results[0]) {
    summary.falls += result.falls;
    summary.reward += result.reward / courses;
    summary.distance += result.distance / courses;
    summary.stopDrift += result.stopDrift / courses;
  }
  for (const CourseResult& result : results[1]) summary.time += result.time / courses;
  for (const CourseResult& result : results[2]) summary.changeFalls += result.falls;
  return summary;
}

}  // namespace nonet::lab
