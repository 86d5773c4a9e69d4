// Charging: server facts 4.10, one scenario per rule.
#include <algorithm>

#include <gtest/gtest.h>

#include "sim/scenario.h"

namespace nonet::sim::test {
namespace {

// Left 5 and right 6, and a way to make a robot run: by default 5 runs into 6.
struct Charge : Field {
  explicit Charge(const Settings& settings = quietSettings()) : Field(settings) {
    charger = add(TeamSide::Left, 5);
    victim = add(TeamSide::Right, 6);
  }
  /// Half a metre apart, face to face, the ball far away, no moves by the referee in the last second.
  void start(double ballX = 0.0, double ballY = 8.0) {
    place(charger, -0.5, 0.0);
    place(victim, 0.0, 0.0, 180.0);
    play(ballX, ballY);
    seconds(1.2);
  }
  void run(double ballX, double ballY) {
    start(ballX, ballY);
    for (int i = 0; i < 40 && sim.fouls().empty(); ++i) {
      push(charger, 1.0);
      step();
    }
  }
  /// Along x, as if it walked at this speed.
  void push(AgentHandle agent, double speed) {
    const AgentInfo who = info(agent);
    for (const model::BodySpec& body : model::robotModel(who.robotType).bodies()) {
      World::BodyState state = sim.world().bodyState(who.robot, body.id);
      state.velocity = Eigen::Vector3d(speed, 0.0, 0.0);
      state.angularVelocity.setZero();
      sim.world().setBodyState(who.robot, body.id, state);
    }
    sim.world().setAsleep(who.robot, false);
  }
  bool inContact() const {
    const auto isRobot = [](const ContactParty& party) { return party.kind == ContactParty::Kind::Robot; };
    const auto contacts = sim.world().contacts();
    return std::any_of(contacts.begin(), contacts.end(), [&](const ContactPair& pair) {
      return isRobot(pair.first) && isRobot(pair.second) && pair.first.robot != pair.second.robot;
    });
  }
  /// Runs until the first contact and two cycles longer. The cycles it took.
  int chargeOnce(AgentHandle agent, double speed) {
    int cycles = 0;
    for (int contacts = 0; contacts < 3 && cycles < 40; ++cycles) {
      push(agent, speed);
      step();
      contacts += inContact() ? 1 : 0;
    }
    EXPECT_LT(cycles, 40) << "the scene is wrong";
    return cycles;
  }
  /// Both come so slowly into contact that it is nobody's fault, and stay there.
  void meet() {
    int cycles = 0;
    for (; !inContact() && cycles < 200; ++cycles) {
      place(charger, -0.5 + 0.002 * cycles, 0.0);
      place(victim, 0.0, 0.0, 180.0);
      step();
    }
    EXPECT_LT(cycles, 200) << "the scene is wrong";
  }

  AgentHandle charger, victim;
};

TEST(Charging, RunningIntoAnOpponentAwayFromTheBallIsAFoul) {
  Charge c;
  c.run(0.0, 8.0);
  ASSERT_GT(c.countFouls(FoulType::Charging), 0);
  EXPECT_EQ(c.sim.fouls()[0].side, TeamSide::Left);
  EXPECT_EQ(c.sim.fouls()[0].unum, 5);
}

// Before kick-off the robots touch; afterwards number 5, now far away, runs. The rule looks at the contact
// only then. With `replaced`, number 5 has left before, and the one that runs is a newcomer.
int foulsAfterContactInPause(bool replaced) {
  Settings settings = quietSettings();
  settings.startAnyFieldPosition = true;  // the referee moves nobody
  Charge c(settings);
  c.place(c.charger, -5.5, 4.0);
  c.place(c.victim, -5.0, 4.0, 180.0);
  c.chargeOnce(c.charger, 1.0);
  if (replaced) {
    c.sim.disconnect(c.charger);
    c.step();
    c.charger = c.add(TeamSide::Left, 5);
  }
  c.place(c.charger, -8.0, 4.0);
  c.place(c.victim, -5.0, 4.0, 180.0);
  for (int i = 0; i < 6; ++i) {
    if (i == 4) c.setMode(PlayMode::PlayOn);
    c.push(c.charger, 1.0);
    c.step();
  }
  return c.countFouls(FoulType::Charging);
}

TEST(Charging, ContactsOfAPlayerWhoHasLeftAreForgotten) {
  EXPECT_GT(foulsAfterContactInPause(false), 0) << "the scene is wrong";
  EXPECT_EQ(foulsAfterContactInPause(true), 0);
}

TEST(Charging, CanBeSwitchedOff) {
  Settings settings = quietSettings();
  settings.useCharging = false;
  Charge c(settings);
  c.run(0.0, 8.0);
  EXPECT_EQ(c.countFouls(FoulType::Charging), 0);
}

TEST(Charging, AContactAtTheBallIsNone) {
  Charge c;
  c.place(c.charger, -0.5, 0.0);
  c.place(c.victim, 0.0, 0.0, 180.0);
  c.play(0.0, 8.0);
  c.seconds(1.2);
  for (int i = 0; i < 40; ++i) {
    c.push(c.charger, 1.0);
    // Above the robots: only the horizontal distance counts, and nobody touches it.
    c.placeBall(0.5 * (c.torso(c.charger).x() + c.torso(c.victim).x()), 0.0, 0.9);
    c.step();
  }
  EXPECT_EQ(c.countFouls(FoulType::Charging), 0);
}

TEST(Charging, WhoIsFartherFromTheBallRunsIntoASlowOpponent) {
  Charge c;
  c.run(0.5, 0.0);
  EXPECT_GT(c.countFouls(FoulType::Charging), 0);
}

TEST(Charging, ASlowTouchIsNone) {
  Settings settings = quietSettings();
  settings.chargingMinSpeed = 1.5;
  Charge c(settings);
  c.run(0.0, 8.0);
  EXPECT_EQ(c.countFouls(FoulType::Charging), 0);
}

TEST(Charging, WhoHasJustTouchedTheBallIsImmune) {
  Charge c;
  c.place(c.charger, -0.5, 0.0);
  c.place(c.victim, 0.0, 0.0, 180.0);
  c.play(0.0, 8.0);
  c.seconds(1.2);
  c.touch(c.charger);
  c.step();
  c.placeBall(0.0, 8.0);
  for (int i = 0; i < 40; ++i) {
    c.push(c.charger, 1.0);
    c.step();
  }
  EXPECT_EQ(c.countFouls(FoulType::Charging), 0);
}

TEST(Charging, TheGoalkeeperInItsAreaMay) {
  Charge c;
  const AgentHandle goalie = c.add(TeamSide::Left, 1);
  c.charger = goalie;
  c.place(goalie, -14.3, 0.0);
  c.place(c.victim, -13.8, 0.0, 180.0);
  c.play(0.0, 8.0);
  c.seconds(1.2);
  for (int i = 0; i < 40; ++i) {
    c.push(c.charger, 1.0);
    c.step();
  }
  EXPECT_EQ(c.countFouls(FoulType::Charging), 0);
}

TEST(Charging, NotWithinASecondAfterAMoveByTheReferee) {
  Charge c;
  c.place(c.charger, -0.5, 0.0);
  c.place(c.victim, 0.0, 0.0, 180.0);
  c.play(0.0, 8.0);
  c.seconds(1.2);
  // A drop ball on the spot moves both away and marks them.
  c.placeBall(-0.25, 0.0);
  c.command("(dropBall)");
  c.step();
  c.place(c.charger, -0.5, 0.0);
  c.place(c.victim, 0.0, 0.0, 180.0);
  c.placeBall(0.0, 8.0);
  for (int i = 0; i < 40; ++i) {
    c.push(c.charger, 1.0);
    c.step();
  }
  EXPECT_EQ(c.countFouls(FoulType::Charging), 0);
}

TEST(Charging, ThePlayerIsRemoved) {
  Charge c;
  c.run(0.0, 8.0);
  ASSERT_GT(c.countFouls(FoulType::Charging), 0);
  c.step(26);
  EXPECT_EQ(c.countFouls(FoulType::Charging), 26);
  EXPECT_NEAR(c.torso(c.charger).x(), -0.6 * 2, 1e-3);
  EXPECT_NEAR(c.torso(c.charger).y(), -10.5, 1e-3);
}

// Both at fault (server facts 4.10, charging, 4): each runs into the other.
TEST(Charging, WithBothAtFaultIsNone) {
  for (const bool both : {true, false}) {
    Charge c;
    c.start();
    c.place(c.charger, -0.6, 0.0);
    for (int i = 0; i < 60; ++i) {
      c.push(c.charger, 1.0);
      if (both) c.push(c.victim, -1.0);
      c.step();
    }
    EXPECT_EQ(c.countFouls(FoulType::Charging) == 0, both);
  }
}

TEST(Charging, NotWhileOneOfThemIsNotStanding) {
  for (const bool down : {true, false}) {
    Charge c;
    c.start();
    if (down) {
      c.sink(c.victim, 0.2);
      c.step();
      c.place(c.victim, 0.0, 0.0, 180.0);
    }
    for (int i = 0; i < 22; ++i) {  // standing for 25 cycles clears the count
      c.push(c.charger, 1.0);
      c.step();
    }
    EXPECT_EQ(c.countFouls(FoulType::Charging) == 0, down);
  }
}

TEST(Charging, WithoutClosingSpeedIsNone) {
  Settings settings = quietSettings();
  settings.chargingMinCollisionSpeed = 1.5;
  Charge c(settings);
  c.run(0.0, 8.0);
  EXPECT_EQ(c.countFouls(FoulType::Charging), 0);
}

// Within a metre of the ball it matters who goes for it: the ball hovers before the charger or beside it.
TEST(Charging, NearTheBallWhoGoesForItIsNotGuilty) {
  for (const bool ahead : {true, false}) {
    Charge c;
    c.start();
    for (int i = 0; i < 40; ++i) {
      c.push(c.charger, 1.0);
      const Vector3f at = c.torso(c.charger);
      c.placeBall(at.x() + (ahead ? 0.06 : 0.02), ahead ? 0.0 : 0.5, 0.9);
      c.step();
    }
    EXPECT_EQ(c.countFouls(FoulType::Charging) == 0, ahead);
  }
}

TEST(Charging, RunningIntoTheBackOfWhoIsNearerTheBallIsAFoul) {
  Charge c;
  c.start();
  c.place(c.victim, 0.0, 0.0, 0.0);
  for (int i = 0; i < 50 && c.sim.fouls().empty(); ++i) {
    c.push(c.charger, 1.0);
    c.push(c.victim, 0.5);
    c.placeBall(c.torso(c.victim).x() + 0.6, 0.0, 0.9);
    c.step();
  }
  ASSERT_GT(c.countFouls(FoulType::Charging), 0);
  EXPECT_EQ(c.sim.fouls()[0].unum, 5);
}

TEST(Charging, ShoulderToShoulderTowardsTheBallIsNone) {
  Charge c;
  c.start();
  c.place(c.charger, -0.5, 0.11);
  c.place(c.victim, -0.5, -0.11);
  bool touched = false;
  for (int i = 0; i < 40; ++i) {
    c.push(c.charger, 1.0);
    c.push(c.victim, 1.0);
    c.placeBall(0.5 * (c.torso(c.charger).x() + c.torso(c.victim).x()) + 0.7, 0.0, 0.9);
    c.step();
    touched = touched || c.inContact();
  }
  EXPECT_TRUE(touched) << "the scene is wrong";
  EXPECT_EQ(c.countFouls(FoulType::Charging), 0);
}

// After a contact that was nobody's fault the timers of both start anew.
TEST(Charging, NotWithinAFifthOfASecondAfterAContactWithoutFault) {
  Charge c;
  c.start();
  c.meet();
  int cycles = 0;
  for (; cycles < 40 && c.countFouls(FoulType::Charging) == 0; ++cycles) {
    c.push(c.charger, 1.0);
    c.step();
  }
  EXPECT_GE(cycles, 10);
  EXPECT_LT(cycles, 40);
}

// The immunity of who has just touched the ball passes to whom it runs into, and ends when its own ends.
TEST(Charging, TheImmunityOfABallTouchPassesToTheVictim) {
  for (const bool charged : {true, false}) {
    Charge c;
    c.start();
    c.touch(c.charger);
    c.step();
    c.placeBall(0.0, 8.0);
    int cycles = 0;  // since the touch
    if (charged) cycles += c.chargeOnce(c.charger, 1.0);
    EXPECT_EQ(c.countFouls(FoulType::Charging), 0);
    c.place(c.charger, -0.4, 0.0);
    c.place(c.victim, 0.0, 0.0, 180.0);
    for (; cycles < 48; ++cycles) {
      c.push(c.victim, -1.0);
      c.step();
    }
    EXPECT_EQ(c.countFouls(FoulType::Charging) == 0, charged);
    c.place(c.charger, -0.4, 0.0);
    c.place(c.victim, 0.0, 0.0, 180.0);
    for (int i = 0; i < 30; ++i) {
      c.push(c.victim, -1.0);
      c.step();
    }
    EXPECT_GT(c.countFouls(FoulType::Charging), 0);
    EXPECT_EQ(c.sim.fouls()[0].unum, 6);
  }
}

TEST(Charging, TheImmunityOfTheGoalkeeperPassesToTheVictim) {
  for (const bool charged : {true, false}) {
    Charge c;
    c.charger = c.add(TeamSide::Left, 1);
    c.start();
    c.place(c.charger, -14.3, 0.0);
    c.place(c.victim, -13.9, 0.0, 180.0);
    c.step();
    if (charged) c.chargeOnce(c.charger, 1.0);
    EXPECT_EQ(c.countFouls(FoulType::Charging), 0);
    c.place(c.charger, -14.3, 0.0);
    c.place(c.victim, -13.9, 0.0, 180.0);
    for (int i = 0; i < 40; ++i) {
      c.push(c.victim, -1.0);
      c.step();
    }
    EXPECT_EQ(c.countFouls(FoulType::Charging) == 0, charged);
  }
}

// Who was just in a contact without fault may charge for a moment, and so may whom it charges.
TEST(Charging, TheTimerOfAContactPassesToTheVictim) {
  for (const bool charged : {true, false}) {
    Settings settings = quietSettings();
    settings.chargingCollisionMinTime = 2.0;
    Charge c(settings);
    const AgentHandle third = c.add(TeamSide::Right, 7);
    c.start();
    const AgentHandle victim = c.victim;
    c.place(victim, 5.0, -5.0);
    c.victim = third;
    c.seconds(2.0);
    c.meet();  // nobody's fault: the charger's timer starts anew
    c.place(third, 5.0, 5.0);
    c.victim = victim;
    c.place(c.charger, -0.4, 0.0);
    c.place(victim, 0.0, 0.0, 180.0);
    c.step();
    if (charged) c.chargeOnce(c.charger, 1.0);
    EXPECT_EQ(c.countFouls(FoulType::Charging), 0);
    c.place(c.charger, -0.4, 0.0);
    c.place(victim, 0.0, 0.0, 180.0);
    for (int i = 0; i < 30; ++i) {
      c.push(victim, -1.0);
      c.step();
    }
    EXPECT_EQ(c.countFouls(FoulType::Charging) == 0, charged);
  }
}

}  // namespace
}  // namespace nonet::sim::test
