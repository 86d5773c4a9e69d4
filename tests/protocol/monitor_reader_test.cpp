#include "nonet/protocol/monitor_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nonet::protocol {
namespace {

constexpr const char* kEnvironment =
    "((FieldLength 30)(BallRadius 0.042)(play_modes BeforeKickOff KickOff_Left KickOff_Right PlayOn)"
    "(time 7.5)(team_left Reds)(half 1)(score_left 2)(score_right 0)(play_mode 3))";

std::string at(double x, double y, double z) {
  return "(SLT 1 0 0 0 0 1 0 0 0 0 1 0 " + std::to_string(x) + " " + std::to_string(y) + " " +
         std::to_string(z) + " 1)";
}

// A scene of a light, the ball and one robot of type 2 whose i-th body stands at (i, 0, 0).
std::string fullMessage() {
  std::string text = std::string(kEnvironment) + "(RSG 0 1)((nd TRF " + at(1, 2, 3) +
                     "(nd Light (setDiffuse 1 1 1 1)))(nd TRF " + at(1, 2, 0.042) +
                     "(nd StaticMesh (setVisible 1) (load models/soccerball.obj) (sSc 1 1 1)"
                     "(resetMaterials soccerball_rcs-soccerball.png)))(nd TRF " +
                     at(0, 0, 0);
  for (int body = 0; body < 23; ++body) {
    text += "(nd TRF " + at(body, 0, 0);
    if (body == 0) {
      text += "(nd TRF " + at(9, 9, 9) +
              "(nd StaticMesh (setVisible 1) (load models/naobody2.obj) (sSc 0.1 0.1 0.1)"
              "(resetMaterials matNum7 matRight matType2 naowhite)))";
    }
    text += ")";
  }
  return text + "))";
}

TEST(MonitorReader, AFullMessageNamesTheNodes) {
  MonitorReader reader;
  ASSERT_TRUE(reader.feed(fullMessage()));
  EXPECT_TRUE(reader.lastWasFull());
  EXPECT_EQ(reader.game().playMode, PlayMode::PlayOn);
  EXPECT_EQ(reader.game().time, 7.5);
  EXPECT_EQ(reader.game().scoreLeft, 2);
  EXPECT_EQ(reader.game().teamLeft, "Reds");
  EXPECT_EQ(reader.field().find("FieldLength")->second, 30.0);
  EXPECT_FLOAT_EQ(reader.ball()[13], 2.0F);
  ASSERT_EQ(reader.robots().size(), 1U);
  const MonitorRobot& robot = reader.robots()[0];
  EXPECT_EQ(robot.unum, 7);
  EXPECT_EQ(robot.side, TeamSide::Right);
  EXPECT_EQ(robot.robotType, 2);
  ASSERT_EQ(robot.bodies.size(), 23U);
  EXPECT_FLOAT_EQ(robot.bodies[22][12], 22.0F);
  EXPECT_FLOAT_EQ(robot.bodies[0][12], 0.0F) << "the mesh's own transform is not the body's";
}

TEST(MonitorReader, DifferencesAreMatchedByPlace) {
  MonitorReader reader;
  EXPECT_FALSE(reader.feed("((time 1))(RDS 0 1)((nd))")) << "nothing to differ from";
  ASSERT_TRUE(reader.feed(fullMessage()));
  // Light, ball moved, robot: first body still, second moved.
  ASSERT_TRUE(reader.feed("((time 7.7)(play_mode 1)(foul 1 6 2 7))(RDS 0 1)((nd(nd))(nd " + at(3, 4, 5) +
                          "(nd StaticMesh))(nd(nd(nd(nd StaticMesh (setVisible 1))))(nd " + at(8, 8, 8) +
                          ")))"));
  EXPECT_FALSE(reader.lastWasFull());
  EXPECT_EQ(reader.game().time, 7.7);
  EXPECT_EQ(reader.game().playMode, PlayMode::KickOffLeft);
  EXPECT_FLOAT_EQ(reader.ball()[14], 5.0F);
  EXPECT_FLOAT_EQ(reader.robots()[0].bodies[0][12], 0.0F);
  EXPECT_FLOAT_EQ(reader.robots()[0].bodies[1][12], 8.0F);
  EXPECT_FLOAT_EQ(reader.robots()[0].bodies[2][12], 2.0F);
  ASSERT_EQ(reader.newFouls().size(), 1U);
  EXPECT_EQ(reader.newFouls()[0].type, 6);
  EXPECT_EQ(reader.newFouls()[0].side, TeamSide::Right);
  EXPECT_EQ(reader.newFouls()[0].unum, 7);
  ASSERT_TRUE(reader.feed("((time 7.9))(RDS 0 1)((nd(nd))(nd)(nd))"));
  EXPECT_THAT(reader.newFouls(), ::testing::IsEmpty());
}

TEST(MonitorReader, EveryPrefixAndEveryMissingByteEnds) {
  const std::string text = fullMessage();
  for (std::size_t length = 0; length < text.size(); length += 3) {
    MonitorReader reader;
    EXPECT_FALSE(reader.feed(std::string_view(text).substr(0, length))) << length;
    std::string hole = text;
    hole.erase(length, 1);
    reader.feed(hole);
    reader.feed(")))(RDS 0 1)((((nd");
  }
}

TEST(MonitorReader, ServerAxesBecomeForwardLeftUp) {
  // A robot that looks along +x of the world: its right (the server's x) is -y, its forward (y) is +x.
  const MonitorMatrix matrix = {0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 4, 5, 6, 1};
  const Pose3 pose = poseFromMonitor(matrix);
  EXPECT_TRUE(pose.linear().isApprox(Matrix3::Identity()));
  EXPECT_TRUE(pose.translation().isApprox(Vector3(4, 5, 6)));
}

}  // namespace
}  // namespace nonet::protocol
