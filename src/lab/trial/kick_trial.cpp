#include "nonet/lab/trial/kick_trial.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "nonet/lab/trial/game_trial.h"
#include "nonet/math/direction.h"
#include "nonet/math/random.h"
#include "nonet/motion/kick_catalogue.h"
#include "nonet/world/ball_law.h"

#include "lab/trial/ball_flight.h"
#include "lab/trial/kicker.h"

namespace nonet::lab {

namespace {

constexpr double kMiss = 0.3;      // m
constexpr double kShort = 2.0;     // m
constexpr double kLasts = 2.0;     // s after contact that the robot must stand
constexpr double kRollsOut = 8.0;  // s, for a ball that flies and bounces
constexpr int kBearings = 10;

world::BallMotion motionOf(const GameTrial& trial) {
  return {trial.ball(), trial.ballVelocity()};
}

// From the contact on: what the ball does, and whether the robot stays on its feet.
void follow(GameTrial& trial, const Vector2& from, const Pose2& X_WAim, Kick& kick) {
  const double contact = trial.time();
  BallFlight flight(from);
  const double least = contact + kLasts;
  while (trial.time() < contact + kRollsOut) {
    trial.step();
    const Vector3 ball = trial.ball();
    kick.ballSpeed = std::max(kick.ballSpeed, trial.ballVelocity().norm());
    flight.note(motionOf(trial));
    const Vector2 aimed = X_WAim.inverse() * Vector2(ball.head<2>());
    kick.path.emplace_back(aimed.x(), aimed.y(), ball.z());
    if (trial.time() < least) kick.fell = kick.fell || trial.down(0);
    if (trial.time() > least && !world::isFlying(motionOf(trial))) break;
  }
  flight.tell(kick);
  // The rest of a roll is certain.
  const Vector2 way = X_WAim.inverse() * world::restPlace(motionOf(trial));
  kick.forward = way.x();
  kick.aside = way.y();
}

}  // namespace

bool Kick::missed() const {
  return !contact || forward < kMiss;
}
bool Kick::tooShort() const {
  return forward < kShort;
}
bool Kick::clears(const motion::KickHead& head) const {
  return height >= head.clears && landing <= head.lands;
}
double Kick::direction() const {
  return std::atan2(aside, forward);
}

double kickBearing(int trial) {
  return kPi * ((trial % kBearings + 0.5) / kBearings - 0.5);
}

motion::KickHead kickHead(const agent::AgentSettings& agent, const std::string& kick) {
  const auto library = motion::sharedSkillLibrary(agent.skillFolder, agent.parameters.motion.skills);
  const motion::KickCatalogue catalogue(*library, agent.robotType);
  std::string known;
  for (const motion::KickOption& option : catalogue.options()) {
    if (option.name == kick) return option.head;
    if (option.foot == model::Side::Left)
      known += fmt::format("{}{}", known.empty() ? "" : ", ", option.name);
  }
  throw std::runtime_error(
      fmt::format("type {} has no kick '{}': use any, all or one of {}", agent.robotType, kick, known));
}

Kick kickOnce(const agent::AgentSettings& agent, const sim::Settings& settings, const KickScene& scene,
              std::uint64_t seed) {
  Random random(seed);
  const KickGame game = kickGame(agent, scene, random);
  GameTrial trial(settings, game.situation, random.next());
  Kick kick;
  double speed = game.situation.ballVelocity.norm();
  Vector2 from = game.situation.ball;
  while (trial.time() < scene.longest && !kick.contact) {
    from = trial.ball().head<2>();
    trial.step();
    const double now = trial.ballVelocity().norm();
    kick.contact = game.kicker->motion.busy && now > speed + kHit;
    speed = now;
    kick.fell = kick.fell || trial.down(0);
  }
  kick.time = trial.time();
  if (!kick.contact) return kick;
  follow(trial, from, Pose2(from, directionOf(game.p_FTarget - from)), kick);
  return kick;
}

}  // namespace nonet::lab
