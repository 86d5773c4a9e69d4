#include "nonet/lab/trial/kick_trial.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "nonet/math/direction.h"
#include "nonet/math/random.h"
#include "nonet/motion/kick_catalogue.h"
#include "nonet/world/ball_law.h"

#include "lab/trial/ball_flight.h"
#include "lab/trial/kick_stage.h"

namespace nonet::lab {

namespace {

constexpr double kMiss = 0.3;         // m
constexpr double kShort = 2.0;        // m
constexpr double kKickedLasts = 2.0;  // s after contact that the robot must stand
constexpr double kRollsOut = 8.0;     // s, for a ball that flies and bounces
constexpr int kBearings = 10;

// From the contact on: what the ball does as long as it is in play, and whether the robot stays on its feet.
void follow(KickStage& stage, const Vector2& from, const Pose2& X_WAim, Kick& kick) {
  const double contact = stage.time();
  BallFlight flight(from);
  world::BallMotion ball = stage.ball();
  bool inPlay = true;
  const double least = contact + kKickedLasts;
  while (stage.time() < contact + kRollsOut) {
    stage.step();
    // In a goal's net it would stop, and from behind a line the referee takes it back.
    inPlay = inPlay && stage.playsOn();
    if (inPlay) {
      ball = stage.ball();
      kick.ballSpeed = std::max(kick.ballSpeed, ball.v_FB.norm());
      flight.note(ball);
      const Vector2 aimed = X_WAim.inverse() * Vector2(ball.p_FB.head<2>());
      kick.path.emplace_back(aimed.x(), aimed.y(), ball.p_FB.z());
    }
    if (stage.time() < least) {
      kick.fell = kick.fell || stage.down();
      kick.selfCollided = stage.selfCollided();
    }
    if (stage.time() > least && (!inPlay || !world::isFlying(ball))) break;
  }
  flight.tell(kick);
  // The rest of a roll is certain, and that of a flight nearly so.
  const Vector2 way = X_WAim.inverse() * world::restPlace(ball);
  kick.forward = way.x();
  kick.aside = way.y();
}

Kick kickOn(KickStage& stage, const KickGame& game, double longest) {
  Kick kick;
  double speed = game.situation.ballVelocity.norm();
  Vector2 from = game.situation.ball;
  while (stage.time() < longest && !kick.contact) {
    from = stage.ball().p_FB.head<2>();
    stage.step();
    const double now = stage.ball().v_FB.norm();
    const motion::MotionState& motion = game.kicker->motion;
    if (motion.busy && !kick.begin) kick.begin = {motion.kick.aim, motion.kick.foot};
    kick.contact = motion.busy && now > speed + kHit;
    speed = now;
    kick.fell = kick.fell || stage.down();
  }
  kick.time = stage.time();
  kick.selfCollided = stage.selfCollided();
  if (kick.contact) follow(stage, from, Pose2(from, directionOf(game.p_FTarget - from)), kick);
  return kick;
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
  return kickOn(*makeKickStage(settings, game, random.next()), game, scene.longest);
}

Kick kickOnServer(const agent::AgentSettings& agent, const ServerAddress& address, const KickScene& scene,
                  std::uint64_t seed) {
  Random random(seed);
  const KickGame game = kickGame(agent, scene, random);
  return kickOn(*connectKickStage(game, address, random.next()), game, scene.longest);
}

}  // namespace nonet::lab
