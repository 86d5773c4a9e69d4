#include "nonet/agent/parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nonet/config/parameters.h"

namespace nonet::agent {
namespace {

TEST(AgentParameters, AreDeclaredWithoutFaults) {
  EXPECT_THAT(config::declarationFaults(AgentParameters{}), testing::IsEmpty());
}

}  // namespace
}  // namespace nonet::agent
