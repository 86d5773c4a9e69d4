#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "nonet/math/angle.h"
#include "nonet/protocol/percept_text.h"
#include "nonet/protocol/server_axes.h"

namespace nonet::protocol {
namespace {

using namespace nonet::literals;

Percept perceptOf(std::string_view text) {
  Percept percept;
  parsePercept(text, percept);
  return percept;
}

TEST(Percept, GameStateInAllForms) {
  const Percept first =
      perceptOf("(time (now 95.12))(GS (unum 7) (team right) (sl 1) (sr 2) (t 3.50) (pm corner_kick_left))");
  EXPECT_EQ(first.unknownTokens, 0);
  EXPECT_EQ(first.time, 95.12);
  EXPECT_EQ(first.game.unum, 7);
  EXPECT_EQ(first.game.side, TeamSide::Right);
  EXPECT_EQ(first.game.scoreLeft, 1);
  EXPECT_EQ(first.game.scoreRight, 2);
  EXPECT_EQ(first.game.time, 3.5);
  EXPECT_EQ(first.game.playMode, PlayMode::CornerKickLeft);
  EXPECT_EQ(first.game.playModeText, "corner_kick_left");

  const Percept bare = perceptOf("(GS (t 0.00) (pm BeforeKickOff))");
  EXPECT_FALSE(bare.game.unum || bare.game.side || bare.game.scoreLeft || bare.game.scoreRight);
  EXPECT_EQ(bare.game.playMode, PlayMode::BeforeKickOff);

  const Percept strange = perceptOf("(GS (t 1.00) (pm dance))");
  EXPECT_EQ(strange.unknownTokens, 1);
  EXPECT_EQ(strange.game.playMode, PlayMode::Unknown);
  EXPECT_EQ(strange.game.playModeText, "dance");
  EXPECT_EQ(strange.game.time, 1.0);
}

TEST(Percept, NumbersThatNoPlayerHasAreUnknown) {
  for (const char* number : {"0", "-1", "12", "2147483647", "-2147483648", "99999999999", "x", "3.5"}) {
    const Percept percept = perceptOf(std::string("(GS (unum ") + number + ") (team left) (t 1.00))");
    EXPECT_FALSE(percept.game.unum) << number;
    EXPECT_EQ(percept.unknownTokens, 1) << number;
    EXPECT_EQ(percept.game.side, TeamSide::Left) << number;
    EXPECT_EQ(percept.game.time, 1.0) << number;
  }
  for (const int number : {1, 11})
    EXPECT_EQ(perceptOf("(GS (unum " + std::to_string(number) + "))").game.unum, number);
}

TEST(Percept, TurnsTheServersAxesIntoOurs) {
  // The server's x is to the right and y forward: a force to the right is along -y, one forward along x.
  const Percept percept = perceptOf(
      "(GYR (n torso) (rt 10.00 20.00 30.00))(ACC (n torso) (a 1.00 2.00 9.81))"
      "(FRP (n lf) (c 0.01 0.05 -0.02) (f 3.00 4.00 22.00))");
  EXPECT_TRUE(percept.gyro.isApprox(Vector3(toRadians(20.0), toRadians(-10.0), toRadians(30.0))));
  EXPECT_TRUE(percept.accelerometer.isApprox(Vector3(2.0, -1.0, 9.81)));
  const auto& foot = percept.forces[static_cast<std::size_t>(ForceSensor::LFoot)];
  ASSERT_TRUE(foot);
  EXPECT_TRUE(foot->center.isApprox(Vector3(0.05, -0.01, -0.02)));
  EXPECT_TRUE(foot->force.isApprox(Vector3(4.0, -3.0, 22.0)));
  EXPECT_FALSE(percept.forces[static_cast<std::size_t>(ForceSensor::RFoot)]);
  // It is a rotation: the cross product goes with it, so rates and torques turn like positions.
  const Vector3 a(1.0, 2.0, 3.0);
  const Vector3 b(-4.0, 5.0, 0.5);
  EXPECT_TRUE(robotFromServerAxes(a).cross(robotFromServerAxes(b)).isApprox(robotFromServerAxes(a.cross(b))));
  EXPECT_EQ(serverFromRobotAxes(robotFromServerAxes(a)), a);
}

TEST(Percept, JointsByName) {
  const Percept percept = perceptOf("(HJ (n hj2) (ax -45.00))(HJ (n llj7) (ax 1.50))");
  EXPECT_EQ(percept.jointsPresent,
            1U << model::index(model::JointId::Head2) | 1U << model::index(model::JointId::LLeg7));
  EXPECT_EQ(percept.joints[model::index(model::JointId::Head2)], toRadians(-45.0));
  EXPECT_EQ(percept.joints[model::index(model::JointId::LLeg7)], toRadians(1.5));
}

TEST(Percept, Vision) {
  const Percept percept = perceptOf(
      "(See (G2R (pol 10.00 30.00 -5.00)) (B (pol 2.00 0.00 -10.00)) (P (team Red) (id 3) (head (pol 4.00 "
      "1.00 "
      "2.00)) (lfoot (pol 4.10 3.00 -9.00))) (mypos 1.00 -2.00 0.50) (myorien -90.00) (ballpos 0.10 0.20 "
      "0.04) "
      "(L (pol 1.00 2.00 3.00) (pol 4.00 5.00 6.00)))");
  ASSERT_EQ(percept.unknownTokens, 0);
  ASSERT_TRUE(percept.vision);
  const Vision& vision = *percept.vision;
  ASSERT_EQ(vision.landmarks.size(), 1U);
  EXPECT_EQ(vision.landmarks[0].id, Landmark::G2R);
  EXPECT_EQ(vision.landmarks[0].at.azimuth, toRadians(30.0));
  ASSERT_TRUE(vision.ball);
  // Straight ahead and 10 degrees down.
  EXPECT_TRUE(
      vision.ball->cartesian().isApprox(Vector3(2.0 * std::cos(10.0_deg), 0.0, -2.0 * std::sin(10.0_deg))));
  ASSERT_EQ(vision.players.size(), 1U);
  const SeenPlayer& player = vision.players[0];
  EXPECT_EQ(player.team, "Red");
  EXPECT_EQ(player.unum, 3);
  EXPECT_TRUE(player.parts[static_cast<std::size_t>(BodyPart::Head)]);
  EXPECT_FALSE(player.parts[static_cast<std::size_t>(BodyPart::RFoot)]);
  EXPECT_EQ(player.parts[static_cast<std::size_t>(BodyPart::LFoot)]->distance, 4.1);
  EXPECT_EQ(vision.truePosition, Vector3(1.0, -2.0, 0.5));
  EXPECT_EQ(vision.trueHeading, toRadians(-90.0));
  EXPECT_EQ(vision.trueBallPosition, Vector3(0.1, 0.2, 0.04));
  ASSERT_EQ(vision.lines.size(), 1U);
  EXPECT_EQ(vision.lines[0].end.distance, 4.0);
}

TEST(Percept, NothingIsLeftFromTheMessageBefore) {
  Percept percept = perceptOf(
      "(GS (unum 7) (sl 1) (t 1.00) (pm PlayOn))(See (B (pol 2.00 0.00 -10.00)) (mypos 1.00 2.00 3.00))"
      "(FRP (n rf) (c 0.00 0.00 0.00) (f 0.00 0.00 1.00))(HJ (n hj1) (ax 5.00))(hear 1.00 self x)(junk)");
  ASSERT_TRUE(percept.vision);
  parsePercept("(time (now 1.02))", percept);
  EXPECT_FALSE(percept.vision || percept.game.unum || percept.game.scoreLeft);
  EXPECT_FALSE(percept.forces[static_cast<std::size_t>(ForceSensor::RFoot)]);
  EXPECT_EQ(percept.jointsPresent, 0U);
  EXPECT_EQ(percept.joints[model::index(model::JointId::Head1)], 0.0);
  EXPECT_TRUE(percept.heard.empty());
  EXPECT_EQ(percept.unknownTokens, 0);
  parsePercept("(See )", percept);
  ASSERT_TRUE(percept.vision);
  EXPECT_FALSE(percept.vision->ball || percept.vision->truePosition);
}

TEST(Percept, HearingWithAndWithoutLabel) {
  const Percept percept = perceptOf(
      "(hear Gold 1.50 self abc)(hear 2.50 -90.00 def)(hear self 3.50 45.00 ghi)(hear 4.50 self self)");
  ASSERT_EQ(percept.heard.size(), 4U);
  EXPECT_EQ(percept.heard[0].team, "Gold");
  EXPECT_TRUE(percept.heard[0].self);
  EXPECT_EQ(percept.heard[0].direction, 0.0);
  EXPECT_EQ(percept.heard[0].message, "abc");
  EXPECT_TRUE(percept.heard[1].team.empty());
  EXPECT_EQ(percept.heard[1].time, 2.5);
  EXPECT_EQ(percept.heard[1].direction, toRadians(-90.0));
  EXPECT_EQ(percept.heard[2].team, "self");
  EXPECT_FALSE(percept.heard[2].self);
  EXPECT_TRUE(percept.heard[3].self);
  EXPECT_EQ(percept.heard[3].message, "self");
}

struct Garbage {
  std::string_view text;
  int unknown;
};

TEST(Percept, GarbageIsCountedAndWhatFollowsIsRead) {
  for (const Garbage& garbage : {
           Garbage{"(AgentState (temp 48) (battery 75))", 1},
           Garbage{"stray", 1},
           Garbage{")))", 3},
           Garbage{"()", 1},
           Garbage{"((HJ (n hj1) (ax 1.00)))", 1},
           Garbage{"(HJ (n nose) (ax 1.00))", 1},
           Garbage{"(HJ (n hj1) (ax 1.00.0))", 1},
           Garbage{"(HJ (n hj1) (ax 1.00) extra)", 1},
           Garbage{"(GYR (n torso) (rt 1.00 2.00))", 1},
           Garbage{"(FRP (n rf2) (c 0.00 0.00 0.00) (f 0.00 0.00 1.00))", 1},
           Garbage{"(hear 1.00 self)", 1},
           Garbage{"(hear a b c d e)", 1},
           Garbage{"(GS (t 0.00) (pm PlayOn) (new 1) word)", 2},
           Garbage{"(See (X1L (pol 1.00 2.00 3.00)) (B (pol 1.00 2.00)) (F1L (pol 1.00 2.00 3.00)))", 2},
           Garbage{"(See (P (team a) (id 1) (tail (pol 1.00 2.00 3.00)) (head (pol 1.00 2.00 3.00))))", 1},
           Garbage{"(See (B (pol 1.00 2.00 3.00)) (B (pol 4.00 2.00 3.00)))(See )", 2},
           Garbage{"(FRP (n  rf)\t(c 0.00\n0.00 0.00)(f 0.00 0.00 1.00) )", 0},
       }) {
    const Percept percept = perceptOf(std::string(garbage.text) + "(time (now 1.50))");
    EXPECT_EQ(percept.unknownTokens, garbage.unknown) << garbage.text;
    EXPECT_EQ(percept.time, 1.5) << garbage.text;
  }
}

TEST(Percept, NestingAndTruncation) {
  std::string deep(100000, '(');
  EXPECT_EQ(perceptOf(deep).unknownTokens, 1);
  deep += std::string(100000, ')') + "(time (now 2.00))";
  EXPECT_EQ(perceptOf(deep).time, 2.0);
  const std::string_view message =
      "(time (now 95.12))(See (B (pol 2.00 0.00 -10.00)) (F1L (pol 1.00 2.00 3.00)))";
  for (std::size_t length = 0; length < message.size(); ++length) {
    const Percept percept = perceptOf(message.substr(0, length));
    const bool whole = length == 0 || message.substr(0, length) == "(time (now 95.12))";
    EXPECT_EQ(percept.unknownTokens > 0, !whole) << message.substr(0, length);
  }
}

}  // namespace
}  // namespace nonet::protocol
