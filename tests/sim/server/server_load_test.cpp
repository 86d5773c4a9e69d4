// The server on the loopback with clients that send too much, too little or too early.
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include "sim/server/running_server.h"

namespace nonet::sim::test {
namespace {

using LoadClock = std::chrono::steady_clock;

double secondsSince(LoadClock::time_point begin) {
  return std::chrono::duration<double>(LoadClock::now() - begin).count();
}

// Clients that send commands without pause, each from a thread of its own, until the end or until `seconds`
// have passed.
class Flood {
 public:
  Flood(std::uint16_t port, int clients, double seconds) {
    for (int i = 0; i < clients; ++i) {
      threads_.emplace_back([this, port, seconds] {
        Client client(port);
        std::string bytes;
        for (int k = 0; k < 20000; ++k) protocol::appendFrame(bytes, "(he1 1)");
        const auto begin = LoadClock::now();
        while (!stopping_ && secondsSince(begin) < seconds && client.sendBytes(bytes)) {
        }
      });
    }
  }
  ~Flood() { stop(); }
  void stop() {
    stopping_ = true;
    for (std::thread& thread : threads_) {
      if (thread.joinable()) thread.join();
    }
  }

 private:
  std::atomic<bool> stopping_{false};
  std::vector<std::thread> threads_;
};

// One of the next so many messages says this; each is answered, if with anything.
bool hears(Client& client, std::string_view wanted, int messages, std::string_view answer = {}) {
  for (int i = 0; i < messages; ++i) {
    const auto message = client.receive(5.0);
    if (!message) return false;
    if (!answer.empty()) client.send(answer);
    if (message->find(wanted) != std::string::npos) return true;
  }
  return false;
}

// How long a player's first cycles take while others flood the server.
void expectPlayUnderFlood(const ServerSettings& serverSettings) {
  Running running(serverSettings);
  constexpr int kFlooders = 4;
  constexpr double kFloodLasts = 15.0;  // s
  Flood flood(running.server.agentPort(), kFlooders, kFloodLasts);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const auto begin = LoadClock::now();
  EXPECT_EQ(play(running.server.agentPort(), 0, 1, "A", 40).find("LOST"), std::string::npos);
  EXPECT_LT(secondsSince(begin), 0.6 * kFloodLasts) << "nobody waits for the end of the flood";
  flood.stop();
  // What they have sent is read to its end, share by share. The player's own is one more.
  const auto end = LoadClock::now();
  while (running.lost < kFlooders + 1 && secondsSince(end) < 60.0)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  running.stop();
  EXPECT_EQ(running.server.statistics().lost, kFlooders + 1);
}

TEST(BadClient, AFloodDoesNotHoldUpOthersInRealTime) {
  expectPlayUnderFlood(inRealTime());
}

TEST(BadClient, AFloodDoesNotHoldUpOthersInLockStep) {
  expectPlayUnderFlood(lockStep());
}

TEST(BadClient, TheServerCanBeStoppedUnderAFlood) {
  Running running(inRealTime());
  const Flood flood(running.server.agentPort(), 4, 15.0);
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  const auto begin = LoadClock::now();
  running.stop();
  EXPECT_LT(secondsSince(begin), 5.0);
}

// In lock-step the answer counts, however much comes before it.
TEST(LockStep, AnAnswerBehindMuchElseIsFound) {
  Running running;
  Client client(running.server.agentPort());
  client.send(sceneText(0));
  ASSERT_TRUE(client.receive());
  std::string bytes;
  while (bytes.size() < 300000) protocol::appendFrame(bytes, "(he1 1)");
  protocol::appendFrame(bytes, "(syn)");
  client.sendBytes(bytes);
  const auto begin = LoadClock::now();
  EXPECT_TRUE(client.receive());
  EXPECT_LT(secondsSince(begin), 5.0);
  client.close();
  running.stop();
  EXPECT_EQ(running.server.statistics().timeouts, 0);
}

TEST(LockStep, TheClockIsRealWhenNobodyAnswersAnyMore) {
  ServerSettings serverSettings = lockStep();
  serverSettings.answerTimeout = 0.2;
  const Running running(serverSettings);
  Client silent(running.server.agentPort());
  const auto begin = LoadClock::now();
  silent.send(sceneText(0));
  ASSERT_TRUE(silent.receive());
  ASSERT_TRUE(silent.receive(5.0)) << "the server gives up waiting";
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(silent.receive(5.0));
  EXPECT_GT(secondsSince(begin), 0.8) << "50 cycles of 20 ms";
}

// The scene waits while another robot is being born; init, sent as blindly, must not be lost with it.
TEST(RealTime, AnInitThatComesWhileTheSceneIsHeldBackCounts) {
  const Running running(inRealTime());
  Client first(running.server.agentPort());
  first.send(sceneText(0));
  Client second(running.server.agentPort());
  second.send(sceneText(0));
  second.send(initText(2, "A"));
  ASSERT_TRUE(first.receive());
  first.send(initText(1, "A"));
  EXPECT_TRUE(hears(second, "(unum 2)", 50));
}

// Does something as soon as the server says this, before the server goes on.
class WhenItSays {
 public:
  WhenItSays(std::string text, std::function<void()> action)
      : sink_(std::make_shared<Sink>(std::move(text), std::move(action))) {
    spdlog::default_logger()->sinks().push_back(sink_);
  }
  ~WhenItSays() { std::erase(spdlog::default_logger()->sinks(), sink_); }
  WhenItSays(const WhenItSays&) = delete;
  WhenItSays& operator=(const WhenItSays&) = delete;

 private:
  class Sink : public spdlog::sinks::base_sink<std::mutex> {
   public:
    Sink(std::string text, std::function<void()> action)
        : text_(std::move(text)), action_(std::move(action)) {}

   private:
    void sink_it_(const spdlog::details::log_msg& message) override {
      const std::string_view said(message.payload.data(), message.payload.size());
      if (said.find(text_) != std::string_view::npos) action_();
    }
    void flush_() override {}

    std::string text_;
    std::function<void()> action_;
  };

  std::shared_ptr<spdlog::sinks::sink> sink_;
};

// It is in the lobby when the match starts without it, and its init comes before its robot is built anew.
TEST(LockStep, AnInitThatComesJustAfterTheStartCounts) {
  ServerSettings serverSettings = lockStep();
  serverSettings.players = 1;
  std::atomic<Client*> waiting{nullptr};
  int starts = 0;
  const WhenItSays whenItSays("the match starts", [&] {
    ++starts;
    waiting.load()->send(initText(2, "A"));
  });
  Running running(serverSettings);
  Client late(running.server.agentPort());
  waiting = &late;
  late.send(sceneText(0));
  ASSERT_TRUE(late.receive()) << "the lobby's answer";
  Client ready(running.server.agentPort());
  ready.send(sceneText(0));
  ASSERT_TRUE(ready.receive());
  ready.send(initText(1, "A"));
  bool plays = false;
  for (int i = 0; i < 100 && !plays; ++i) {
    ASSERT_TRUE(ready.receive());
    ready.send("(syn)");
    const auto message = late.receive(0.5);
    if (!message) continue;
    late.send("(syn)");
    plays = message->find("(unum 2)") != std::string::npos;
  }
  EXPECT_TRUE(plays);
  running.stop();
  EXPECT_EQ(starts, 1);
}

TEST(Lobby, NobodyEntersAsARobotThatDoesNotExist) {
  ServerSettings serverSettings = lockStep();
  serverSettings.players = 1;
  const Running running(serverSettings);
  Client client(running.server.agentPort());
  client.send("(scene rsg/agent/nao/nao_hetero.rsg 5)(syn)");
  EXPECT_FALSE(client.receive(0.5));
  client.send("(scene rsg/agent/nao/nao.rsg 100000000)(syn)");  // type 0, whatever follows
  ASSERT_TRUE(client.receive());
  client.send(initText(1, "A"));
  EXPECT_TRUE(hears(client, "(unum 1)", 10, "(syn)"));
}

}  // namespace
}  // namespace nonet::sim::test
