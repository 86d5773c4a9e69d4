// `nonet skill check` as a user runs it.
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/program.h"

namespace nonet::app {
namespace {

using testing::HasSubstr;
using testing::Not;

class SkillCommand : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder.file(name)) << text;
    return folder.file(name);
  }
  std::pair<int, std::string> check(const std::vector<std::string>& files) const {
    std::vector<std::string> arguments = {"skill", "check"};
    arguments.insert(arguments.end(), files.begin(), files.end());
    Program program(arguments, folder.file("out.txt"));
    const int code = program.wait();
    return {code, program.output()};
  }

  TestFolder folder{"nonet_skill"};
};

TEST_F(SkillCommand, OurOwnSkillsHaveNoErrors) {
  const auto [code, output] = check({NONET_SOURCE_DIR "/skills"});
  EXPECT_EQ(code, 0) << output;
}

// Every error with its place, in one run.
TEST_F(SkillCommand, ReportsEveryErrorOfAFile) {
  const std::string file = write("bad.skl",
                                 "skill one {\n"
                                 "  parameter a = nonsense\n"
                                 "  move over 1s {\n"
                                 "    left.knee 200deg\n"
                                 "    left.nose 3deg\n"
                                 "    both.elbow -20xyz\n"
                                 "    right.hipPitch a\n"
                                 "  }\n"
                                 "  jump\n"
                                 "  if upright { wait }\n"
                                 "  call nosuch\n"
                                 "  wait 1s\n"
                                 "}\n"
                                 "skill two {\n"
                                 "  head.pan 3deg\n"
                                 "  call\n"
                                 "    missing\n"
                                 "}\n");
  const auto [code, output] = check({file});
  EXPECT_EQ(code, 1);
  for (const std::string place :
       {":2:17: ", ":4:15: ", ":5:10: ", ":6:17: ", ":9:3: ", ":10:21: ", ":11:8: ", ":15:3: ", ":17:5: "}) {
    EXPECT_THAT(output, HasSubstr(file + place));
  }
  EXPECT_THAT(output, HasSubstr("200 deg is out of the joint's reach"));
  EXPECT_THAT(output, HasSubstr("1 files, 9 errors"));
}

TEST_F(SkillCommand, JointsReachTheirLimitsOfEitherSideAndNoFarther) {
  const auto body = [](const std::string& target) { return "skill a { move over 1s { " + target + " } }\n"; };
  // The elbow bends to one side only, which is the other one on the right arm.
  for (const std::string fine :
       {"left.knee -130deg", "both.elbow -90deg", "head.pan 120deg", "head.tilt 45deg"})
    EXPECT_EQ(check({write("fine.skl", body(fine))}).first, 0) << fine;
  for (const std::string far : {"left.knee -131deg", "both.elbow 10deg", "right.elbow -91deg",
                                "head.pan 121deg", "head.tilt 50deg", "left.knee 2deg"})
    EXPECT_EQ(check({write("fine.skl", body(far))}).first, 1) << far;
}

TEST_F(SkillCommand, BrokenNeighboursAreMentionedOnly) {
  write("broken.skl", "skill broken { jump }\nskill helper { wait 1s }\n");
  const std::string file = write("good.skl", "skill good { call helper }\n");
  const auto [code, output] = check({file});
  EXPECT_EQ(code, 0) << output;
  EXPECT_THAT(output, HasSubstr("broken.skl: has errors of its own (1)"));
}

TEST_F(SkillCommand, EndsWhateverItReads) {
  const std::string whole = "skill a { if upright { move over 1s { left.knee 1deg } } else { call b } }";
  for (std::size_t cut = 0; cut < whole.size(); ++cut) {
    write("part" + std::to_string(cut) + ".skl", whole.substr(0, cut));
    write("rest" + std::to_string(cut) + ".skl", whole.substr(cut));
  }
  const auto [code, output] = check({folder.file("")});
  EXPECT_EQ(code, 1);
  EXPECT_THAT(output, Not(HasSubstr("no errors")));
}

}  // namespace
}  // namespace nonet::app
