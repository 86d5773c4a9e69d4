// A server that runs alongside a test, and what its clients say.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <string_view>
#include <thread>

#include <fmt/format.h>

#include "nonet/sim/server/server.h"

#include "sim/server/server_client.h"

namespace nonet::sim::test {

inline ServerSettings lockStep() {
  ServerSettings serverSettings;
  serverSettings.address = "127.0.0.1";
  serverSettings.agentPort = 0;
  serverSettings.monitorPort = 0;
  serverSettings.lockStep = true;
  serverSettings.realTime = false;
  return serverSettings;
}

inline ServerSettings inRealTime() {
  ServerSettings serverSettings = lockStep();
  serverSettings.lockStep = false;
  serverSettings.realTime = true;
  return serverSettings;
}

// A server that runs in its own thread until the end of the test.
class Running {
 public:
  explicit Running(const ServerSettings& serverSettings = lockStep(), const Settings& settings = {},
                   std::uint64_t seed = 1)
      : server(settings, seed, serverSettings) {
    server.onCycle([this](const Simulation&) { lost = server.statistics().lost; });
    thread_ = std::thread([this] {
      server.run();
      ended = true;
    });
  }
  ~Running() { stop(); }
  void stop() {
    server.stop();
    if (thread_.joinable()) thread_.join();
  }

  Server server;
  std::atomic<bool> ended{false};
  std::atomic<int> lost{0};  // agents that were, as of the last cycle

 private:
  std::thread thread_;
};

inline std::string sceneText(int type) {
  return fmt::format("(scene rsg/agent/nao/nao_hetero.rsg {})(syn)", type);
}
inline std::string initText(int unum, std::string_view team) {
  return fmt::format("(init (unum {})(teamname {}))(syn)", unum, team);
}

// Connects, introduces itself, and answers `cycles` messages; everything it got is in the result.
inline std::string play(std::uint16_t port, int type, int unum, std::string_view team, int cycles,
                        const std::function<std::string(int)>& answer = {}) {
  Client client(port);
  std::string log;
  client.send(sceneText(type));
  for (int i = 0; i <= cycles; ++i) {
    const auto message = client.receive();
    if (!message) return log + "LOST";
    log += *message + "\n";
    if (i == 0) {
      client.send(initText(unum, team));
    } else {
      client.send((answer ? answer(i) : std::string()) + "(syn)");
    }
  }
  return log;
}

}  // namespace nonet::sim::test
