#include "nonet/lab/trial/save_trial.h"

#include <cmath>
#include <variant>

#include "nonet/lab/trial/game_trial.h"
#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/model/ball.h"
#include "nonet/team/goalie.h"

#include "lab/trial/ball_touch.h"

namespace nonet::lab {

namespace {

using model::kBallRadius;

const Vector2 kGoal(-15.0, 0.0);  // the middle of the line
constexpr double kHalfGoal = 1.05;
constexpr double kClear = 0.02;        // m
constexpr double kHighest = 0.75;      // m, of a shot at the line
constexpr double kSlowest = 1.5;       // m/s, of a shot at the line
constexpr double kLongestRoll = 10.0;  // s from the shot to the line
constexpr double kSettles = 1.0;       // s for which the goalie takes its place, at least
constexpr double kWaits = 1.0;         // s that it then waits for the shot, at most
constexpr double kAfter = 12.0;        // s from the shot to the end of the trial
constexpr double kStands = 0.6;        // s that a stand must last
constexpr double kUpright = 0.3;       // rad
constexpr double kStopped = 0.3;       // m/s towards the line: a slower ball is no shot any more
constexpr double kCalm = 0.5;          // s for which it must be that slow
constexpr double kClearedAway = 3.0;   // m from the middle of the goal: cleared
constexpr double kBehindBall = 0.3;    // m, of the opponent
constexpr double kMisplaced = 0.15;    // m

Vector2 onCircle(double radius, double angle) {
  return radius * unitVector(angle);
}

Vector2 drawPlace(ShotKind kind, Random& random) {
  const double bearing = random.uniform(toRadians(-60.0), toRadians(60.0));
  const bool rolls = kind == ShotKind::Rolling;
  return kGoal + onCircle(rolls ? random.uniform(2.0, 5.0) : random.uniform(4.0, 12.0), bearing);
}

Shot drawCandidate(ShotKind kind, const Vector2& place, Random& random) {
  const bool rolls = kind == ShotKind::Rolling;
  const Vector2 way = kGoal + Vector2(0.0, random.uniform(-kHalfGoal, kHalfGoal)) - place;
  const double speed = rolls ? random.uniform(0.0, 10.0) : random.uniform(7.0, 13.0);
  const double rise = rolls ? 0.0 : random.uniform(toRadians(10.0), toRadians(60.0));
  const Vector2 level = speed * std::cos(rise) * way.normalized();
  // A flying ball begins clear of the ground, which would slow it down by a third in its first cycle.
  const double height = kind == ShotKind::Flying ? kBallRadius + kClear : kBallRadius;
  return {kind, {place.x(), place.y(), height}, {level.x(), level.y(), speed * std::sin(rise)}};
}

// Spares the simulation of most balls that stop on the way: a roll ends after 0.677 s of its first speed
// (server facts 3.5).
bool mayArrive(const Shot& shot) {
  const double distance = shot.p_WB.x() - kGoal.x();
  return shot.kind == ShotKind::Flying || -0.7 * shot.v_WB.x() > distance;
}

// An opponent that stands behind the ball and does nothing: the ball is not the goalie's to fetch.
GamePlayer opponentBehind(const agent::AgentSettings& goalie, const Shot& shot) {
  GamePlayer player;
  player.agent = goalie;
  player.agent.unum = 2;
  player.rightTeam = true;
  const Vector2 way = shot.v_WB.head<2>().normalized();
  player.X_WR = Pose2(shot.p_WB.head<2>() - kBehindBall * way, directionOf(way));
  player.mind = [](const world::WorldState&, const motion::MotionState&) { return team::Action(); };
  return player;
}

GameSituation situationOf(const agent::AgentSettings& agent, const Shot& shot, Random& random) {
  GamePlayer goalie;
  goalie.agent = agent;
  goalie.agent.unum = 1;
  goalie.X_WR = team::guardPlace(shot.p_WB.head<2>(), world::FieldGeometry{}, agent.parameters.team.goalie);
  const double misplaced = random.uniform(-kPi, kPi);
  goalie.X_WR.translation += onCircle(random.uniform(0.0, kMisplaced), misplaced);
  GameSituation situation;
  situation.players = {goalie, opponentBehind(agent, shot)};
  situation.ball = shot.p_WB.head<2>();
  return situation;
}

// One shot while it lasts, and what the goalie makes of it.
class Watcher {
 public:
  Watcher(GameTrial& trial, Save& save)
      : trial_(trial), save_(save), start_(trial.time()), comesAt_(start_) {}

  double time() const { return trial_.time() - start_; }
  bool over() const { return over_; }
  bool goal() const { return trial_.simulation().match().scoreRight > 0; }

  void step() {
    trial_.step();
    const sim::World& world = trial_.simulation().world();
    // The goalie's robot was built first.
    save_.touched = save_.touched || ballTouches(world, world.robots().front()).robot;
    noteAnswer();
    noteFall();
    if (over_) return;
    save_.path.push_back(trial_.ball());
    // What bounces off the goalie and trickles in is still the shot.
    if (trial_.ballVelocity().x() < -kStopped) comesAt_ = trial_.time();
    over_ = goal() || trial_.time() - comesAt_ > kCalm;
  }

  /// Upright for so long that it stands.
  bool stands() const { return trial_.time() - downAt_ > kStands; }

 private:
  void noteAnswer() {
    const team::Action& action = trial_.action(0);
    if (over_ || !save_.answer.empty()) return;
    const auto* skill = std::get_if<motion::PlaySkill>(&action.motion);
    if (skill == nullptr) return;
    save_.answer = std::string(skill->name.view());
    save_.answerTime = time();
  }

  void noteFall() {
    const bool down = trial_.down(0) || trial_.tilt(0) > kUpright;
    save_.fell = save_.fell || trial_.down(0);
    if (!down) return;
    downAt_ = trial_.time();
    save_.riseTime += save_.fell ? kCycleTime : 0.0;
  }

  GameTrial& trial_;
  Save& save_;
  double start_;
  double downAt_ = -kLongestRoll;
  double comesAt_;
  bool over_ = false;
};

bool away(const GameTrial& trial) {
  const bool out = trial.simulation().match().playMode != protocol::PlayMode::PlayOn;
  return out || (trial.ball().head<2>() - kGoal).norm() > kClearedAway;
}

}  // namespace

std::optional<GoalLineCrossing> freeCrossing(const Shot& shot) {
  sim::World world;
  world.setBallPosition(shot.p_WB.cast<float>());
  world.setBallVelocity(shot.v_WB.cast<float>());
  Vector3 before = shot.p_WB;
  for (double time = 0.0; time < kLongestRoll; time += kCycleTime) {
    world.prePhysics();
    world.stepPhysics();
    const Vector3 now = world.ballPosition().cast<double>();
    if (now.x() <= kGoal.x()) {
      const double share = (before.x() - kGoal.x()) / (before.x() - now.x());
      const Vector3 p = before + share * (now - before);
      return GoalLineCrossing{time + share * kCycleTime, p.y(), p.z(), world.ballVelocity().norm()};
    }
    if (now == before) return std::nullopt;
    before = now;
  }
  return std::nullopt;
}

bool countsAsShot(const GoalLineCrossing& crossing) {
  return std::abs(crossing.y) < kHalfGoal - kBallRadius && crossing.height < kHighest &&
         crossing.speed >= kSlowest;
}

Shot drawShot(ShotKind kind, Random& random) {
  constexpr int kTries = 1000;
  while (true) {
    const Vector2 place = drawPlace(kind, random);
    for (int i = 0; i < kTries; ++i) {
      Shot shot = drawCandidate(kind, place, random);
      if (!mayArrive(shot)) continue;
      const auto crossing = freeCrossing(shot);
      if (crossing && countsAsShot(*crossing)) return shot;
    }
  }
}

Save saveOnce(const agent::AgentSettings& goalie, const sim::Settings& settings, const Shot& shot,
              std::uint64_t seed) {
  Random random(seed);
  const GameSituation situation = situationOf(goalie, shot, random);
  GameTrial trial(settings, situation, random.next());
  trial.run(kSettles + random.uniform(0.0, kWaits));
  Save save;
  save.shot = shot;
  save.X_WStart = trial.pose(0);
  const Vector2 ball = save.X_WStart.inverse() * Vector2(shot.p_WB.head<2>());
  const Vector2 way = save.X_WStart.inverse() * Vector2((shot.p_WB + shot.v_WB).head<2>()) - ball;
  save.aside = ball.y() - ball.x() * way.y() / way.x();
  trial.throwBall(shot.p_WB, shot.v_WB);
  Watcher watcher(trial, save);
  while (watcher.time() < kAfter && !watcher.goal()) {
    const bool stopped = watcher.over();
    watcher.step();
    save.ownGoal = stopped && watcher.goal();
    if (watcher.over() && watcher.stands() && away(trial)) break;
  }
  save.saved = !watcher.goal();
  // After a goal play goes on elsewhere: who may be beamed to its place need not rise.
  while (watcher.time() < kAfter && !watcher.stands()) {
    trial.setPlayMode(protocol::PlayMode::PlayOn);
    trial.throwBall({0.0, 0.0, kBallRadius}, Vector3::Zero());
    watcher.step();
  }
  save.up = watcher.stands();
  save.cleared = save.saved && away(trial);
  return save;
}

}  // namespace nonet::lab
