#include "nonet/lab/reports/token_difference.h"

#include <gtest/gtest.h>

namespace nonet::lab {
namespace {

TEST(TokenDifference, NamesTheInnermostListAroundTheFirstDifference) {
  const auto found = firstTokenDifference("(he1 0.50)(lae1 1.25)(syn)", "(he1 0.50)(lae1 1.26)(syn)");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->token, 7U);
  EXPECT_EQ(found->first, "(lae1 1.25)");
  EXPECT_EQ(found->second, "(lae1 1.26)");
}

TEST(TokenDifference, BlanksDoNotCount) {
  EXPECT_FALSE(firstTokenDifference("(time (now 1.00))", "( time  (now 1.00) )"));
  EXPECT_FALSE(firstTokenDifference("", " "));
}

TEST(TokenDifference, AListTooMuchOrTooFew) {
  const auto more = firstTokenDifference("(he1 1)(say hi)", "(he1 1)");
  ASSERT_TRUE(more);
  EXPECT_EQ(more->first, "(say hi)");
  EXPECT_EQ(more->second, "nothing");
  const auto nested = firstTokenDifference("(See (B (pol 1 2 3)) (X (pol 4 5 6)))", "(See (B (pol 1 2 3)))");
  ASSERT_TRUE(nested);
  EXPECT_EQ(nested->first, "(X (pol 4 5 6))");
}

TEST(TokenDifference, BrokenBracketsEnd) {
  for (const char* text : {")", "(((", ")(", "(a))b", "("}) {
    EXPECT_TRUE(firstTokenDifference(text, "x"));
    EXPECT_TRUE(firstTokenDifference("x", text));
    EXPECT_FALSE(firstTokenDifference(text, text));
  }
}

}  // namespace
}  // namespace nonet::lab
