#include "nonet/motion/skill_language.h"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "nonet/math/angle.h"
#include "nonet/math/random.h"
#include "nonet/motion/skill_library.h"

namespace nonet::motion {
namespace {

using model::JointId;
using testing::ElementsAre;
using testing::HasSubstr;

Skill parseOne(const std::string& body) {
  return parseSkills("skill test {\n" + body + "\n}\n", "test.skl").at(0);
}

std::string errorOf(const std::string& text) {
  try {
    parseSkills(text, "test.skl");
  } catch (const SkillError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SkillLanguage, JointTargetsTakeUnitsAndSides) {
  const Skill skill =
      parseOne("move over 200ms { left.knee -30deg right.elbow 0.5rad both.hipRoll 10deg head.tilt 5deg }");
  ASSERT_EQ(skill.program.size(), 2U);  // and the end
  const Instruction& move = skill.program[0];
  EXPECT_EQ(move.kind, Instruction::Kind::MoveOver);
  EXPECT_DOUBLE_EQ(move.duration.constant, 0.2);
  ASSERT_EQ(move.joints.size(), 5U);
  EXPECT_EQ(move.joints[0].joint, JointId::LLeg4);
  EXPECT_DOUBLE_EQ(move.joints[0].angle.constant, toRadians(-30.0));
  // Angles are those of the left side: the right elbow bends the other way.
  EXPECT_EQ(move.joints[1].joint, JointId::RArm4);
  EXPECT_DOUBLE_EQ(move.joints[1].angle.constant, -0.5);
  EXPECT_EQ(move.joints[2].joint, JointId::LLeg2);
  EXPECT_DOUBLE_EQ(move.joints[2].angle.constant, toRadians(10.0));
  EXPECT_EQ(move.joints[3].joint, JointId::RLeg2);
  EXPECT_DOUBLE_EQ(move.joints[3].angle.constant, toRadians(-10.0));
  // Tilt is positive downwards, the joint upwards.
  EXPECT_EQ(move.joints[4].joint, JointId::Head2);
  EXPECT_DOUBLE_EQ(move.joints[4].angle.constant, toRadians(-5.0));
}

TEST(SkillLanguage, ExpressionsUseParametersAndPrecedence) {
  const Skill skill = parseOne(
      "parameter a = 10deg in 0deg..20deg\nparameter n = 3\n"
      "move over 0.1s * n { left.knee -(a + 2deg) * n / 2 - a }");
  ASSERT_EQ(skill.parameters.size(), 2U);
  EXPECT_EQ(skill.parameters[0].unit, config::Unit::Radian);
  ASSERT_TRUE(skill.parameters[0].range.has_value());
  EXPECT_FALSE(skill.parameters[1].range.has_value());
  EXPECT_NEAR(skill.program[0].duration.constant, 0.3, 1e-12);
  EXPECT_NEAR(skill.program[0].joints[0].angle.constant, toRadians(-12.0 * 3.0 / 2.0 - 10.0), 1e-12);
}

TEST(SkillLanguage, KicksSayWhatTheyAre) {
  const Skill skill = parseOne(
      "parameter x = 0.2m kick { ball (x, -1cm) within (2cm, 3cm) for 0.4s direction 45deg distance 3m .. 8m "
      "flies "
      "1.1m at 3m within 0.3m contact 0.3s "
      "clears 0.7m within 4m low 0.3m room 0.5m from walk types 0 4 }");
  ASSERT_TRUE(skill.kick.has_value());
  EXPECT_TRUE(skill.kick->p_RBall.isApprox(Vector2(0.2, -0.01)));
  EXPECT_TRUE(skill.kick->tolerance.isApprox(Vector2(0.02, 0.03)));
  EXPECT_DOUBLE_EQ(skill.kick->steady, 0.4);
  EXPECT_DOUBLE_EQ(skill.kick->direction, toRadians(45.0));
  EXPECT_DOUBLE_EQ(skill.kick->shortest, 3.0);
  EXPECT_DOUBLE_EQ(skill.kick->longest, 8.0);
  EXPECT_DOUBLE_EQ(skill.kick->apex, 1.1);
  EXPECT_DOUBLE_EQ(skill.kick->apexAt, 3.0);
  EXPECT_DOUBLE_EQ(skill.kick->apexSpread, 0.3);
  EXPECT_DOUBLE_EQ(skill.kick->contact, 0.3);
  EXPECT_DOUBLE_EQ(skill.kick->room, 0.5);
  EXPECT_TRUE(skill.kick->isChip());
  EXPECT_DOUBLE_EQ(skill.kick->clears, 0.7);
  EXPECT_DOUBLE_EQ(skill.kick->lands, 4.0);
  EXPECT_DOUBLE_EQ(skill.kick->low, 0.3);
  EXPECT_TRUE(skill.kick->fromWalk);
  EXPECT_TRUE(skill.kick->serves(0));
  EXPECT_FALSE(skill.kick->serves(3));
}

// Against drawn flights: a parabola through where the ball lay, its height disturbed.
TEST(SkillLanguage, ProbabilityOfALowBallIsThatOfDrawnFlights) {
  KickHead head;
  EXPECT_EQ(head.fliesBelow(0.05, 1.0), 1.0) << "it rolls";
  head.apex = 1.0;
  head.apexAt = 4.0;
  head.apexSpread = 0.25;
  Random random(5);
  for (const double distance : {0.5, 1.0, 2.0, 4.0, 6.0, 7.5}) {
    int low = 0;
    constexpr int kFlights = 20000;
    for (int i = 0; i < kFlights; ++i) {
      const double height = 4.0 * head.apex * (distance / 8.0) * (1.0 - distance / 8.0);
      low += random.normal(height, head.apexSpread) < 0.8 ? 1 : 0;
    }
    EXPECT_NEAR(head.fliesBelow(0.8, distance), static_cast<double>(low) / kFlights, 0.02) << distance;
  }
  EXPECT_EQ(head.fliesBelow(0.05, 8.5), 1.0) << "it has landed";
}

TEST(SkillLanguage, AFlightNeedsAHeightAPlaceAndADeviation) {
  const std::string head = "kick { ball (0.2m, 0) distance 1m..2m contact 0.3s flies ";
  EXPECT_NO_THROW(parseOne(head + "0m at 0m within 0m }"));
  for (const char* wrong : {"1m at 0m within 0.2m }", "0m at 1m within 0.2m }", "1m at 2m within 0m }"})
    EXPECT_THROW(parseOne(head + wrong), std::runtime_error) << wrong;
}

// Against the same arithmetic by hand, at a place of the ball that no coefficient hides.
TEST(SkillLanguage, ValuesMayDependOnTheBall) {
  const Skill skill = parseOne(
      "kick { ball (0.2m, 0) distance 1m..2m contact 0.3s }\n"
      "swing over 0.1s + 0.3s * ballAhead { right.hipRoll -(2deg - 10deg * ballAside) * 3 / 2 + 5deg "
      "after 0.02s - ballAhead * 0.1s }");
  const Instruction& swing = skill.program[0];
  KickInputs offset = KickInputs::Zero();
  offset.head<2>() = Vector2(0.03, -0.02);
  EXPECT_EQ(swing.kind, Instruction::Kind::Swing);
  EXPECT_NEAR(swing.duration.at(offset), 0.1 + 0.3 * 0.03, 1e-12);
  // The right hip rolls the other way.
  EXPECT_NEAR(swing.joints[0].angle.at(offset), -toRadians(-(2.0 + 10.0 * 0.02) * 1.5 + 5.0), 1e-12);
  EXPECT_NEAR(swing.joints[0].after.at(offset), 0.02 - 0.1 * 0.03, 1e-12);
}

TEST(SkillLanguage, ValuesMayDependOnAimAndPace) {
  const Skill skill = parseOne(
      "kick { ball (0.2m, 0) direction 10deg within 0.3rad distance 1m..2m contact 0.3s }\n"
      "swing over 0.1s + 0.3s * paceAhead { left.hipRoll 2rad * turn - 1rad * paceAside / 4 }");
  EXPECT_DOUBLE_EQ(skill.kick->turn, 0.3);
  const KickInputs inputs = (KickInputs() << 9.0, 9.0, 0.1, 0.5, 0.2, 9.0).finished();
  EXPECT_NEAR(skill.program[0].duration.at(inputs), 0.1 + 0.3 * 0.5, 1e-12);
  EXPECT_NEAR(skill.program[0].joints[0].angle.at(inputs), 2.0 * 0.1 - 0.2 / 4.0, 1e-12);
}

// Also one whose numbers say that the distance does not matter yet: where a search begins.
TEST(SkillLanguage, KicksThatNameTheDistanceScaleWithIt) {
  const std::string head = "kick { ball (0.2m, 0) distance 1m..2m contact 0.3s }\n";
  const Skill skill = parseOne(head + "swing over 0.1s + 0.02s * (distance - 4) { left.knee -1rad }");
  EXPECT_TRUE(skill.kick->scales);
  const KickInputs inputs = 6.0 * KickInputs::Unit(kDistanceInput);
  EXPECT_NEAR(skill.program[0].duration.at(inputs), 0.1 + 0.02 * (6.0 - 4.0), 1e-12);
  EXPECT_TRUE(parseOne(head + "swing over 0.1s { left.knee -1rad - 0rad * distance }").kick->scales);
  const Skill steep = parseOne(head + "move over 0.1s + 0.03s * (distance - 4) { left.knee -1rad }");
  EXPECT_LT(steep.program[0].duration.constant, 0.0);
  EXPECT_NEAR(steep.program[0].duration.at(inputs), 0.1 + 0.03 * (6.0 - 4.0), 1e-12);
  EXPECT_FALSE(parseOne(head + "swing over 0.1s { left.knee -1rad - 1rad * turn }").kick->scales);
}

TEST(SkillLanguage, ParametersAreReplaced) {
  const std::string text = "skill test { parameter t = 1s in 0.5s..2s wait t }";
  const auto lookup = [](std::string_view skill, std::string_view parameter) -> std::optional<double> {
    EXPECT_EQ(skill, "test");
    EXPECT_EQ(parameter, "t");
    return 1.5;
  };
  EXPECT_DOUBLE_EQ(parseSkills(text, "f", lookup)[0].program[0].value, 1.5);
}

TEST(SkillLanguage, BranchesAndLoopsJumpToTheRightPlace) {
  const Skill skill = parseOne("if upright { wait 1s } else { fail }\nrepeat 3 { wait 2s }");
  using Kind = Instruction::Kind;
  const std::vector<Kind> expected{Kind::Branch, Kind::Wait, Kind::Jump, Kind::Fail,
                                   Kind::Wait,   Kind::Loop, Kind::End};
  ASSERT_EQ(skill.program.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(skill.program[i].kind, expected[i]) << i;
  EXPECT_EQ(skill.program[0].target, 3);  // the else part
  EXPECT_EQ(skill.program[2].target, 4);  // past it
  EXPECT_EQ(skill.program[5].target, 4);
  EXPECT_EQ(skill.program[5].count, 3);
}

TEST(SkillLanguage, ConditionsBindAndBeforeOr) {
  const Skill skill = parseOne("wait until upright or fallen front and not contact left within 1s");
  const ConditionNode& root = skill.conditions[static_cast<std::size_t>(skill.program[0].condition)];
  EXPECT_EQ(root.kind, ConditionNode::Kind::Or);
  EXPECT_EQ(skill.conditions[static_cast<std::size_t>(root.first)].kind, ConditionNode::Kind::Upright);
  EXPECT_EQ(skill.conditions[static_cast<std::size_t>(root.second)].kind, ConditionNode::Kind::And);
}

TEST(SkillLanguage, ErrorsNameFileLineAndColumn) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"skill a {\n  mov over 1s {}\n}", "test.skl:2:3: 'mov' is no statement"},
      {"skill a {\n  move over 1s { left.kne 1deg }\n}", "test.skl:2:23: unknown joint 'kne'"},
      {"skill a { wait 10deg }", "test.skl:1:16: a value in s is needed"},
      {"skill a { wait 10kg }", "test.skl:1:16: unknown unit 'kg'"},
      {"skill a { wait 0s }", "test.skl:1:16: must be more than zero"},
      {"skill a { move over 0.1s - 0.1s { } }", "test.skl:1:21: must be more than zero"},
      {"skill a { move over 1s { left.knee x } }", "unknown parameter 'x'"},
      {"skill a { parameter x = 5 in 6..7 }", "test.skl:1:21: the default lies outside"},
      {"skill a { parameter x = 5 parameter x = 5 }", "exists already"},
      {"skill a { wait 1s", "'}' is missing"},
      {"skill a { if happy { } }", "'happy' is no condition"},
      {"skill a { repeat 0 { } }", "whole number"},
      {"skill a { wait 1s ; }", "this character means nothing"},
      {"skill a { stiffness 2 }", "between 0 and 1"},
      {"skill a { move over 1s + 1deg { } }", "units of a sum differ"},
      {"skill a { curve left foot over 1s { } }", "1 to 12 points"},
      {"skill a { curve left foot over 1s { point (0, 0, 0) foot left at (0, 0, 0) } }", "follows the curve"},
      {"skil a { }", "expected 'skill'"},
      {"skill a { swing over 1s { left.knee 1deg after 2deg } }", "a value in s is needed"},
      {"skill a { move over 1s { left.knee 1deg * ballAhead } }", "only a skill with a 'kick' head"},
      {"skill a { kick { ball (0.1m, 0) contact 0.1s } }", "needs at least"},
      {"skill a { kick { ball (0.1m, 0) distance 3m..2m contact 0.1s } }", "the wrong way round"},
      {"skill a { kick { types 5 } }", "a number from 0 to 4"},
      {"skill a { kick { colour } }", "'colour' does not belong into the head of a kick"},
      {"skill a { kick { ball (0.1m, 0) distance 1m..2m contact 0.1s } wait 1s * ballAhead }",
       "must not depend on the ball"},
      {"skill a { kick { ball (0.1m, 0) distance 1m..2m contact 0.1s } "
       "move over 1s { left.knee 1deg * ballAhead * ballAside } }",
       "only one factor may depend on the ball"},
  };
  for (const auto& [text, message] : cases) EXPECT_THAT(errorOf(text), HasSubstr(message)) << text;
}

// An error in a parameter is told once, not where the parameter is used; its own value and range cannot use
// it.
TEST(SkillLanguage, ACheckTellsAParameterThatNamesItself) {
  const auto errorsOf = [](const std::string& text) { return checkSkills(text, "test.skl", {}).errors; };
  const std::string use = " move over 1s { left.knee x } }";
  EXPECT_THAT(errorsOf("skill a { parameter x = -4deg in x-9deg..0deg" + use),
              ElementsAre(HasSubstr("test.skl:1:34: unknown parameter 'x'")));
  EXPECT_THAT(errorsOf("skill a { parameter x = x" + use),
              ElementsAre(HasSubstr("test.skl:1:25: unknown parameter 'x'")));
  EXPECT_THAT(errorsOf("skill a { parameter x = 5 in 6..7" + use),
              ElementsAre(HasSubstr("test.skl:1:21: the default lies outside")));
}

TEST(SkillLanguage, LibraryResolvesCallsAndFindsCircles) {
  const auto library = [](const std::string& text) { return SkillLibrary(parseSkills(text, "l.skl")); };
  const SkillLibrary good = library("skill a { call b mirrored }\nskill b { wait 1s }");
  EXPECT_EQ(good.skill(good.find("a")).program[0].callee, good.find("b"));
  EXPECT_TRUE(good.skill(good.find("a")).program[0].mirrored);
  EXPECT_EQ(good.find("c"), -1);
  EXPECT_THROW(library("skill a { call nobody }"), SkillError);
  EXPECT_THROW(library("skill a { call b } skill b { call a }"), SkillError);
  EXPECT_THROW(library("skill a { } skill a { }"), SkillError);
}

TEST(SkillFormat, NormalisesAndKeepsCommentsAndMeaning) {
  const std::string text =
      "# head\n\n\nskill   a{   # why\nparameter p=-5deg in -10deg .. 0deg\n"
      "move over 1s{left.knee   -30deg right.knee p-2deg}\n  # alone\n if  time<1s{\nwait 1s }\n}\n";
  const std::string expected =
      "# head\n\nskill a {  # why\n  parameter p = -5deg in -10deg..0deg\n"
      "  move over 1s { left.knee -30deg right.knee p - 2deg }\n  # alone\n  if time < 1s {\n    wait 1s "
      "}\n}\n";
  // "p-2deg" keeps its meaning: p minus 2 degrees.
  const std::string formatted = formatSkills(text, "f");
  EXPECT_EQ(formatted, expected);
  EXPECT_EQ(formatSkills(formatted, "f"), formatted);
}

TEST(SkillFolder, AFileThatCannotBeReadIsAnErrorThatNamesIt) {
  const auto folder =
      std::filesystem::path(testing::TempDir()) / ("nonet_skills_unreadable_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder / "broken.skl");  // a folder in the place of a file
  try {
    skillTexts(folder.string());
    ADD_FAILURE() << "no error";
  } catch (const SkillError& error) {
    EXPECT_THAT(error.what(), HasSubstr("broken.skl: cannot be read"));
  }
  std::filesystem::remove_all(folder);
}

// The formatter may change blanks only: the words stay the same, for every shipped skill and for random cuts
// of blanks.
TEST(SkillFormat, ShippedSkillsLoadAndAreFormatted) {
  const std::string folder = std::string(NONET_SOURCE_DIR) + "/skills";
  const SkillLibrary library(folder, declareSkillParameters(folder));
  EXPECT_GT(library.size(), 0U);
  const std::vector<SkillText> texts = skillTexts(folder);
  for (const auto& [path, text] : texts)
    EXPECT_EQ(formatSkills(text, path, texts), text) << path << ": run `nonet skill format`";
}

// Random mutations of a good text: an error or a skill, never a crash (run under the sanitizers too).
TEST(SkillLanguage, SurvivesGarbage) {
  const std::string good =
      "skill a { parameter x = 5deg in 0deg..9deg move at 2rad/s { both.knee -(x + 1deg) * 2 } if not "
      "upright "
      "and time > 1s { call a } else { curve left foot over 1s from ball { point (0, 1m, -2mm) rpy (0, 1deg, "
      "0) } } }";
  Random random(7);
  int parsed = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string text = good;
    for (std::uint64_t k = 1 + random.below(4); k > 0; --k) {
      const std::size_t at = random.below(text.size());
      switch (random.below(3)) {
        case 0:
          text.erase(at, 1 + random.below(8));
          break;
        case 1:
          text.insert(at, 1, static_cast<char>(random.below(256)));
          break;
        default:
          text.insert(at, text.substr(random.below(text.size()), random.below(12)));
          break;
      }
      if (text.empty()) text = "s";
    }
    try {
      parseSkills(text, "garbage");
      ++parsed;
    } catch (const SkillError&) {
    }
  }
  EXPECT_LT(parsed, 3000);
}

TEST(SkillParameters, AreDeclaredUnderTheirSkill) {
  const std::string folder = std::string(NONET_SOURCE_DIR) + "/skills";
  const SkillParameters parameters = declareSkillParameters(folder);
  ASSERT_FALSE(parameters.values.empty());
  const auto& name = parameters.names->front();
  EXPECT_EQ(parameters.find(name.skill, name.parameter), parameters.values.front());
  EXPECT_EQ(parameters.find(name.skill, "there is none"), std::nullopt);
}

TEST(SkillParameters, AreFoundFromEverywhere) {
  const SkillParameters parameters = declareSkillParameters(std::string(NONET_SOURCE_DIR) + "/skills");
  const std::size_t count = parameters.values.size();
  Random random(3);
  for (std::size_t i = 0; i < count; ++i) {
    const SkillParameters::Name& name = (*parameters.names)[i];
    EXPECT_EQ(parameters.indexOf(name.skill, name.parameter), i);
    EXPECT_EQ(parameters.indexOf(name.skill, name.parameter, random.below(count + 1)), i);
  }
  EXPECT_EQ(parameters.indexOf("none", "none", count / 2), count);
}

TEST(SharedSkillLibrary, IsOneForTheSameParameters) {
  const std::string folder = std::string(NONET_SOURCE_DIR) + "/skills";
  const SkillParameters parameters = declareSkillParameters(folder);
  const auto library = sharedSkillLibrary(folder, parameters);
  SkillParameters copy = parameters;
  EXPECT_EQ(sharedSkillLibrary(folder, copy), library);
  copy.values.front() += 1.0;
  const auto other = sharedSkillLibrary(folder, copy);
  EXPECT_NE(other, library);
  EXPECT_EQ(sharedSkillLibrary(folder, parameters), library);
  // Declared anew: the files may be others.
  EXPECT_NE(sharedSkillLibrary(folder, declareSkillParameters(folder)), library);
  // Whoever has one keeps it, however many are asked for.
  for (int i = 0; i < 30; ++i) {
    copy.values.front() += 1.0;
    sharedSkillLibrary(folder, copy);
  }
  EXPECT_EQ(library->size(), SkillLibrary(folder, parameters).size());
}

}  // namespace
}  // namespace nonet::motion
