// Alarms against a queue in which their handlers wait behind others, as under load.
#include "nonet/app/alarm.h"

#include <chrono>
#include <optional>
#include <thread>

#include <asio.hpp>
#include <gtest/gtest.h>

namespace nonet::app {
namespace {

using namespace std::chrono_literals;

/// Runs `action` at a moment when every timer that is due at once is in the queue already, behind it.
template <class Action>
void amongQueuedTimers(asio::io_context& io, Action action) {
  asio::post(io, [&io, action] {
    std::this_thread::sleep_for(5ms);
    asio::post(io, action);
  });
}

TEST(Alarm, RunsOnceAfterItsTime) {
  asio::io_context io;
  Alarm alarm(io);
  int rings = 0;
  const auto begin = std::chrono::steady_clock::now();
  alarm.set(0.02, [&] { ++rings; });
  io.run();
  EXPECT_EQ(rings, 1);
  EXPECT_GE(std::chrono::steady_clock::now() - begin, 20ms);
}

// The trap itself: without generations a cancelled timer runs. If Asio should ever change, this says so.
TEST(Alarm, APlainTimerRingsThoughCancelled) {
  asio::io_context io{1};
  asio::steady_timer timer(io);
  int rings = 0;
  timer.expires_after(1ms);
  timer.async_wait([&](std::error_code error) { rings += error ? 0 : 1; });
  amongQueuedTimers(io, [&] { timer.cancel(); });
  io.run();
  EXPECT_EQ(rings, 1);
}

TEST(Alarm, NeverRingsOnceCancelledThoughItsHandlerIsQueued) {
  asio::io_context io{1};
  Alarm alarm(io);
  int rings = 0;
  alarm.set(0.001, [&] { ++rings; });
  amongQueuedTimers(io, [&] { alarm.cancel(); });
  io.run();
  EXPECT_EQ(rings, 0);
}

TEST(Alarm, RingsForTheNewestSettingOnly) {
  asio::io_context io{1};
  Alarm alarm(io);
  int first = 0;
  int second = 0;
  alarm.set(0.001, [&] { ++first; });
  amongQueuedTimers(io, [&] { alarm.set(0.01, [&] { ++second; }); });
  io.run();
  EXPECT_EQ(first, 0);
  EXPECT_EQ(second, 1);
}

TEST(Alarm, NeverRingsOnceDestroyed) {
  asio::io_context io{1};
  std::optional<Alarm> alarm(io);
  int rings = 0;
  alarm->set(0.001, [&] { ++rings; });
  amongQueuedTimers(io, [&] { alarm.reset(); });
  io.run();
  EXPECT_EQ(rings, 0);
}

// More nanoseconds than the clock can count are no reason to ring at once.
TEST(Alarm, RingsNotSoonForATimeBeyondTheClock) {
  for (const double seconds : {1e10, 1e300}) {
    asio::io_context io;
    Alarm alarm(io);
    int rings = 0;
    alarm.set(seconds, [&] { ++rings; });
    io.run_for(20ms);
    EXPECT_EQ(rings, 0) << seconds;
  }
}

}  // namespace
}  // namespace nonet::app
