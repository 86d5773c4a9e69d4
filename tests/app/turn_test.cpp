#include "nonet/app/turn.h"

#include <gtest/gtest.h>

namespace nonet::app {
namespace {

asio::ip::tcp::endpoint at(const char* address, unsigned short port) {
  return {asio::ip::make_address(address), port};
}

TEST(Turn, OneServerHasOneQueueWhateverItIsCalled) {
  Turn first;
  EXPECT_TRUE(first.take()) << "no queue yet";
  first.queueFor(at("127.0.0.1", 7));
  EXPECT_TRUE(first.take());
  for (const char* same : {"127.0.0.1", "127.0.1.1", "::1", "::ffff:127.0.0.1", "0.0.0.0", "::"}) {
    Turn other;
    other.queueFor(at(same, 7));
    EXPECT_FALSE(other.take()) << same;
    first.release();
    EXPECT_TRUE(other.take()) << same;
    other.release();
    EXPECT_TRUE(first.take()) << same;
  }
  for (const auto& elsewhere : {at("127.0.0.1", 8), at("192.0.2.1", 7), at("2001:db8::1", 7)}) {
    Turn other;
    other.queueFor(elsewhere);
    EXPECT_TRUE(other.take()) << elsewhere;
  }
  first.queueFor(at("192.0.2.1", 7));
  Turn other;
  other.queueFor(at("127.0.0.1", 7));
  EXPECT_TRUE(other.take()) << "who queues elsewhere leaves";
}

}  // namespace
}  // namespace nonet::app
