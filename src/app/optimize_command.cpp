#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <stop_token>
#include <thread>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include "nonet/app/commands.h"
#include "nonet/app/console.h"
#include "nonet/app/data_folder.h"
#include "nonet/app/option_checks.h"
#include "nonet/app/stop_signal.h"
#include "nonet/app/version.h"
#include "nonet/config/parameters.h"
#include "nonet/lab/common/atomic_file.h"
#include "nonet/lab/match/series_settings.h"
#include "nonet/lab/optimize/evaluator_mpi.h"
#include "nonet/lab/optimize/optimization_run.h"
#include "nonet/lab/optimize/optimize_report.h"
#include "nonet/lab/optimize/solver_comparison.h"

namespace nonet::app {
namespace {

using Clock = std::chrono::steady_clock;

struct OptimizeArguments {
  std::string task;
  std::string out;
  lab::OptimizationSettings settings;
  std::string restarts = "none";
  std::vector<std::string> parameterFiles;
  int threads = 0;
  bool mpi = false;
  bool resume = false;
  bool list = false;
  std::string repeat;
  std::string accept;
  int compareSolvers = 0;
  std::string reportFolder;
  const CLI::App* command = nullptr;

  bool wasGiven(const std::string& option) const { return command->count(option) > 0; }
};

int threadsOf(const OptimizeArguments& arguments) {
  return arguments.threads > 0 ? arguments.threads
                               : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  return fmt::format("{:%Y-%m-%d}", utc);
}

int listTasks() {
  for (const lab::Task* task : lab::registeredTasks()) {
    if (task->hidden()) continue;
    fmt::print("{}: {}\n  moves {}\n", task->name(), task->description(),
               fmt::join(task->searchedKeys(), ", "));
  }
  fmt::print("\nParameters that may be moved, with the range where the search starts:\n");
  for (const auto& view : config::listParameters(lab::defaultParameters(dataFolder()))) {
    const auto& range = view.declaration.searchRange;
    if (!range) continue;
    fmt::print("  {} = {} ({} .. {} {}) {}\n", view.key, view.value, range->low, range->high,
               config::unitName(view.declaration.unit), view.declaration.text);
  }
  return 0;
}

void printMeasurement(const lab::Measurement& measurement) {
  fmt::print("fitness {:.6f}", measurement.fitness);
  if (!std::isnan(measurement.standardError)) fmt::print(" +- {:.4f}", measurement.standardError);
  for (const auto& [name, value] : measurement.measures) fmt::print(", {} {:.3f}", name, value);
  fmt::print("\n");
}

lab::MeasureProgress showTrials(Console& console) {
  return [&console](const std::string& task, std::size_t done, std::size_t all) {
    console.progress(fmt::format("{}: {} of {} trials", task, done, all));
  };
}

int repeatFile(const OptimizeArguments& arguments) {
  Console console;
  const auto repetitions =
      lab::repeatLearned(arguments.repeat, dataFolder(), threadsOf(arguments), showTrials(console));
  console.end();
  if (repetitions.empty()) throw std::runtime_error(arguments.repeat + ": has no [provenance.<task>] table");
  int exitCode = 0;
  for (const auto& [recorded, repeated] : repetitions) {
    const bool same =
        std::abs(recorded.fitness - repeated.fitness) <= 1e-9 * (1.0 + std::abs(recorded.fitness));
    fmt::print("{}: recorded {:.6f} over {} trials, {}: ", recorded.task, recorded.fitness,
               recorded.seeds.size(), same ? "confirmed" : "DIFFERENT");
    printMeasurement(repeated);
    if (!same) exitCode = 1;
  }
  return exitCode;
}

/// The robot type that the file was learned for, unless it does not say; then the one given.
int acceptedType(const OptimizeArguments& arguments, const std::vector<lab::Provenance>& origins) {
  const int given = arguments.settings.robotType;
  if (origins.empty()) return given;
  const int learned = origins.front().robotType;
  const bool agree = std::all_of(origins.begin(), origins.end(), [learned](const lab::Provenance& origin) {
    return origin.robotType == learned;
  });
  if (!agree) return given;
  if (arguments.wasGiven("--type") && given != learned) {
    throw std::runtime_error(fmt::format("{}: was learned for robot type {}, not for --type {}",
                                         arguments.accept, learned, given));
  }
  return learned;
}

/// A learned file is whole: what it leaves out has the code's value. Any other is overlaid on the type's
/// file.
agent::AgentParameters acceptedParameters(OptimizeArguments& arguments, bool learned) {
  if (!learned) {
    std::vector<std::string> files = arguments.parameterFiles;
    files.push_back(arguments.accept);
    lab::setStart(arguments.settings, dataFolder(), files);
    return arguments.settings.startParameters(dataFolder());
  }
  if (!arguments.parameterFiles.empty())
    throw std::runtime_error(
        fmt::format("--params: {} was learned and holds all values: leave the option out", arguments.accept));
  agent::AgentParameters parameters = lab::defaultParameters(dataFolder());
  config::overlayFile(parameters, arguments.accept);
  return parameters;
}

// Another set, other seeds: whoever accepts the best of several would else choose it by luck.
std::uint64_t freshSeed(const std::string& file) {
  return std::stoull(lab::fingerprintOfFiles({file}), nullptr, 16) >> 32U;
}

// Measures a set on fresh seeds and writes it with that fitness as its provenance.
int acceptFile(OptimizeArguments& arguments) {
  if (arguments.out.empty()) throw std::runtime_error("--out FILE says where the accepted set goes");
  lab::OptimizationSettings& settings = arguments.settings;
  const lab::Task& task = lab::findTask(arguments.task);
  settings.task = arguments.task;
  if (arguments.command->count("--seed") == 0) settings.seed = freshSeed(arguments.accept);
  std::vector<lab::Provenance> origins = lab::readProvenance(arguments.accept);
  lab::Provenance origin;
  for (const lab::Provenance& known : origins) {
    if (known.task == arguments.task) origin = known;
  }
  settings.robotType = acceptedType(arguments, origins);
  agent::AgentParameters parameters = acceptedParameters(arguments, !origins.empty());
  if (origins.empty()) origins = settings.inherited;  // of the type's file, whose values are in it too
  task.prepare(parameters);
  origin.task = arguments.task;
  origin.robotType = settings.robotType;
  origin.quickSolver = settings.quickSolver;
  origin.seeds = {};
  origin.seeds.add(lab::SeedDraw{settings.seed, 0, settings.trials});
  origin.date = today();
  origin.version = versionText();
  Console console;
  const lab::Measurement measurement =
      lab::measure(task, parameters, origin.seeds.all(), settings.taskSettings(dataFolder()),
                   threadsOf(arguments), showTrials(console));
  console.end();
  printMeasurement(measurement);
  origin.fitness = measurement.fitness;
  origin.standardError = measurement.standardError;
  lab::replaceProvenance(origins, origin);
  const lab::SearchSpace space(parameters, settings.keys.empty() ? task.searchedKeys() : settings.keys);
  lab::writeAtomically(arguments.out, lab::learnedToml(parameters, lab::defaultParameters(dataFolder()),
                                                       space.keys(), origins));
  return 0;
}

// Timings go here and to the terminal; generations.jsonl holds none, so that its bytes can be compared.
class Progress {
 public:
  explicit Progress(const std::string& folder, int generations)
      : log_(folder + "/progress.log", std::ios::app), generations_(generations) {}

  void show(const lab::GenerationReport& report, int workers) {
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    if (first_ < 0) {
      first_ = report.generation - 1;
      firstTrials_ = report.generation == 1 ? 0 : lastTrials_;
    }
    const double rate = static_cast<double>(report.trials - firstTrials_) / std::max(seconds, 1e-9);
    const double left = seconds / (report.generation - first_) * (generations_ - report.generation);
    const std::string line = fmt::format(
        "generation {}/{}  best {:.3f}  mean {:.3f}  incumbent {:.3f}  sigma {:.4f}  {:.2f} trials/s on {} "
        "workers  {:.0f} s gone, about {:.0f} s left",
        report.generation, generations_, report.best, report.mean, report.incumbent, report.sigma, rate,
        workers, seconds, left);
    fmt::print("{}\n", line);
    std::fflush(stdout);
    log_ << line << std::endl;
  }
  void startFrom(std::int64_t trials) { lastTrials_ = trials; }

 private:
  std::ofstream log_;
  int generations_;
  Clock::time_point start_ = Clock::now();
  int first_ = -1;
  std::int64_t firstTrials_ = 0;
  std::int64_t lastTrials_ = 0;
};

/// Says at once that a signal has come, for a generation may take minutes to its end.
class StopNotice {
 private:
  static void watch(const std::stop_token& over) {
    while (!StopSignal::came()) {
      if (over.stop_requested()) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    // Throws nothing, in a thread of its own, where the output finds no room.
    std::fputs("stopping: the generation under way is finished first; a second signal ends at once\n",
               stdout);
    std::fflush(stdout);
  }

  std::jthread thread_{[](const std::stop_token& over) { watch(over); }};
};

/// Exit code. A signal ends the search after the generation that it came in: all is in the folder.
int optimize(lab::OptimizationRun& run, lab::Evaluator& evaluator, const std::string& folder) {
  const StopSignal stopSignal;
  Progress progress(folder, run.settings().generations);
  progress.startFrom(run.trials());
  lab::GenerationReport report;
  {
    const StopNotice notice;
    while (!StopSignal::came() && run.step(evaluator, report)) progress.show(report, evaluator.workers());
  }
  const bool stopped = StopSignal::came();
  if (stopped) fmt::print("stopped by a signal after generation {}; --resume goes on\n", run.generation());
  fmt::print("best parameters: {}/best.toml\n", folder);
  return stopped ? 1 : 0;
}

/// The options that a run keeps, by their names in its config.json.
constexpr std::array<std::pair<const char*, const char*>, 11> kKept{
    {{"--type", "robotType"},
     {"--population", "population"},
     {"--sigma", "sigma"},
     {"--trials", "trials"},
     {"--validation-every", "validationEvery"},
     {"--validation-trials", "validationTrials"},
     {"--quick", "quickSolver"},
     {"--racing", "racing"},
     {"--restarts", "restarts"},
     {"--keys", "keys"},
     {"--seed", "seed"}}};

/// A run goes on as it began: whoever says otherwise means another run. Throws std::runtime_error.
void checkAgainst(const OptimizeArguments& arguments, const lab::OptimizationSettings& begun) {
  const auto contradiction = [&](const std::string& what, const std::string& given, const std::string& kept) {
    return std::runtime_error(
        fmt::format("--resume: the run in {} was begun with {} {}, not {}: leave it out, or "
                    "start another run",
                    arguments.out, what, kept, given));
  };
  if (!arguments.task.empty() && arguments.task != begun.task)
    throw contradiction("task", arguments.task, begun.task);
  lab::OptimizationSettings given = arguments.settings;
  given.restarts = lab::restartSchemeOf(arguments.restarts);
  const nlohmann::json now = given.toJson();
  const nlohmann::json then = begun.toJson();
  for (const auto& [option, key] : kKept) {
    if (arguments.wasGiven(option) && now.at(key) != then.at(key))
      throw contradiction(option, now.at(key).dump(), then.at(key).dump());
  }
  if (arguments.wasGiven("--params"))
    throw std::runtime_error(
        "--resume: a run keeps the parameters that it was begun with: leave out --params");
}

lab::OptimizationRun openRun(OptimizeArguments& arguments, bool generationsGiven) {
  if (arguments.resume) {
    const lab::OptimizationSettings begun = lab::OptimizationRun::readSettings(arguments.out);
    checkAgainst(arguments, begun);
    if (!begun.fingerprint.empty() && begun.fingerprint != lab::fingerprintOf({}, dataFolder()))
      spdlog::warn(
          "the program, params/ or skills/ changed since the run in {} began ({}): its fitness may mean "
          "something else now",
          arguments.out, begun.version);
    return lab::OptimizationRun::resume(
        arguments.out, dataFolder(),
        generationsGiven ? std::optional<int>(arguments.settings.generations) : std::nullopt);
  }
  lab::OptimizationSettings& settings = arguments.settings;
  settings.task = arguments.task;
  lab::findTask(settings.task);
  settings.restarts = lab::restartSchemeOf(arguments.restarts);
  settings.date = today();
  settings.version = versionText();
  settings.fingerprint = lab::fingerprintOf({}, dataFolder());
  lab::setStart(settings, dataFolder(), arguments.parameterFiles);
  return lab::OptimizationRun::create(arguments.out, settings, dataFolder());
}

int runMpi(OptimizeArguments& arguments, bool generationsGiven) {
  lab::MpiJob job;
  if (job.rank() != 0) {
    const std::string text = job.share({});
    if (text.empty()) return 1;  // rank 0 has said why
    const auto settings = lab::OptimizationSettings::fromJson(nlohmann::json::parse(text));
    lab::serveEvaluations(job, lab::makeObjective(settings, dataFolder()));
    return 0;
  }
  std::unique_ptr<lab::OptimizationRun> run;
  try {
    run = std::make_unique<lab::OptimizationRun>(openRun(arguments, generationsGiven));
  } catch (...) {
    job.share({});
    throw;
  }
  job.share(run->settings().toJson().dump());
  const auto evaluator = lab::makeMpiEvaluator(job, lab::makeObjective(run->settings(), dataFolder()));
  return optimize(*run, *evaluator, arguments.out);
}

int runThreads(OptimizeArguments& arguments, bool generationsGiven) {
  lab::OptimizationRun run = openRun(arguments, generationsGiven);
  const auto evaluator =
      lab::makeThreadEvaluator(lab::makeObjective(run.settings(), dataFolder()), threadsOf(arguments));
  return optimize(run, *evaluator, arguments.out);
}

int compareSolvers(OptimizeArguments& arguments) {
  arguments.settings.task = arguments.task;
  lab::setStart(arguments.settings, dataFolder(), arguments.parameterFiles);
  const lab::SolverComparison comparison =
      lab::compareSolvers(arguments.settings, arguments.compareSolvers, dataFolder(), threadsOf(arguments));
  for (const auto& [exact, quick] : comparison.fitness)
    fmt::print("exact {:9.4f}  quick {:9.4f}\n", exact, quick);
  fmt::print(
      "{} sets, {} trials each: Spearman's rank correlation {:.3f}; seconds per trial: exact {:.3f}, "
      "quick {:.3f}\n",
      comparison.fitness.size(), arguments.settings.trials, comparison.rankCorrelation,
      comparison.exactSeconds, comparison.quickSeconds);
  return 0;
}

int runOptimize(OptimizeArguments& arguments, bool generationsGiven) {
  if (arguments.list) return listTasks();
  spdlog::set_level(spdlog::level::warn);  // who enters the field is no news here
  if (!arguments.repeat.empty()) return repeatFile(arguments);
  if (arguments.task.empty() && !arguments.resume) throw std::runtime_error("name a task; --list shows them");
  if (!arguments.accept.empty()) return acceptFile(arguments);
  if (arguments.compareSolvers > 1) return compareSolvers(arguments);
  if (arguments.out.empty()) throw std::runtime_error("--out FOLDER says where the run is kept");
  return arguments.mpi ? runMpi(arguments, generationsGiven) : runThreads(arguments, generationsGiven);
}

void addSearchOptions(CLI::App& command, OptimizeArguments& arguments) {
  lab::OptimizationSettings& settings = arguments.settings;
  command.add_option("--type", settings.robotType, "Robot type")->check(CLI::Range(0, 4));
  command.add_option("--population", settings.population, "Candidates per generation; 0: CMA-ES' default");
  command.add_option("--sigma", settings.sigma, "First step size as a share of the search ranges");
  command.add_option("--trials", settings.trials, "Seeds per candidate, the same for all of a generation")
      ->check(moreThanZero());
  command.add_option("--validation-every", settings.validationEvery, "Generations between validations")
      ->check(moreThanZero());
  command.add_option("--validation-trials", settings.validationTrials, "Fresh seeds per validation")
      ->check(moreThanZero());
  command.add_flag("--quick", settings.quickSolver,
                   "Quick physics: the same equations, three to four times faster, not to the last bit");
  command.add_flag("--racing", settings.racing, "The worse half of a generation gets half of the trials");
  command.add_option("--restarts", arguments.restarts, "none, ipop or bipop");
  command
      .add_option("--keys", settings.keys,
                  "A prefix of the parameters to move, as often as there are some; default: the task's")
      ->allow_extra_args(false);
  command
      .add_option(
          "--params", arguments.parameterFiles,
          "A parameter file where the search starts; given again, the later one lies over the earlier")
      ->allow_extra_args(false)
      ->check(CLI::ExistingFile);
  command.add_option("--seed", settings.seed, "Decides every random number of the run");
}

}  // namespace

void addOptimizeCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand("optimize", "Learns parameters with CMA-ES");
  auto arguments = std::make_shared<OptimizeArguments>();
  command->add_option("task", arguments->task, "What to learn; --list shows the tasks");
  CLI::Option* out =
      command->add_option("--out", arguments->out, "Folder of the run; with --accept the file to write");
  CLI::Option* generations = command->add_option("--generations", arguments->settings.generations,
                                                 "How many; extends with --resume");
  addSearchOptions(*command, *arguments);
  arguments->command = command;
  command->add_option("--threads", arguments->threads, "Evaluations at once; 0: one per core")
      ->check(threadCount());
  command->add_flag("--mpi", arguments->mpi, "Evaluate on all ranks of this MPI job (under mpirun or srun)");
  CLI::Option* resume =
      command->add_flag("--resume", arguments->resume, "Continue the run in --out after a kill at any point");
  command->add_flag("--list", arguments->list, "Show tasks and parameters");
  command->add_option("--repeat", arguments->repeat, "Measure a learned file with the seeds it names")
      ->check(CLI::ExistingFile)
      ->excludes(resume, out);
  command
      ->add_option(
          "--accept", arguments->accept,
          "Measure a file on TRIALS seeds of its own (or of --seed), write it to --out with that fitness")
      ->check(CLI::ExistingFile);
  command
      ->add_option("--compare-solvers", arguments->compareSolvers,
                   "Rank correlation of quick and exact physics over so many random sets")
      ->check(CLI::Range(2, 100000));
  CLI::App* report = command->add_subcommand("report", "Writes FOLDER/report.html: curves and paths");
  report->add_option("folder", arguments->reportFolder, "Folder of a run")->required();
  command->footer(
      "Examples:\n"
      "  nonet optimize --list\n"
      "  nonet optimize goToTarget --type 0 --quick --population 20 --trials 5 --out runs/walk0\n"
      "  nonet optimize --resume --out runs/walk0          after a kill at any point\n"
      "  nonet optimize report runs/walk0                  curves and paths as a page\n"
      "  nonet optimize goToTarget --accept runs/walk0/best.toml --trials 100 --out params/type0.toml\n"
      "More: docs/learning.md");
  command->callback([arguments, &exitCode, report, generations] {
    if (report->parsed()) {
      fmt::print("{}\n", lab::writeOptimizationReport(arguments->reportFolder, dataFolder()));
    } else {
      exitCode = runOptimize(*arguments, generations->count() > 0);
    }
  });
}

}  // namespace nonet::app
