// The simulation on the network (server facts, sections 1, 5 and 6): agents on one TCP port, monitors and
// trainers on another, in real time, in lock-step or as fast as it goes. One thread does everything, so that
// a run in lock-step depends on nothing but what the agents send.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "nonet/math/duration_counts.h"
#include "nonet/sim/settings/settings.h"
#include "nonet/sim/simulation.h"

namespace nonet::sim {

struct ServerSettings {
  /// To listen on: this machine only, since whoever reaches the trainer's port is obeyed.
  std::string address = "127.0.0.1";
  std::uint16_t agentPort = 3100;  // 0: any free one, see Server::agentPort()
  std::uint16_t monitorPort = 3200;
  int mostConnections = 64;  // of agents, and as many of monitors and trainers; one more is closed at once
  int mostPerAddress = 32;   // of these from one address, so that no machine can take all places
  bool lockStep = false;  // each cycle waits for the answer, ended by (syn), of every agent that has a robot
  bool realTime = true;   // never faster than 20 ms per cycle; a cycle that takes longer slows the match down
  /// Lock-step: an agent that does not answer for so long is no longer waited for, until it answers again.
  /// Seconds.
  double answerTimeout = 10.0;
  /// If not 0: nothing happens until so many agents are initialised; they then enter in the order of team and
  /// number, which makes a match in lock-step reproducible.
  int players = 0;
  std::string monitorLog;      // file to record the monitor stream into; empty: none
  bool endWithMatch = false;   // run() returns 1 s of simulated time after the end of the match
  bool handleSignals = false;  // SIGINT and SIGTERM end run()
};

class Server {
 public:
  /// Opens both ports. Throws std::runtime_error naming the port if one is taken, or the log file.
  Server(const Settings& settings, std::uint64_t seed, const ServerSettings& serverSettings);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  std::uint16_t agentPort() const;
  std::uint16_t monitorPort() const;

  /// Serves until stop(), a trainer's (killsim), a signal or the end of the match.
  void run();
  /// From any thread: run() returns after the present cycle, at once when it waits.
  void stop();

  /// Called after every cycle, in the thread of run().
  void onCycle(std::function<void(const Simulation&)> callback);
  /// Only from the thread of run(), or while it does not run.
  const Simulation& simulation() const;

  /// What happened to connections so far, for reports and tests.
  struct Statistics {
    int accepted = 0;
    int lost = 0;              // vanished or closed by the agent
    int refused = 0;           // closed by the server: oversize messages, or one connection too many
    long droppedMessages = 0;  // sense and monitor messages that a slow reader did not get
    int timeouts = 0;          // lock-step: times that an agent was given up waiting for
    int skippedExpressions = 0;
    // In real time:
    DurationCounts answers;  // from a sense message until its answer is read, after the physics
    DurationCounts delays;   // by which cycles began later than 20 ms after the one before
  };
  /// Not while another thread is in run().
  Statistics statistics() const;
  /// After run(): why the monitor log is not whole, with its name; empty if it is, or none was asked for.
  std::string recordingError() const;

  struct Implementation;

 private:
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace nonet::sim
