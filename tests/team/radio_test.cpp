// Oracle: the listener's decoder and the capacity rule of the server.
#include "nonet/team/radio.h"

#include <algorithm>
#include <functional>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "nonet/protocol/say_codec.h"

namespace nonet::team {
namespace {

world::WorldState stateOf(int unum) {
  world::WorldState world;
  world.game.unum = unum;
  world.game.team.assign("Nonet");
  world.self.localized = true;
  world.self.covariance = Matrix3::Identity() * 1e-4;
  world.self.X_FR = Pose2(-3.0 + unum, 2.0, 0.5);
  world.ball.known = true;
  world.ball.p_FB = Vector3(1.0, -2.0, 0.04);
  world.ball.p_RB = Vector2(1.0, 0.0);
  return world;
}

TEST(Radio, EveryPlayerIsHeardOncePerRoundAndNobodyCollides) {
  std::array<Radio, 12> radios;
  std::map<int, int> spoken;
  int previousCycle = -10;
  const int rounds = 20;
  for (int cycle = 0; cycle < rounds * 22; ++cycle) {
    int speakers = 0;
    for (int unum = 1; unum <= 11; ++unum) {
      world::WorldState world = stateOf(unum);
      world.time = 100.0 + 0.02 * cycle;
      world.ball.lastSeen = world.time - 0.06;
      const auto say = radios[unum].update(world, {});
      if (!say) continue;
      ++speakers;
      ++spoken[unum];
      const auto heard = protocol::decodeSay(say->view(), "Nonet");
      ASSERT_TRUE(heard.has_value());
      EXPECT_EQ(heard->unum, unum);
      EXPECT_NEAR(heard->X_FR.translation.x(), -3.0 + unum, 0.034);
      ASSERT_TRUE(heard->ball.has_value());
      EXPECT_NEAR(heard->ball->p_FB.y(), -2.0, 0.02);
    }
    ASSERT_LE(speakers, 1);
    if (speakers == 1) {
      EXPECT_GE(cycle - previousCycle, 2) << "a listener hears one team mate in two cycles";
      previousCycle = cycle;
    }
  }
  for (int unum = 1; unum <= 11; ++unum) EXPECT_NEAR(spoken[unum], rounds, 1) << unum;
}

TEST(Radio, SaysNothingOfABallThatIsNotKnown) {
  Radio radio;
  world::WorldState world = stateOf(4);
  world.ball.known = false;
  int said = 0;
  for (int cycle = 0; cycle < 30; ++cycle) {
    world.time = 7.0 + 0.02 * cycle;
    const auto say = radio.update(world, {2.0, std::nullopt});
    if (!say) continue;
    ++said;
    const auto heard = protocol::decodeSay(say->view(), "Nonet");
    ASSERT_TRUE(heard.has_value());
    EXPECT_FALSE(heard->ball.has_value());
    EXPECT_FALSE(heard->timeToBall.has_value());
  }
  EXPECT_GT(said, 0);
}

/// Sees an opponent here, just now.
void seeOpponent(world::WorldState& world, int unum, const Vector2& place) {
  world::PlayerState& player = world.opponents[static_cast<std::size_t>(unum)];
  player.known = true;
  player.X_FP = Pose2(place, 0.0);
  player.lastSighted = player.lastSeen = world.time;
}

/// All that one says in its own turns.
std::vector<protocol::SayMessage> said(Radio& radio, world::WorldState& world, double seconds,
                                       const std::function<void(world::WorldState&)>& look) {
  std::vector<protocol::SayMessage> messages;
  for (double end = world.time + seconds; world.time < end; world.time += 0.02) {
    look(world);
    if (const auto say = radio.update(world, {})) messages.push_back(*protocol::decodeSay(*say, "Nonet"));
  }
  return messages;
}

TEST(Radio, TellsOfTheNearestOpponentsEverySecondTime) {
  Radio radio;
  world::WorldState world = stateOf(4);
  world.time = 50.0;
  world.ball.p_RB = Vector2(5.0, 0.0);
  const auto messages = said(radio, world, 4.4, [](world::WorldState& w) {
    seeOpponent(w, 2, Vector2(9.0, 0.0));
    seeOpponent(w, 5, Vector2(3.0, 0.0));
    seeOpponent(w, 8, Vector2(2.0, 0.0));
  });
  ASSERT_GE(messages.size(), 9U);
  for (std::size_t i = 1; i < messages.size(); ++i) {
    EXPECT_NE(messages[i].kind, messages[i - 1].kind);
    if (messages[i].kind != protocol::SayKind::Sightings) continue;
    EXPECT_EQ(messages[i].sightings[0].unum, 8);
    EXPECT_EQ(messages[i].sightings[1].unum, 5);
    EXPECT_LT((messages[i].sightings[0].p_FP - Vector2(2.0, 0.0)).norm(), 0.09);
  }
}

TEST(Radio, KeepsToStatusNearTheBallAndOfWhatOthersTold) {
  Radio radio;
  world::WorldState world = stateOf(4);
  world.time = 50.0;
  const auto near = said(radio, world, 2.0, [](world::WorldState& w) {
    w.ball.p_RB = Vector2(1.0, 0.0);
    seeOpponent(w, 8, Vector2(2.0, 0.0));
  });
  const auto told = said(radio, world, 2.0, [](world::WorldState& w) {
    w.ball.p_RB = Vector2(5.0, 0.0);
    seeOpponent(w, 8, Vector2(2.0, 0.0));
    w.opponents[8].lastTold = w.time - 0.5;
  });
  const auto old = said(radio, world, 2.0, [](world::WorldState& w) {
    seeOpponent(w, 8, Vector2(2.0, 0.0));
    w.opponents[8].lastTold = world::kNever;
    w.opponents[8].lastSighted = w.time - 0.4;
  });
  for (const auto& messages : {near, told, old}) {
    ASSERT_GE(messages.size(), 4U);
    for (const protocol::SayMessage& message : messages) EXPECT_EQ(message.kind, protocol::SayKind::Status);
  }
}

/// What one listener takes (server facts 1.7): capacity 2, a message costs 2, a cycle gives 1. Of two
/// messages in a cycle the first counts; who that is follows from the senders' addresses, here from a fixed
/// order.
class Listener {
 public:
  bool takes() {
    if (capacity_ < 2) return false;
    capacity_ -= 2;
    return true;
  }
  void cycle() { capacity_ = std::min(2, capacity_ + 1); }

 private:
  int capacity_ = 2;
};

struct PassDelay {
  double mean = 0.0;
  double longest = 0.0;
  double inTime = 0.0;  // share heard passLead before the kick
  int lost = 0;         // messages of others that were not heard
};

/// A pass is decided at any moment of a round, `lead` before the kick: how long until a mate hears of it?
PassDelay passDelay(int players, double lead, int announcer) {
  PassDelay delay;
  const int trials = 22;
  int inTime = 0;
  for (int start = 0; start < trials; ++start) {
    std::vector<Radio> radios(12);
    Listener listener;
    const double decided = 200.0 + 0.02 * start;
    double heardAt = 0.0;
    std::vector<double> last(12, world::kNever);
    for (double time = 198.0; time < decided + lead && heardAt == 0.0; time += 0.02) {
      // From the last address to the first: the announcer loses against those that come before it.
      for (int unum = players; unum >= 1; --unum) {
        world::WorldState world = stateOf(unum);
        world.time = time;
        for (int other = 1; other <= 11; ++other) world.radio[other].time = last[other];
        for (int other = 1; other <= players; ++other) world.radio[other].time = time - 0.3;
        Tidings tidings;
        if (unum == announcer && time >= decided - 1e-9)
          tidings.pass = PassAnnouncement{3, Vector2(5.0, 0.0), decided + lead, decided + lead + 1.0};
        const auto say = radios[unum].update(world, tidings);
        if (!say) continue;
        const bool taken = listener.takes();
        const bool pass = protocol::decodeSay(*say, "Nonet")->kind == protocol::SayKind::Pass;
        if (taken && pass) heardAt = time + 0.04;  // two messages after the one that was replied to
        if (!taken && !pass) ++delay.lost;
      }
      listener.cycle();
    }
    const double wait = heardAt > 0.0 ? heardAt - decided : lead;
    delay.mean += wait / trials;
    delay.longest = std::max(delay.longest, wait);
    inTime += heardAt > 0.0 && heardAt <= decided + lead - 0.5 + 0.041 ? 1 : 0;
  }
  delay.inTime = static_cast<double>(inTime) / trials;
  return delay;
}

// The wait of the turn alone is up to 0.44 s, 0.22 s in the mean, and 0.04 s on the way.
TEST(Radio, APassIsHeardHalfASecondBeforeTheKick) {
  for (int announcer = 2; announcer <= 9; ++announcer) {
    // Nine players: two turns are free. The next kick begins about a second before the contact.
    const PassDelay nine = passDelay(9, 1.0, announcer);
    EXPECT_EQ(nine.inTime, 1.0) << announcer;
    EXPECT_LE(nine.longest, 0.04 + 0.36) << announcer;
    EXPECT_EQ(nine.lost, 0) << announcer;
    EXPECT_LE(nine.mean, 0.21) << announcer;
    const PassDelay eleven = passDelay(11, 1.0, announcer);
    EXPECT_EQ(eleven.inTime, 1.0) << announcer;
    EXPECT_LE(eleven.longest, 0.04 + 0.44 + 1e-9) << announcer;
  }
}

// Decided too late for the own turn: spoken in the turns of others. Whoever has the last address is heard
// there only if a turn is free.
TEST(Radio, AnUrgentPassIsToldInTheNextTurn) {
  const PassDelay first = passDelay(11, 0.6, 11);  // speaks first in each cycle
  EXPECT_EQ(first.inTime, 1.0);
  EXPECT_LE(first.longest, 0.04 + 0.1 + 1e-9);  // what is left of the 0.6 s is waited for the own turn
  EXPECT_LE(first.mean, 0.07);
  const PassDelay last = passDelay(11, 0.6, 2);
  EXPECT_LE(last.longest, 0.04 + 0.44 + 1e-9);
  EXPECT_LT(last.inTime, 1.0);
}

// The price of it: while the pass is urgent, of each turn one of two messages is heard; not more is lost.
TEST(Radio, APassNeverSpeaksInTheSecondCycleOfATurn) {
  Radio radio;
  world::WorldState world = stateOf(4);
  int said = 0;
  for (int cycle = 0; cycle < 44; ++cycle) {
    world.time = 100.0 + 0.02 * cycle;
    for (world::RadioReport& report : world.radio) report.time = world.time - 0.2;
    Tidings tidings;
    tidings.pass = PassAnnouncement{3, Vector2(5.0, 0.0), 100.9, 102.0};
    if (!radio.update(world, tidings)) continue;
    ++said;
    EXPECT_NE(protocol::saySlot(world.time), protocol::saySlot(world.time - 0.02));
  }
  EXPECT_GE(said, 2);
  EXPECT_LE(said, 4);
}

}  // namespace
}  // namespace nonet::team
