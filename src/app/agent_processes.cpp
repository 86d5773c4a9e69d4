#include "nonet/app/agent_processes.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace nonet::app {

AgentProcesses::~AgentProcesses() {
  stop(0.0);
}

void AgentProcesses::start(const std::vector<std::string>& command, const std::string& output) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid < 0) throw std::runtime_error("cannot start an agent: out of processes or memory");
  if (pid == 0) {
    // Only calls that are safe between fork and exec.
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) ::_exit(127);
    const int in = ::open("/dev/null", O_RDONLY);
    const int out = ::open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (in >= 0) ::dup2(in, STDIN_FILENO);
    if (out >= 0) {
      ::dup2(out, STDOUT_FILENO);
      ::dup2(out, STDERR_FILENO);
    }
    ::close_range(STDERR_FILENO + 1, ~0U, 0);  // sockets that are closed here are not to live on there
    ::setpgid(0, 0);  // Ctrl-C in the terminal is for the match, which then stops its agents
    ::execv(arguments[0], arguments.data());
    ::_exit(127);
  }
  Process process;
  process.pid = pid;
  process.running = true;
  process.output = output;
  processes_.push_back(process);
}

void AgentProcesses::poll() {
  for (Process& process : processes_) {
    if (!process.running) continue;
    int status = 0;
    if (::waitpid(process.pid, &status, WNOHANG) != process.pid) continue;
    process.running = false;
    if (WIFEXITED(status)) process.exitCode = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) process.signal = WTERMSIG(status);
  }
}

bool AgentProcesses::waitFor(double seconds) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  for (;;) {
    poll();
    if (std::none_of(processes_.begin(), processes_.end(), [](const Process& p) { return p.running; })) {
      return true;
    }
    if (std::chrono::steady_clock::now() >= deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

void AgentProcesses::signalAll(int signal) {
  for (const Process& process : processes_) {
    if (process.running) ::kill(process.pid, signal);
  }
}

void AgentProcesses::stop(double seconds) {
  if (waitFor(seconds)) return;
  signalAll(SIGTERM);
  signalAll(SIGCONT);
  if (waitFor(2.0)) return;
  signalAll(SIGKILL);
  waitFor(2.0);
}

}  // namespace nonet::app
