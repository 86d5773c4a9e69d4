#include "nonet/config/toml_letters.h"

#include <string>

#include <gtest/gtest.h>

#include "nonet/config/toml.h"

namespace nonet::config {
namespace {

TEST(TomlLetters, MayStandInCommentsAndQuotes) {
  EXPECT_EQ(lineOfForeignLetter(""), 0u);
  EXPECT_EQ(lineOfForeignLetter("a = 1 # \xC3\xB6\nb = 2\n"), 0u);
  EXPECT_EQ(lineOfForeignLetter("a = \"\xC3\xB6\" # \xC3\xB6\nb = '\xC3\xB6'"), 0u);
  EXPECT_EQ(lineOfForeignLetter("a = \"#\\\"\xC3\xB6\"\n"), 0u) << "a quote behind a backslash ends no text";
  EXPECT_EQ(lineOfForeignLetter("\xEF\xBB\xBF"
                                "a = 1\n"),
            0u)
      << "the mark that some editors begin files with";
  EXPECT_EQ(
      lineOfForeignLetter("'\xC3\xB6' = {b = [\"\xC3\xB6\",'\xC3\xB6', [\"\xC3\xB6\"]], \"\xC3\xB6\"=1}\n"),
      0u)
      << "wherever a text may begin";
  EXPECT_EQ(lineOfForeignLetter("a=\"\xC3\xB6\"\nb = [\n\"c\"]\nd='\xC3\xB6'\n"), 0u)
      << "behind a line's first =";
}

TEST(TomlLetters, AreFoundElsewhere) {
  EXPECT_EQ(lineOfForeignLetter("\xC3\x96"), 1u);
  EXPECT_EQ(lineOfForeignLetter("a = 1\n\xC3\xB6 = 1\n"), 2u);
  EXPECT_EQ(lineOfForeignLetter("a = 1\nb = 1 \xC3\xB6\n"), 2u);
  EXPECT_EQ(lineOfForeignLetter("a = \"#\" \xC3\xB6\n"), 1u) << "in quotes # begins no comment";
  EXPECT_EQ(lineOfForeignLetter("a = 'b\\' \xC3\xB6\n"), 1u)
      << "in single quotes a backslash is a letter like others";
  EXPECT_EQ(lineOfForeignLetter("# \"\n\xC3\xB6\n"), 2u) << "a quote in a comment begins no text";
  EXPECT_EQ(lineOfForeignLetter("a = \"b\n\xC3\xB6\n"), 2u) << "a text ends with its line";
  EXPECT_EQ(lineOfForeignLetter("a = \"\"\"\nb # \" c\n\xC3\xB6\"\"\"\n"), 3u)
      << "but for one in three quotes";
  EXPECT_EQ(lineOfForeignLetter("a = 2\"\"b\"c\xC3\xB6\"\n"), 1u) << "a quote in a number begins no text";
  for (const std::string before : {"a = 2.", "a = [1, 2.", "a = +inf.", "a.", "a = {b = 1, c.",
                                   "a = [2=", "a=2=", "a = 2[", "a = 2{", "a = {b=", "a = [\n2="})
    EXPECT_NE(lineOfForeignLetter(before + "\"b\xC3\xB6\"\n"), 0u) << before << ": a key's part or a mistake";
  EXPECT_EQ(lineOfForeignLetter("a.\"#\" = \"\" # b\nc = 1 # \xC3\xB6\n"), 0u) << "only in that line";
  EXPECT_EQ(lineOfForeignLetter("a = '''b''' # \xC3\xB6\nb = \"\"\"c\"\"\" \xC3\xB6"), 2u);
}

// With sanitizers toml++'s undefined behaviour ends the test.
TEST(TomlLetters, NoShortBeginReachesWhatTomlTakesToBeImpossible) {
  const std::string letters = "\"'=.[]{},# \n0a\\";
  for (const std::string place : {"", "x=", "x =[", "x={", "x=[\n"}) {
    for (std::size_t i = 0; i < letters.size() * letters.size() * letters.size(); ++i) {
      const std::size_t next = i / letters.size();
      const std::string text = place + letters[i % letters.size()] + letters[next % letters.size()] +
                               letters[next / letters.size()] + "\xEF\xBB\xAE\"w";
      try {
        parseToml(text);
      } catch (const TomlError& error) {
        EXPECT_GE(error.line(), 1u) << text;
      }
    }
  }
}

}  // namespace
}  // namespace nonet::config
