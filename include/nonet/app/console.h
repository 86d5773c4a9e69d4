// A terminal with one line at the bottom that changes (progress) and lines above it that stay.
#pragma once

#include <chrono>
#include <cstdio>
#include <mutex>
#include <string>

#include "nonet/lab/common/progress.h"

namespace nonet::app {

class Console {
 public:
  /// `out`: stderr for a command whose standard output is for programs.
  explicit Console(std::FILE* out = stdout);

  /// Shows `line` in place of the last progress. At most four times a second on a terminal; elsewhere (a
  /// file, CI) every ten seconds as a line of its own.
  void progress(const std::string& line);
  /// Whether progress() would show something now.
  bool due() const;
  /// Shows the trials that a measurement has done. As long as the console.
  lab::TrialProgress trials();
  /// A line that stays. From any thread.
  void say(const std::string& line);
  /// Lets the last progress stay.
  void end();

 private:
  using Clock = std::chrono::steady_clock;

  std::FILE* out_;
  bool terminal_ = false;
  bool shown_ = false;
  Clock::time_point next_;
  mutable std::mutex mutex_;
};

/// What `measure` finds with these settings, its trials shown on stderr.
template <class Settings, class Measure>
auto measureShown(Settings settings, const Measure& measure) {
  Console console(stderr);
  settings.progress = console.trials();
  auto result = measure(settings);
  console.end();
  return result;
}

/// Writes the file whole or not at all, and names it on stderr.
void writeAndName(const std::string& path, const std::string& text);

}  // namespace nonet::app
