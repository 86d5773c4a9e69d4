#include "nonet/team/challenge.h"

#include <gtest/gtest.h>

#include "scene.h"

namespace nonet::team {
namespace {

TEST(Challenge, NamesInAnySpelling) {
  EXPECT_EQ(challengeFromName("run"), Challenge::Run);
  EXPECT_EQ(challengeFromName("RunChallenge"), Challenge::Run);
  EXPECT_EQ(challengeFromName("KICK"), Challenge::Kick);
  EXPECT_EQ(challengeFromName("keep-away"), Challenge::KeepAway);
  EXPECT_EQ(challengeFromName("keepAwayChallenge"), Challenge::KeepAway);
  EXPECT_EQ(challengeFromName("passing"), Challenge::Passing);
  EXPECT_EQ(challengeFromName("goalie"), Challenge::Goalie);
  EXPECT_FALSE(challengeFromName("juggling"));
  for (const Challenge challenge :
       {Challenge::Run, Challenge::Kick, Challenge::Goalie, Challenge::Passing, Challenge::KeepAway})
    EXPECT_EQ(challengeFromName(challengeName(challenge)), challenge);
}

TEST(Challenge, TheRunnerKeepsToItsLineAndDoesNotCareForTheBall) {
  Scene scene;
  scene.stand(Pose2(-13.5, 2.0, 0.0));
  scene.putBall({-12.5, 1.0});
  ChallengePlayer player(Challenge::Run);
  EXPECT_NEAR(goalOf(scene, *player.update(scene.situation(Role::OnBall))).y(), 2.0, 1e-9);
  scene.stand(Pose2(-10.0, 2.4, 0.5));
  const auto action = player.update(scene.situation(Role::OnBall));
  ASSERT_TRUE(action);
  EXPECT_NEAR(goalOf(scene, *action).y(), 2.0, 1e-9) << "back to the line on which it began";
  EXPECT_GT(goalOf(scene, *action).x(), -8.0);
  EXPECT_FALSE(std::get<motion::WalkTo>(action->motion).stopAtTarget);
  scene.stand(Pose2(14.6, 2.0, 0.0));
  EXPECT_TRUE(std::holds_alternative<motion::Stand>(player.update(scene.situation(Role::OnBall))->motion));
}

TEST(Challenge, TheKickerBringsTheBallToTheCentreWithOneKick) {
  Scene scene;
  scene.stand(Pose2(-9.0, 0.0, 0.0));
  scene.putBall({-6.0, 1.0});
  ChallengePlayer player(Challenge::Kick);
  // The ball of the match before lies elsewhere until the trainer puts it here.
  scene.putBall({0.0, 0.0});
  player.update(scene.situation(Role::Stopper));
  scene.putBall({-6.0, 1.0});
  const auto walk = player.update(scene.situation(Role::Stopper));
  ASSERT_TRUE(walk);
  EXPECT_LT(goalOf(scene, *walk).x(), -6.0) << "to a place behind the ball";

  scene.stand(Pose2(-6.3, 1.05, -0.16));
  const auto kick = player.update(scene.situation(Role::Stopper));
  ASSERT_TRUE(kick && std::holds_alternative<motion::KickTo>(kick->motion));
  const Vector2 target = scene.world.self.X_FR * std::get<motion::KickTo>(kick->motion).target;
  EXPECT_NEAR(target.norm(), 0.0, 1e-9);

  scene.putBall({-5.4, 0.9}, {3.0, -0.5});
  EXPECT_TRUE(std::holds_alternative<motion::Stand>(player.update(scene.situation(Role::OnBall))->motion));
  scene.putBall({-6.0, 1.0});  // once is once
  EXPECT_TRUE(std::holds_alternative<motion::Stand>(player.update(scene.situation(Role::OnBall))->motion));
}

// From every side of the ball, and at every distance: to run through it would bring it somewhere, but not to
// rest.
TEST(Challenge, TheKickerNeverDribbles) {
  for (double angle = 0.0; angle < 6.28; angle += 0.3) {
    for (const double distance : {0.15, 0.3, 0.6, 1.5}) {
      Scene scene;
      const Vector2 ball(-5.0, -2.0);
      scene.stand(Pose2(ball.x() - distance * std::cos(angle), ball.y() - distance * std::sin(angle), angle));
      scene.putBall(ball);
      ChallengePlayer player(Challenge::Kick);
      const auto action = player.update(scene.situation(Role::OnBall));
      ASSERT_TRUE(action);
      EXPECT_NE(action->reason.detail, "through the ball");
    }
  }
}

TEST(Challenge, OthersArePlayedAsAMatchAndBeforeTheStartAllAre) {
  Scene scene;
  for (const Challenge challenge :
       {Challenge::None, Challenge::Goalie, Challenge::Passing, Challenge::KeepAway})
    EXPECT_FALSE(ChallengePlayer(challenge).update(scene.situation(Role::OnBall)));
  scene.world.game.phase = world::Phase::BeforeKickOff;
  for (const Challenge challenge : {Challenge::Run, Challenge::Kick})
    EXPECT_FALSE(ChallengePlayer(challenge).update(scene.situation(Role::OnBall)));
}

}  // namespace
}  // namespace nonet::team
