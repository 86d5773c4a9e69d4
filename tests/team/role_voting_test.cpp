// A team of points that hear each other, each with its own noisy view: whatever they believe, they must agree
// on one player on the ball, keep it, and hand it over when a ban or another player's lead says so.
#include "nonet/team/role_voting.h"

#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "nonet/math/random.h"

namespace nonet::team {
namespace {

constexpr int kFirst = 2;
constexpr int kLast = 9;

class Team {
 public:
  explicit Team(std::uint64_t seed) : random_(seed) {
    for (int unum = kFirst; unum <= kLast; ++unum) {
      voting_.push_back(std::make_unique<RoleVoting>());
      worlds_.emplace_back();
      places_.emplace_back(random_.uniform(-12, 12), random_.uniform(-8, 8));
    }
    noise_.resize(worlds_.size() * 12);
    for (Vector2& n : noise_) n = 0.2 * Vector2(random_.normal(), random_.normal());
  }

  void cycle() {
    time_ += 0.02;
    std::vector<std::pair<int, protocol::SayMessage>> said;
    for (std::size_t i = 0; i < worlds_.size(); ++i) {
      world::WorldState& world = worlds_[i];
      look(i, world);
      voting_[i]->update(assess(world, parameters_, motion_), banned);
      if (protocol::saySlot(time_) != world.game.unum || world.game.unum == vanished) continue;
      protocol::SayMessage message;
      message.unum = world.game.unum;
      message.timeToBall = 1.0;
      message.vote = voting_[i]->vote();
      said.emplace_back(message.unum, message);
    }
    for (const auto& [unum, message] : said)
      for (world::WorldState& world : worlds_)
        if (world.game.unum != unum) world.radio[static_cast<std::size_t>(unum)] = {time_, message};
  }
  void run(double seconds) {
    for (double end = time_ + seconds; time_ < end;) cycle();
  }

  /// The player that everybody believes to be on the ball; 0 if they disagree.
  int agreedOnBall() const {
    std::set<int> players;
    for (const auto& voting : voting_) players.insert(voting->onBall());
    return players.size() == 1 ? *players.begin() : 0;
  }
  int onBallOf(int unum) const { return voting_[static_cast<std::size_t>(unum - kFirst)]->onBall(); }
  std::multiset<Role> roles() const {
    std::multiset<Role> roles;
    for (const auto& voting : voting_) roles.insert(voting->role());
    return roles;
  }
  Vector2& place(int unum) { return places_[static_cast<std::size_t>(unum - kFirst)]; }

  // Everybody far from the ball.
  void goHome() {
    for (int unum = kFirst; unum <= kLast; ++unum) place(unum) = Vector2(-10.0, unum);
  }

  Role roleOf(int unum) const { return voting_[static_cast<std::size_t>(unum - kFirst)]->role(); }

  Vector2 ball = Vector2(1.0, 1.0);
  int banned = 0;
  int vanished = 0;  // says nothing any more
  int lying = 0;     // has fallen, and everybody sees it
  world::Phase phase = world::Phase::PlayOn;
  VariantParameters& variant() { return parameters_.variant; }

 private:
  void look(std::size_t i, world::WorldState& world) {
    world.time = time_;
    world.game.unum = static_cast<int>(i) + kFirst;
    world.game.phase = phase;
    world.self.localized = true;
    world.self.X_FR = Pose2(places_[i], 0.0);
    world.ball.known = true;
    world.ball.p_FB = Vector3(ball.x(), ball.y(), 0.04);
    for (std::size_t k = 0; k < places_.size(); ++k) {
      world::PlayerState& mate = world.teammates[k + kFirst];
      mate.known = mate.headingKnown = true;
      const Vector2 error = k == i ? Vector2::Zero() : noise_[i * 12 + k];
      mate.X_FP = Pose2(places_[k] + error, 0.0);
      mate.lies(static_cast<int>(k) + kFirst == lying, time_);
    }
  }

  TeamParameters parameters_;
  motion::MotionState motion_;
  Random random_;
  double time_ = 10.0;
  std::vector<std::unique_ptr<RoleVoting>> voting_;
  std::vector<world::WorldState> worlds_;
  std::vector<Vector2> places_;
  std::vector<Vector2> noise_;  // of each observer about each player
};

TEST(RoleVoting, EverybodyAgreesWithinARoundThoughViewsDiffer) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Team team(seed);
    team.run(1.5);
    EXPECT_NE(team.agreedOnBall(), 0) << "seed " << seed;
    // All hear the same votes, so all follow the same one: every role once.
    const std::multiset<Role> roles = team.roles();
    EXPECT_EQ(std::set<Role>(roles.begin(), roles.end()).size(), roles.size()) << "seed " << seed;
  }
}

TEST(RoleVoting, WithFixedRolesTheNearestTakesTheBallAndTheOthersStay) {
  Team team(5);
  team.variant().fixedRoles = true;
  for (const int nearest : {3, 8}) {
    team.goHome();
    team.place(nearest) = team.ball + Vector2(-0.6, 0.0);
    team.run(3.0);
    EXPECT_EQ(team.agreedOnBall(), nearest);
    for (int unum = kFirst; unum <= kLast; ++unum) {
      const Role own = unum == nearest ? Role::OnBall : static_cast<Role>(unum - 1);
      EXPECT_EQ(team.roleOf(unum), own) << unum;
    }
  }
}

TEST(RoleVoting, WithoutFormationEverybodyIsOnTheBall) {
  Team team(5);
  team.variant().allBall = true;
  team.run(1.0);
  for (const Role role : team.roles()) EXPECT_EQ(role, Role::OnBall);
}

TEST(RoleVoting, KeepsThePlayerOnTheBallAgainstSmallDifferences) {
  Team team(3);
  team.goHome();
  team.place(4) = team.ball + Vector2(-1.0, 0.3);
  team.place(5) = team.ball + Vector2(-1.1, -0.3);
  team.run(1.5);
  const int first = team.agreedOnBall();
  ASSERT_TRUE(first == 4 || first == 5);
  const int other = 9 - first;
  // The other one is now a little nearer, again and again.
  for (int k = 0; k < 10; ++k) {
    team.place(other) = team.ball + Vector2(-0.9 + 0.02 * k, 0.0);
    team.run(0.3);
    EXPECT_EQ(team.agreedOnBall(), first);
  }
  // Far nearer.
  team.place(first) = team.ball + Vector2(-4.0, 0.0);
  team.run(1.5);
  EXPECT_EQ(team.agreedOnBall(), other);
}

// Seen on the real server: the receiver of the kick-off came in first, kept the ball, and walked around it.
TEST(RoleVoting, BeforeAKickOffWhoComesInFirstKeepsNothing) {
  Team team(3);
  team.phase = world::Phase::BeforeKickOff;
  team.goHome();
  team.place(6) = team.ball + Vector2(-1.3, 0.0);
  team.run(1.5);
  EXPECT_EQ(team.agreedOnBall(), 6);
  team.place(9) = team.ball + Vector2(-0.5, 0.0);
  team.run(1.5);
  EXPECT_EQ(team.agreedOnBall(), 9);
}

TEST(RoleVoting, TheBannedPlayerHandsOver) {
  Team team(4);
  for (int unum = kFirst; unum <= kLast; ++unum) team.place(unum) = Vector2(-8.0, unum);
  team.place(9) = team.ball + Vector2(-0.2, 0.0);
  team.place(6) = team.ball + Vector2(-1.5, 0.0);
  team.run(1.5);
  ASSERT_EQ(team.agreedOnBall(), 9);
  team.banned = 9;
  team.run(0.6);
  EXPECT_EQ(team.agreedOnBall(), 6);
}

// Its process has died, and the others still see the robot stand at the ball.
TEST(RoleVoting, WhoIsNotHeardAnyMoreHandsOver) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Team team(seed);
    team.run(1.5);
    const int before = team.agreedOnBall();
    ASSERT_NE(before, 0);
    team.place(before) = team.ball + Vector2(-0.3, 0.0);
    team.run(1.5);
    ASSERT_EQ(team.agreedOnBall(), before);
    team.vanished = before;
    team.run(5.5);
    EXPECT_NE(team.onBallOf(before == 5 ? 6 : 5), before) << "seed " << seed;
  }
}

TEST(RoleVoting, WithoutAViewOfTheFieldThereIsNoVote) {
  RoleVoting voting;
  world::WorldState world;
  const TeamParameters parameters;
  const motion::MotionState motion;
  world.game.unum = 4;
  for (int cycle = 0; cycle < 50; ++cycle) {
    world.time = 0.02 * cycle;
    voting.update(assess(world, parameters, motion), 0);
    EXPECT_FALSE(voting.vote().has_value());
  }
}

// The one on the ball falls beside it; the next one is so far that it would not get it otherwise.
TEST(RoleVoting, WhoFallsLosesTheBallAtOnce) {
  Team team(3);
  team.goHome();
  team.place(4) = team.ball + Vector2(-0.3, 0.0);
  team.place(5) = team.ball + Vector2(-1.4, -0.3);
  team.run(1.5);
  ASSERT_EQ(team.agreedOnBall(), 4);
  team.run(2.0);
  ASSERT_EQ(team.agreedOnBall(), 4);
  team.lying = 4;
  team.run(0.3);
  EXPECT_EQ(team.agreedOnBall(), 5) << "after a third of a second, when most have not spoken again";
}

// The votes of those who have not spoken since do not bring it back.
TEST(RoleVoting, AfterAFallTheBallChangesHandsOnce) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Team team(seed);
    team.goHome();
    team.place(4) = team.ball + Vector2(-0.3, 0.0);
    team.place(5) = team.ball + Vector2(-1.4, -0.3);
    team.run(3.0);
    ASSERT_EQ(team.agreedOnBall(), 4) << seed;
    team.lying = 4;
    std::array<int, kLast + 1> changes{};
    std::array<int, kLast + 1> last{};
    last.fill(4);
    for (int i = 0; i < 50; ++i) {
      team.cycle();
      for (int unum = kFirst; unum <= kLast; ++unum) {
        const auto u = static_cast<std::size_t>(unum);
        if (team.onBallOf(unum) != last[u]) ++changes[u];
        last[u] = team.onBallOf(unum);
      }
    }
    EXPECT_LE(*std::max_element(changes.begin(), changes.end()), 1) << seed;
  }
}

TEST(RoleVoting, WhoFallsKeepsTheBallIfNobodyIsNear) {
  Team team(3);
  team.goHome();
  team.place(4) = team.ball + Vector2(-0.3, 0.0);
  team.run(1.5);
  team.lying = 4;
  team.run(2.0);
  EXPECT_EQ(team.agreedOnBall(), 4);
}

// From far away there is less to lose than at the ball.
TEST(RoleVoting, WhoIsFarFromTheBallIsRelievedSooner) {
  const auto keeps = [](double far, double sooner) {
    Team team(3);
    team.goHome();
    team.place(4) = team.ball + Vector2(-far, 0.0);
    team.run(1.5);
    EXPECT_EQ(team.agreedOnBall(), 4);
    team.place(5) = team.ball + Vector2(-far + sooner * PaceParameters{}.walkSpeed, 0.1);
    team.run(1.5);
    return team.agreedOnBall() == 4;
  };
  EXPECT_TRUE(keeps(0.9, 0.6));
  EXPECT_FALSE(keeps(4.0, 0.9));
}

}  // namespace
}  // namespace nonet::team
