// Games of a series in which a side cannot play in this process: other executables, foreign agents, other
// servers. Every agent is then a process.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "nonet/app/agent_processes.h"
#include "nonet/app/play_command_line.h"
#include "nonet/lab/match/series.h"

namespace nonet::app {

/// A line for the user, from any thread.
using SayLine = std::function<void(const std::string& line)>;

/// Plays where `settings.place` says, in processes. `folder`: of the series; what agents say is kept there,
/// in games/, if a game goes wrong. `say`: for what a game waits. Throws std::runtime_error if an executable
/// is none of Nonet.
lab::PlayGame gamesOfProcesses(const lab::SeriesSettings& settings, const std::string& folder,
                               const std::string& dataFolder, const SayLine& say);

/// A place "HOST:PORT:MONITORPORT"; nothing for "process", "tcp" and "realtime". Throws std::runtime_error if
/// it is none of these.
struct ServerPlace {
  std::string host;
  std::uint16_t port = 0;
  std::uint16_t monitorPort = 0;
};
std::optional<ServerPlace> serverPlace(const std::string& place);

/// The agents of both sides in one game, and what becomes of them.
class SideAgents {
 public:
  /// The programs of both sides; they are asked once what they understand.
  struct Programs {
    explicit Programs(const lab::SeriesSettings& settings);
    std::optional<PlayProgram> a;
    std::optional<PlayProgram> b;
  };

  /// `logs`: a folder of this game's own.
  SideAgents(const lab::SeriesSettings& settings, const lab::SeriesGame& game, const Programs& programs,
             const lab::MatchSettings& match, const std::string& dataFolder, const std::string& logs);

  /// Starts one team of the match.
  void start(bool rightTeam, const ServerPlace& server, bool lockStep);
  /// Looks who has ended. Empty, or what went wrong with one that had no reason to end.
  std::string trouble();
  void stop(double seconds) { processes_.stop(seconds); }
  /// Adds to the record: crashed agents, and late and lost cycles of Nonet's, per side, after stop().
  void addTo(lab::GameRecord& record);

 private:
  struct Agent {
    bool rightTeam = false;
    bool foreign = false;  // a command that starts agents, not an agent
    std::string report;
  };

  void startForeign(const lab::SideSettings& side, bool rightTeam, const ServerPlace& server);
  bool crashed(std::size_t i) const;
  bool crashedInGame(std::size_t i) const;

  const lab::SeriesSettings& settings_;
  lab::SeriesGame game_;
  const Programs& programs_;
  const lab::MatchSettings& match_;
  std::string dataFolder_;
  std::string logs_;
  std::vector<Agent> agents_;  // beside processes_.processes()
  AgentProcesses processes_;
};

/// One game on a server that is not in this process; see external_game.cpp. Gives the teams the names that
/// the server knows already.
lab::GameRecord playOnServer(const lab::SeriesSettings& settings, const lab::SeriesGame& game,
                             lab::MatchSettings& match, SideAgents& agents,
                             const std::function<bool(double)>& goOn, const std::string& logs,
                             const SayLine& say);

/// Puts values in the place of "{key}".
std::string filledIn(std::string text,
                     std::initializer_list<std::pair<std::string_view, std::string>> values);

}  // namespace nonet::app
