// Other players as the server's vision shows them, against where they are.
#include "nonet/world/player_tracker.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "vision_simulator.h"

namespace nonet::world {
namespace {

constexpr int kUnum = 4;

// An observer at the middle of the field that looks along x, and one player before it.
struct Watched {
  explicit Watched(std::uint64_t seed, bool own = false) : eyes(seed, {}), mate(own) {
    state.game.team = protocol::TeamName("Us");
    state.game.unum = 9;
    state.self.localized = true;
    state.self.X_FC.translation() = Vector3(0, 0, 0.5);
    state.time = 10.0;
  }
  void cycle(const Vector2& place, double headHeight = 0.5) {
    state.time += kCycleTime;
    tracker.predict(kCycleTime, state);
    if (++cycles % 3 != 0) return;
    protocol::SeenPlayer player;
    player.team = protocol::TeamName(mate ? "Us" : "Them");
    player.unum = kUnum;
    const auto part = [&](protocol::BodyPart which, double left, double height) {
      player.parts[static_cast<std::size_t>(which)] =
          eyes.point(state.self.X_FC, Vector3(place.x(), place.y() + left, height));
    };
    part(protocol::BodyPart::Head, 0.0, headHeight);
    part(protocol::BodyPart::RLowerArm, -0.12, 0.25);
    part(protocol::BodyPart::LLowerArm, 0.12, 0.25);
    part(protocol::BodyPart::RFoot, -0.05, 0.02);
    part(protocol::BodyPart::LFoot, 0.05, 0.02);
    protocol::Vision vision;
    vision.players.push_back(player);
    tracker.see(vision, eyes.offset, state);
  }
  const PlayerState& player() const { return (mate ? state.teammates : state.opponents)[kUnum]; }

  test::VisionSimulator eyes;
  bool mate;
  PlayerTracker tracker;
  WorldState state;
  int cycles = 0;
};

// It stands, walks at a metre a second, and stands again: followed closely, and the stated error is true.
TEST(PlayerTracker, FollowsAPlayerThatStartsAndStops) {
  for (const double away : {3.0, 6.0}) {
    int honest = 0, count = 0;
    double worst = 0.0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      Watched watched(seed);
      Vector2 place(away, -0.7);
      for (int i = 0; i < 200; ++i) {
        if (i >= 50 && i < 125) place.y() += kCycleTime * 1.0;
        watched.cycle(place);
        if (i < 10) continue;
        const double error = (watched.player().X_FP.translation - place).norm();
        worst = std::max(worst, error);
        honest += error < 3.0 * watched.player().sigma ? 1 : 0;
        ++count;
      }
    }
    EXPECT_LT(worst, 0.04 * away) << away;
    EXPECT_GT(honest, 0.95 * count) << away;
  }
}

// The referee puts it a metre aside: it is there, and has not run.
TEST(PlayerTracker, APlayerThatIsMovedHasNotWalked) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Watched watched(seed);
    for (int i = 0; i < 60; ++i) watched.cycle({3.0, -0.5});
    for (int i = 0; i < 6; ++i) watched.cycle({3.0, 0.5});
    EXPECT_LT((watched.player().X_FP.translation - Vector2(3.0, 0.5)).norm(), 0.1) << seed;
    EXPECT_LT(watched.player().v_FP.norm(), 0.4) << seed;
  }
}

// Its head is up before it stands.
TEST(PlayerTracker, AMateThatRisesIsUpWhenItSaysSo) {
  Watched watched(1, true);
  const auto say = [&](bool fallen) {
    watched.tracker.hear(PlayerTracker::Report{kUnum, Pose2(3.0, 0.0, 0.0), 0.1, fallen, true},
                         watched.state);
    watched.state.radio[kUnum].time = watched.state.time;
  };
  for (int i = 0; i < 12; ++i) watched.cycle({3.0, 0.0}, 0.2);
  say(true);
  const double since = watched.player().fallenSince;
  for (int i = 0; i < 22; ++i) watched.cycle({3.0, 0.0}, 0.42);
  EXPECT_TRUE(watched.player().fallen);
  say(true);
  EXPECT_EQ(watched.player().fallenSince, since);
  say(false);
  EXPECT_FALSE(watched.player().fallen);
  for (int i = 0; i < 60; ++i) watched.cycle({3.0, 0.0}, 0.2);
  EXPECT_TRUE(watched.player().fallen) << "it has not spoken for long";
}

// A body on the ground is seen long before its turn to speak.
TEST(PlayerTracker, AMateThatFallsIsSeenToLieThoughItJustSaidThatItStands) {
  Watched watched(1, true);
  for (int i = 0; i < 12; ++i) watched.cycle({3.0, 0.0}, 0.42);
  watched.tracker.hear(PlayerTracker::Report{kUnum, Pose2(3.0, 0.0, 0.0), 0.1, false, true}, watched.state);
  watched.state.radio[kUnum].time = watched.state.time;
  for (int i = 0; i < 3; ++i) watched.cycle({3.0, 0.0}, 0.42);
  EXPECT_FALSE(watched.player().fallen);
  for (int i = 0; i < 6; ++i) watched.cycle({3.0, 0.0}, 0.15);
  EXPECT_TRUE(watched.player().fallen);
}

}  // namespace
}  // namespace nonet::world
