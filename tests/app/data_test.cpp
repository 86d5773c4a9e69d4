// Params and skills: found from wherever the program lies, missed with a word, never silently.
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nonet/agent/data_folder.h"

#include "app/program.h"

namespace nonet::app {
namespace {

using testing::HasSubstr;

class Data : public testing::Test {
 protected:
  /// A folder that looks like data.
  fs::path make(const std::string& name) {
    const fs::path place = folder.file(name);
    fs::create_directories(place / "params");
    fs::create_directories(place / "skills");
    return place;
  }
  /// Exit code and output of `nonet ARGUMENTS` with NONET_DATA set.
  std::pair<int, std::string> run(const std::string& data, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"NONET_DATA=" + data, NONET_BINARY});
    Program program("/usr/bin/env", arguments, folder.file("out.txt"));
    const int code = program.wait();
    return {code, program.output()};
  }

  TestFolder folder{"nonet data test"};
};

TEST_F(Data, IsFoundAboveTheExecutableAndInItsInstallation) {
  const fs::path tree = make("tree");
  EXPECT_EQ(agent::findData(tree / "build" / "dev" / "nonet", "--data", "/none"), tree);
  const fs::path installed = make("usr/share/nonet");
  EXPECT_EQ(agent::findData(folder.file("usr/bin/nonet"), "--data", "/none"), installed);
  EXPECT_EQ(agent::findData("/none/nonet", "--data", tree), tree) << "the source tree comes last";
}

TEST_F(Data, IsMissedWithTheRemedy) {
  fs::create_directories(folder.file("lone/skills"));  // half of it does not count
  try {
    agent::findData(folder.file("lone/nonet"), "--data", "/none");
    FAIL();
  } catch (const std::exception& error) {
    EXPECT_THAT(error.what(), HasSubstr(folder.file("lone/nonet")));
    EXPECT_THAT(error.what(), HasSubstr("NONET_DATA or --data"));
  }
}

TEST_F(Data, EveryCommandRefusesAWrongFolder) {
  for (const std::vector<std::string>& command : {std::vector<std::string>{"play", "--wait", "0.1"},
                                                  {"match", "--in-process", "--minutes", "0.02"},
                                                  {"walk-report", "--trials", "1"},
                                                  {"optimize", "quadratic", "--out", folder.file("run")}}) {
    const auto [code, output] = run("/nope", command);
    EXPECT_EQ(code, 1) << output;
    EXPECT_THAT(output, HasSubstr("NONET_DATA /nope")) << command[0];
  }
}

// The folders are there, their contents are not: neither skills nor the learned values of the robot's type.
TEST_F(Data, EmptyFoldersAreRefused) {
  const fs::path empty = make("empty");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"play", "--data", empty, "--wait", "0.1"},
        {"match", "--left-data", empty, "--players", "1", "--minutes", "0.02", "--json",
         folder.file("m.json")}}) {
    Program program(command, folder.file("out.txt"));
    EXPECT_EQ(program.wait(), 1) << program.output();
    EXPECT_THAT(program.output(), HasSubstr("there are no skills"));
  }
  fs::copy(NONET_SOURCE_DIR "/skills", empty / "skills", fs::copy_options::recursive);
  Program program({"play", "--type", "3", "--data", empty, "--wait", "0.1"}, folder.file("out.txt"));
  EXPECT_EQ(program.wait(), 1) << program.output();
  EXPECT_THAT(program.output(), HasSubstr("type3.toml: is missing"));
}

TEST_F(Data, ACopyElsewhereServes) {
  const fs::path copy = folder.file("copy");
  for (const char* part : {"params", "skills"}) {
    fs::create_directories(copy / part);
    fs::copy(fs::path(NONET_SOURCE_DIR) / part, copy / part, fs::copy_options::recursive);
  }
  Program program({"match", "--in-process", "--alone", "--data", copy, "--players", "1", "--minutes", "0.02",
                   "--kick-off-wait", "0.2", "--json", folder.file("m.json")},
                  folder.file("out.txt"));
  EXPECT_EQ(program.wait(), 0) << program.output();
}

}  // namespace
}  // namespace nonet::app
