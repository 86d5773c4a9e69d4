#include "nonet/lab/optimize/search_space.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace nonet::lab {
namespace {

TEST(SearchSpace, StartGivesTheBaseParametersBack) {
  agent::AgentParameters base;
  base.motion.sets.goToTarget.gait.stepHeight = 0.0437;
  const SearchSpace space(base, {"motion.walk."});
  const agent::AgentParameters same = space.apply(space.start());
  const auto before = config::listParameters(base);
  const auto after = config::listParameters(same);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_NEAR(before[i].value, after[i].value, 1e-12 * (1.0 + std::abs(before[i].value))) << before[i].key;
}

TEST(SearchSpace, SpansSearchRangeByOneAndStaysInTheDeclaredRange) {
  const SearchSpace space(agent::AgentParameters{}, {"motion.walk."});
  const auto all = config::listParameters(agent::AgentParameters{});
  ASSERT_GT(space.dimension(), 10);
  for (int i = 0; i < space.dimension(); ++i) {
    const std::string& key = space.keys()[static_cast<std::size_t>(i)];
    const auto it = std::find_if(all.begin(), all.end(), [&](const auto& view) { return view.key == key; });
    ASSERT_NE(it, all.end());
    EXPECT_DOUBLE_EQ(space.value(i, 0.0), it->declaration.searchRange->low);
    EXPECT_NEAR(space.value(i, 1.0), it->declaration.searchRange->high, 1e-12);
    EXPECT_NEAR(space.value(i, space.low()[i]), it->declaration.range.low, 1e-12);
    EXPECT_NEAR(space.value(i, space.high()[i]), it->declaration.range.high, 1e-12);
  }
  EXPECT_NO_THROW(space.apply(space.low()));
  EXPECT_NO_THROW(space.apply(space.high()));
}

TEST(SearchSpace, MovesOnlyWhatItNames) {
  const SearchSpace space(agent::AgentParameters{},
                          {"motion.walk.gait.stepHeight", "motion.sprint.gait.liftBegin"});
  ASSERT_EQ(space.keys(),
            (std::vector<std::string>{"motion.walk.gait.stepHeight", "motion.sprint.gait.liftBegin"}));
  Eigen::VectorXd point = space.start();
  point[0] += 0.1;
  const agent::AgentParameters moved = space.apply(point);
  const motion::WalkParameters defaults;
  EXPECT_NE(moved.motion.sets.goToTarget.gait.stepHeight, defaults.gait.stepHeight);
  EXPECT_EQ(moved.motion.sets.goToTarget.gait.footSeparation, defaults.gait.footSeparation);
  EXPECT_THROW(SearchSpace(agent::AgentParameters{}, {"motion.walk.gait.stepHight"}), std::runtime_error);
}

}  // namespace
}  // namespace nonet::lab
