#include "nonet/lab/trial/measured_robot.h"

namespace nonet::lab {

namespace {

class InProcessRobot final : public MeasuredRobot {
 public:
  explicit InProcessRobot(const TrialSettings& setup) : trial_(setup) {}
  void settle(const Pose2& X_FR) override { trial_.settle(X_FR); }
  void step(const motion::MotionRequest& request) override { trial_.step(request); }
  Pose2 pose() const override { return trial_.pose(); }
  bool down() const override { return trial_.down(); }
  const world::WorldState& belief() const override { return trial_.belief(); }

 private:
  RobotTrial trial_;
};

}  // namespace

std::unique_ptr<MeasuredRobot> makeMeasuredRobot(const TrialSettings& setup) {
  return std::make_unique<InProcessRobot>(setup);
}

}  // namespace nonet::lab
