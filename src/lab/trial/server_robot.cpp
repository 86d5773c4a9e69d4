// A robot on a server whose walk is measured.
#include <fmt/format.h>

#include "nonet/lab/trial/measured_robot.h"
#include "nonet/model/ball.h"

#include "lab/trial/server_body.h"

namespace nonet::lab {

namespace {

class ServerRobot final : public MeasuredRobot {
 public:
  ServerRobot(const TrialSettings& setup, const ServerAddress& address) : body_(setup, address) {
    body_.train("(playMode PlayOn)");
    body_.train(fmt::format("(ball (pos {} {} {})(vel 0 0 0))", kMeasuredRobotBall.x(),
                            kMeasuredRobotBall.y(), model::kBallRadius));
    step({});
  }

  void settle(const Pose2& X_FR) override {
    constexpr double kWait = 1.5;  // s
    run({}, kWait);
    for (int i = 0; i < 600 && belief().body.posture != world::Posture::Upright; ++i) step({});
    body_.move(X_FR);
    run({}, kWait);
  }

  void step(const motion::MotionRequest& request) override {
    team::Action action;
    action.motion = request;
    body_.step(action);
  }

  Pose2 pose() const override { return body_.pose(); }
  bool down() const override { return body_.down(); }
  const world::WorldState& belief() const override { return body_.robot().world(); }

 private:
  ServerBody body_;
};

}  // namespace

std::unique_ptr<MeasuredRobot> connectMeasuredRobot(const TrialSettings& setup,
                                                    const ServerAddress& address) {
  return std::make_unique<ServerRobot>(setup, address);
}

}  // namespace nonet::lab
