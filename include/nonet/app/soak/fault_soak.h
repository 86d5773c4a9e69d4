// Faults during a match, at random times: what happens to an agent, to a connection, to the server, to the
// disk. The others play on, and whoever was hit is back in play soon.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "nonet/app/console.h"

namespace nonet::app {

struct FaultSoakSettings {
  int times = 5;           // each kind of fault
  int players = 3;         // a side, 2..11
  double pause = 3.0;      // s between two faults, half of it to one and a half of it
  double patience = 10.0;  // s until who was hit must be back in play
  std::uint64_t seed = 1;
  std::vector<std::string> kinds;  // empty: all of faultKinds()
  std::string out;                 // folder
};

/// Their names, as the option takes them.
std::vector<std::string> faultKinds();

/// Plays a match in real time and harms it. The result: per kind how often, how many came back in time and
/// with all others in play, the longest time that took (s), and what went wrong in words.
nlohmann::ordered_json soakFaults(const FaultSoakSettings& settings, Console& console);

}  // namespace nonet::app
