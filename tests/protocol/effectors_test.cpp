#include "nonet/protocol/effectors.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "nonet/math/angle.h"
#include "nonet/math/random.h"
#include "nonet/protocol/play_mode.h"

#include "round_trip_properties.h"

namespace nonet::protocol {
namespace {

using model::JointId;

Effectors parsed(std::string_view text, int skipped = 0) {
  Effectors effectors;
  EXPECT_EQ(parseEffectors(text, effectors), skipped) << text;
  return effectors;
}

TEST(Effectors, WritesTheServersForms) {
  Effectors effectors;
  std::string text = "old";
  writeEffectors(effectors, text);
  EXPECT_EQ(text, "");
  effectors.scene = SceneEffector{3, {}};
  effectors.init = InitEffector{7, TeamName("Nonet")};
  effectors.beam = Pose2(-0.5, 7.0, toRadians(-90.0));
  effectors.setSpeed(JointId::LLeg7, -1.5);
  effectors.setSpeed(JointId::Head1, 1.0 / 3.0);
  effectors.say = std::string_view("abc");
  effectors.pass = true;
  effectors.syn = true;
  writeEffectors(effectors, text);
  EXPECT_EQ(text,
            "(scene rsg/agent/nao/nao_hetero.rsg 3)(init (unum 7)(teamname Nonet))(beam -0.5 7 -90)"
            "(he1 0.333333)(lle7 -1.5)(say abc)(pass)(syn)");
  Effectors again = parsed(text);
  roundAsWritten(effectors);
  EXPECT_EQ(difference(effectors, again), "");
}

TEST(Effectors, RandomOnesReadBackAsRounded) {
  Random random(5);
  std::string text;
  for (int i = 0; i < 5000; ++i) {
    Effectors effectors;
    for (std::size_t joint = 0; joint < model::kJointCount; ++joint) {
      if (random.below(3) != 0) {
        effectors.setSpeed(model::jointAt(joint),
                           random.normal() * std::pow(10.0, random.uniform(-8.0, 2.0)));
      }
    }
    if (random.below(4) == 0) {
      effectors.beam =
          Pose2(random.uniform(-15.0, 0.0), random.uniform(-10.0, 10.0), random.uniform(-kPi, kPi));
    }
    effectors.syn = random.below(2) == 0;
    writeEffectors(effectors, text);
    const Effectors again = parsed(text);
    roundAsWritten(effectors);
    ASSERT_EQ(difference(effectors, again), "") << text;
  }
}

TEST(Effectors, SceneForms) {
  const Effectors plain = parsed("(scene rsg/agent/nao/nao.rsg)(syn)");
  EXPECT_EQ(plain.scene->file, "rsg/agent/nao/nao.rsg");
  EXPECT_EQ(plain.scene->robotType, 0);
  const Effectors typed = parsed("(scene rsg/agent/nao/nao_hetero.rsg 4)");
  EXPECT_TRUE(typed.scene->file.empty());
  EXPECT_EQ(typed.scene->robotType, 4);
  std::string text;
  writeEffectors(plain, text);
  EXPECT_EQ(text, "(scene rsg/agent/nao/nao.rsg)(syn)");
}

// The server's tolerance (server facts 1.7 and 1.8).
TEST(Effectors, ReadsAsTheServerReads) {
  EXPECT_EQ(parsed("(he1 1.0 2.0)").speeds[0], 1.0);
  EXPECT_EQ(parsed("(he1 1.0)(he1 2.0)").speeds[0], 2.0);
  EXPECT_EQ(parsed("(he1 1.5abc)(he2 +2)").speeds[0], 1.5);
  EXPECT_EQ(parsed("(he2 +2)").speeds[1], 2.0);
  EXPECT_TRUE(parsed("(he1 abc)").hasSpeed(JointId::Head1));
  EXPECT_EQ(parsed("(he1 abc)").speeds[0], 0.0);
  EXPECT_FALSE(parsed("(he1)", 1).hasSpeed(JointId::Head1));
  EXPECT_FALSE(parsed("((he1 2))", 1).hasSpeed(JointId::Head1));
  EXPECT_TRUE(parsed("he1 2 (syn) junk", 3).syn);
  EXPECT_TRUE(parsed("(dance 1)(syn)", 1).syn);
  EXPECT_EQ(parsed("(he1 1)(he1 2", 1).speeds[0], 1.0);  // incomplete: dropped
  EXPECT_TRUE(parsed("; (he1 3)\n(syn) ; end").syn);
  EXPECT_FALSE(parsed("; (he1 3)\n(syn)").hasSpeed(JointId::Head1));
  EXPECT_TRUE(parsed(")(syn)", 1).syn);
}

TEST(Effectors, Beam) {
  EXPECT_FALSE(parsed("(beam 1 2)", 1).beam);
  EXPECT_FALSE(parsed("(beam nan 2 0)", 1).beam);
  EXPECT_FALSE(parsed("(beam 1 inf 0)", 1).beam);
  const Effectors effectors = parsed("(beam -1.5 2 90)");
  ASSERT_TRUE(effectors.beam);
  EXPECT_EQ(effectors.beam->translation, Vector2(-1.5, 2.0));
  EXPECT_EQ(effectors.beam->rotation, toRadians(90.0));
}

TEST(Effectors, Init) {
  const Effectors swapped = parsed("(init (teamname Red)(unum 4))");
  EXPECT_EQ(swapped.init->unum, 4);
  EXPECT_EQ(swapped.init->team, "Red");
  EXPECT_EQ(parsed("(init (teamname Red))").init->unum, 0);
  const std::string longest(64, 'R');
  EXPECT_EQ(parsed("(init (unum 4)(teamname " + longest + "))").init->team, longest);
  EXPECT_EQ(parsed("(init (unum 4)(teamname " + longest + "R))", 1).init->team, "")
      << "not another team's name";
  EXPECT_EQ(parsed("(init (unum x)(teamname Red))").init->unum, 0);
  EXPECT_EQ(parsed("(init (teamname Red)(color blue))", 1).init->team, "Red");
}

TEST(Effectors, Say) {
  EXPECT_EQ(*parsed("(say x y)").say, "x");
  EXPECT_EQ(*parsed("(say a%b&c!'x)").say, "a%b&c!");
  EXPECT_EQ(*parsed("(say 12345678901234567890)").say, "12345678901234567890");
  EXPECT_FALSE(parsed("(say 123456789012345678901)", 1).say);
  EXPECT_FALSE(parsed("(say \"a b\")", 1).say);
  EXPECT_FALSE(parsed("(say \"a)b\")", 1).say);
  EXPECT_FALSE(parsed("(say )", 1).say);
  EXPECT_FALSE(parsed("(say \xC3\xA4)", 1).say);
  EXPECT_FALSE(isSayable(""));
}

// Server facts 1.7: others hear the first, who speaks hears the last.
TEST(Effectors, OfSeveralSaysTheFirstAndTheLastAreKept) {
  EXPECT_FALSE(parsed("(say a)").firstSay);
  EXPECT_FALSE(parsed("(say 123456789012345678901)(say b)", 1).firstSay);
  const Effectors several = parsed("(say a)(say b)(say c)");
  ASSERT_TRUE(several.firstSay && several.say);
  EXPECT_EQ(*several.firstSay, "a");
  EXPECT_EQ(*several.say, "c");
  std::string text;
  writeEffectors(several, text);
  EXPECT_EQ(text, "(say a)(say c)");
}

TEST(Effectors, TeamNames) {
  for (const char* good : {"", "Nonet", "A-B_c!", "9"}) EXPECT_TRUE(isTeamName(good)) << good;
  for (const char* bad : {"A B", "A(", ")A", "\"A\"", "A'", "A\n", "\x7f", "\xC3\xA4"}) {
    EXPECT_FALSE(isTeamName(bad)) << bad;
  }
}

TEST(Names, JointsAndModesMapBack) {
  for (std::size_t i = 0; i < model::kJointCount; ++i) {
    const JointId joint = model::jointAt(i);
    EXPECT_EQ(model::jointFromPerceptorName(model::perceptorName(joint)), joint);
    EXPECT_EQ(model::jointFromEffectorName(model::effectorName(joint)), joint);
    EXPECT_EQ(model::mirrored(model::mirrored(joint)), joint);
    // The mirror image has the same name but for the side.
    const std::string_view name = model::perceptorName(joint);
    const std::string_view image = model::perceptorName(model::mirrored(joint));
    EXPECT_EQ(name.substr(1), image.substr(1));
    EXPECT_EQ(name[0] == 'h', name == image);
  }
  for (const std::string_view name :
       {"", "h", "hj0", "hj3", "he1", "raj0", "raj5", "laj5", "rlj8", "xaj1", "rxj1", "raj12", "rae1"}) {
    EXPECT_FALSE(model::jointFromPerceptorName(name)) << name;
  }
  for (int i = 0; i < kPlayModeCount; ++i) {
    const auto mode = static_cast<PlayMode>(i);
    EXPECT_EQ(playModeFromName(playModeName(mode)), mode);
  }
  EXPECT_FALSE(playModeFromName("unknown"));
  EXPECT_EQ(playModeName(PlayMode::Unknown), "unknown");
  // Spot checks against the server's table of indices (server facts 1.11).
  EXPECT_EQ(playModeName(static_cast<PlayMode>(12)), "GameOver");
  EXPECT_EQ(playModeName(static_cast<PlayMode>(20)), "pass_right");
}

}  // namespace
}  // namespace nonet::protocol
