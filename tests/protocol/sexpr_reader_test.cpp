#include "nonet/protocol/sexpr_reader.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace nonet::protocol {
namespace {

template <typename Reader>
std::vector<std::string> tokens(std::string_view text) {
  Reader reader(text);
  std::vector<std::string> found;
  while (!reader.atEnd()) {
    std::string_view atom;
    if (reader.open()) {
      found.emplace_back("(");
    } else if (reader.close()) {
      found.emplace_back(")");
    } else if (reader.atom(atom)) {
      found.emplace_back(atom);
    } else {
      reader.skipOne();
      found.emplace_back("stray");
    }
  }
  return found;
}

using Tokens = std::vector<std::string>;

TEST(SexprReader, PlainTokens) {
  EXPECT_EQ(tokens<SexprReader>(" (a\t(b 'c;\"d)) e\r\n)"),
            (Tokens{"(", "a", "(", "b", "'c;\"d", ")", ")", "e", "stray"}));
  EXPECT_EQ(tokens<SexprReader>("   "), Tokens{});
}

TEST(SexprReader, CommandTokens) {
  EXPECT_EQ(tokens<CommandReader>("(a b;c) ;comment )\n\"x )y\" d'(e f) g'h)"),
            (Tokens{"(", "a", "b;c", ")", "x )y", "d", "(e f)", "g", "h", "stray"}));
  EXPECT_EQ(tokens<CommandReader>("; only a comment"), Tokens{});
  EXPECT_EQ(tokens<CommandReader>("\"never closed"), Tokens{"never closed"});
  EXPECT_EQ(tokens<CommandReader>(R"("a\"b" c)"), (Tokens{R"(a\"b)", "c"}));
}

TEST(SexprReader, AtomsAreViewsIntoTheText) {
  const std::string text = "(abc def)";
  SexprReader reader(text);
  std::string_view atom;
  ASSERT_TRUE(reader.open() && reader.atom(atom));
  EXPECT_EQ(atom.data(), text.data() + 1);
  ASSERT_TRUE(reader.atom(atom));
  EXPECT_EQ(atom.data(), text.data() + 5);
}

TEST(SexprReader, AFailedQuestionLeavesTheCursor) {
  SexprReader reader("  (x 1.5) word");
  std::string_view atom;
  double number = 0.0;
  int integer = 0;
  EXPECT_FALSE(reader.close() || reader.atom(atom) || reader.number(number) || reader.integer(integer));
  ASSERT_TRUE(reader.open());
  EXPECT_FALSE(reader.literal("y") || reader.number(number) || reader.open());
  EXPECT_TRUE(reader.literal("x"));
  EXPECT_FALSE(reader.integer(integer));  // 1.5 is none
  EXPECT_TRUE(reader.number(number));
  EXPECT_EQ(number, 1.5);
  EXPECT_TRUE(reader.close());
  EXPECT_EQ(reader.depth(), 0);
}

TEST(SexprReader, LeavesListsOfAnyDepth) {
  SexprReader reader("(a (b (c (d) e) f) g) h");
  std::string_view atom;
  ASSERT_TRUE(reader.open() && reader.atom(atom) && reader.open() && reader.atom(atom) && reader.open());
  EXPECT_EQ(reader.depth(), 3);
  EXPECT_TRUE(reader.leaveTo(1));
  ASSERT_TRUE(reader.atom(atom));
  EXPECT_EQ(atom, "g");
  EXPECT_TRUE(reader.leaveTo(0));
  ASSERT_TRUE(reader.atom(atom));
  EXPECT_EQ(atom, "h");
  SexprReader torn("(a (b");
  torn.open();
  EXPECT_FALSE(torn.leaveTo(0));
}

}  // namespace
}  // namespace nonet::protocol
