// Skills that are `like` another one.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "nonet/math/angle.h"
#include "nonet/motion/skill_language.h"
#include "nonet/motion/skill_library.h"

#include "fuzz/skill_properties.h"

namespace nonet::motion {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kBase =
    "skill base {\n"
    "  parameter a = 10deg in 0deg..20deg\n"
    "  parameter b = a * 2 in 0deg..90deg\n"
    "  parameter near = 20cm\n"
    "  kick { ball (near, 0) distance 1m..2m contact 0.3s }\n"
    "  move over 0.2s { left.knee -a left.hipRoll b * turn }\n"
    "  if upright { wait 0.1s } else { fail }\n"
    "}\n";

std::vector<SkillText> baseBeside() {
  return {{"base.skl", kBase}};
}

Skill like(const std::string& text) {
  return parseSkills(text, "test.skl", nullptr, baseBeside()).at(0);
}

std::string errorBeside(const std::string& text, const std::vector<SkillText>& others = baseBeside()) {
  try {
    parseSkills(text, "test.skl", nullptr, others);
  } catch (const SkillError& error) {
    return error.what();
  }
  return "no error";
}

std::vector<std::string> namesOf(const Skill& skill) {
  std::vector<std::string> names;
  for (const SkillParameter& parameter : skill.parameters) names.push_back(parameter.name);
  return names;
}

TEST(SkillLike, TakesParametersInOrderThenItsOwn) {
  const Skill skill = like(
      "skill test like base {\n  parameter extra = 3s\n  parameter near = 30cm in 1cm..50cm\n  parameter a = "
      "15deg\n}\n");
  EXPECT_THAT(namesOf(skill), ElementsAre("a", "b", "near", "extra"));
  EXPECT_DOUBLE_EQ(skill.parameters[0].value, toRadians(15.0));
  ASSERT_TRUE(skill.parameters[0].range.has_value());  // the other one's
  EXPECT_DOUBLE_EQ(skill.parameters[0].range->high, toRadians(20.0));
  EXPECT_DOUBLE_EQ(skill.parameters[1].value, toRadians(30.0)) << "twice the new a";
  EXPECT_DOUBLE_EQ(skill.parameters[2].value, 0.3);
  ASSERT_TRUE(skill.parameters[2].range.has_value());  // its own
  EXPECT_DOUBLE_EQ(skill.parameters[2].range->low, 0.01);
  EXPECT_FALSE(skill.parameters[3].range.has_value());
  EXPECT_EQ(skill.file, "test.skl");
  EXPECT_EQ(skill.textFile, "base.skl");
  EXPECT_EQ(skill.program[0].line, 6);
}

TEST(SkillLike, HasTheOthersHeadUnlessItHasOne) {
  const Skill other = like("skill test like base { parameter near = 30cm }");
  ASSERT_TRUE(other.kick.has_value());
  EXPECT_DOUBLE_EQ(other.kick->p_RBall.x(), 0.3);
  EXPECT_DOUBLE_EQ(other.kick->longest, 2.0);
  const Skill own =
      like("skill test like base { kick { ball (near, 1cm) distance 1m..7m contact 0.2s types 3 } }");
  EXPECT_DOUBLE_EQ(own.kick->p_RBall.x(), 0.2);
  EXPECT_DOUBLE_EQ(own.kick->longest, 7.0);
  EXPECT_FALSE(own.kick->serves(0));
}

TEST(SkillLike, LooksParametersUpUnderItsOwnName) {
  const auto lookup = [](std::string_view skill, std::string_view parameter) -> std::optional<double> {
    EXPECT_EQ(skill, "test");
    return parameter == "a" ? std::optional(0.3) : std::nullopt;
  };
  const Skill skill =
      parseSkills("skill test like base { parameter a = 15deg }", "test.skl", lookup, baseBeside()).at(0);
  EXPECT_DOUBLE_EQ(skill.parameters[0].value, 0.3);
  EXPECT_DOUBLE_EQ(skill.program[0].joints[0].angle.constant, -0.3);
}

// The oracle: the same skill by hand.
TEST(SkillLike, IsTheSameAsTheTextWrittenOut) {
  const std::string written =
      "skill test {\n"
      "  parameter a = 12deg in 5deg..20deg\n"
      "  parameter b = a * 3 in 0deg..90deg\n"
      "  parameter near = 20cm\n"
      "  parameter c = b / 2\n"
      "  parameter d = 4m\n"
      "  kick { ball (near, 0) distance 1m..d contact 0.3s direction c within 10deg }\n"
      "  move over 0.2s { left.knee -a left.hipRoll b * turn }\n"
      "  if upright { wait 0.1s } else { fail }\n"
      "}\n";
  // In two steps, the first of which stands behind the second.
  const std::string chain =
      "skill test like between {\n"
      "  parameter d = 4m\n"
      "  parameter a = 12deg\n"
      "  kick { ball (near, 0) distance 1m..d contact 0.3s direction c within 10deg }\n"
      "}\n"
      "skill between like base {\n"
      "  parameter a = 30deg in 5deg..20deg\n"  // out of its range, but nothing uses it so
      "  parameter b = a * 3\n"
      "  parameter c = b / 2\n"
      "}\n";
  EXPECT_THAT(errorBeside(chain), HasSubstr("test.skl:7:13: the default lies outside the range"));
  std::string whole = chain;
  whole.replace(whole.find("30deg"), 5, "13deg");
  EXPECT_EQ(fuzz::describe({like(whole)}), fuzz::describe(parseSkills(written, "test.skl")));
}

TEST(SkillLike, MayStandBeforeTheOtherInOneFile) {
  const std::vector<Skill> skills = parseSkills("skill test like base { }\n" + kBase, "test.skl");
  ASSERT_EQ(skills.size(), 2U);
  Skill renamed = skills[0];
  renamed.name = "base";
  EXPECT_EQ(fuzz::describe({renamed}), fuzz::describe({skills[1]}));
}

TEST(SkillLike, ErrorsNameThePlaceAndTheSkill) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"skill a like nosuch { }", "test.skl:1:14: there is no skill 'nosuch'"},
      {"skill a like base {\n  wait 1s }",
       "test.skl:2:3: a skill that is like another one has only parameters"},
      {"skill a like base { parameter a = 5deg\n move over 1s { } }", "test.skl:2:2: a skill that is like"},
      {"skill a like a { }", "test.skl:1:14: a skill cannot be like itself: a like a"},
      {"skill a like b { } skill b like a { }",
       "test.skl:1:33: a skill cannot be like itself: a like b like a"},
      {"skill a like base { parameter a = 5s }", "test.skl:1:35: a value in rad is needed"},
      {"skill a like base { parameter a = 25deg }", "test.skl:1:31: the default lies outside the range"},
      {"skill a like base { parameter a = 5deg parameter a = 5deg }",
       "test.skl:1:50: this parameter exists already"},
      {"skill a like base { parameter n = 1 parameter n = 1 }",
       "test.skl:1:47: this parameter exists already"},
      {"skill a like base { parameter a = 5deg", "test.skl:1:39: the file ends inside a skill"},
      {"skill a like { }", "test.skl:1:14: expected the name of the skill that this one is like"},
      {"skill a like base { parameter a = n parameter n = 5deg }", "test.skl:1:35: unknown parameter 'n'"},
      // A number with which the other one's text makes no sense: told where that stands.
      {"skill a like base { parameter near = 0m }", "base.skl:6:3: the head of a kick needs at least"},
  };
  for (const auto& [text, message] : cases) EXPECT_THAT(errorBeside(text), HasSubstr(message)) << text;
  EXPECT_THAT(errorBeside("skill a like base { }", {{"base.skl", "skill base {\n  jump\n}"}}),
              HasSubstr("base.skl:2:3: 'jump' is no statement"));
  EXPECT_THAT(errorBeside("skill a like base { }", {{"base.skl", "skill base {\n  wait 1kg }"}}),
              HasSubstr("base.skl:2:8: unknown unit"));
}

TEST(SkillLike, OnlySoManyInARow) {
  std::string text = "skill s0 { wait 1s }\n";
  for (int i = 1; i <= 7; ++i) text += fmt::format("skill s{} like s{} {{ }}\n", i, i - 1);
  EXPECT_EQ(parseSkills(text, "test.skl").size(), 8U);
  EXPECT_THAT(errorBeside(text + "skill s8 like s7 { }"),
              HasSubstr("test.skl:2:15: more than 8 skills in a row"));
}

TEST(SkillLike, ACheckCollectsEveryError) {
  const SkillCheck check = checkSkills(
      "skill a like base {\n  parameter a = 99deg\n  parameter n = 5xyz\n}\n"
      "skill b like nosuch {\n  parameter a = nonsense\n  kick { ball (near, 0) }\n}\n"
      "skill c { jump call b }\n"
      "skill d like broken {\n  parameter a = 5deg\n}\n",
      "test.skl", {{"base.skl", kBase}, {"broken.skl", "skill broken {\n  hop\n  wait 5deg\n}"}});
  std::string errors;
  for (const std::string& error : check.errors) errors += error + "\n";
  for (const std::string place :
       {"test.skl:2:13: the default lies", "test.skl:3:17: unknown unit", "test.skl:5:14: there is no skill",
        "test.skl:6:17: unknown parameter", "test.skl:9:11: 'jump'", "broken.skl:2:3: 'hop'",
        "broken.skl:3:8: a value in s is needed here (in d)"})
    EXPECT_THAT(errors, HasSubstr(place));
  EXPECT_EQ(check.errors.size(), 7U) << errors;
  EXPECT_EQ(check.skills.size(), 4U);
}

TEST(SkillLike, IsFormatted) {
  const std::string text =
      "# why\nskill   a like  base{ # how\nparameter a=5deg# less\n\nkick{ball(near,-1cm)distance "
      "1m..2m\ncontact 1s}}\n";
  const std::string expected =
      "# why\nskill a like base {  # how\n  parameter a = 5deg  # less\n\n  kick { ball (near, -1cm) "
      "distance 1m..2m\n    "
      "contact 1s } }\n";
  EXPECT_EQ(formatSkills(text, "f", baseBeside()), expected);
  EXPECT_EQ(formatSkills(expected, "f", baseBeside()), expected);
  EXPECT_THROW(formatSkills(text, "f"), SkillError);
}

// In a folder: declared under its own name, overlaid under its own name, and played with that.
TEST(SkillLike, LibrariesReadItBeforeOrAfterTheOther) {
  const fs::path folder = fs::path(testing::TempDir()) / ("nonet_skill_like_" + std::to_string(::getpid()));
  fs::remove_all(folder);
  fs::create_directories(folder);
  std::ofstream(folder / "base.skl") << kBase;
  std::ofstream(folder / "after.skl") << "skill after like zlast { parameter a = 7deg }\n";
  std::ofstream(folder / "zlast.skl") << "skill zlast like base { parameter near = 30cm }\n";
  SkillParameters parameters = declareSkillParameters(folder.string());
  ASSERT_EQ(parameters.values.size(), 9U);
  EXPECT_EQ(parameters.names->front().skill, "after");
  EXPECT_EQ(parameters.names->front().range.high, toRadians(20.0));
  EXPECT_EQ(parameters.find("after", "near"), 0.3);
  EXPECT_EQ(parameters.find("base", "near"), 0.2);
  parameters.values.front() = 0.25;
  const SkillLibrary library(folder.string(), parameters);
  EXPECT_DOUBLE_EQ(library.skill(library.find("after")).program[0].joints[0].angle.constant, -0.25);
  EXPECT_DOUBLE_EQ(library.skill(library.find("base")).program[0].joints[0].angle.constant, -toRadians(10.0));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace nonet::motion
