// What a series of paired games is: two sides, how many pairs, how they are played.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "nonet/lab/match/match.h"
#include "nonet/lab/match/pair_statistics.h"

namespace nonet::lab {

/// A team and what runs it. At most one of `dataFolder`, `executable` and `command` is set; none: this
/// program with its own data.
struct SideSettings {
  std::string name;
  std::string dataFolder;  // this program with params/ and skills/ from here
  std::string executable;  // another executable of Nonet, an older commit say
  std::string command;     // starts agents of any kind; {host} {port} {monitor} {team} are filled in
  std::vector<std::string> parameterFiles;  // overlaid in this order
  std::vector<std::string> assignments;     // "key=value", overlaid after the files
  std::vector<int> robotTypes;              // of the numbers from 1; empty: the usual ones
  std::string fingerprint;  // of all that (fingerprintOf()), so that a changed side is noticed

  /// Can play in this process.
  bool ours() const { return executable.empty() && command.empty(); }
  /// Its agents are processes of Nonet, this one or another.
  bool nonet() const { return command.empty(); }
  /// Something is set that only agents of ours take: parameters or robot types.
  bool hasOverlays() const { return !parameterFiles.empty() || !assignments.empty() || !robotTypes.empty(); }
  /// "own", the folder, the executable or the command, and the overlays.
  std::string describe() const;
  friend bool operator==(const SideSettings&, const SideSettings&) = default;
};

/// What a word of the command line means as a side: "own", the name of a variant (a file in params/variants/
/// of `dataFolder`), a folder with params/ and skills/, an executable file, or a shell command that contains
/// {port}. Paths become absolute. Throws std::runtime_error.
SideSettings sideFromWord(const std::string& word, const std::string& dataFolder);

/// Names of the variants there, in alphabetical order.
std::vector<std::string> variantsIn(const std::string& dataFolder);

/// The folder with params/ and skills/ that this executable of Nonet finds from where it lies, without
/// NONET_DATA; empty: none. An older program must not play with the data of this one.
std::string dataBeside(const std::string& executable);

/// A hash of what the files hold, 16 hexadecimal digits.
std::string fingerprintOfFiles(const std::vector<std::string>& files);
/// A hash of what decides how the side plays, as far as files tell: the executable, its params/ and skills/,
/// the parameter files; empty for a command. `dataFolder`: of this program.
std::string fingerprintOf(const SideSettings& side, const std::string& dataFolder);

struct SeriesSettings {
  SideSettings a;
  SideSettings b;
  int pairs = 20;                               // at most, if a sequential test is used
  std::uint64_t seed = 1;                       // of the first pair; the next pair has the next one
  double minutes = 10.0;                        // game time of one game
  double kickOffWait = 5.0;                     // s
  int players = 9;                              // a side
  std::vector<std::string> settingFiles;        // of the server
  std::vector<std::string> settingAssignments;  // of the server, Name=Value
  std::string settingsFingerprint;              // of what the files hold (takeFingerprints())
  std::optional<SequentialBounds> sequential;
  bool monitorLogs = false;  // keep the monitor stream of each game in the folder, game-PAIR-GAME.mon
  // "process"; "tcp": embedded server in lock-step, "realtime": by the clock; or "HOST:PORT:MONITORPORT".
  std::string place = "process";
  std::string serverCommand;  // starts that server before each game; empty: it runs already
  // For the reader of the result.
  std::string commandLine;
  std::string date;
  std::string version;

  nlohmann::ordered_json toJson() const;
  static SeriesSettings fromJson(const nlohmann::ordered_json& json);
  /// Whether a game of the one is a game of the other: everything but the number of pairs, the test, and what
  /// is for readers or for the viewer.
  bool sameGames(const SeriesSettings& other) const;
  /// What the difference of one goal in one game is worth in a pair, goals per ten minutes.
  double resolution() const { return 10.0 / (2.0 * minutes); }
};

/// Where the games are played: what `place` says; empty: in this process if that can be. Throws
/// std::runtime_error: in this process, but a side is another program.
std::string placeFor(const SeriesSettings& settings);

/// "process", "tcp" or "realtime": our own server; anything else is the place of another one.
bool playedHere(const std::string& place);

/// What would do nothing where the games are played (placeFor()): settings or monitor logs of a server that
/// is not ours, a command for a server that is. Also settings that our own server would not take. Throws
/// std::runtime_error that names the option.
void checkPlace(const SeriesSettings& settings);

/// Those of both sides and of the server's settings, as the files are now.
void takeFingerprints(SeriesSettings& settings, const std::string& dataFolder);

/// One game of a series. In the first of a pair A plays on the left.
struct SeriesGame {
  int pair = 1;  // from 1
  int game = 1;  // 1 or 2
  std::uint64_t seed = 1;

  bool aLeft() const { return game == 1; }
};
SeriesGame gameOf(const SeriesSettings& settings,
                  int index);  // index from 0: pair 1 game 1, pair 1 game 2, ...

/// The match that this game is. `overlayFolder` holds the sides' assignments as files (writeOverlays()).
MatchSettings matchOf(const SeriesSettings& settings, const SeriesGame& game,
                      const std::string& overlayFolder);

/// Tries the parameters of a side that runs this program, before anything is written. Throws.
void checkSide(const SideSettings& side, const std::string& dataFolder);

/// Writes the assignments of both sides as parameter files into the folder. Throws.
void writeOverlays(const SeriesSettings& settings, const std::string& overlayFolder);

}  // namespace nonet::lab
