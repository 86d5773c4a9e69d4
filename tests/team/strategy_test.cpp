// Which behaviour answers in which scene. The scenes are told in the words of the rules, not of the code.
#include "nonet/team/strategy.h"

#include <array>
#include <set>

#include <gtest/gtest.h>

#include "nonet/math/random.h"
#include "nonet/math/straight_way.h"

#include "scene.h"

namespace nonet::team {
namespace {

using world::Phase;

TEST(Strategy, NamesAreDifferentAndTheLastBehaviourAlwaysAnswers) {
  std::set<std::string_view> names;
  for (const StrategyEntry& entry : strategy()) names.insert(entry.name);
  EXPECT_EQ(names.size(), strategy().size());
  EXPECT_TRUE(strategy().back().behavior(Scene().situation(Role::Stopper)));
}

TEST(Strategy, OnlyTheOneOnTheBallPlaysIt) {
  Scene scene;
  EXPECT_EQ(scene.decideAs(Role::OnBall).reason.behavior, "go to ball");
  for (const Role role : {Role::Stopper, Role::WingLeft, Role::ForwardRight, Role::Sweeper})
    EXPECT_EQ(scene.decideAs(role).reason.behavior, "support");
}

TEST(Strategy, ThePlayerThatTookTheSetPieceLeavesTheBall) {
  Scene scene;
  Situation situation = scene.situation(Role::OnBall);
  situation.mayTouch = false;
  situation.play = ownTurn(situation);
  const Action action = decide(situation);
  EXPECT_EQ(action.reason.behavior, "support");
  EXPECT_GT((goalOf(scene, action) - situation.ball()).norm(), 0.6);
}

TEST(Strategy, TheGoaliesWordKeepsFieldPlayersOffTheBall) {
  Scene scene;
  scene.world.radio[1].time = scene.world.time - 0.5;
  scene.world.radio[1].message.timeToBall = 1.0;
  EXPECT_EQ(scene.decideAs(Role::OnBall).reason.behavior, "support");
  scene.world.radio[1].message.fallen = true;
  EXPECT_EQ(scene.decideAs(Role::OnBall).reason.behavior, "go to ball");
  scene.world.radio[1].message.fallen = false;
  scene.world.radio[1].time = scene.world.time - 2.0;
  EXPECT_EQ(scene.decideAs(Role::OnBall).reason.behavior, "go to ball") << "that was long ago";
}

TEST(Strategy, StandsWhileThereIsNothingToDecide) {
  for (const Phase phase : {Phase::GameOver, Phase::Other}) {
    Scene scene;
    scene.world.game.phase = phase;
    EXPECT_EQ(scene.decideAs(Role::OnBall).reason.behavior, "rest");
  }
  Scene rising;
  rising.motion.rising = true;
  EXPECT_EQ(rising.decideAs(Role::OnBall).reason.behavior, "rest");
  Scene busy;
  busy.motion.busy = true;
  EXPECT_TRUE(std::holds_alternative<motion::Stand>(busy.decideAs(Role::OnBall).motion));
}

TEST(Strategy, LooksForTheBallWithTheHeadThenWithTheBody) {
  Scene scene;
  scene.world.ball.known = false;
  scene.world.ball.lastSeen = scene.world.time - 1.0;
  EXPECT_TRUE(std::holds_alternative<motion::Stand>(scene.decideAs(Role::Stopper).motion));
  scene.world.ball.lastSeen = scene.world.time - 5.0;
  scene.world.ball.p_RB = Vector2(-1.0, -1.0);
  const Action turn = scene.decideAs(Role::Stopper);
  EXPECT_EQ(turn.reason.behavior, "search ball");
  ASSERT_TRUE(std::holds_alternative<motion::WalkVelocity>(turn.motion));
  EXPECT_LT(std::get<motion::WalkVelocity>(turn.motion).velocity.rotation, 0.0) << "it was to the right";
  scene.world.game.unum = 1;
  EXPECT_TRUE(std::holds_alternative<motion::Stand>(scene.decideAs(Role::Goalie).motion))
      << "guards its goal";
}

TEST(Strategy, DoesNotWalkWhileItIsLost) {
  Scene scene;
  scene.world.self.localized = false;
  EXPECT_EQ(scene.decideAs(Role::OnBall).reason.behavior, "find oneself");
}

TEST(Strategy, BeamsOnceBeforeTheKickOffAndAgainWhenElsewhere) {
  Scene scene;
  scene.world.game.phase = Phase::BeforeKickOff;
  scene.world.game.side = protocol::TeamSide::Left;
  scene.world.game.phaseSince = scene.world.time;
  Situation situation = scene.situation(Role::Stopper);
  const Action first = decide(situation);
  ASSERT_TRUE(first.beam);
  EXPECT_LT(first.beam->translation.x(), 0.0);
  situation.lastBeam = scene.world.time;
  EXPECT_FALSE(decide(situation).beam);
  situation.lastBeam = scene.world.time - 3.0;
  scene.world.game.phaseSince = scene.world.time - 4.0;
  EXPECT_TRUE(decide(situation).beam) << "three seconds later still elsewhere";
  scene.world.self.X_FR = *first.beam;
  EXPECT_FALSE(decide(situation).beam) << "it is there";
}

// The referee keeps opponents outside a circle; the nearest player stands between ball and goal.
TEST(Strategy, KeepsTheDistanceAtTheOpponentsSetPieces) {
  Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    Scene scene;
    constexpr std::array kPhases = {Phase::OpponentFreeKick, Phase::OpponentKickIn, Phase::OpponentPass};
    scene.world.game.phase = kPhases[static_cast<std::size_t>(trial) % kPhases.size()];
    scene.putBall({random.uniform(-12.0, 12.0), random.uniform(-9.0, 9.0)});
    scene.stand(Pose2(random.uniform(-12.0, 12.0), random.uniform(-9.0, 9.0), 0.0));
    for (int role = 0; role < kFieldRoles; ++role) {
      const Situation situation = scene.situation(static_cast<Role>(role));
      ASSERT_FALSE(situation.play);
      const auto action = opponentSetPiece(situation);
      ASSERT_TRUE(action);
    }
    // From the own side, with nothing in the way, the request leads to the place itself.
    const Vector2 ball = scene.world.ball.p_FB.head<2>();
    const Vector2 way = (Vector2(-15.0, 0.0) - ball).normalized();
    const double clear = scene.world.game.phase == Phase::OpponentPass ? scene.parameters.passMode.clear
                                                                       : scene.parameters.clearOfOpponentKick;
    scene.stand(Pose2(ball + (clear + 1.0) * way, 0.0));
    const Vector2 place = goalOf(scene, *opponentSetPiece(scene.situation(Role::OnBall)));
    EXPECT_NEAR((place - ball).norm(), clear, 1e-6);
    // What decides for a place on the ball itself turns it by a hundredth of a radian at most.
    EXPECT_LT((place - (ball + clear * way)).norm(), 0.0101 * clear);
  }
}

// From the other side of the ball: around the circle, not through it.
TEST(Strategy, WalksAroundTheCircleOfTheOpponentsSetPiece) {
  Scene scene;
  scene.world.game.phase = Phase::OpponentFreeKick;
  scene.putBall({2.0, 1.0});
  const Vector2 ball = scene.world.ball.p_FB.head<2>();
  for (const double aside : {-1.0, 0.0, 0.1, 1.0}) {
    const Vector2 start = ball + Vector2(4.0, aside);
    scene.stand(Pose2(start, kPi));
    const Vector2 next = goalOf(scene, *opponentSetPiece(scene.situation(Role::OnBall)));
    const StraightWay way(start, next);
    EXPECT_GT((next - start).norm(), 1.0);
    EXPECT_GT(way.distanceTo(ball), 2.1) << aside;
  }
  // Somebody stands on the place: still to that side of the ball.
  const Vector2 place =
      ball + scene.parameters.clearOfOpponentKick * (Vector2(-15.0, 0.0) - ball).normalized();
  Scene::put(scene.world.opponents[3], Pose2(place, 0.0));
  scene.stand(Pose2(ball + Vector2(0.0, 4.0), 0.0));
  const Action action = *opponentSetPiece(scene.situation(Role::OnBall));
  EXPECT_LT(goalOf(scene, action).x(), ball.x() - 1.0);
}

// Whoever is in their penalty area then is moved by the referee (server facts 4.7).
TEST(Strategy, NobodyWaitsInTheirAreaAtTheirGoalKick) {
  Scene scene;
  scene.world.game.phase = Phase::OpponentGoalKick;
  scene.putBall({14.0, 0.0});
  scene.stand(Pose2(8.0, 1.0, 0.0));
  for (int role = 0; role < kFieldRoles; ++role) {
    const Situation situation = scene.situation(static_cast<Role>(role));
    const Vector2 place = goalOf(scene, *opponentSetPiece(situation));
    EXPECT_FALSE(place.x() > 13.2 - 0.5 && std::abs(place.y()) < 3.0 + 0.5)
        << "role " << role << " at " << place.transpose();
  }
}

// Who cannot kick has only the pass to the one next to it.
TEST(Strategy, TheTakerWaitsForTheReceiverButNotForEver) {
  Scene scene;
  scene.motion.kicks = {};
  scene.world.game.phase = Phase::OwnFreeKick;
  scene.world.game.phaseSince = scene.world.time - 1.2;
  Scene::put(scene.world.teammates[7], Pose2(-8.0, 0.0, 0.0));
  EXPECT_EQ(scene.decideAs(Role::OnBall).reason.behavior, "wait at ball");
  const Situation situation = scene.situation(Role::OnBall);
  Scene::put(scene.world.teammates[7], Pose2(situation.setPlay->p_FReceiver, 0.0));
  EXPECT_EQ(scene.decideAs(Role::OnBall).reason.behavior, "go to ball");
  scene.world.teammates[7].fallen = true;
  EXPECT_EQ(scene.decideAs(Role::OnBall).reason.behavior, "wait at ball");
  scene.world.game.phaseSince = scene.world.time - scene.parameters.waitForReceiver - 0.1;
  EXPECT_EQ(scene.decideAs(Role::OnBall).reason.behavior, "go to ball");
}

TEST(Strategy, TheStopperReceives) {
  Scene scene;
  scene.world.game.phase = Phase::OwnFreeKick;
  const Situation situation = scene.situation(Role::Stopper);
  scene.stand(Pose2(situation.setPlay->p_FReceiver + Vector2(-0.5, 0.0), 0.0));
  const Action action = decide(scene.situation(Role::Stopper));
  EXPECT_EQ(action.reason.detail, "receive");
  EXPECT_LT((goalOf(scene, action) - situation.setPlay->p_FReceiver).norm(), 0.3);
}

}  // namespace
}  // namespace nonet::team
