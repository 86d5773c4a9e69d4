#include "nonet/app/stop_signal.h"

#include <atomic>
#include <csignal>

namespace nonet::app {

namespace {

std::atomic<bool> signalled{false};

// No SA_RESTART: what waits is to wake up.
void handle(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

// The second signal finds the default again, whichever of the two it is; SA_RESETHAND resets only its own.
void remember(int /*signal*/) {
  signalled = true;
  handle(SIG_DFL);
}

}  // namespace

StopSignal::StopSignal() {
  signalled = false;
  handle(remember);
}

StopSignal::~StopSignal() {
  handle(SIG_DFL);
}

bool StopSignal::came() {
  return signalled;
}

}  // namespace nonet::app
