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
    int exitCode = -1;           // if it ended by itself
    int signal = 0;              // if a signal ended it
    double processorTime = 0.0;  // s, once it has ended
    bool told = false;           // its end was reported
    std::string output;          // file with what it said
  };

  AgentProcesses();
  ~AgentProcesses();
  AgentProcesses(const AgentProcesses&) = delete;
  AgentProcesses& operator=(const AgentProcesses&) = delete;

  /// Starts a program; what it says goes into `output`. It dies with the thread that starts it, at the latest
  /// with this process. Throws std::runtime_error.
  void start(const std::vector<std::string>& command, const std::string& output);
  /// The same with `variables`, each NAME=value, added to its environment.
  void start(const std::vector<std::string>& command, const std::string& output,
             const std::vector<std::string>& variables);
  /// The same with a line for the shell. Whatever that starts in turn, in the background too, is stopped by
  /// stop(): it is known by a mark in its environment.
  void startShell(const std::string& line, const std::string& output);
  /// Looks who has ended since.
  void poll();
  /// Waits up to `seconds` for all to end by themselves, then asks (SIGTERM), then insists (SIGKILL).
  void stop(double seconds);

  std::vector<Process>& processes() { return processes_; }
  const std::vector<Process>& processes() const { return processes_; }

 private:
  bool waitFor(double seconds);
  void signalAll(int signal);
  std::vector<pid_t> marked() const;

  std::vector<Process> processes_;
  std::string mark_;    // NAME=value in the environment of all that is started here
  bool shell_ = false;  // a shell was started: there may be more than processes_ tells
};

/// How it ended, for people: "killed by signal 11 (Segmentation fault)", "exit code 1: ..." with its last
/// words.
std::string endingOf(const AgentProcesses::Process& process);

}  // namespace nonet::app
