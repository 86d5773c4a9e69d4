#include "lab/trial/ball_drill.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/world/ball_law.h"

namespace nonet::lab {

namespace {

constexpr int kNumber = 7;        // any but the goalie's
constexpr double kAhead = 0.55;   // m along the path that the intent leads the ball
constexpr double kCorner = 0.45;  // m before a corner from which the ball is led to the next leg: it rolls on

constexpr double kDribbleFrom = 0.5;  // m behind the ball
constexpr double kPassFrom = 3.0;     // m
constexpr double kPassAside = 0.4;    // m
constexpr double kPassBefore = 1.0;   // m before the robot, where the speed is said

BallScene onPath(const Pose2& start, const BallPath& path) {
  const Vector2 first = path.corners[1] - path.corners[0];
  const double heading = directionOf(first);
  BallScene scene;
  scene.situation.ball = start.translation;
  scene.start = Pose2(start.translation - kDribbleFrom * unitVector(heading), heading);
  scene.target = path.corners.back();
  scene.path = path;
  return scene;
}

class Driller {
 public:
  Driller(const team::TeamParameters& parameters, Intention intention)
      : behavior_(parameters), intention_(std::move(intention)) {}

  team::Action operator()(const world::WorldState& world, const motion::MotionState& motion) {
    behavior_.setIntent(intention_(world));
    return behavior_.update(world, motion);
  }

 private:
  team::Behavior behavior_;
  Intention intention_;
};

class Guide {
 public:
  explicit Guide(const BallPath& path) : corners_(path.corners), keep_(path.keep) {}

  team::BallIntent operator()(const world::WorldState& world) {
    const Vector2 ball = world.ball.p_FB.head<2>();
    while (leg_ + 2 < corners_.size() && along(ball) > legLength() - kCorner) ++leg_;
    return {corners_[leg_] + (std::max(0.0, along(ball)) + kAhead) * direction(), team::KickUse::Never,
            keep_};
  }

 private:
  Vector2 direction() const { return (corners_[leg_ + 1] - corners_[leg_]).normalized(); }
  double legLength() const { return (corners_[leg_ + 1] - corners_[leg_]).norm(); }
  double along(const Vector2& ball) const { return (ball - corners_[leg_]).dot(direction()); }

  std::vector<Vector2> corners_;
  double keep_;
  std::size_t leg_ = 0;
};

}  // namespace

BallScene dribbleScene(Random& random) {
  const double x = random.uniform(-9.0, -3.0);
  const double y = random.uniform(-5.0, 5.0);
  const Pose2 start(x, y, random.uniform(-0.3, 0.3));
  return onPath(start, straightPath(start, 10.0));
}

BallScene slalomScene(Random& random) {
  const double x = random.uniform(-9.0, -6.0);
  const double y = random.uniform(-5.0, 5.0);
  const Pose2 start(x, y, random.uniform(-0.2, 0.2));
  const double side = random.uniform() < 0.5 ? -1.0 : 1.0;
  BallPath path = slalomPath(start, 6, side * toRadians(60.0), 2.0);
  path.keep = 0.5;
  path.width = 0.6;
  return onPath(start, path);
}

BallScene passScene(Random& random) {
  BallScene scene;
  const double x = random.uniform(-8.0, 8.0);
  const double y = random.uniform(-5.0, 5.0);
  const double from = random.uniform(-kPi, kPi);  // the pass comes from there
  scene.speed = random.uniform(1.0, 3.0);
  scene.aside = random.uniform(-kPassAside, kPassAside);
  scene.start = Pose2(x, y, wrapAngle(from + random.uniform(-0.3, 0.3)));
  scene.target = Vector2(15.0, 0.0);
  const Vector2 place(x, y);
  scene.situation.ball = place + kPassFrom * unitVector(from);
  const Vector2 aim = place + scene.aside * unitVector(from + 0.5 * kPi);
  const double first = scene.speed + world::kRollDecay * (kPassFrom - kPassBefore);
  scene.situation.ballVelocity = first * (aim - scene.situation.ball).normalized();
  return scene;
}

Mind drilled(const team::TeamParameters& parameters, Intention intention) {
  auto driller = std::make_shared<Driller>(parameters, std::move(intention));
  return [driller](const world::WorldState& world, const motion::MotionState& motion) {
    return (*driller)(world, motion);
  };
}

Mind drilled(const team::TeamParameters& parameters, const Vector2& p_FTarget, team::KickUse use) {
  return drilled(parameters, [=](const world::WorldState& /*world*/) {
    return team::BallIntent{p_FTarget, use};
  });
}

Intention along(const BallPath& path) {
  return Guide(path);
}

GamePlayer fieldPlayer(const agent::AgentSettings& agent, const Pose2& X_WR, Mind mind, bool rightTeam) {
  GamePlayer player{agent, rightTeam, X_WR, std::move(mind)};
  player.agent.unum = kNumber;
  return player;
}

GamePlayer rightGoalie(const agent::AgentSettings& agent, const Vector2& goal) {
  constexpr double kBefore = 0.6;  // m
  GamePlayer goalie{agent, true, Pose2(goal.x() - kBefore, goal.y(), kPi), {}};
  goalie.agent.unum = 1;
  return goalie;
}

RecordedTrial::RecordedTrial(const sim::Settings& settings, const GameSituation& situation,
                             std::uint64_t seed)
    : game_(settings, situation, seed) {
  record();
}

void RecordedTrial::record() {
  track_.push_back({game_.time(), game_.ball().head<2>(), game_.pose(0)});
  fell_ = fell_ || game_.down(0);
}

void RecordedTrial::step() {
  game_.step();
  record();
}

void RecordedTrial::run(double seconds, const std::function<bool()>& goesOn) {
  const double end = game_.time() + seconds - 0.5 * kCycleTime;
  while (game_.time() < end && goesOn()) step();
}

bool RecordedTrial::playsOn() const {
  return game_.simulation().match().playMode == protocol::PlayMode::PlayOn;
}

void RecordedTrial::charge(TrialCost& cost) const {
  cost.fell = fell_;
  cost.selfCollisions = game_.fouls(0, sim::FoulType::SelfCollision);
  cost.simulated = game_.time();
}

}  // namespace nonet::lab
