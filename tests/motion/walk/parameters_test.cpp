#include "nonet/motion/walk/parameters.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace nonet::motion {
namespace {

TEST(WalkParameters, AreDeclaredWell) {
  EXPECT_TRUE(config::declarationFaults(WalkParameters{}).empty());
  std::set<std::string> sentences;
  for (const auto& parameter : config::listParameters(WalkParameters{})) {
    EXPECT_TRUE(sentences.insert(std::string(parameter.declaration.text)).second) << parameter.key;
  }
}

TEST(WalkParameters, BlendGoesFromOneToTheOther) {
  WalkParameters from;
  WalkParameters to;
  int i = 0;
  for (auto& field : config::fieldsOf(to)) *field.real += 0.01 * ++i;
  const auto at = [&](double share) { return config::listParameters(blend(from, to, share)); };
  const auto begin = config::listParameters(from);
  const auto end = config::listParameters(to);
  const auto low = at(0.0);
  const auto middle = at(0.25);
  const auto high = at(1.0);
  for (std::size_t k = 0; k < begin.size(); ++k) {
    EXPECT_DOUBLE_EQ(low[k].value, begin[k].value);
    EXPECT_DOUBLE_EQ(high[k].value, end[k].value);
    EXPECT_NEAR(middle[k].value, 0.75 * begin[k].value + 0.25 * end[k].value, 1e-12);
  }
}

}  // namespace
}  // namespace nonet::motion
