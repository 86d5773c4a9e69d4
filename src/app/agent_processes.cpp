#include "nonet/app/agent_processes.h"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/close_range.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace nonet::app {

namespace {

std::string newMark() {
  static std::atomic<int> next{0};
  return fmt::format("NONET_GAME={}-{}", ::getpid(), next++);
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

std::vector<char*> pointersTo(const std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (const std::string& text : texts) pointers.push_back(const_cast<char*>(text.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

// Only calls that are safe between fork and exec.
[[noreturn]] void becomeAgent(pid_t parent, char* const* arguments, char* const* environment,
                              const char* output) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(127);
  const int in = ::open("/dev/null", O_RDONLY);
  const int out = ::open(output, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (in >= 0) ::dup2(in, STDIN_FILENO);
  if (out >= 0) {
    ::dup2(out, STDOUT_FILENO);
    ::dup2(out, STDERR_FILENO);
  }
  // Connections of other matches in this process would otherwise stay open in here after their end.
  ::close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC);
  ::setpgid(0, 0);  // Ctrl-C in the terminal is for the match, which then stops its agents
  ::execve(arguments[0], arguments, environment);
  ::_exit(127);
}

}  // namespace

AgentProcesses::AgentProcesses() : mark_(newMark()) {}

AgentProcesses::~AgentProcesses() {
  stop(0.0);
}

void AgentProcesses::start(const std::vector<std::string>& command, const std::string& output) {
  start(command, output, std::vector<std::string>{});
}

void AgentProcesses::start(const std::vector<std::string>& command, const std::string& output,
                           const std::vector<std::string>& variables) {
  const std::vector<char*> arguments = pointersTo(command);
  // Of two variables with the same name the first counts.
  std::vector<std::string> all = {mark_};
  all.insert(all.end(), variables.begin(), variables.end());
  for (char** variable = environ; *variable != nullptr; ++variable) all.emplace_back(*variable);
  const std::vector<char*> environment = pointersTo(all);
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid < 0) throw std::runtime_error("cannot start an agent: out of processes or memory");
  if (pid == 0) becomeAgent(parent, arguments.data(), environment.data(), output.c_str());
  Process process;
  process.pid = pid;
  process.running = true;
  process.output = output;
  processes_.push_back(process);
}

void AgentProcesses::startShell(const std::string& line, const std::string& output) {
  shell_ = true;
  start({"/bin/sh", "-c", line}, output);
}

void AgentProcesses::poll() {
  for (Process& process : processes_) {
    if (!process.running) continue;
    int status = 0;
    rusage usage{};
    if (::wait4(process.pid, &status, WNOHANG, &usage) != process.pid) continue;
    process.running = false;
    process.processorTime = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    if (WIFEXITED(status)) process.exitCode = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) process.signal = WTERMSIG(status);
  }
}

// Who was started by a shell of ours and is not our child: its environment tells. Nobody else's can be read.
std::vector<pid_t> AgentProcesses::marked() const {
  std::vector<pid_t> found;
  if (!shell_) return found;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", error)) {
    const std::string name = entry.path().filename().string();
    pid_t pid = 0;
    const auto [end, failure] = std::from_chars(name.data(), name.data() + name.size(), pid);
    if (failure != std::errc() || end != name.data() + name.size()) continue;
    std::ifstream file(entry.path() / "environ", std::ios::binary);
    const std::string variables{std::istreambuf_iterator<char>(file), {}};
    if (variables.starts_with(mark_ + '\0') || variables.find('\0' + mark_ + '\0') != std::string::npos)
      found.push_back(pid);
  }
  return found;
}

bool AgentProcesses::waitFor(double seconds) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  for (;;) {
    poll();
    const bool running =
        std::any_of(processes_.begin(), processes_.end(), [](const Process& p) { return p.running; });
    if (!running && marked().empty()) return true;
    if (std::chrono::steady_clock::now() >= deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(shell_ ? 50 : 10));
  }
}

void AgentProcesses::signalAll(int signal) {
  for (const Process& process : processes_) {
    if (process.running) ::kill(process.pid, signal);
  }
  for (const pid_t pid : marked()) ::kill(pid, signal);
}

void AgentProcesses::stop(double seconds) {
  if (waitFor(seconds)) return;
  signalAll(SIGTERM);
  signalAll(SIGCONT);
  if (waitFor(2.0)) return;
  signalAll(SIGKILL);
  waitFor(2.0);
}

std::string endingOf(const AgentProcesses::Process& process) {
  if (process.signal != 0)
    return fmt::format("killed by signal {} ({})", process.signal, ::strsignal(process.signal));
  std::string last;
  std::ifstream output(process.output);
  for (std::string line; std::getline(output, line);) {
    if (!line.empty()) last = line;
  }
  return fmt::format("exit code {}: {}", process.exitCode, last);
}

}  // namespace nonet::app
