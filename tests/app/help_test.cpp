// Every command tells how it is used.
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/program.h"

namespace nonet::app {
namespace {

using ::testing::HasSubstr;

class Help : public testing::Test {
 protected:
  std::string help(const std::vector<std::string>& arguments) {
    Program program(arguments, folder.file("help.txt"));
    EXPECT_EQ(program.wait(), 0);
    return program.output();
  }
  TestFolder folder{"nonet_help"};
};

TEST_F(Help, OfEveryCommandHasAnExample) {
  const std::string all = help({"--help"});
  std::istringstream lines(all.substr(all.find("Subcommands:")));
  std::string line;
  std::getline(lines, line);
  int commands = 0;
  for (; std::getline(lines, line); ++commands) {
    std::string name;
    std::istringstream(line) >> name;
    if (name.empty()) break;
    const std::string text = help({name, "--help"});
    ASSERT_THAT(text, HasSubstr("Example")) << name;
    EXPECT_THAT(text.substr(text.find("Example")), HasSubstr("nonet " + name)) << name;
    EXPECT_THAT(text, ::testing::Not(HasSubstr("include/")))
        << name << ": packages hold documents, no sources";
  }
  EXPECT_GE(commands, 20);
}

}  // namespace
}  // namespace nonet::app
