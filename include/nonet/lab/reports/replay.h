// Runs the agent over a recorded log. Our own logs say which agent it was, so every byte it sent must come
// again; for foreign logs the whole stack runs and what it believes is compared with the truth, where the log
// holds it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "nonet/agent/session.h"

namespace nonet::lab {

struct ReplaySettings {
  std::string dataFolder;  // holds params/ and skills/
  // For foreign logs; what the log's own (scene ..) and (init ..) say comes first.
  std::optional<int> unum;
  std::optional<std::string> team;
  std::optional<int> robotType;
  // For our own logs too; their answers then differ.
  std::vector<std::string> parameterFiles;
  std::vector<std::string> assignments;  // single parameters, "world.useLines=0", set last
  /// Called after each message, with the agent stepped; for measurements.
  std::function<void(const agent::Session&)> observer;
  /// Called with each line of ground truth (JSON) that belongs to the message observed last.
  std::function<void(std::string_view)> truthObserver;
};

/// Median and 95th percentile of a sample.
struct Quantiles {
  std::size_t count = 0;
  double median = 0.0;
  double p95 = 0.0;
};

struct EffectorDifference {
  std::size_t line = 0;   // of the log
  double time = 0.0;      // server time of the message answered, s
  long cycle = 0;         // number of that message, from 1
  std::size_t token = 0;  // the first that differs, from 1
  std::string recorded;   // the list around that token: "(he1 0.123)"
  std::string replayed;
};

struct UnknownToken {
  std::size_t line = 0;  // of the log
  double time = 0.0;     // server time of the message, s
  std::string text;      // the list in question
};

struct ReplayReport {
  std::string file;
  bool own = false;     // written by our program: the answers are compared
  std::string problem;  // a torn or damaged end, or why this is no log, in a sentence
  bool sound = true;    // false: damaged, or no log at all. A torn end is sound, killed agents leave it.
  agent::SessionCounts counts;
  long roundtripDifferences = 0;  // messages that come out differently when written back
  long effectorDifferences = 0;   // answers that differ from the recorded ones (own logs)
  std::optional<EffectorDifference> firstDifference;
  std::vector<UnknownToken> unknown;       // the first of each of the first messages that hold one
  std::map<std::string, long> perceptors;  // how often each came
  double cycleMedian = 0.0;                // us of processor time per message: parse, agent, write
  double cycleP999 = 0.0;
  // Against mypos, myorien and ballpos, over the messages that hold them.
  std::optional<Quantiles> positionError;  // m, of the camera
  std::optional<Quantiles> headingError;   // rad
  std::optional<Quantiles> ballError;      // m, while the ball is known

  /// Nothing lost, unknown or different.
  bool clean() const {
    return effectorDifferences == 0 && roundtripDifferences == 0 && counts.unknownTokens == 0;
  }
  nlohmann::ordered_json toJson() const;
  std::string toText() const;
};

/// Throws protocol::LogError that names the file if it cannot be read or what stands in its header makes no
/// agent, config::ParameterError for wrong settings. A damaged header line is a report that is not sound.
ReplayReport replay(const std::string& path, const ReplaySettings& settings);

/// The agent's configuration as the log tells it. Throws protocol::LogError.
agent::AgentSettings agentOfLog(const std::string& path, const ReplaySettings& settings);

}  // namespace nonet::lab
