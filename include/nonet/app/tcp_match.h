// A match over TCP: the embedded server in this process, every agent a `nonet play` process of its own.
#pragma once

#include <string>

#include "nonet/app/console.h"
#include "nonet/lab/match/match.h"

namespace nonet::app {

struct TcpMatchSettings {
  lab::MatchSettings match;
  bool realTime = false;   // otherwise lock-step
  std::uint16_t port = 0;  // 0: any free one
  std::uint16_t monitorPort = 0;
  double answerTimeout = 10.0;  // s, lock-step
  std::string logs;             // folder for one log per agent; empty: none
  bool draw = false;            // on the RoboViz of this machine
  std::string traces;           // folder for one decision trace per agent; empty: none
};

/// Plays to the end, or to SIGINT or SIGTERM. Throws std::runtime_error if the match cannot begin.
lab::MatchResult playOverTcp(const TcpMatchSettings& settings, Console& console);

}  // namespace nonet::app
