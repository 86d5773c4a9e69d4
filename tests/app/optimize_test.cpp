// `nonet optimize` as a user runs it: what cannot be meant is refused, what is stopped is kept.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/program.h"

namespace nonet::app {
namespace {

using testing::HasSubstr;
using Arguments = std::vector<std::string>;

class Optimize : public testing::Test {
 protected:
  std::pair<int, std::string> run(Arguments arguments) const {
    arguments.insert(arguments.begin(), "optimize");
    Program program(arguments, folder.file("out.txt"));
    const int code = program.wait();
    return {code, program.output()};
  }
  std::string text(const std::string& name) const {
    std::ifstream file(folder.file(name));
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void write(const std::string& name, const std::string& content) const {
    std::ofstream(folder.file(name)) << content;
  }

  TestFolder folder{"nonet_optimize"};
};

TEST_F(Optimize, RefusesWhatMakesNoSearch) {
  const std::vector<std::pair<Arguments, std::string>> cases = {
      {{"--generations", "-3"}, "generations must be 1 or more, not -3"},
      {{"--generations", "0"}, "generations must be 1 or more"},
      {{"--sigma", "0"}, "sigma"},
      {{"--sigma", "-1"}, "sigma"},
      {{"--sigma", "50"}, "sigma"},
      {{"--population", "1"}, "population"},
      {{"--threads", "-2"}, "--threads"},
      {{"--threads", "999"}, "--threads"},
  };
  for (const auto& [options, message] : cases) {
    Arguments arguments = {"quadratic", "--out", folder.file("run"), "--threads", "1"};
    if (options[0] == "--threads") arguments.resize(3);
    arguments.insert(arguments.end(), options.begin(), options.end());
    const auto [code, output] = run(arguments);
    EXPECT_EQ(code, 1) << options[0] << " " << options[1];
    EXPECT_THAT(output, HasSubstr(message));
    EXPECT_FALSE(fs::exists(folder.file("run/config.json"))) << "nothing was begun";
  }
}

TEST_F(Optimize, ResumesOnlyWhatWasBegun) {
  const Arguments begin = {"quadratic", "--out", folder.file("run"), "--generations", "2", "--seed", "7"};
  ASSERT_EQ(run(begin).first, 0);
  const std::vector<std::pair<Arguments, std::string>> contradictions = {
      {{"kick"}, "was begun with task quadratic, not kick"},
      {{"--seed", "8"}, "was begun with --seed 7, not 8"},
      {{"--type", "3"}, "--type 0, not 3"},
      {{"--sigma", "0.2"}, "--sigma 0.1, not 0.2"},
      {{"--restarts", "ipop"}, "--restarts"},
  };
  for (const auto& [options, message] : contradictions) {
    Arguments arguments = {"--resume", "--out", folder.file("run")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const auto [code, output] = run(arguments);
    EXPECT_EQ(code, 1) << output;
    EXPECT_THAT(output, HasSubstr(message));
  }
  const auto [code, output] =
      run({"quadratic", "--resume", "--out", folder.file("run"), "--seed", "7", "--generations", "4"});
  EXPECT_EQ(code, 0) << output;
  EXPECT_THAT(output, HasSubstr("generation 4/4"));
}

TEST_F(Optimize, DamagedFilesOfARunAreNamed) {
  ASSERT_EQ(run({"quadratic", "--out", folder.file("run"), "--generations", "1"}).first, 0);
  for (const std::string name : {"checkpoint.json", "config.json"}) {
    for (const std::string content : {"{\"generation\":", "{}"}) {
      const std::string whole = text("run/" + name);
      write("run/" + name, content);
      const auto [code, output] = run({"--resume", "--out", folder.file("run")});
      EXPECT_EQ(code, 1);
      EXPECT_THAT(output, HasSubstr(folder.file("run/" + name) + ": is damaged"));
      write("run/" + name, whole);
    }
  }
}

TEST_F(Optimize, AcceptsForTheTypeThatTheFileWasLearnedFor) {
  ASSERT_EQ(run({"quadratic", "--out", folder.file("run"), "--generations", "1", "--type", "4"}).first, 0);
  const std::string best = folder.file("run/best.toml");
  EXPECT_EQ(run({"quadratic", "--accept", best}).first, 1) << "it has to go somewhere";
  const auto [wrong, message] =
      run({"quadratic", "--accept", best, "--type", "3", "--out", folder.file("a.toml")});
  EXPECT_EQ(wrong, 1);
  EXPECT_THAT(message, HasSubstr("was learned for robot type 4, not for --type 3"));
  ASSERT_EQ(run({"quadratic", "--accept", best, "--out", folder.file("b.toml")}).first, 0);
  EXPECT_THAT(text("b.toml"), HasSubstr("robotType = 4"));
}

// A fit, or a line written by hand: everything else that the type has learned stays.
TEST_F(Optimize, AcceptsAFewValuesOnTopOfTheTypesFile) {
  write("few.toml", "[team.ball]\nkick = false\n");
  const auto [code, output] = run({"quadratic", "--accept", folder.file("few.toml"), "--type", "2",
                                   "--trials", "1", "--out", folder.file("all.toml")});
  ASSERT_EQ(code, 0) << output;
  EXPECT_THAT(text("all.toml"), HasSubstr("kick = false"));
  EXPECT_THAT(text("all.toml"), HasSubstr("[motion.skills.kick_power]"));
  EXPECT_THAT(text("all.toml"), HasSubstr("[provenance.goToTarget]"));
}

TEST_F(Optimize, ASignalEndsItWithWhatIsLearned) {
  Program program({"optimize", "quadratic", "--out", folder.file("run"), "--generations", "1000000",
                   "--restarts", "ipop"},
                  folder.file("long.txt"));
  ASSERT_TRUE(program.says("generation 3/"));
  ::kill(program.pid(), SIGTERM);
  EXPECT_EQ(program.wait(), 1);
  EXPECT_THAT(program.output(), HasSubstr("stopping: the generation under way is finished first"));
  EXPECT_THAT(program.output(), HasSubstr("stopped by a signal after generation"));
  EXPECT_TRUE(fs::exists(folder.file("run/best.toml")));
  EXPECT_TRUE(fs::exists(folder.file("run/checkpoint.json")));
}

// Every task that can be chosen has a word in the documentation.
TEST_F(Optimize, TasksAreDocumented) {
  std::string documents;
  for (const auto& entry : fs::recursive_directory_iterator(NONET_SOURCE_DIR "/docs")) {
    std::ifstream file(entry.path());
    if (entry.path().extension() == ".md") documents.append(std::istreambuf_iterator<char>(file), {});
  }
  const std::string list = run({"--list"}).second;
  const std::regex name("(?:^|\n)([A-Za-z_]+): ");
  int tasks = 0;
  for (std::sregex_iterator task(list.begin(), list.end(), name), end; task != end; ++task, ++tasks) {
    EXPECT_THAT(documents, HasSubstr("`" + (*task)[1].str() + "`"));
  }
  EXPECT_GE(tasks, 10);
}

}  // namespace
}  // namespace nonet::app
