#include "nonet/agent/session.h"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/protocol/say_codec.h"

namespace nonet::agent {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

SessionSettings settings(bool sync = true) {
  AgentChoice choice;
  choice.unum = 5;
  choice.team = "Test";
  choice.robotType = 1;
  return {makeAgentSettings(choice, NONET_SOURCE_DIR), sync};
}

std::string messageAt(double time, const std::string& status = "") {
  char clock[32];
  std::snprintf(clock, sizeof clock, "%.2f", time);
  return "(time (now " + std::string(clock) + "))(GS " + status +
         "(sl 0) (sr 0) (t 0.00) (pm BeforeKickOff))" +
         "(GYR (n torso) (rt 0.00 0.00 0.00))(ACC (n torso) (a 0.00 0.00 9.81))(HJ (n hj1) (ax 0.00))";
}
std::string message(int cycle, const std::string& status = "") {
  return messageAt(3.0 + 0.02 * cycle, status);
}
const std::string kAccepted = "(unum 5) (team right) ";

TEST(Session, FollowsTheHandshake) {
  Session session(settings());
  EXPECT_EQ(session.begin(), "(scene rsg/agent/nao/nao_hetero.rsg 1)(syn)");
  EXPECT_EQ(session.stage(), Session::Stage::Connecting);
  EXPECT_EQ(session.answer(), "") << "no message, no answer";
  session.receive(message(0));
  EXPECT_EQ(session.stage(), Session::Stage::Introducing);
  EXPECT_THAT(std::string(session.answer()), StartsWith("(init (unum 5)(teamname Test))"));
  EXPECT_EQ(session.answer(), "") << "one answer per message";
  session.receive(message(1));
  session.answer();
  session.receive(message(2, kAccepted));
  EXPECT_EQ(session.stage(), Session::Stage::Playing);
  EXPECT_EQ(session.counts().messages, 3);
  EXPECT_EQ(session.counts().passedOver, 0);
  EXPECT_EQ(session.counts().lostCycles, 0);
}

TEST(Session, LeavesSynAwayWhenTold) {
  Session session(settings(false));
  EXPECT_THAT(std::string(session.begin()), Not(HasSubstr("syn")));
  session.receive(message(0));
  EXPECT_THAT(std::string(session.answer()), Not(HasSubstr("syn")));
}

TEST(Session, CountsGapsInTheServersTime) {
  Session session(settings());
  session.begin();
  for (const int cycle : {0, 1, 2, 5, 6, 10}) session.receive(message(cycle));
  EXPECT_EQ(session.counts().lostCycles, 2 + 3);
}

// The server's clock is a 32-bit sum of steps, printed with two decimals.
TEST(Session, DoesNotTakeRoundingForAGap) {
  for (const bool gap : {false, true}) {
    Session session(settings());
    session.begin();
    float time = 78.70F;
    for (int cycle = 0; cycle < 3000; ++cycle) {
      time += 0.02F;
      if (gap && cycle % 100 == 99) continue;
      char text[64];
      std::snprintf(text, sizeof text, "(time (now %.2f))", static_cast<double>(time) + 0.004999);
      session.receive(text);
      session.answer();
    }
    EXPECT_EQ(session.counts().lostCycles, gap ? 29 : 0);
  }
}

TEST(Session, KeepsInitWhenItsMessageIsPassedOver) {
  Session session(settings());
  session.begin();
  session.receive(message(0));
  session.receive(message(1));
  const std::string answer(session.answer());
  EXPECT_THAT(answer, StartsWith("(init "));
  EXPECT_THAT(answer, EndsWith("(syn)"));
  EXPECT_EQ(session.counts().passedOver, 1);
  EXPECT_EQ(session.counts().answers, 1);
}

TEST(Session, KeepsTheBeamOfAPassedOverMessage) {
  // Two equal agents; one answers the message in which it wants to be beamed, the other one message later.
  Session prompt(settings());
  Session late(settings());
  std::string prompted;
  int beamCycle = -1;
  for (int cycle = 0; cycle < 20 && beamCycle < 0; ++cycle) {
    prompt.receive(message(cycle, cycle == 2 ? kAccepted : ""));
    prompted = prompt.answer();
    if (prompted.find("(beam ") != std::string::npos) beamCycle = cycle;
  }
  ASSERT_GE(beamCycle, 0) << "the agent takes its place before kick-off";
  for (int cycle = 0; cycle < beamCycle; ++cycle) {
    late.receive(message(cycle, cycle == 2 ? kAccepted : ""));
    late.answer();
  }
  late.receive(message(beamCycle, beamCycle == 2 ? kAccepted : ""));
  late.receive(message(beamCycle + 1));
  EXPECT_THAT(std::string(late.answer()), HasSubstr("(beam "));
}

// A team mate hears one of us in two cycles: who speaks in another's turn takes the turn from him.
TEST(Session, SaysNothingOfAPassedOverMessageInTheTurnOfAnother) {
  int said = 0;
  for (int cycle = 2; cycle < 60; ++cycle) {
    // Answers all messages up to this one, which it passes over for the next one or for the one after that.
    for (const int more : {1, 2}) {
      Session prompt(settings()), late(settings());
      std::string answer;
      for (int i = 0; i <= cycle; ++i) {
        for (Session* session : {&prompt, &late}) session->receive(message(i, i == 1 ? kAccepted : ""));
        answer = prompt.answer();
        if (i < cycle) late.answer();
      }
      if (answer.find("(say ") == std::string::npos) continue;
      ++said;
      for (int i = 1; i <= more; ++i) late.receive(message(cycle + i));
      const bool ownTurn = protocol::saySlot(3.0 + 0.02 * (cycle + more)) == 5;
      EXPECT_EQ(ownTurn, more == 1) << "a turn has two cycles";
      EXPECT_EQ(late.answer().find("(say ") != std::string_view::npos, ownTurn) << cycle << " " << more;
    }
  }
  EXPECT_GE(said, 4);
}

// Oracle: an agent that gets every message once.
TEST(Session, AMessageThatComesTwiceMovesNothing) {
  Session once(settings()), twice(settings());
  std::string repeated;
  for (Session* session : {&once, &twice}) session->begin();
  for (int i = 0; i < 40; ++i) {
    const std::string text = message(i, i == 1 ? kAccepted : "");
    once.receive(text);
    twice.receive(text);
    ASSERT_EQ(once.answer(), twice.answer()) << i;
    twice.receive(text);
    repeated = twice.answer();
    EXPECT_THAT(repeated, Not(HasSubstr("(beam"))) << i;
    EXPECT_THAT(repeated, Not(HasSubstr("(init"))) << i;
  }
  EXPECT_THAT(repeated, HasSubstr("(he1 "));
}

TEST(Session, TellsARefusal) {
  Session session(settings());
  session.begin();
  for (int cycle = 0; cycle <= Session::kRefusalPatience; ++cycle) {
    session.receive(message(cycle));
    session.answer();
    ASSERT_EQ(session.stage(), Session::Stage::Introducing);
  }
  session.receive(message(Session::kRefusalPatience + 1));
  EXPECT_EQ(session.stage(), Session::Stage::Refused);
}

// A process that slept for a second finds all messages at once: the server has refused nobody, since nobody
// has introduced himself.
TEST(Session, WhoHasNotAnsweredYetIsNotRefused) {
  Session session(settings());
  session.begin();
  int cycle = 0;
  for (; cycle < 2 * Session::kRefusalPatience; ++cycle) session.receive(message(cycle));
  EXPECT_EQ(session.stage(), Session::Stage::Introducing);
  EXPECT_THAT(std::string(session.answer()), HasSubstr("(init "));
  session.receive(message(cycle++));
  session.receive(message(cycle++, kAccepted));
  EXPECT_EQ(session.stage(), Session::Stage::Playing);
}

// The own number is an index of many tables; the server says it once.
TEST(Session, SurvivesNumbersThatNoPlayerHas) {
  for (const char* number :
       {"0", "-1", "12", "99", "2147483647", "-2147483648", "99999999999", "nan", "1e9"}) {
    Session session(settings());
    session.begin();
    const std::string status =
        "(unum " + std::string(number) + ") (team left) (sl 2147483647) (sr -2147483648) ";
    for (int cycle = 0; cycle < 120; ++cycle) {
      std::string text = message(cycle, cycle > 1 ? status : "");
      if (cycle > 20) text.replace(text.find("BeforeKickOff"), 13, cycle > 60 ? "PlayOn" : "KickOff_Left");
      text +=
          "(See (G1R (pol 15.00 4.00 -1.00)) (G2R (pol 15.10 -4.00 -1.00)) (F1R (pol 18.00 33.00 -2.00)) "
          "(B (pol 2.00 0.00 -14.00)) (P (team Test) (id " +
          std::string(number) + ") (head (pol 3.00 9.00 0.00))))";
      session.receive(text);
      EXPECT_THAT(std::string(session.answer()), EndsWith("(syn)")) << number;
      ASSERT_EQ(session.agent().world().game.unum, 0) << number;
    }
    EXPECT_GE(session.counts().unknownTokens, 118) << number;
  }
}

// A server that has run for six days: its time, a 32-bit sum, does not grow any more.
TEST(Session, PlaysOnWhereTheServersTimeStandsStill) {
  Session session(settings());
  session.begin();
  std::set<int> slots;
  for (int cycle = 0; cycle < 200; ++cycle) {
    session.receive(messageAt(cycle < 50 ? 524286.71875 + 0.03125 * std::min(cycle, 41) : 524288.0,
                              cycle == 1 ? kAccepted : ""));
    session.answer();
    slots.insert(protocol::saySlot(session.percept().time));
    ASSERT_EQ(session.timeStands(), cycle >= 41) << cycle;
  }
  EXPECT_EQ(session.counts().lostCycles, 0);
  EXPECT_EQ(slots.size(), 11U);
  EXPECT_NEAR(session.agent().world().time, 524288.0 + 0.02 * (199 - 41), 1e-6);
}

TEST(Session, SurvivesAnything) {
  Session session(settings());
  session.begin();
  for (const std::string& text :
       {std::string(")))((("), std::string("\0\1\2", 3), std::string("(time (now nan))"),
        std::string("(See (B (pol 1 2"), std::string(5000, '(')}) {
    session.receive(text);
    EXPECT_THAT(std::string(session.answer()), EndsWith("(syn)"));
  }
  EXPECT_GT(session.counts().unknownTokens, 0);
}

// Comments of a log come from outside.
TEST(AgentSetup, AStartIsThreeNumbersOrNone) {
  const Pose2 start(-3.5, 2.0, 0.5);
  const auto read = startFromComment(startComment(start));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->translation, start.translation);
  EXPECT_EQ(read->rotation, start.rotation);
  for (const std::string_view text :
       {"start [\"a\", 1, 2]", "start [1, 2, null]", "start [1, 2]", "start {}", "start [1, 2,", "stop"})
    EXPECT_FALSE(startFromComment(text)) << text;
}

}  // namespace
}  // namespace nonet::agent
