#include "lab/trial/kick_stage.h"

#include <cmath>

#include <fmt/format.h>

#include "nonet/agent/agent_setup.h"

#include "lab/trial/server_body.h"

namespace nonet::lab {

namespace {

class TrialStage final : public KickStage {
 public:
  TrialStage(const sim::Settings& settings, const KickGame& game, std::uint64_t seed)
      : trial_(settings, game.situation, seed) {}

  void step() override { trial_.step(); }
  double time() const override { return trial_.time(); }
  world::BallMotion ball() const override { return {trial_.ball(), trial_.ballVelocity()}; }
  bool down() const override { return trial_.down(0); }
  bool selfCollided() const override { return trial_.fouls(0, sim::FoulType::SelfCollision) > 0; }
  bool playsOn() const override { return trial_.simulation().match().playMode == protocol::PlayMode::PlayOn; }

 private:
  GameTrial trial_;
};

agent::RobotSettings robotOf(const GamePlayer& player, std::uint64_t seed) {
  agent::AgentSettings settings = player.agent;
  settings.seed = seed;
  return agent::robotSettings(settings);
}

class ServerStage final : public KickStage {
 public:
  ServerStage(const KickGame& game, const ServerAddress& address, std::uint64_t seed)
      : mind_(game.situation.players.front().mind),
        body_(robotOf(game.situation.players.front(), seed), address) {
    constexpr double kStands = 1.0;  // s, until it stands on the ground
    constexpr double kLooks = 3.0;   // s, until it has found its place and the ball's by its own eyes
    body_.train("(playMode PlayOn)");
    body_.train("(time 0)");
    putBall(game.situation.ball, Vector2::Zero());
    wait(kStands);
    body_.move(game.situation.players.front().X_WR);
    putBall(game.situation.ball, Vector2::Zero());  // the robot may have pushed it
    wait(kLooks);
    putBall(game.situation.ball, game.situation.ballVelocity);
    selfCollisionsBefore_ = body_.selfCollisions();
  }

  void step() override {
    body_.step(mind_(body_.robot().world(), body_.robot().motion().state()));
    ++cycles_;
  }
  double time() const override { return static_cast<double>(cycles_) * kCycleTime; }
  world::BallMotion ball() const override { return body_.ball(); }
  bool down() const override { return body_.down(); }
  bool selfCollided() const override { return body_.selfCollisions() > selfCollisionsBefore_; }
  bool playsOn() const override { return body_.playsOn(); }

 private:
  void wait(double seconds) {
    for (long i = std::lround(seconds / kCycleTime); i > 0; --i) body_.step({});
  }
  void putBall(const Vector2& place, const Vector2& velocity) {
    body_.train(fmt::format("(ball (pos {:.4f} {:.4f} {})(vel {:.4f} {:.4f} 0))", place.x(), place.y(),
                            world::kBallRestHeight, velocity.x(), velocity.y()));
  }

  Mind mind_;
  ServerBody body_;
  long cycles_ = 0;
  int selfCollisionsBefore_ = 0;
};

}  // namespace

std::unique_ptr<KickStage> makeKickStage(const sim::Settings& settings, const KickGame& game,
                                         std::uint64_t seed) {
  return std::make_unique<TrialStage>(settings, game, seed);
}
std::unique_ptr<KickStage> connectKickStage(const KickGame& game, const ServerAddress& address,
                                            std::uint64_t seed) {
  return std::make_unique<ServerStage>(game, address, seed);
}

}  // namespace nonet::lab
