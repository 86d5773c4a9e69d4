#include "nonet/lab/match/series.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "nonet/lab/common/atomic_file.h"

namespace nonet::lab {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* kChoice = "series.json";
constexpr const char* kMatches = "matches.jsonl";
constexpr const char* kTimes = "times.jsonl";
constexpr const char* kResult = "result.json";

// Held until the last copy goes or the process ends, however it ends.
std::shared_ptr<void> lockFolder(const std::string& folder) {
  const std::string path = folder + "/lock";
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file < 0) throw std::runtime_error(fmt::format("cannot write {}", path));
  if (::flock(file, LOCK_EX | LOCK_NB) != 0) {
    ::close(file);
    throw std::runtime_error(
        fmt::format("another process works on {}: wait for its end or stop it first", folder));
  }
  return {nullptr, [file](void*) { ::close(file); }};
}

int indexOf(const ordered_json& line) {
  return 2 * (line.at("pair").get<int>() - 1) + line.at("game").get<int>() - 1;
}

// Whole lines of a file that a killed process may have left with half a line at its end; that half is cut
// off, so that the next line begins well.
std::map<int, ordered_json> readWholeLines(const std::string& path) {
  std::map<int, ordered_json> lines;
  std::ifstream file(path, std::ios::binary);
  std::uintmax_t whole = 0;
  for (std::string text; std::getline(file, text) && !file.eof();) {
    const ordered_json line = ordered_json::parse(text, nullptr, false);
    if (line.is_discarded())
      throw std::runtime_error(fmt::format("{}: line {} is damaged", path, lines.size() + 1));
    lines[indexOf(line)] = line;
    whole += text.size() + 1;
  }
  file.close();
  if (fs::exists(path) && fs::file_size(path) != whole) fs::resize_file(path, whole);
  return lines;
}

// On the disk when it returns.
void appendLine(const std::string& path, const std::string& text) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  const std::string line = text + "\n";
  const bool written = file >= 0 &&
                       ::write(file, line.data(), line.size()) == static_cast<ssize_t>(line.size()) &&
                       ::fdatasync(file) == 0;
  if (file >= 0) ::close(file);
  if (!written) throw std::runtime_error(fmt::format("cannot write {}: is the disk full?", path));
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
  fs::create_directories(folder);
  lock_ = lockFolder(folder);
  if (fs::exists(path(kChoice))) {
    std::ifstream file(path(kChoice));
    const auto before = SeriesSettings::fromJson(ordered_json::parse(file));
    const bool same = before.sameGames(settings);
    if (!same && fs::exists(path(kMatches)))
      throw std::runtime_error(fmt::format(
          "{} holds a series of other games (see series.json; the program or a side's files may have "
          "changed): choose another folder with --out",
          folder));
    if (same) settings_ = before;
    settings_.pairs = settings.pairs;
    settings_.sequential = settings.sequential;
    settings_.monitorLogs = settings.monitorLogs;
  }
  writeAtomically(path(kChoice), settings_.toJson().dump(1) + "\n");
  readLines();
}

void Series::readLines() {
  const std::map<int, ordered_json> times = readWholeLines(path(kTimes));
  for (const auto& [index, line] : readWholeLines(path(kMatches))) {
    GameRecord record{gameOf(settings_, index), line, {}};
    if (record.game.seed != line.at("seed").get<std::uint64_t>())
      throw std::runtime_error(fmt::format("{}: a game has another seed than the series", path(kMatches)));
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
  appendLine(path(kTimes), record.times.dump());
  appendLine(path(kMatches), record.line.dump());
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
  result.difference = summarizePairs(result.pairs);
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
