// Whole matches between two teams of our agents: what is counted in them, and how they are played in one
// process, without sockets and text. Over TCP the `match` command plays them.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "nonet/agent/agent.h"
#include "nonet/agent/agent_setup.h"
#include "nonet/math/duration_counts.h"
#include "nonet/sim/invariants.h"
#include "nonet/sim/settings/settings.h"
#include "nonet/sim/simulation.h"

namespace nonet::lab {

struct TeamSettings {
  std::string name;
  int players = 9;  // numbers 1 to players; 0: the team stays away
  std::vector<std::string> parameterFiles;
  std::string dataFolder;                // with params/ and skills/; empty: the program's own
  std::vector<std::string> assignments;  // single parameters, set last
  std::vector<int> robotTypes = {};      // of the numbers from 1; empty: the usual ones
};

struct MatchSettings {
  TeamSettings left{"Nonet", 9, {}, {}, {}};
  TeamSettings right{"Guests", 9, {}, {}, {}};
  std::uint64_t seed = 1;
  double minutes = 10.0;   // of game time in all, two halves
  double kickOffWait = 5;  // s of simulated time before each half, to take one's place
  sim::Settings settings;
  std::string monitorLog;  // file for the monitor stream, none if empty
  bool check = false;      // watch the simulation's invariants
};

/// Throws std::runtime_error if there is not one type for each player, or the server would refuse one of them
/// (server facts 1.4). No types at all are the usual ones.
void checkRobotTypes(const std::vector<int>& robotTypes, int players);

/// Who plays, for people.
std::string matchTitle(const MatchSettings& match);

/// The settings of a match as chosen: half time, automatic kick-off, names of the teams.
sim::Settings simulationSettings(const MatchSettings& match);

/// Names of the agents' parameters have a dot (team.ball.kick=false), those of the server's settings have
/// none (QuickSolver=true).
bool namesParameter(std::string_view assignment);

/// One of the server's settings, Name=Value. Throws std::runtime_error for those that simulationSettings()
/// overwrites, with the option that sets them.
void setServerSetting(sim::Settings& settings, const std::string& assignment);

/// One robot's agent as chosen.
agent::AgentChoice agentChoice(const MatchSettings& match, bool rightTeam, int unum);

/// What happened to one player.
struct PlayerRecord {
  bool rightTeam = false;
  std::string team;
  int unum = 0;
  int robotType = 0;
  bool connected = false;           // came to play at all
  bool gone = false;                // left before the end
  int falls = 0;                    // times it lay down, whoever was to blame
  double standingAfterKickOff = 0;  // s on the game's clock until the first fall, or until the end
  // From the agent's own report.
  long messages = 0;
  long passedOver = 0;  // messages answered too late: a newer one was there already
  long lostCycles = 0;  // cycles whose message never came
  std::string ending;   // "" for an agent that played to the end, otherwise why it did not
};

struct MatchResult {
  std::string teamLeft;
  std::string teamRight;
  int scoreLeft = 0;
  int scoreRight = 0;
  double gameTime = 0.0;  // s
  bool finished = false;  // reached GameOver
  long cycles = 0;
  double wallTime = 0.0;  // s, from the first cycle
  std::uint64_t seed = 0;
  std::uint64_t signature = 0;   // of the simulation at the end: equal matches have equal ones
  long timeouts = 0;             // lock-step: times that the server gave up waiting for an agent
  long droppedMessages = 0;      // that slow readers did not get
  DurationCounts answers;        // real time: agents' answers, at the server
  DurationCounts delays;         // real time: by which cycles began too late
  std::uint64_t violations = 0;  // of invariants, if they were watched
  std::string invariants;        // what was watched and found, lines; empty if not
  std::vector<PlayerRecord> players;
  std::vector<std::string> warnings;  // recordings that are not whole, each with the file's name

  int falls(bool rightTeam) const;
  /// Every player came, stayed to the end, and answered every message in time; every recording is whole.
  bool flawless() const;
  nlohmann::ordered_json toJson() const;
  std::string toText() const;
};

/// Watches a simulation cycle by cycle. Needs nothing of the agents.
class MatchWatcher {
 public:
  explicit MatchWatcher(const MatchSettings& match);

  void update(const sim::Simulation& simulation);
  /// So far.
  const MatchResult& result() const { return result_; }
  MatchResult& result() { return result_; }
  /// The result with the simulation's signature.
  MatchResult finish(const sim::Simulation& simulation);
  /// One line: clock, score, play mode, ball, falls per team.
  std::string progress(const sim::Simulation& simulation) const;

 private:
  enum class Stance : std::uint8_t { Unknown, Standing, Fallen };

  PlayerRecord* find(bool rightTeam, int unum);

  MatchResult result_;
  std::vector<Stance> stances_;  // beside result_.players
  std::optional<sim::Invariants> invariants_;
};

/// A message that an agent has absorbed, and what it made of it.
struct Thought {
  sim::AgentHandle handle = sim::kNoAgent;
  const protocol::Percept& percept;
  const agent::Agent& agent;
  const protocol::Effectors& answer;
};

/// What may be watched in a match in one process.
struct MatchObservers {
  /// After every cycle; false ends the match.
  std::function<bool(const sim::Simulation&, const MatchWatcher&)> afterCycle;
  /// After every message of every agent, before the next cycle; for measurements.
  std::function<void(const Thought&)> afterThought;
};

/// Plays a match in this process. The result does not depend on `threads`.
MatchResult playInProcess(const MatchSettings& match, const std::string& dataFolder, int threads,
                          const MatchObservers& observers = {});

}  // namespace nonet::lab
