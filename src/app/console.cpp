#include "nonet/app/console.h"

#include <fmt/format.h>
#include <unistd.h>

#include "nonet/lab/common/atomic_file.h"

namespace nonet::app {

Console::Console(std::FILE* out) : out_(out), terminal_(::isatty(::fileno(out)) != 0), next_(Clock::now()) {}

bool Console::due() const {
  const std::lock_guard lock(mutex_);
  return Clock::now() >= next_;
}

void Console::progress(const std::string& line) {
  const std::lock_guard lock(mutex_);
  if (Clock::now() < next_) return;
  next_ = Clock::now() + (terminal_ ? std::chrono::milliseconds(250) : std::chrono::milliseconds(10000));
  fmt::print(out_, "{}{}{}", terminal_ ? "\r\033[K" : "", line, terminal_ ? "" : "\n");
  std::fflush(out_);
  shown_ = terminal_;
}

lab::TrialProgress Console::trials() {
  return [this](const std::string& what, int done, int all) {
    progress(fmt::format("{}: {} of {}", what, done, all));
  };
}

void Console::say(const std::string& line) {
  const std::lock_guard lock(mutex_);
  fmt::print(out_, "{}{}\n", shown_ ? "\r\033[K" : "", line);
  std::fflush(out_);
  shown_ = false;
}

void Console::end() {
  const std::lock_guard lock(mutex_);
  if (shown_) fmt::print(out_, "\n");
  shown_ = false;
}

void writeAndName(const std::string& path, const std::string& text) {
  lab::writeAtomically(path, text);
  fmt::print(stderr, "{}\n", path);
}

}  // namespace nonet::app
