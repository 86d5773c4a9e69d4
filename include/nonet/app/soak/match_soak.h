// Unattended matches over TCP, one after the other: what breaks over hours.
#pragma once

#include <cstdint>
#include <string>

#include <nlohmann/json.hpp>

#include "nonet/app/console.h"

namespace nonet::app {

struct MatchSoakSettings {
  int matches = 100;
  double minutes = 10.0;       // of game time each
  int players = 9;             // a side
  double kickOffWait = 5.0;    // s
  double realTimeShare = 0.5;  // of the matches; the others in lock-step
  double elevenShare = 0.25;   // of the matches: eleven players a side
  std::uint64_t seed = 1;
  bool keepLogs = false;  // otherwise only those of matches that were not flawless
  std::string out;        // folder: matches.jsonl, result.json, the matches' files
};

/// Match number `index` of a run: decided by the seed, so that a run that was stopped can go on.
struct SoakMatch {
  int index = 0;
  bool realTime = false;
  int players = 9;
  std::uint64_t seed = 1;
};
SoakMatch soakMatch(const MatchSoakSettings& settings, int index);

/// What a line of matches.jsonl holds for a match with this result of `nonet match`, and nothing about files
/// and memory. A crash: somebody ended by a signal or an error; missing: never came; late: a message answered
/// after the next had come, or a server that gave up waiting.
nlohmann::ordered_json countFaults(const nlohmann::json& match);

/// All lines together: numbers are summed, those that begin with "most_" are the largest.
nlohmann::ordered_json sumUp(const std::vector<nlohmann::ordered_json>& matches);

/// Plays those that are not in matches.jsonl yet. True if all were played, and without a fault; in real time
/// a late message is counted, but is none. False as well after a signal.
bool soakMatches(const MatchSoakSettings& settings, Console& console);

}  // namespace nonet::app
