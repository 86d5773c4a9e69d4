#include "nonet/app/series_run.h"

#include <algorithm>
#include <ctime>
#include <fstream>
#include <thread>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "nonet/app/series_games.h"
#include "nonet/app/shell_word.h"
#include "nonet/app/stop_signal.h"
#include "nonet/app/version.h"

namespace nonet::app {

SeriesRun playSeries(lab::SeriesSettings settings, const std::string& folder, int jobs,
                     const std::string& dataFolder, Console& console, const std::string& title) {
  const bool elsewhere = serverPlace(settings.place).has_value();
  settings.date = fmt::format("{:%Y-%m-%d %H:%M}", fmt::gmtime(std::time(nullptr)));
  settings.version = versionText();
  lab::takeFingerprints(settings, dataFolder);
  const auto level = spdlog::get_level();
  spdlog::set_level(spdlog::level::warn);  // who enters the field is no news here
  SeriesRun run;
  run.series = std::make_unique<lab::Series>(folder, settings);
  lab::Series& series = *run.series;
  lab::writeOverlays(series.settings(), folder);
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const int atOnce = elsewhere ? 1 : jobs > 0 ? jobs : cores;
  console.say(fmt::format("{}{} pairs, seeds {} to {}, {} games at a time, in {}", title, settings.pairs,
                          settings.seed, settings.seed + static_cast<std::uint64_t>(settings.pairs) - 1,
                          atOnce, folder));
  if (series.played() > 0) console.say(fmt::format("resumed: {} games are there", series.played()));
  const StopSignal stopSignal;
  const lab::PlayGame play =
      settings.place == "process"
          ? lab::inProcessGames(series.settings(), folder, dataFolder)
          : gamesOfProcesses(series.settings(), folder, dataFolder,
                             [&console](const std::string& line) { console.say(line); });
  run.complete = lab::playSeries(series, atOnce, lab::unlessChanged(series.settings(), dataFolder, play),
                                 [&](const lab::SeriesProgress& progress) {
                                   if (console.due())
                                     console.progress(title + progress.line(series.settings()));
                                   return !StopSignal::came();
                                 });
  console.end();
  spdlog::set_level(level);
  run.result = run.complete ? series.finish() : series.result();
  return run;
}

std::string commandLine() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::string text;
  for (std::string word; std::getline(file, word, '\0');) text += (text.empty() ? "" : " ") + shellWord(word);
  return text;
}

}  // namespace nonet::app
