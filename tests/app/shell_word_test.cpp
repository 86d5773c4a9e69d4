// Words as a shell reads them back.
#include "nonet/app/shell_word.h"

#include <array>
#include <cstdio>

#include <gtest/gtest.h>

namespace nonet::app {
namespace {

std::string readByAShell(const std::string& word) {
  std::FILE* pipe = ::popen(("printf %s " + word).c_str(), "r");
  std::array<char, 256> text{};
  const std::size_t size = std::fread(text.data(), 1, text.size(), pipe);
  ::pclose(pipe);
  return {text.data(), size};
}

TEST(ShellWord, IsReadBackAsItWas) {
  for (const std::string text :
       {"plain", "a b", "it's", "'", "echo {port} 'x y' \"$HOME\"", "a\\b", "*?[a]~#!`id`", "one\ntwo"}) {
    EXPECT_EQ(readByAShell(quoted(text)), text);
    EXPECT_EQ(readByAShell(shellWord(text)), text);
  }
  EXPECT_EQ(shellWord("--set=team.ball.kick=false"), "--set=team.ball.kick=false");
  EXPECT_EQ(shellWord("it's"), R"('it'\''s')");
  EXPECT_EQ(shellWord(""), "''");
}

}  // namespace
}  // namespace nonet::app
