// The `play` command without its command line: one agent, one TCP connection, one log file.
#pragma once

#include <memory>
#include <string>

#include "nonet/agent/session.h"
#include "nonet/protocol/log_file.h"

namespace nonet::app {

/// Exit codes of `nonet play`.
enum class PlayExit : int {
  Stopped = 0,   // by SIGINT or SIGTERM
  Error = 1,     // what the server sent makes no sense, or the log cannot be written
  NoServer = 2,  // nobody listened, or the server said nothing, within the time to wait
  ServerGone = 3,
  Refused = 4,  // the server did not take us into a team
};

struct PlaySettings {
  std::string host = "127.0.0.1";
  int port = 3100;
  agent::SessionSettings session;
  std::string record;  // log file; empty: none
  protocol::LogHeader recordHeader;
  std::string trace;       // file for the decision trace; empty: none
  std::string draw;        // host of RoboViz to draw on; empty: none
  std::string report;      // JSON of what was counted, written at the end; empty: none
  bool rescue = true;      // before the first message, free a lock-step server that hangs
  bool atOnce = false;     // introduce oneself without waiting for other agents of this machine
  double wait = 30.0;      // s until a server must have sent its first message
  bool reconnect = false;  // who has played and loses the connection looks for the server again, for `wait` s
  bool quiet = false;      // only errors
};

/// Plays until the server goes, refuses, or a signal comes. Says what happens on standard output, errors on
/// standard error.
PlayExit play(const PlaySettings& settings);

}  // namespace nonet::app
