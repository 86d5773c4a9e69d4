#include "nonet/app/console.h"

#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace nonet::app {

Console::Console() : terminal_(::isatty(STDOUT_FILENO) != 0), next_(Clock::now()) {}

bool Console::due() const {
  const std::lock_guard lock(mutex_);
  return Clock::now() >= next_;
}

void Console::progress(const std::string& line) {
  const std::lock_guard lock(mutex_);
  if (Clock::now() < next_) return;
  next_ = Clock::now() + (terminal_ ? std::chrono::milliseconds(250) : std::chrono::milliseconds(10000));
  fmt::print("{}{}{}", terminal_ ? "\r\033[K" : "", line, terminal_ ? "" : "\n");
  std::fflush(stdout);
  shown_ = terminal_;
}

void Console::say(const std::string& line) {
  const std::lock_guard lock(mutex_);
  fmt::print("{}{}\n", shown_ ? "\r\033[K" : "", line);
  std::fflush(stdout);
  shown_ = false;
}

void Console::end() {
  const std::lock_guard lock(mutex_);
  if (shown_) fmt::print("\n");
  shown_ = false;
}

}  // namespace nonet::app
