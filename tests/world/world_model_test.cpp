// The whole world stage: players, radio, both sides, no allocation, same input same output.
#include "nonet/world/world_model.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "nonet/math/angle.h"
#include "nonet/world/ball_law.h"
#include "nonet/world/set_piece_spot.h"
#include "nonet/world/vision_frame.h"

#include "recording.h"
#include "vision_simulator.h"

namespace nonet::world {
namespace {

using protocol::PlayMode;
using protocol::TeamSide;

/// Messages of a robot that stands at a known place and sees a ball and two players.
class Scene {
 public:
  Scene(TeamSide side, const Pose2& X_FR) : side_(side), eyes_(9, {}) {
    const Pose2 X_WR = side == TeamSide::Right ? Pose2(0, 0, kPi) * X_FR : X_FR;
    X_WC_.translation() << X_WR.translation, 0.385 + 0.155;
    X_WC_.linear() = Eigen::AngleAxisd(X_WR.rotation, Vector3::UnitZ()).toRotationMatrix();
  }
  Vector3 toWorld(const Vector3& p_F) const {
    return side_ == TeamSide::Right ? Vector3(-p_F.x(), -p_F.y(), p_F.z()) : p_F;
  }

  bool seesNext() const { return count_ % 3 == 0; }
  protocol::Percept nextWithoutPlayers() {
    protocol::Percept percept = next();
    if (percept.vision) percept.vision->players.clear();
    return percept;
  }
  const protocol::Percept& next() {
    percept_.clear();
    percept_.time = 10.0 + 0.02 * count_;
    percept_.game.playMode = PlayMode::PlayOn;
    if (count_ == 0) {
      percept_.game.side = side_;
      percept_.game.unum = 3;
    }
    percept_.accelerometer = {0.0, 0.0, kGravity};
    percept_.joints.fill(0.0);
    percept_.joints[2] = 1e-4 * (count_ % 2);  // not asleep
    percept_.jointsPresent = ~0U;
    for (const auto sensor : {protocol::ForceSensor::LFoot, protocol::ForceSensor::RFoot}) {
      percept_.forces[static_cast<std::size_t>(sensor)] = protocol::FootForce{{0, 0, -0.01}, {0, 0, 22.6}};
    }
    if (seesNext()) {
      protocol::Vision& vision = percept_.beginVision();
      protocol::Vision seen = eyes_.see(X_WC_);
      vision.landmarks.assign(seen.landmarks.begin(), seen.landmarks.end());
      vision.lines.assign(seen.lines.begin(), seen.lines.end());
      vision.ball = eyes_.point(X_WC_, toWorld({2.0, 1.0, 0.042}));
      vision.players.clear();
      vision.players.push_back(player("Us", 7, Pose2(1.0, -2.0, 0.8), false));
      vision.players.push_back(player("Them", 4, Pose2(4.0, 0.5, -2.0), false));
      vision.players.push_back(player("Them", 9, Pose2(5.0, 3.0, 0.0), true));
      vision.players.push_back(player("Us", 3, Pose2(-2.9, 0.1, 0.0), false));  // the own arms
    }
    ++count_;
    return percept_;
  }

 private:
  protocol::SeenPlayer player(const char* team, int unum, const Pose2& X_FP, bool lying) {
    protocol::SeenPlayer seen;
    seen.team = protocol::TeamName(team);
    seen.unum = unum;
    const auto put = [&](protocol::BodyPart part, double x, double y, double z) {
      const Vector2 p = X_FP * Vector2(x, y);
      seen.parts[static_cast<std::size_t>(part)] = eyes_.point(X_WC_, toWorld({p.x(), p.y(), z}));
    };
    put(protocol::BodyPart::Head, lying ? 0.4 : 0.0, 0.0, lying ? 0.07 : 0.52);
    put(protocol::BodyPart::RLowerArm, 0.1, -0.1, lying ? 0.05 : 0.4);
    put(protocol::BodyPart::LLowerArm, 0.1, 0.1, lying ? 0.05 : 0.4);
    put(protocol::BodyPart::RFoot, 0.0, -0.055, 0.01);
    put(protocol::BodyPart::LFoot, 0.0, 0.055, 0.01);
    return seen;
  }

  TeamSide side_;
  test::VisionSimulator eyes_;
  Pose3 X_WC_ = Pose3::Identity();
  protocol::Percept percept_;
  int count_ = 0;
};

TEST(WorldModel, SeesTheSameFieldFromBothSides) {
  for (const TeamSide side : {TeamSide::Left, TeamSide::Right}) {
    Scene scene(side, Pose2(-3.0, 0.0, 0.1));
    WorldModel world(model::robotModel(0), {}, protocol::TeamName("Us"), 1);
    for (int i = 0; i < 300; ++i) world.update(scene.next());
    const WorldState& state = world.state();
    EXPECT_TRUE(state.self.localized);
    EXPECT_LT((state.self.X_FR.translation - Vector2(-3.0, 0.0)).norm(), 0.03);
    EXPECT_NEAR(state.self.X_FR.rotation, 0.1, 0.005);
    EXPECT_NEAR(state.self.height, 0.385, 0.02);
    EXPECT_TRUE(state.ball.known);
    EXPECT_LT((state.ball.p_FB.head<2>() - Vector2(2.0, 1.0)).norm(), 0.05);
    EXPECT_LT((state.self.X_FR * state.ball.p_RB - Vector2(2.0, 1.0)).norm(), 0.05);
    EXPECT_LT(state.ball.v_FB.norm(), 0.15);
    const Vector2 rest = restPlace({state.ball.p_FB, state.ball.v_FB});
    EXPECT_LT((rest - Vector2(2.0, 1.0)).norm(), 0.2);

    const PlayerState& mate = state.teammates[7];
    ASSERT_TRUE(mate.known);
    EXPECT_LT((mate.X_FP.translation - Vector2(1.0, -2.0)).norm(), 0.15);
    ASSERT_TRUE(mate.headingKnown);
    EXPECT_NEAR(angleDifference(mate.X_FP.rotation, 0.8), 0.0, 0.25);
    EXPECT_FALSE(mate.fallen);
    ASSERT_TRUE(state.opponents[4].known);
    EXPECT_LT((state.opponents[4].X_FP.translation - Vector2(4.0, 0.5)).norm(), 0.15);
    ASSERT_TRUE(state.opponents[9].known);
    EXPECT_TRUE(state.opponents[9].fallen);
    EXPECT_LT(state.opponents[4].v_FP.norm(), 0.2);
    // Oneself is told by the localization, not by one's own arms.
    EXPECT_LT((state.teammates[3].X_FP.translation - Vector2(-3.0, 0.0)).norm(), 0.03);
    int known = 0;
    for (const PlayerState& player : state.opponents) known += player.known ? 1 : 0;
    EXPECT_EQ(known, 2);
  }
}

// Server facts 4.7, table: for either team, from wherever the ball left.
TEST(SetPieceSpot, IsWhereTheServerPutsTheBall) {
  const FieldGeometry field;
  for (const double side : {-1.0, 1.0}) {
    const auto spot = [&](Phase phase, double x, double y) {
      return setPieceSpot(phase, {x, side * y}, field).value_or(Vector2::Zero());
    };
    EXPECT_LT((spot(Phase::OwnKickIn, 3.0, 10.4) - Vector2(3.0, side * 9.958)).norm(), 1e-9);
    EXPECT_LT((spot(Phase::OpponentKickIn, -15.2, 10.4) - Vector2(-14.958, side * 9.958)).norm(), 1e-9);
    EXPECT_LT((spot(Phase::OwnCorner, 15.3, 2.0) - Vector2(14.958, side * 5.483)).norm(), 1e-9);
    EXPECT_LT((spot(Phase::OpponentCorner, -15.3, 8.0) - Vector2(-14.958, side * 5.483)).norm(), 1e-9);
    EXPECT_LT((spot(Phase::OwnGoalKick, -15.3, 4.0) - Vector2(-14.0, 0.0)).norm(), 1e-9);
    EXPECT_LT((spot(Phase::OpponentGoalKick, 15.3, 4.0) - Vector2(14.0, 0.0)).norm(), 1e-9);
  }
  EXPECT_FALSE(setPieceSpot(Phase::PlayOn, {0.0, 0.0}, field));
  const auto free = [&](Phase phase, double x, double y) { return *setPieceSpot(phase, {x, y}, field); };
  for (const Phase phase : {Phase::OwnFreeKick, Phase::OpponentDirectFreeKick}) {
    EXPECT_EQ(free(phase, 3.0, -2.0), Vector2(3.0, -2.0));
    EXPECT_EQ(free(phase, 14.0, -3.2), Vector2(14.0, -3.2));
    // In a penalty area: its front corner on that side.
    EXPECT_LT((free(phase, 14.0, -0.5) - Vector2(13.2, -3.0)).norm(), 1e-9);
    EXPECT_LT((free(phase, -13.5, 2.9) - Vector2(-13.2, 3.0)).norm(), 1e-9);
  }
}

// It rolls on for a second, and then lies there: nobody runs after it.
TEST(WorldModel, ABallThatLeftTheFieldIsWhereItWillLie) {
  for (const TeamSide side : {TeamSide::Left, TeamSide::Right}) {
    Scene scene(side, Pose2(-3.0, 0.0, 0.1));
    WorldModel world(model::robotModel(0), {}, protocol::TeamName("Us"), 1);
    for (int i = 0; i < 150; ++i) world.update(scene.next());
    for (int i = 0; i < 100; ++i) {
      protocol::Percept percept = scene.next();
      percept.game.playMode = PlayMode::KickInLeft;
      world.update(percept);
      const BallState& ball = world.state().ball;
      ASSERT_TRUE(ball.known) << i;
      const bool lies = 0.02 * i > 1.2;  // the scene's ball is seen where it was before
      const Vector2 expected = lies ? Vector2(2.0, 1.0) : Vector2(2.0, 9.958);
      if (lies || i < 52) {
        EXPECT_LT((ball.p_FB.head<2>() - expected).norm(), 0.1) << i;
      }
    }
  }
}

// The real server sends ends of lines that are not a number (server facts 2.7).
TEST(VisionFrame, LeavesOutWhatIsNoNumber) {
  const protocol::Polar good{5.0, 0.1, -0.1};
  const double nan = std::nan("");
  protocol::Vision vision;
  vision.lines.push_back({good, {nan, nan, nan}});
  vision.lines.push_back({good, {4.0, 0.3, -0.1}});
  vision.lines.push_back({{5.0, nan, 0.0}, good});
  vision.landmarks.push_back({protocol::Landmark::F1L, {nan, 0.0, 0.0}});
  VisionFrame frame;
  frame.assign(vision);
  EXPECT_EQ(frame.lines().size(), 1U);
  EXPECT_EQ(frame.landmarks().size(), 0U);
}

// Lost, such a line in sight, found, lost again: the particles must stay places on the field.
TEST(WorldModel, SurvivesLinesThatAreNoNumbers) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Scene scene(TeamSide::Left, Pose2(-3.0, 0.0, 0.1));
    WorldModel world(model::robotModel(0), {}, protocol::TeamName("Us"), seed);
    for (int i = 0; i < 300; ++i) {
      protocol::Percept percept = scene.next();
      if (percept.vision && i % 60 < 30) {
        protocol::Vision& vision = *percept.vision;
        vision.landmarks.clear();
        vision.lines.clear();
        const double nan = std::nan("");
        vision.lines.push_back({{4.0, 0.3, -0.1}, {nan, nan, nan}});
      }
      world.update(percept);
    }
    for (const Pose2& particle : world.particles()) {
      ASSERT_TRUE(particle.translation.allFinite()) << seed;
      ASSERT_TRUE(std::isfinite(particle.rotation)) << seed;
    }
    EXPECT_TRUE(world.state().self.localized) << seed;
  }
}

TEST(WorldModel, HearsTeamMatesAndNobodyElse) {
  Scene scene(TeamSide::Left, Pose2(-3.0, 0.0, kPi));  // looks away from the ball and the others
  WorldModel world(model::robotModel(0), {}, protocol::TeamName("Us"), 1);
  for (int i = 0; i < 60; ++i) world.update(scene.next());
  EXPECT_FALSE(world.state().ball.known);

  protocol::SayMessage message;
  message.unum = 8;
  message.X_FR = Pose2(6.0, 4.0, 1.0);
  message.fallen = true;
  message.ball = protocol::SayMessage::Ball{Vector2(7.0, 3.0), Vector2::Zero(), 0.0};
  message.vote = protocol::RoleVote{1, 0, 2, 3, 4, 5, 6, 7, 9, 8};
  protocol::Percept percept = scene.next();
  protocol::Heard heard;
  heard.message = protocol::encodeSay(message, "Us");
  heard.team = protocol::TeamName("Them");
  percept.heard.push_back(heard);  // an opponent that repeats our words
  world.update(percept);
  EXPECT_FALSE(world.state().teammates[8].known);
  percept = scene.next();
  heard.team = protocol::TeamName("Us");
  percept.heard.assign(1, heard);
  world.update(percept);
  const WorldState& state = world.state();
  ASSERT_TRUE(state.teammates[8].known);
  EXPECT_LT((state.teammates[8].X_FP.translation - Vector2(6.0, 4.0)).norm(), 0.042);
  EXPECT_TRUE(state.teammates[8].fallen);
  EXPECT_TRUE(state.ball.known);
  EXPECT_LT((state.ball.p_FB.head<2>() - Vector2(7.0, 3.0)).norm(), 0.03);
  EXPECT_EQ(state.radio[8].message.vote, message.vote);
  EXPECT_DOUBLE_EQ(state.radio[8].time, percept.time);
}

protocol::Percept hearing(const protocol::Percept& percept, const protocol::SayMessage& message) {
  protocol::Percept changed = percept;
  protocol::Heard heard;
  heard.message = protocol::encodeSay(message, "Us");
  heard.team = protocol::TeamName("Us");
  changed.heard.assign(1, heard);
  return changed;
}

// Looks away from the ball and the others, and hears number 8.
struct Listener {
  Listener() {
    for (int i = 0; i < 60; ++i) world.update(scene.next());
    message.unum = 8;
    message.X_FR = Pose2(6.0, 4.0, 1.0);
    message.sigma = 0.1;
  }
  const WorldState& hears() { return world.update(hearing(scene.next(), message)); }

  Scene scene{TeamSide::Left, Pose2(-3.0, 0.0, kPi)};
  WorldModel world{model::robotModel(0), {}, protocol::TeamName("Us"), 1};
  protocol::SayMessage message;
};

// A mate tells where the ball is, however long ago it has seen it: two cycles later it has rolled for two.
TEST(WorldModel, ABallThatIsToldIsWhereItWasToldAndRollsOnFromThere) {
  for (const double age : {0.0, 0.3, 0.5}) {
    Listener robot;
    robot.message.ball = protocol::SayMessage::Ball{Vector2(2.0, 1.0), Vector2(3.0, 0.0), age};
    const BallState& ball = robot.hears().ball;
    EXPECT_LT((ball.p_FB.head<2>() - Vector2(2.0 + 3.0 * 0.04, 1.0)).norm(), 0.15) << age;
  }
}

// One that fell tells a place that it is not sure of itself.
TEST(WorldModel, AMatesPoorPlaceDoesNotReplaceAGoodOneButItsFallCounts) {
  Listener robot;
  robot.hears();
  robot.message.X_FR = Pose2(2.0, 4.0, 1.0);
  robot.message.sigma = 3.0;
  robot.message.fallen = true;
  robot.hears();
  const PlayerState& mate = robot.world.update(robot.scene.next()).teammates[8];
  ASSERT_TRUE(mate.known);
  EXPECT_TRUE(mate.fallen);
  EXPECT_LT((mate.X_FP.translation - Vector2(6.0, 4.0)).norm(), 0.2);
}

TEST(WorldModel, TakesOverOpponentsThatItDoesNotSeeItself) {
  Scene scene(TeamSide::Left, Pose2(-3.0, 0.0, 0.1));
  WorldModel world(model::robotModel(0), {}, protocol::TeamName("Us"), 1);
  for (int i = 0; i < 60; ++i) world.update(scene.next());
  const WorldState& state = world.state();
  protocol::SayMessage message;
  message.kind = protocol::SayKind::Sightings;
  message.unum = 7;
  message.X_FR = Pose2(1.0, -2.0, 0.0);
  message.sigma = 0.05;
  message.sightings[0] = {2, Vector2(-8.0, 4.0), false, 0.4};   // behind one
  message.sightings[1] = {4, Vector2(6.0, -3.0), false, 0.05};  // that one sees oneself, elsewhere
  const Pose2 mate = state.teammates[7].X_FP;
  const double before = state.time;
  world.update(hearing(scene.next(), message));
  const PlayerState& told = state.opponents[2];
  ASSERT_TRUE(told.known);
  EXPECT_LT((told.X_FP.translation - Vector2(-8.0, 4.0)).norm(), 0.1);
  EXPECT_GT(told.sigma, 0.4);  // half a second of walking, and the sender's own place
  EXPECT_LT(told.sigma, 0.7);
  EXPECT_NEAR(told.lastSeen, before - 0.5, 0.04);  // told as 0.5 s old, said two cycles ago
  EXPECT_EQ(told.lastTold, told.lastSeen);
  EXPECT_LT(told.lastSighted, 0.0);
  EXPECT_FALSE(told.headingKnown);
  EXPECT_EQ(told.v_FP.norm(), 0.0);
  EXPECT_LT((state.opponents[4].X_FP.translation - Vector2(4.0, 0.5)).norm(), 0.15);
  EXPECT_GT(state.opponents[4].lastTold, 0.0);
  // The message has no heading of the sender.
  EXPECT_NEAR(angleDifference(state.teammates[7].X_FP.rotation, mate.rotation), 0.0, 0.1);
  // Nothing older follows, and nothing older than what is known counts.
  message.sightings[0] = {2, Vector2(-4.0, 4.0), false, 0.9};
  world.update(hearing(scene.next(), message));
  EXPECT_LT((told.X_FP.translation - Vector2(-8.0, 4.0)).norm(), 0.1);
  for (int i = 0; i < 500; ++i) world.update(scene.next());
  EXPECT_FALSE(told.known);
}

TEST(WorldModel, HearsPasses) {
  Scene scene(TeamSide::Left, Pose2(-3.0, 0.0, 0.1));
  WorldModel world(model::robotModel(0), {}, protocol::TeamName("Us"), 1);
  for (int i = 0; i < 30; ++i) world.update(scene.next());
  protocol::SayMessage message;
  message.kind = protocol::SayKind::Pass;
  message.unum = 5;
  message.pass = {3, Vector2(6.0, 2.0), 0.8, 2.1};
  message.vote = protocol::RoleVote{1, 0, 2, 3, 4, 5, 6, 7, 9, 8};
  world.update(hearing(scene.next(), message));
  const WorldState& state = world.state();
  EXPECT_EQ(state.pass.from, 5);
  EXPECT_EQ(state.pass.receiver, 3);
  EXPECT_LT((state.pass.p_FTarget - Vector2(6.0, 2.0)).norm(), 0.03);
  EXPECT_NEAR(state.pass.kickAt, state.time - 0.04 + 0.8, 0.051);
  EXPECT_NEAR(state.pass.thereAt, state.time - 0.04 + 2.1, 0.051);
  EXPECT_EQ(state.radio[5].message.vote, message.vote);
  // Nothing under one's own number is believed.
  message.unum = 3;
  message.pass.receiver = 9;
  world.update(hearing(scene.next(), message));
  EXPECT_EQ(state.pass.from, 5);
  EXPECT_LT(state.radio[3].time, 0.0);
}

TEST(WorldModel, ForgetsPlayersWithGrace) {
  Scene scene(TeamSide::Left, Pose2(-3.0, 0.0, 0.1));
  WorldModel world(model::robotModel(0), {}, protocol::TeamName("Us"), 1);
  for (int i = 0; i < 60; ++i) world.update(scene.next());
  double sigma = world.state().opponents[4].sigma;
  for (int i = 0; i < 600; ++i) {
    protocol::Percept percept = scene.next();
    percept.vision.reset();  // nobody is missed where nothing is seen
    world.update(percept);
    if (i == 100) {
      EXPECT_TRUE(world.state().opponents[4].known);
      EXPECT_GT(world.state().opponents[4].sigma, sigma + 0.5);
    }
  }
  EXPECT_FALSE(world.state().opponents[4].known);
}

protocol::SayMessage tellingOfNumberFour() {
  protocol::SayMessage message;
  message.kind = protocol::SayKind::Sightings;
  message.unum = 7;
  message.X_FR = Pose2(1.0, -2.0, 0.0);
  message.sigma = 0.05;
  message.sightings[0] = {4, Vector2(4.0, 0.5), false, 0.05};
  return message;
}

// Nothing hides a player: who is not where it must be seen has been carried away by the referee.
TEST(WorldModel, MissesAnOpponentThatWasCarriedAway) {
  for (const double heading : {0.1, 1.4}) {  // it sees the place, and not
    Scene scene(TeamSide::Left, Pose2(-3.0, 0.0, heading));
    WorldModel world(model::robotModel(0), {}, protocol::TeamName("Us"), 1);
    for (int i = 0; i < 60; ++i) world.update(scene.next());
    const bool seen = world.state().opponents[4].known;
    if (!seen) world.update(hearing(scene.next(), tellingOfNumberFour()));
    ASSERT_TRUE(world.state().opponents[4].known);
    for (int i = 0; i < 15; ++i) {
      world.update(scene.nextWithoutPlayers());
    }
    EXPECT_EQ(world.state().opponents[4].known, !seen) << heading;
    // A mate's sighting from before does not bring it back.
    protocol::SayMessage old = tellingOfNumberFour();
    old.sightings[0].age = 0.3;
    world.update(hearing(scene.nextWithoutPlayers(), old));
    EXPECT_EQ(world.state().opponents[4].known, !seen) << heading;
    EXPECT_TRUE(world.state().teammates[7].known) << "a mate is not missed";
  }
}

TEST(WorldModel, AtAKickOffTheBallLiesInTheMiddle) {
  Scene scene(TeamSide::Left, Pose2(-3.0, 0.0, 0.1));
  WorldModel world(model::robotModel(0), {}, protocol::TeamName("Us"), 1);
  const auto update = [&](PlayMode mode, bool sees) {
    protocol::Percept percept = scene.next();
    percept.game.playMode = mode;
    if (!sees) percept.vision.reset();
    world.update(percept);
    return world.state().ball.p_FB.head<2>().eval();
  };
  for (int i = 0; i < 150; ++i) update(PlayMode::GoalRight, true);
  ASSERT_LT((update(PlayMode::GoalRight, false) - Vector2(2.0, 1.0)).norm(), 0.1);
  // The first message still shows it where it was.
  int first = 0;
  while (!scene.seesNext()) ++first, update(PlayMode::GoalRight, false);
  ASSERT_LT(first, 4);
  EXPECT_LT(update(PlayMode::KickOffLeft, true).norm(), 0.05);
  for (int i = 0; i < 3; ++i) EXPECT_LT(update(PlayMode::KickOffLeft, false).norm(), 0.05);
  // What is seen counts at once: from the first touch on it rolls.
  for (int i = 0; i < 6; ++i) update(PlayMode::KickOffLeft, true);
  EXPECT_LT((update(PlayMode::KickOffLeft, true) - Vector2(2.0, 1.0)).norm(), 0.2);
}

TEST(WorldModel, SameInputGivesTheSameBits) {
  std::vector<double> first;
  for (int run = 0; run < 2; ++run) {
    WorldModel world(model::robotModel(0), {}, protocol::TeamName("Probe"), 1);
    std::size_t index = 0;
    test::readRecording("poses.log.gz", [&](const protocol::Percept& percept) {
      const WorldState& state = world.update(percept);
      for (const double value : {state.self.X_FR.translation.x(), state.self.X_FR.rotation,
                                 state.ball.p_FB.x(), state.self.covariance(0, 0), state.body.v_GR.y()}) {
        if (run == 0) {
          first.push_back(value);
        } else {
          ASSERT_EQ(first[index++], value);
        }
      }
    });
  }
}

TEST(WorldModel, ForeignAgentsBeamsDoNotMislead) {
  // A replayed log of another agent: our own wishes to be beamed were never heard by that server.
  WorldModel world(model::robotModel(0), {}, protocol::TeamName("Gold"), 1);
  double worst = 0.0;
  test::readRecording("half_time.log.gz", [&](const protocol::Percept& percept) {
    const WorldState& state = world.update(percept, Pose2(-3.0, 5.0, 0.5));
    if (!percept.vision || !percept.vision->truePosition || state.game.unum == 0) return;
    worst = std::max(worst, (state.self.X_FC.translation() - *percept.vision->truePosition).head<2>().norm());
  });
  EXPECT_LT(worst, 0.2);
}

// A server that stands still sends the same time again, with what was said meanwhile.
TEST(WorldModel, HearsInAMessageWithTheTimeOfTheLastOne) {
  Listener listener;
  protocol::Percept percept = listener.scene.next();
  listener.world.update(percept);
  EXPECT_FALSE(listener.world.state().teammates[8].known);
  percept.vision.reset();
  EXPECT_TRUE(listener.world.update(hearing(percept, listener.message)).teammates[8].known);
}

}  // namespace
}  // namespace nonet::world
