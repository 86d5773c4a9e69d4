// Counts the calls of operator new in this program: what an agent does in each cycle must make none.
#include <cstddef>
#include <cstdlib>
#include <new>
#include <string>

#include <gtest/gtest.h>

#include "nonet/protocol/effectors.h"
#include "nonet/protocol/framing.h"
#include "nonet/protocol/percept_text.h"

#include "golden.h"

namespace {

std::size_t allocations = 0;

void* countedAllocation(std::size_t size) {
  ++allocations;
  void* memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return memory;
}

}  // namespace

void* operator new(std::size_t size) {
  return countedAllocation(size);
}
void* operator new[](std::size_t size) {
  return countedAllocation(size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace nonet::protocol {
namespace {

TEST(Allocation, NoneInSteadyState) {
  const auto received = goldenLines(LogLine::Kind::Received);
  const auto sent = goldenLines(LogLine::Kind::Sent);
  std::string stream;
  for (const std::string& message : received) {
    appendFrame(stream, message);
  }
  FrameReader frames;
  Percept percept;
  Effectors effectors;
  std::string text;
  std::string answer;
  std::size_t messages = 0;
  const auto cycle = [&] {
    for (std::size_t at = 0; at < stream.size(); at += 1460) {  // as TCP segments come
      frames.append(std::string_view(stream).substr(at, 1460));
      while (const auto message = frames.next()) {
        parsePercept(*message, percept);
        writePercept(percept, text);
        parseEffectors(sent[messages % sent.size()], effectors);
        roundAsWritten(effectors);
        writeEffectors(effectors, text);
        answer.clear();
        appendFrame(answer, text);
        ++messages;
      }
    }
  };
  cycle();
  const std::size_t before = allocations;
  ASSERT_GT(before, 0U);
  cycle();
  EXPECT_EQ(allocations, before);
  EXPECT_EQ(messages, 2 * received.size());
}

}  // namespace
}  // namespace nonet::protocol
