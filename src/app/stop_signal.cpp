#include "nonet/app/stop_signal.h"

#include <atomic>
#include <csignal>

namespace nonet::app {

namespace {

std::atomic<bool> signalled{false};

void remember(int /*signal*/) {
  signalled = true;
}

// With SA_RESETHAND the second signal finds the default again. No SA_RESTART: what waits is to wake up.
void handle(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
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
