#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <filesystem>
#include <mutex>
#include <thread>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <time.h>

#include "nonet/lab/match/frame_sources.h"
#include "nonet/lab/match/series.h"

namespace nonet::lab {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kTick = std::chrono::milliseconds(200);

// Of this thread, s.
double processorTime() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Its agents would be started from another file than the one that runs.
bool programWasReplaced() {
  std::error_code error;
  return !std::filesystem::exists(std::filesystem::read_symlink("/proc/self/exe", error), error);
}

// The games of one run of the program, shared among the threads that play them.
class Run {
 public:
  Run(Series& series, const PlayGame& play) : series_(series), play_(play), games_(series.open()) {
    played_.resize(games_.size(), 0.0);
  }

  void work() {
    for (;;) {
      std::size_t next = 0;
      {
        const std::lock_guard lock(mutex_);
        if (stop_ || next_ == games_.size()) break;
        next = next_++;
        ++running_;
      }
      playOne(next);
      const std::lock_guard lock(mutex_);
      --running_;
      changed_.notify_all();
    }
  }

  // Until all threads have nothing left to do; an exception of `watch` ends the run.
  void watch(const std::function<bool(const SeriesProgress&)>& watch) {
    try {
      tell(watch);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      fail();
    }
  }

  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  bool over() const { return running_ == 0 && (stop_ || next_ == games_.size()); }

  void tell(const std::function<bool(const SeriesProgress&)>& watch) {
    std::unique_lock lock(mutex_);
    while (!over()) {
      const SeriesProgress now = progress();
      lock.unlock();
      const bool more = watch(now);
      lock.lock();
      if (!more) stop_ = true;
      changed_.wait_for(lock, kTick, [this] { return over(); });
    }
    const SeriesProgress last = progress();
    lock.unlock();
    watch(last);
  }

  // In a handler, under the lock: the run ends, and the first exception comes out of it.
  void fail() {
    if (!error_) error_ = std::current_exception();
    stop_ = true;
  }

  void playOne(std::size_t i) {
    try {
      const GameRecord record = play_(gameOf(series_.settings(), games_[i]), [this, i](double gameTime) {
        const std::lock_guard lock(mutex_);
        played_[i] = gameTime;
        return !stop_;
      });
      const std::lock_guard lock(mutex_);
      if (stop_) return;
      played_[i] = 60.0 * series_.settings().minutes;
      series_.add(record);
      if (series_.settings().sequential && series_.result().verdict != Verdict::Open) stop_ = true;
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!stop_) fail();
    }
  }

  SeriesProgress progress() const {
    SeriesProgress now;
    now.gamesPlayed = series_.played();
    now.gamesAtMost = 2 * series_.settings().pairs;
    now.running = running_;
    now.result = series_.result();
    double done = 0.0;
    for (const double seconds : played_) done += seconds;
    const double all = 60.0 * series_.settings().minutes * static_cast<double>(games_.size());
    const double wall = std::chrono::duration<double>(Clock::now() - start_).count();
    now.secondsLeft = done > 0.0 ? wall * (all - done) / done : -1.0;
    return now;
  }

  Series& series_;
  const PlayGame& play_;
  std::vector<int> games_;
  std::vector<double> played_;  // s of game time, beside games_
  const Clock::time_point start_ = Clock::now();
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t next_ = 0;
  int running_ = 0;
  bool stop_ = false;
  std::exception_ptr error_;
};

}  // namespace

PlayGame unlessChanged(const SeriesSettings& settings, const std::string& dataFolder, const PlayGame& play) {
  return [settings, dataFolder, play](const SeriesGame& game, const std::function<bool(double)>& goOn) {
    GameRecord record = play(game, goOn);
    SeriesSettings now = settings;
    takeFingerprints(now, dataFolder);
    if (!now.sameGames(settings) || (settings.place != "process" && programWasReplaced()))
      throw std::runtime_error(
          fmt::format("a file of a side or of the server's settings changed during game {} of pair {}, which "
                      "is not counted: put it back, or begin anew in another folder",
                      game.game, game.pair));
    return record;
  };
}

bool playSeries(Series& series, int jobs, const PlayGame& play,
                const std::function<bool(const SeriesProgress&)>& watch) {
  Run run(series, play);
  const int games = static_cast<int>(series.open().size());
  std::vector<std::thread> threads;
  try {
    for (int i = std::clamp(games, 1, std::max(1, jobs)); i > 0; --i)
      threads.emplace_back([&run] { run.work(); });
  } catch (const std::system_error&) {
    if (threads.empty()) throw;  // else those that there are play
  }
  run.watch(watch);
  for (std::thread& thread : threads) thread.join();
  run.rethrow();
  return series.open().empty();
}

PlayGame inProcessGames(const SeriesSettings& settings, const std::string& overlayFolder,
                        const std::string& dataFolder) {
  return
      [settings, overlayFolder, dataFolder](const SeriesGame& game, const std::function<bool(double)>& goOn) {
        constexpr long kCyclesBetweenReports = 50;
        const double before = processorTime();
        const MatchSettings match = matchOf(settings, game, overlayFolder);
        SimulationFrames frames;
        MatchStatistics statistics(
            {match.settings.fieldLength, match.settings.fieldWidth, match.settings.goalWidth});
        std::array<int, 2> score{};
        MatchObservers observers;
        observers.afterThought = [&](const Thought& thought) {
          frames.setRole(thought.handle, team::roleName(thought.agent.role()));
          frames.setKick(thought.handle, thought.agent.kick());
        };
        observers.afterCycle = [&](const sim::Simulation& simulation, const MatchWatcher& watcher) {
          if (const Frame* frame = frames.cycle(simulation)) {
            statistics.add(*frame);
            score = frame->score;
          }
          return watcher.result().cycles % kCyclesBetweenReports != 0 || goOn(watcher.result().gameTime);
        };
        const MatchResult result = playInProcess(match, dataFolder, 1, observers);
        for (const std::string& warning : result.warnings) spdlog::warn("{}", warning);
        GameRecord record = gameRecord(game, score[0], score[1], result.gameTime, result.finished);
        record.line["signature"] = fmt::format("{:016x}", result.signature);
        record.line["statistics"] = statistics.toJson();
        record.times["wall_time_s"] = result.wallTime;
        record.times["processor_time_s"] = processorTime() - before;
        return record;
      };
}

}  // namespace nonet::lab
