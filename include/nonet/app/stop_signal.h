// SIGINT and SIGTERM as a question that a long computation asks now and then, so that it ends with its
// result.
#pragma once

namespace nonet::app {

/// Catches both signals for as long as it lives; one at a time. A second signal ends the process at once.
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  /// Whether one came. From any thread.
  static bool came();
};

}  // namespace nonet::app
