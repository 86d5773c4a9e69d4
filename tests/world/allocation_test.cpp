// Counts the calls of operator new in this program: the world stage must make none in steady state.
#include <cstddef>
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include "nonet/world/world_model.h"

#include "recording.h"

namespace {

long allocations = 0;

[[gnu::noinline]] void* countedAllocation(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void release(void* memory) {
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) {
  return countedAllocation(size);
}
void* operator new[](std::size_t size) {
  return countedAllocation(size);
}
void operator delete(void* memory) noexcept {
  release(memory);
}
void operator delete[](void* memory) noexcept {
  release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  release(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  release(memory);
}

namespace nonet::world {
namespace {

TEST(Allocation, NoneInSteadyState) {
  for (const char* file : {"wander.log.gz", "game_fall.log.gz"}) {
    WorldModel world(model::robotModel(0), {}, protocol::TeamName("Probe"), 1);
    int messages = 0;
    long during = 0;
    test::readRecording(file, [&](const protocol::Percept& percept) {
      const long before = allocations;
      world.update(percept);
      if (++messages > 100) during += allocations - before;
    });
    EXPECT_EQ(during, 0) << file;
  }
}

}  // namespace
}  // namespace nonet::world
