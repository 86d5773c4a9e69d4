#include "nonet/lab/match/series.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

#include "nonet/lab/common/atomic_file.h"
#include "nonet/lab/common/folder_lock.h"
#include "nonet/lab/common/json_lines.h"

namespace nonet::lab {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* kChoice = "series.json";
constexpr const char* kMatches = "matches.jsonl";
constexpr const char* kTimes = "times.jsonl";
constexpr const char* kResult = "result.json";
constexpr const char* kRemedy = "put back what it held, or choose another folder with --out";

int indexOf(const ordered_json& line) {
  return 2 * (line.at("pair").get<int>() - 1) + line.at("game").get<int>() - 1;
}

std::map<int, ordered_json> readGames(const std::string& path) {
  return readOrDamaged(path, kRemedy, [&path] {
    std::map<int, ordered_json> games;
    for (const ordered_json& line : readWholeLines(path)) games[indexOf(line)] = line;
    return games;
  });
}

SeriesSettings readChoice(const std::string& path) {
  return readOrDamaged(path, kRemedy, [&path] {
    std::ifstream file(path);
    return SeriesSettings::fromJson(ordered_json::parse(file));
  });
}

// A line of matches.jsonl, with all that the result is made of.
GameRecord recordOf(const SeriesGame& game, const ordered_json& line, const std::string& path) {
  GameRecord record{game, line, {}};
  const auto seed = readOrDamaged(path, kRemedy, [&record] {
    (void)(record.scoreA() + record.scoreB() + record.gameTime());
    return record.line.at("seed").get<std::uint64_t>();
  });
  if (seed != game.seed)
    throw std::runtime_error(fmt::format("{}: a game has another seed than the series", path));
  return record;
}

}  // namespace

GameRecord gameRecord(const SeriesGame& game, int scoreLeft, int scoreRight, double gameTime, bool finished) {
  GameRecord record;
  record.game = game;
  record.line = {{"pair", game.pair},
                 {"game", game.game},
                 {"seed", game.seed},
                 {"a", game.aLeft() ? "left" : "right"},
                 {"score_a", game.aLeft() ? scoreLeft : scoreRight},
                 {"score_b", game.aLeft() ? scoreRight : scoreLeft},
                 {"game_time_s", gameTime},
                 {"finished", finished}};
  record.times = {{"pair", game.pair}, {"game", game.game}};
  return record;
}

Series::Series(const std::string& folder, const SeriesSettings& settings)
    : folder_(folder), settings_(settings) {
  makeFolder(folder);
  lock_ = lockFolder(folder);
  if (fs::exists(path(kChoice))) resume(settings);
  writeAtomically(path(kChoice), settings_.toJson().dump(1) + "\n");
  if (!open().empty()) fs::remove(path(kResult));  // of fewer games
}

void Series::resume(const SeriesSettings& settings) {
  const SeriesSettings before = readChoice(path(kChoice));
  if (before.sameGames(settings)) {
    settings_ = before;
    readLines();
  } else if (fs::exists(path(kMatches))) {
    throw std::runtime_error(fmt::format(
        "{} holds a series of other games (see series.json; the program or a side's files may have "
        "changed): choose another folder with --out",
        folder_));
  }
  const int counted = result().games;
  // Who plays more of it says how the whole is played.
  if (settings_.pairs != settings.pairs || settings_.sequential != settings.sequential)
    settings_.commandLine = settings.commandLine;
  settings_.pairs = settings.pairs;
  settings_.sequential = settings.sequential;
  settings_.monitorLogs = settings.monitorLogs;
  const int counts = result().games;
  const bool beyond = !records_.empty() && records_.rbegin()->first >= 2 * settings_.pairs;
  if (counts < counted || beyond)
    throw std::runtime_error(fmt::format(
        "{} holds {} games, not all of which would count with these --pairs and --sprt: give those it was "
        "played with (see series.json), or choose another folder with --out",
        folder_, records_.size()));
}

void Series::readLines() {
  const std::map<int, ordered_json> times = readGames(path(kTimes));
  for (const auto& [index, line] : readGames(path(kMatches))) {
    GameRecord record = recordOf(gameOf(settings_, index), line, path(kMatches));
    const auto time = times.find(index);
    if (time != times.end()) record.times = time->second;
    records_.emplace(index, record);
  }
}

std::vector<int> Series::open() const {
  std::vector<int> games;
  if (settings_.sequential && result().verdict != Verdict::Open) return games;
  for (int index = 0; index < 2 * settings_.pairs; ++index) {
    if (!has(index)) games.push_back(index);
  }
  return games;
}

void Series::add(const GameRecord& record) {
  const int index = indexOf(record.line);
  if (has(index)) return;
  // A game without its times is whole, times without their game are passed over.
  appendLine(path(kTimes), record.times);
  appendLine(path(kMatches), record.line);
  records_.emplace(index, record);
}

SeriesResult Series::result() const {
  SeriesResult result;
  SequentialTest test(settings_.sequential.value_or(SequentialBounds{0.0, 1.0}), settings_.resolution());
  for (int pair = 0; pair < settings_.pairs && has(2 * pair) && has(2 * pair + 1); ++pair) {
    if (settings_.sequential && test.verdict() != Verdict::Open) break;
    int difference = 0;
    double seconds = 0.0;
    for (const int index : {2 * pair, 2 * pair + 1}) {
      const GameRecord& record = records_.at(index);
      const int goals = record.scoreA() - record.scoreB();
      ++result.games;
      result.wins += goals > 0 ? 1 : 0;
      result.ties += goals == 0 ? 1 : 0;
      result.losses += goals < 0 ? 1 : 0;
      result.goalsA += record.scoreA();
      result.goalsB += record.scoreB();
      result.crashedA += record.line.value("crashed_a", 0);
      result.crashedB += record.line.value("crashed_b", 0);
      result.goneA += record.line.value("gone_a", 0);
      result.goneB += record.line.value("gone_b", 0);
      difference += goals;
      seconds += record.gameTime();
    }
    result.pairs.push_back(seconds > 0.0 ? difference * 600.0 / seconds : 0.0);
    test.add(result.pairs.back());
  }
  result.difference = summarizePairs(result.pairs, settings_.resolution());
  if (settings_.sequential) {
    result.verdict = test.verdict();
    result.logLikelihoodRatio = test.logLikelihoodRatio();
  }
  return result;
}

SeriesResult Series::finish() {
  SeriesResult end = result();
  for (auto record = records_.begin(); record != records_.end();) {
    record = record->first >= end.games ? records_.erase(record) : std::next(record);
  }
  std::string lines;
  std::string times;
  for (const auto& [index, record] : records_) {
    lines += record.line.dump() + "\n";
    if (!record.times.empty()) times += record.times.dump() + "\n";
  }
  writeAtomically(path(kMatches), lines);
  writeAtomically(path(kTimes), times);
  writeAtomically(path(kResult), end.toJson(settings_).dump(1) + "\n");
  return end;
}

}  // namespace nonet::lab
