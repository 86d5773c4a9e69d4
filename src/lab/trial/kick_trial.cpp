#include "nonet/lab/trial/kick_trial.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <variant>

#include "nonet/lab/trial/game_trial.h"
#include "nonet/math/random.h"
#include "nonet/team/behaviors.h"
#include "nonet/world/ball_law.h"

namespace nonet::lab {

namespace {

constexpr double kMiss = 0.3;      // m
constexpr double kHit = 0.7;       // m/s that a kick adds at least to the ball's speed in a cycle
constexpr double kLasts = 2.0;     // s after contact that the robot must stand
constexpr double kRollsOut = 8.0;  // s, for a ball that flies and bounces
constexpr int kBearings = 10;

// Plays the ball to the target with the team's own behaviours but for dribbling.
class Kicker {
 public:
  Kicker(const team::TeamParameters& parameters, const Vector2& p_FTarget, const std::string& kick)
      : parameters_(parameters), p_FTarget_(p_FTarget) {
    kick_.assign(kick);
  }

  team::Action operator()(const world::WorldState& world, const motion::MotionState& motion) {
    busy = motion.busy;
    if (!world.ball.known || !world.self.localized || motion.busy || motion.rising) return {};
    team::Situation situation = team::assess(world, parameters_, motion);
    situation.play = team::playTowards(situation, p_FTarget_, team::KickUse::Clear);
    for (const auto& behavior : {team::goToBall, team::kick, team::goBehindBall}) {
      std::optional<team::Action> action = behavior(situation);
      if (!action) continue;
      if (auto* request = std::get_if<motion::KickTo>(&action->motion)) request->kick = kick_;
      return *action;
    }
    return {};
  }

  bool busy = false;  // a skill runs

 private:
  team::TeamParameters parameters_;
  Vector2 p_FTarget_;
  InlineString<32> kick_;
};

GameSituation situationOf(const agent::AgentConfig& agent, const KickScene& scene, Random& random,
                          const Vector2& ball, double heading) {
  GameSituation situation;
  const double from = heading + scene.bearing;
  const Vector2 place = ball - scene.start * Vector2(std::cos(from), std::sin(from));
  situation.players = {{agent, false, Pose2(place, from), {}}};
  situation.ball = ball;
  const double way = random.uniform(-kPi, kPi);
  situation.ballVelocity = scene.rolling * random.uniform(0.0, 1.0) * Vector2(std::cos(way), std::sin(way));
  return situation;
}

world::BallMotion motionOf(const GameTrial& trial) {
  return {trial.ball(), trial.ballVelocity()};
}

// From the contact on: what the ball does, and whether the robot stays on its feet.
void follow(GameTrial& trial, const Vector2& from, const Pose2& X_WAim, Kick& kick) {
  const double contact = trial.time();
  bool passed = false;
  const double least = contact + kLasts;
  while (trial.time() < contact + kRollsOut) {
    trial.step();
    const Vector3 ball = trial.ball();
    kick.ballSpeed = std::max(kick.ballSpeed, trial.ballVelocity().norm());
    if (!passed && (ball.head<2>() - from).norm() > 1.0) {
      passed = true;
      kick.height = ball.z();
    }
    const Vector2 aimed = X_WAim.inverse() * Vector2(ball.head<2>());
    kick.path.emplace_back(aimed.x(), aimed.y(), ball.z());
    if (trial.time() < least) kick.fell = kick.fell || trial.down(0);
    if (trial.time() > least && !world::isFlying(motionOf(trial))) break;
  }
  // The rest of a roll is certain.
  const Vector2 way = X_WAim.inverse() * world::restPlace(motionOf(trial));
  kick.forward = way.x();
  kick.aside = way.y();
}

}  // namespace

bool Kick::missed() const {
  return !contact || forward < kMiss;
}
double Kick::direction() const {
  return std::atan2(aside, forward);
}

double kickBearing(int trial) {
  return kPi * ((trial % kBearings + 0.5) / kBearings - 0.5);
}

Kick kickOnce(const agent::AgentConfig& agent, const sim::Settings& settings, const KickScene& scene,
              std::uint64_t seed) {
  Random random(seed);
  // Where lines and goals are as far as anywhere on average.
  const Vector2 start(random.uniform(-8.0, 4.0), random.uniform(-5.0, 5.0));
  const double heading = random.uniform(-0.7, 0.7);
  const auto target = Vector2(start + scene.distance * Vector2(std::cos(heading), std::sin(heading)));
  GameSituation situation = situationOf(agent, scene, random, start, heading);
  auto kicker = std::make_shared<Kicker>(agent.parameters.team, target, scene.kick);
  situation.players[0].mind = [kicker](const world::WorldState& world, const motion::MotionState& motion) {
    return (*kicker)(world, motion);
  };
  GameTrial trial(settings, situation, random.next());
  Kick kick;
  double speed = situation.ballVelocity.norm();
  Vector2 from = start;
  while (trial.time() < scene.longest && !kick.contact) {
    from = trial.ball().head<2>();
    trial.step();
    const double now = trial.ballVelocity().norm();
    kick.contact = kicker->busy && now > speed + kHit;
    speed = now;
    kick.fell = kick.fell || trial.down(0);
  }
  kick.time = trial.time();
  if (!kick.contact) return kick;
  const Vector2 way = target - from;
  follow(trial, from, Pose2(from, std::atan2(way.y(), way.x())), kick);
  return kick;
}

}  // namespace nonet::lab
