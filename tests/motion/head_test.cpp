#include <cmath>

#include <gtest/gtest.h>

#include "nonet/motion/head_control.h"

namespace nonet::motion {
namespace {

using model::index;
using model::JointId;

class Head : public testing::Test {
 protected:
  Head() { follow(); }
  // The neck follows every target at once.
  void follow() {
    body_.cycleTime = kCycleTime;
    body_.joints = targets_.angles;
    model::forwardKinematics(model_, body_.joints, body_.bodies);
  }
  void step(const HeadRequest& request) {
    before_ = targets_.angles;
    control_.update(body_, request, targets_);
    follow();
  }
  double pan() const { return targets_.angles[index(JointId::Head1)]; }
  double lastStep() const {
    return std::max(std::abs(pan() - before_[index(JointId::Head1)]),
                    std::abs(targets_.angles[index(JointId::Head2)] - before_[index(JointId::Head2)]));
  }

  const model::RobotModel& model_ = model::robotModel(0);
  HeadParameters parameters_;
  HeadControl control_{model_, parameters_};
  world::BodyState body_;
  JointTargets targets_;
  model::JointArray before_{};
};

TEST_F(Head, PointsTheCameraAxisAtThePoint) {
  for (const Vector3& p_RP : {Vector3(2.0, 1.0, -0.3), Vector3(1.0, -2.0, 0.2), Vector3(0.5, 0.1, -0.2)}) {
    HeadRequest request;
    request.kind = HeadRequest::Kind::Point;
    request.p_RP = p_RP;
    for (int i = 0; i < 60; ++i) step(request);
    const Pose3& X_RC = model::cameraPose(body_.bodies);
    const Vector3 direction = (X_RC.inverse() * p_RP).normalized();
    EXPECT_GT(direction.x(), std::cos(0.02)) << p_RP.transpose();
  }
}

TEST_F(Head, NeverTurnsFasterThanItsSpeedNorIntoTheStops) {
  HeadRequest request;
  request.kind = HeadRequest::Kind::Look;
  for (int i = 0; i < 200; ++i) {
    request.pan = i % 40 < 20 ? 3.0 : -3.0;
    request.tilt = i % 30 < 15 ? 2.0 : -2.0;
    step(request);
    EXPECT_LE(lastStep(), parameters_.maxSpeed * kCycleTime + 1e-12);
    for (const JointId id : {JointId::Head1, JointId::Head2}) {
      EXPECT_GT(targets_.angles[index(id)], model_.joint(id).low + 0.05);
      EXPECT_LT(targets_.angles[index(id)], model_.joint(id).high - 0.05);
    }
  }
}

TEST_F(Head, ScanSweepsBothSidesFromWhereverItBegins) {
  HeadRequest look;
  look.kind = HeadRequest::Kind::Look;
  look.pan = 0.9;
  for (int i = 0; i < 50; ++i) step(look);
  double low = 0.0;
  double high = 0.0;
  for (int i = 0; i < 200; ++i) {
    step(HeadRequest{});
    low = std::min(low, pan());
    high = std::max(high, pan());
    EXPECT_LE(lastStep(), parameters_.maxSpeed * kCycleTime + 1e-12);
  }
  EXPECT_NEAR(low, -parameters_.scanPan, 0.05);
  EXPECT_NEAR(high, parameters_.scanPan, 0.05);
}

// A ball straight behind, now a little left, now a little right of that: the head waits on its side.
TEST_F(Head, KeepsToItsSideForWhatIsStraightBehind) {
  HeadRequest request;
  request.kind = HeadRequest::Kind::Point;
  request.p_RP = {-1.0, 0.5, -0.3};
  for (int i = 0; i < 60; ++i) step(request);
  const double side = pan();
  ASSERT_GT(side, 1.5);
  for (const double left : {-0.05, 0.05, -0.1, 0.1}) {
    request.p_RP.y() = left;
    step(request);
    EXPECT_NEAR(pan(), side, 1e-9) << left;
  }
  request.p_RP.y() = -0.5;
  for (int i = 0; i < 100; ++i) step(request);
  EXPECT_LT(pan(), -1.5) << "clearly on the other side";
}

}  // namespace
}  // namespace nonet::motion
