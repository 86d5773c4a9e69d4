// The agent processes of a match: started, watched, stopped; nobody else's.
#pragma once

#include <string>
#include <vector>

#include <sys/types.h>

namespace nonet::app {

class AgentProcesses {
 public:
  struct Process {
    pid_t pid = -1;
    bool running = false;
    int exitCode = -1;   // if it ended by itself
    int signal = 0;      // if a signal ended it
    bool told = false;   // its end was reported
    std::string output;  // file with what it said
  };

  AgentProcesses() = default;
  ~AgentProcesses();
  AgentProcesses(const AgentProcesses&) = delete;
  AgentProcesses& operator=(const AgentProcesses&) = delete;

  /// Starts a program; what it says goes into `output`. It dies with this process. Throws std::runtime_error.
  void start(const std::vector<std::string>& command, const std::string& output);
  /// Looks who has ended since.
  void poll();
  /// Waits up to `seconds` for all to end by themselves, then asks (SIGTERM), then insists (SIGKILL).
  void stop(double seconds);

  std::vector<Process>& processes() { return processes_; }

 private:
  bool waitFor(double seconds);
  void signalAll(int signal);

  std::vector<Process> processes_;
};

}  // namespace nonet::app
