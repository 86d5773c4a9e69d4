// `nonet skill check` and `nonet skill play` as a user runs them.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "nonet/app/view/track.h"

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

// The other skill stands in a file that is read later; its faults are told once, those of the new numbers by
// name.
TEST_F(SkillCommand, ChecksAndFormatsSkillsThatAreLikeNeighbours) {
  const std::string base =
      write("base.skl", "skill base {\n  parameter x = 5deg\n  move over 1s { left.knee -x }\n}\n");
  const std::string file = write("as_base.skl", "skill as_base like base{\nparameter x=9deg # more\n}\n");
  EXPECT_EQ(check({file}).first, 0) << check({file}).second;
  Program program({"skill", "format", file}, folder.file("out.txt"));
  EXPECT_EQ(program.wait(), 0) << program.output();
  std::ifstream stream(file);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(stream), {}),
            "skill as_base like base {\n  parameter x = 9deg  # more\n}\n");

  write("as_base.skl", "skill as_base like base { parameter x = 200deg }\n");
  auto [code, output] = check({folder.file("")});
  EXPECT_EQ(code, 1);
  EXPECT_THAT(output, HasSubstr(base + ":3:28: -200 deg is out of the joint's reach"));
  EXPECT_THAT(output, HasSubstr("(in as_base)"));
  EXPECT_THAT(output, HasSubstr("2 files, 1 errors"));

  write("base.skl", "skill base {\n  parameter x = 5deg\n  jump\n  call nosuch\n}\n");
  std::tie(code, output) = check({folder.file("")});
  EXPECT_THAT(output, HasSubstr(base + ":3:3: 'jump' is no statement"));
  EXPECT_THAT(output, HasSubstr(base + ":4:8: there is no skill 'nosuch'"));
  EXPECT_THAT(output, HasSubstr("2 files, 2 errors"));
  EXPECT_THAT(check({file}).second, HasSubstr(base + ":3:3: 'jump' is no statement"));

  fs::remove(base);
  EXPECT_THAT(check({file}).second, HasSubstr(file + ":1:20: there is no skill 'base'"));
}

// The file is exchanged, not emptied first: whoever has it open still reads the old text.
TEST_F(SkillCommand, FormatNeverTruncatesAndKeepsTheMode) {
  const std::string file = write("mode.skl", "skill waiting{\nwait 1s\n}\n");
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
  std::ifstream open(file);
  Program program({"skill", "format", file}, folder.file("out.txt"));
  EXPECT_EQ(program.wait(), 0) << program.output();
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(open), {}), "skill waiting{\nwait 1s\n}\n");
  std::ifstream formatted(file);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(formatted), {}), "skill waiting {\n  wait 1s\n}\n");
  EXPECT_EQ(fs::status(file).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_FALSE(fs::exists(file + ".new"));
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

class SkillPlay : public SkillCommand {
 protected:
  std::pair<int, std::string> play(const std::string& skill, const std::vector<std::string>& options) const {
    std::vector<std::string> arguments = {"skill", "play", skill};
    arguments.insert(arguments.end(), options.begin(), options.end());
    Program program(arguments, folder.file("out.txt"));
    const int code = program.wait();
    return {code, program.output()};
  }
  // Standard error is in the same file.
  static nlohmann::json jsonOf(const std::string& output) {
    const std::size_t begin = output.find("{\n");
    return nlohmann::json::parse(output.substr(begin, output.rfind('}') + 1 - begin));
  }
  static int count(const std::string& text, const std::string& part) {
    int count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
  }

  const std::string wave =
      "skill wave {\n"
      "  move over 0.4s {\n"
      "    right.shoulderPitch 60deg\n"
      "    right.shoulderYaw 30deg\n"
      "  }\n"
      "  wait 0.1s\n"
      "  call back\n"
      "}\n";
  const std::string kickFromStand = NONET_TEST_DATA "/skills/kick_stand.skl";
  const std::string back = "skill back { move over 0.3s { right.shoulderYaw 10deg left.elbow -40deg } }\n";
};

// What the text says is what the robot has done at the end, in the report, the picture and the monitor log.
TEST_F(SkillPlay, EndsInTheLastPosture) {
  write("back.skl", back);
  const auto [code, output] = play(write("wave.skl", wave), {"--json", "--plot", folder.file("wave.svg"),
                                                             "--monitor", folder.file("wave.mon")});
  ASSERT_EQ(code, 0) << output;
  const nlohmann::json json = jsonOf(output);
  EXPECT_EQ(json["result"], "finished");
  EXPECT_NEAR(json["duration_s"].get<double>(), 0.8, 0.021);
  EXPECT_FALSE(json["fell"].get<bool>());
  EXPECT_FALSE(json.contains("kick"));
  const std::map<std::string, double> posture = {
      {"right.shoulderPitch", 60.0}, {"right.shoulderYaw", 10.0}, {"left.elbow", -40.0}};
  ASSERT_EQ(json["joints"].size(), posture.size());
  for (const auto& [joint, angle] : posture) {
    EXPECT_NEAR(json["joints"][joint]["target_end_deg"].get<double>(), angle, 1e-6) << joint;
    EXPECT_NEAR(json["joints"][joint]["angle_end_deg"].get<double>(), angle, 1.0) << joint;
  }
  ASSERT_EQ(json["statements"].size(), 3U);
  EXPECT_EQ(json["statements"][1]["line"], 6);
  EXPECT_NEAR(json["statements"][1]["time_s"].get<double>(), 0.4, 0.021);
  EXPECT_EQ(json["statements"][2]["skill"], "back");
  EXPECT_NEAR(json["statements"][2]["time_s"].get<double>(), 0.5, 0.021);

  const Track track = readMonitorLog(folder.file("wave.mon"));
  EXPECT_EQ(track.frames(), static_cast<std::size_t>(std::lround(json["watched_s"].get<double>() / 0.02)));
  EXPECT_NEAR(track.step(), 0.02, 1e-9);

  std::ifstream file(folder.file("wave.svg"));
  const std::string svg{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(count(svg, "<g class='joint'>"), 3);
  for (const auto& [joint, angle] : posture) EXPECT_THAT(svg, HasSubstr(">" + joint + " ("));
  for (const std::string part : {"skill wave, robot type 0", ">time, s<", ">angle, deg<", ">told (target)<",
                                 ">done (measured)<", ">limit of the joint<", ">6</text>"})
    EXPECT_THAT(svg, HasSubstr(part));
}

TEST_F(SkillPlay, PlaysASkillThatIsLikeItsNeighbour) {
  write("base.skl",
        "skill base {\n  parameter x = 5deg in 0deg..90deg\n  move over 0.3s { left.elbow -x }\n}\n");
  const auto [code, output] =
      play(write("as_base.skl", "skill as_base like base { parameter x = 40deg }\n"), {"--json"});
  ASSERT_EQ(code, 0) << output;
  EXPECT_NEAR(jsonOf(output)["joints"]["left.elbow"]["target_end_deg"].get<double>(), -40.0, 1e-6);
}

TEST_F(SkillPlay, MirrorsIt) {
  write("back.skl", back);
  const auto [code, output] =
      play(write("wave.skl", wave), {"--json", "--mirror", "--type", "4", "--seconds", "1.5"});
  ASSERT_EQ(code, 0) << output;
  const nlohmann::json json = jsonOf(output);
  EXPECT_NEAR(json["joints"]["left.shoulderYaw"]["angle_end_deg"].get<double>(), 10.0, 1.0);
  EXPECT_NEAR(json["joints"]["right.elbow"]["angle_end_deg"].get<double>(), -40.0, 1.0);
  EXPECT_NEAR(json["watched_s"].get<double>(), 1.5, 1e-9);
}

// A learned kick from a stand sends the ball where its head says, with either foot; one beside the way stays
// there.
TEST_F(SkillPlay, KicksTheBallThatLiesInItsPlace) {
  for (const std::vector<std::string>& side : {std::vector<std::string>{}, {"--mirror"}}) {
    std::vector<std::string> options = {"--json", "--type", "4", "--monitor", folder.file("kick.mon")};
    options.insert(options.end(), side.begin(), side.end());
    const auto [code, output] = play(kickFromStand, options);
    ASSERT_EQ(code, 0) << output;
    const nlohmann::json kick = jsonOf(output)["kick"];
    EXPECT_TRUE(kick["contact"].get<bool>());
    EXPECT_GT(kick["distance_m"].get<double>(), 4.0);
    EXPECT_NEAR(kick["direction_deg"].get<double>(), kick["intended_direction_deg"].get<double>(), 15.0);
    EXPECT_LT(kick["contact_s"].get<double>(), jsonOf(output)["duration_s"].get<double>());
    // The viewer finds the kick by itself, in what anybody can see.
    const Track track = readMonitorLog(folder.file("kick.mon"));
    const auto event = std::find_if(track.events().begin(), track.events().end(),
                                    [](const TrackEvent& e) { return e.kind == TrackEvent::Kind::Kick; });
    ASSERT_NE(event, track.events().end());
    EXPECT_NEAR(static_cast<double>(event->frame) * 0.02, kick["contact_s"].get<double>(), 0.041);
  }
  const auto [code, output] =
      play(kickFromStand, {"--json", "--type", "4", "--ball", "0.2,0.6", "--seconds", "1.5"});
  ASSERT_EQ(code, 0) << output;
  EXPECT_FALSE(jsonOf(output)["kick"]["contact"].get<bool>());
}

TEST_F(SkillPlay, SaysWhatIsWrong) {
  const auto says = [&](const std::string& skill, const std::vector<std::string>& options,
                        const std::string& what) {
    const auto [code, output] = play(skill, options);
    EXPECT_EQ(code, 1) << output;
    EXPECT_THAT(output, HasSubstr(what));
  };
  says("nosuch", {}, "there is no skill 'nosuch'");
  says("nosuch", {}, "kick_power");  // which there are
  says("rise_front", {"--type", "7"}, "--type");
  says(folder.file("nosuch.skl"), {}, "nosuch.skl: cannot be read");
  const std::string bad = write("bad.skl", "skill bad {\n  move over 1s { left.nose 3deg }\n}\n");
  says(bad, {}, bad + ":2:");
  fs::remove(bad);
  const std::string two = write("two.skl", "skill a { wait 1s }\nskill b { wait 1s }\n");
  says(two, {}, "holds a, b");
  says("rise_front", {"--monitor", "/nosuch/log.mon"}, "/nosuch/log.mon");
}

}  // namespace
}  // namespace nonet::app
