// A series of paired games as a folder:
//
//   series.json    what is played (series_settings.h)
//   matches.jsonl  one line per game: score and statistics, nothing that depends on the machine's speed
//   times.jsonl    one line per game: what does depend on it (wall and processor time)
//   result.json    wins, goal difference with its interval, verdict; written at the end
//
// A game's line is appended, and on the disk, when the game ends; at the end the lines are put in the order
// of the games. A series that is killed at any point and resumed ends in the same matches.jsonl and
// result.json as one that was not.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "nonet/lab/match/series_settings.h"

namespace nonet::lab {

/// What a game leaves.
struct GameRecord {
  SeriesGame game;
  nlohmann::ordered_json
      line;  // pair, game, seed, a, score_a, score_b, game_time_s, finished, ... statistics
  nlohmann::ordered_json times;  // pair, game, wall_time_s, ...

  int scoreA() const { return line.at("score_a").get<int>(); }
  int scoreB() const { return line.at("score_b").get<int>(); }
  double gameTime() const { return line.at("game_time_s").get<double>(); }
};

/// The first keys of every line.
GameRecord gameRecord(const SeriesGame& game, int scoreLeft, int scoreRight, double gameTime, bool finished);

/// What is known after the games so far. Only pairs that are whole count, in their order and without a gap;
/// with a sequential test none after its verdict.
struct SeriesResult {
  int games = 0;  // that count: twice the pairs
  int wins = 0;   // of A
  int ties = 0;
  int losses = 0;
  int goalsA = 0;
  int goalsB = 0;
  int crashedA = 0;  // agents that ended before their game did
  int crashedB = 0;
  int goneA = 0;  // players that were not there at the end of a game, crashed or thrown out
  int goneB = 0;
  PairSummary difference;  // goals of A minus goals of B, per ten minutes
  Verdict verdict = Verdict::Open;
  double logLikelihoodRatio = 0.0;
  std::vector<double> pairs;  // value of each, goals per ten minutes

  nlohmann::ordered_json toJson(const SeriesSettings& settings) const;
  /// difference_per_10_min; standard_error and interval_95, null with fewer than two pairs; stopped_early:
  /// the test has decided, so that the interval, which knows nothing of that, holds the truth less often than
  /// 95 % (83 to 94 % in simulations) and lies too far out.
  nlohmann::ordered_json differenceJson() const;
  std::string toText(const SeriesSettings& settings) const;
};

class Series {
 public:
  /// Begins or resumes the series in the folder. Resuming takes the number of pairs and the test from
  /// `settings` and demands that the games are the same, and that all that counted so far still count. Throws
  /// std::runtime_error: other games in the folder, another process works on it, damaged files.
  Series(const std::string& folder, const SeriesSettings& settings);

  const SeriesSettings& settings() const { return settings_; }
  const std::string& folder() const { return folder_; }
  /// Indices (gameOf()) of games that are to be played, in order; empty when all are, or the test has
  /// decided.
  std::vector<int> open() const;
  bool has(int index) const { return records_.contains(index); }
  int played() const { return static_cast<int>(records_.size()); }
  SeriesResult result() const;
  /// One more game, from one thread at a time.
  void add(const GameRecord& record);
  /// Puts matches.jsonl in order, without games that do not count, and writes result.json.
  SeriesResult finish();

 private:
  void resume(const SeriesSettings& settings);
  void readLines();
  std::string path(const char* name) const { return folder_ + "/" + name; }

  std::string folder_;
  std::shared_ptr<void> lock_;
  SeriesSettings settings_;
  std::map<int, GameRecord> records_;  // by index
};

/// Plays one game. Calls `goOn` with the game time now and then; false means to give up, and the record is
/// then not used. Throws std::runtime_error if the game cannot be played.
using PlayGame = std::function<GameRecord(const SeriesGame&, const std::function<bool(double)>& goOn)>;

struct SeriesProgress {
  int gamesPlayed = 0;  // of this and earlier runs
  int gamesAtMost = 0;
  int running = 0;
  double secondsLeft = 0.0;  // wall time at the present speed; below 0: not known yet
  SeriesResult result;

  std::string line(const SeriesSettings& settings) const;
};

/// Plays what is open, `jobs` games at a time, each in a thread of its own. `watch` is called a few times a
/// second from the calling thread; false stops, and what was finished can be resumed. The first error of a
/// game stops the others and is thrown. True if the series is complete.
bool playSeries(Series& series, int jobs, const PlayGame& play,
                const std::function<bool(const SeriesProgress&)>& watch);

/// The same games, but each throws afterwards if a file that the settings' fingerprints tell of has changed.
PlayGame unlessChanged(const SeriesSettings& settings, const std::string& dataFolder, const PlayGame& play);

/// Plays games in this process, one thread each.
PlayGame inProcessGames(const SeriesSettings& settings, const std::string& overlayFolder,
                        const std::string& dataFolder);

}  // namespace nonet::lab
