#include "nonet/lab/trial/ball_trial.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/math/random.h"

#include "lab/trial/ball_drill.h"

namespace nonet::lab {

namespace {

constexpr double kFacing = toRadians(10.0);

// In any direction.
Vector2 anyWay(Random& random, double least, double most) {
  const double length = random.uniform(least, most);
  return length * unitVector(random.uniform(-kPi, kPi));
}

// -- approach

constexpr double kApproachFrom = 1.5;      // m
constexpr double kApproachRolling = 1.0;   // m/s
constexpr double kApproachLongest = 10.0;  // s
constexpr double kKickOver = 8.0;          // m, to the target
constexpr double kPushEvery = 1.0;         // s, on average

// What the body said of itself last, and where it was last told to kick: a shot goes to the goal.
struct KickWatch {
  bool ready = false;      // in place, or the kick has begun
  double direction = 0.0;  // of that kick, from straight ahead
  Vector2 p_FTarget = Vector2::Zero();
};

void update(KickWatch& watch, const motion::MotionState& motion) {
  watch.ready = !motion.kick.name.empty() && (motion.kick.inPlace || motion.busy);
  watch.direction = 0.0;
  for (const motion::KickOption& option : motion.kicks) {
    if (option.name == motion.kick.name && option.foot == motion.kick.foot)
      watch.direction = option.head.direction;
  }
}

// -- dribbling

Dribble dribbleIn(const BallScene& scene, const agent::AgentSettings& agent, const sim::Settings& settings,
                  double longest, std::uint64_t seed) {
  GameSituation situation = scene.situation;
  situation.players = {fieldPlayer(agent, scene.start, drilled(agent.parameters.team, along(scene.path)))};
  RecordedTrial trial(settings, situation, seed);
  const std::vector<Vector2>& corners = scene.path.corners;
  const Vector2 end = corners.back();
  const Vector2 last = (end - corners[corners.size() - 2]).normalized();
  trial.run(longest, [&] {
    const Vector2 beyond = trial.track().back().ball - end;
    return trial.playsOn() && !(beyond.dot(last) >= 0.0 && beyond.norm() < 1.0);
  });
  Dribble dribble;
  static_cast<DribbleResult&>(dribble) = measureDribble(trial.track(), scene.path);
  dribble.path = scene.path;
  dribble.track = trial.track();
  trial.charge(dribble);
  return dribble;
}

// -- drive

constexpr double kDriveTime = 15.0;  // s

// -- duel

constexpr double kDuelApart = 0.5;  // m from the ball
constexpr double kDuelGain = 2.0;   // m
constexpr double kDuelTime = 20.0;  // s

// -- attack

constexpr double kAttackTime = 25.0;   // s
constexpr double kAttackBehind = 0.4;  // m behind the ball
constexpr double kAttackLost = 5.0;    // m
constexpr double kStillOpen = 0.3;     // worth of a ball that is still there in the end

constexpr double kPassTime = 6.0;  // s

// -- run

constexpr double kRunAfter = 3.0;  // m
constexpr double kRunTime = 3.0;   // s
constexpr double kStill = 0.08;    // m/s
constexpr double kStopTime = 3.0;  // s

}  // namespace

Approach approachOnce(const agent::AgentSettings& agent, const sim::Settings& settings, std::uint64_t seed,
                      double push) {
  Random random(seed);
  GameSituation situation;
  situation.ball = {random.uniform(-8.0, 5.0), random.uniform(-5.0, 5.0)};
  const double from = random.uniform(-kPi, kPi);
  const Pose2 start(situation.ball - kApproachFrom * unitVector(from), from);
  situation.ballVelocity = anyWay(random, 0.0, kApproachRolling);
  const Vector2 target = situation.ball + kKickOver * unitVector(random.uniform(-0.5, 0.5));
  const Mind mind = drilled(agent.parameters.team, target, team::KickUse::Clear);
  auto watch = std::make_shared<KickWatch>();
  watch->p_FTarget = target;
  situation.players = {fieldPlayer(
      agent, start, [mind, watch](const world::WorldState& world, const motion::MotionState& motion) {
        update(*watch, motion);
        team::Action action = mind(world, motion);
        if (const auto* kick = std::get_if<motion::KickTo>(&action.motion))
          watch->p_FTarget = world.self.X_FR * kick->target;
        return action;
      })};
  RecordedTrial trial(settings, situation, random.next());
  const auto inPlace = [&] {
    const BallSample& now = trial.track().back();
    const double wanted = directionOf(watch->p_FTarget - now.ball) - watch->direction;
    return watch->ready && std::abs(wrapAngle(wanted - now.X_WR.rotation)) < kFacing;
  };
  trial.run(kApproachLongest, [&] {
    if (push > 0.0 && random.uniform() < kCycleTime / kPushEvery) trial.game().push(0, push, random);
    return !inPlace();
  });
  Approach approach;
  approach.arrived = inPlace();
  approach.time = trial.game().time();
  trial.charge(approach);
  return approach;
}

Dribble dribbleOnce(const agent::AgentSettings& agent, const sim::Settings& settings, std::uint64_t seed) {
  Random random(seed);
  const BallScene scene = dribbleScene(random);
  return dribbleIn(scene, agent, settings, 30.0, random.next());
}

Dribble slalomOnce(const agent::AgentSettings& agent, const sim::Settings& settings, std::uint64_t seed) {
  Random random(seed);
  const BallScene scene = slalomScene(random);
  return dribbleIn(scene, agent, settings, 60.0, random.next());
}

Drive driveOnce(const agent::AgentSettings& agent, const sim::Settings& settings, std::uint64_t seed) {
  Random random(seed);
  GameSituation situation;
  situation.ball = {random.uniform(-8.0, 12.0), random.uniform(-8.0, 8.0)};
  const Vector2 place = situation.ball + anyWay(random, 0.5, 3.0);
  situation.players = {fieldPlayer(agent, Pose2(place, random.uniform(-kPi, kPi)), {})};
  RecordedTrial trial(settings, situation, random.next());
  const Vector2 goal(0.5 * trial.game().simulation().settings().fieldLength, 0.0);
  double rest = (situation.ball - goal).norm();
  const double whole = rest;
  trial.run(kDriveTime, [&] {
    if (trial.playsOn()) rest = (trial.track().back().ball - goal).norm();
    return trial.playsOn();
  });
  Drive drive;
  drive.goal = trial.game().simulation().match().playMode == protocol::PlayMode::GoalLeft;
  drive.gained = drive.goal ? whole * kDriveTime / trial.game().time() : whole - rest;
  trial.charge(drive);
  return drive;
}

Duel duelOnce(const agent::AgentSettings& agent, const agent::AgentSettings& opponent,
              const sim::Settings& settings, std::uint64_t seed) {
  Random random(seed);
  GameSituation situation;
  situation.ball = {random.uniform(-6.0, 6.0), random.uniform(-5.0, 5.0)};
  const double heading = random.uniform(-0.7, 0.7);  // the opponent stands towards its own goal
  const Vector2 way = unitVector(heading);
  situation.players = {
      fieldPlayer(agent, Pose2(situation.ball - kDuelApart * way, heading), {}),
      fieldPlayer(opponent, Pose2(situation.ball + kDuelApart * way, wrapAngle(heading + kPi)), {}, true)};
  RecordedTrial trial(settings, situation, random.next());
  const auto gained = [&] { return trial.track().back().ball.x() - situation.ball.x(); };
  trial.run(kDuelTime, [&] { return trial.playsOn() && std::abs(gained()) < kDuelGain; });
  Duel duel;
  if (std::abs(gained()) >= kDuelGain) duel.won = gained() > 0.0 ? 1.0 : 0.0;
  trial.charge(duel);
  return duel;
}

double Attack::worth() const {
  if (goal) return 1.0;
  return out || lost ? 0.0 : kStillOpen;
}

Attack attackOnce(const agent::AgentSettings& agent, const Defence& defence, const sim::Settings& settings,
                  std::uint64_t seed) {
  Random random(seed);
  const Vector2 goal(0.5 * settings.fieldLength, 0.0);
  GameSituation situation;
  situation.ball = {goal.x() - random.uniform(2.5, 6.0), random.uniform(-4.0, 4.0)};
  const double toGoal = directionOf(goal - situation.ball);
  const double heading = toGoal + random.uniform(-0.7, 0.7);
  situation.players = {
      fieldPlayer(agent, Pose2(situation.ball - kAttackBehind * unitVector(heading), heading), {}),
      rightGoalie(defence.goalie, goal)};
  for (const double least : {0.6, 1.8}) {
    const double from = toGoal + random.uniform(-1.2, 1.2);
    const Vector2 place = situation.ball + random.uniform(least, least + 1.4) * unitVector(from);
    GamePlayer back{defence.back, true, Pose2(place, wrapAngle(from + kPi)), {}};
    back.agent.unum = static_cast<int>(situation.players.size());
    situation.players.push_back(back);
  }
  RecordedTrial trial(settings, situation, random.next());
  const auto lost = [&] { return trial.track().back().ball.x() < situation.ball.x() - kAttackLost; };
  trial.run(kAttackTime, [&] { return trial.playsOn() && !lost(); });
  Attack attack;
  attack.goal = trial.game().simulation().match().playMode == protocol::PlayMode::GoalLeft;
  attack.out = !attack.goal && !trial.playsOn();
  attack.lost = lost();
  attack.charged = trial.game().fouls(0, sim::FoulType::Charging) > 0;
  trial.charge(attack);
  return attack;
}

Reception receiveOnce(const agent::AgentSettings& agent, const sim::Settings& settings, std::uint64_t seed,
                      bool keeps) {
  Random random(seed);
  const BallScene scene = passScene(random);
  GameSituation situation = scene.situation;
  const ReceiveRule rule;
  team::BallIntent intent{scene.target, team::KickUse::Never};
  if (keeps) intent.keep = rule.near;
  situation.players = {fieldPlayer(agent, scene.start,
                                   drilled(agent.parameters.team, [intent](const auto&) { return intent; }))};
  RecordedTrial trial(settings, situation, random.next());
  trial.run(kPassTime);
  Reception reception;
  static_cast<ReceiveResult&>(reception) = measureReceive(trial.track(), rule);
  reception.speed = scene.speed;
  reception.aside = scene.aside;
  trial.charge(reception);
  return reception;
}

Run runOnce(const agent::AgentSettings& agent, const sim::Settings& settings, std::uint64_t seed) {
  Random random(seed);
  const double aside = random.uniform(-6.0, 6.0);
  const Pose2 start(-13.0, aside, random.uniform(-0.1, 0.1));
  const Vector2 goal = start * Vector2(28.0, 0.0);
  auto stop = std::make_shared<bool>(false);
  GameSituation situation;
  situation.ball = {10.0, start.translation.y() > 0.0 ? -8.0 : 8.0};
  situation.players = {fieldPlayer(
      agent, start, [goal, stop](const world::WorldState& world, const motion::MotionState& /*motion*/) {
        if (*stop) return team::Action();
        const Vector2 way = world.self.X_FR.inverse() * goal;
        return team::Action(motion::WalkTo{Pose2(way, directionOf(way)), false}, "run");
      })};
  RecordedTrial trial(settings, situation, random.next());
  Run run;
  trial.run(20.0, [&] { return (run.speed = runSpeed(trial.track(), kRunAfter, kRunTime)) == 0.0; });
  *stop = true;
  const double begin = trial.game().time();
  trial.run(kStopTime);
  run.stopTime = stopTime(trial.track(), begin, kStill);
  trial.charge(run);
  return run;
}

}  // namespace nonet::lab
