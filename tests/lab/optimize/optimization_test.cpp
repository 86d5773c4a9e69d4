// The run folder: the same bytes whatever interrupts it, values that can be measured again.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "nonet/config/parameters.h"
#include "nonet/lab/common/atomic_file.h"
#include "nonet/lab/optimize/optimization_run.h"
#include "nonet/lab/optimize/optimize_report.h"
#include "nonet/lab/optimize/solver_comparison.h"
#include "nonet/math/random.h"

namespace nonet::lab {
namespace {

namespace fs = std::filesystem;

class RunFolder : public testing::Test {
 protected:
  RunFolder() {
    root_ = (fs::temp_directory_path() / "nonet-optimization-XXXXXX").string();
    if (mkdtemp(root_.data()) == nullptr) throw std::runtime_error("no temporary folder");
  }
  ~RunFolder() override { fs::remove_all(root_); }

  static OptimizationSettings settings() {
    OptimizationSettings settings;
    settings.task = "quadratic";
    settings.seed = 4;
    settings.generations = 120;
    settings.trials = 3;
    settings.racing = true;
    settings.validationTrials = 6;
    settings.restarts = RestartScheme::Bipop;
    settings.parameters = config::toToml(agent::AgentParameters{});
    settings.date = "2026-01-01";
    settings.version = "test";
    return settings;
  }

  static void finish(OptimizationRun& run, int threads) {
    const auto evaluator = makeThreadEvaluator(makeObjective(run.settings(), ""), threads);
    GenerationReport report;
    while (run.step(*evaluator, report)) {
    }
  }

  // A run of its own that ends after so many generations, on the disk.
  std::string ended(const std::string& name, int generations, int threads = 1) const {
    OptimizationSettings some = settings();
    some.generations = generations;
    const std::string folder = root_ + "/" + name;
    auto run = OptimizationRun::create(folder, some, "");
    finish(run, threads);
    return folder;
  }

  static std::string bytes(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }
  static void expectSameRun(const std::string& a, const std::string& b) {
    for (const char* name : {"/config.json", "/generations.jsonl", "/checkpoint.json", "/best.toml"}) {
      EXPECT_FALSE(bytes(a + name).empty()) << name;
      EXPECT_EQ(bytes(a + name), bytes(b + name)) << name;
    }
  }

  std::string root_;
};

TEST_F(RunFolder, KilledAtAnyPointAndResumedEndsInTheSameBytes) {
  const std::string straight = root_ + "/straight";
  auto whole = OptimizationRun::create(straight, settings(), "");
  finish(whole, 1);

  const std::string killed = root_ + "/killed";
  { OptimizationRun::create(killed, settings(), ""); }
  Random random(9);
  int kills = 0;
  for (bool finished = false; !finished;) {
    ASSERT_LT(kills, 400) << "makes no progress";
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      auto run = OptimizationRun::resume(killed, "", std::nullopt);
      finish(run, 1);
      _exit(0);
    }
    // Some generations further, and then anywhere within one.
    const auto generations = bytes(killed + "/generations.jsonl").size();
    int status = 0;
    bool over = false;
    while (!over && bytes(killed + "/generations.jsonl").size() <= generations) {
      usleep(100);
      over = waitpid(child, &status, WNOHANG) == child;
    }
    usleep(static_cast<useconds_t>(random.uniform(0.0, 3000.0)));
    if (!over) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
    }
    finished = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    kills += finished ? 0 : 1;
  }
  EXPECT_GE(kills, 2);
  expectSameRun(straight, killed);
}

TEST_F(RunFolder, DoesNotDependOnTheThreadsAndCanBeExtended) {
  const std::string one = ended("one", settings().generations);
  const std::string three = ended("three", 33, 3);
  auto longer = OptimizationRun::resume(three, "", settings().generations);
  finish(longer, 2);
  expectSameRun(one, three);
}

// A torn last line and a best.toml from after the checkpoint are what a kill between two writes leaves.
TEST_F(RunFolder, ForgetsWhatWasWrittenAfterTheCheckpoint) {
  const std::string whole = ended("whole", settings().generations);
  const std::string torn = ended("torn", 60);
  std::ofstream(torn + "/generations.jsonl", std::ios::app) << "{\"generation\":61,\"best";
  std::ofstream(torn + "/best.toml", std::ios::app) << "junk";
  auto resumed = OptimizationRun::resume(torn, "", settings().generations);
  finish(resumed, 1);
  expectSameRun(whole, torn);
}

// A run that ends between two regular validations: the last generations count as well.
TEST_F(RunFolder, TheLastGenerationIsValidated) {
  OptimizationSettings four = settings();
  four.generations = 4;
  const std::string folder = root_ + "/run";
  GenerationReport report;
  std::int64_t trials = 0;
  {
    auto run = OptimizationRun::create(folder, four, "");
    const auto evaluator = makeThreadEvaluator(makeObjective(run.settings(), ""), 1);
    while (run.step(*evaluator, report)) {
    }
    trials = run.trials();
  }
  const std::string best = bytes(folder + "/best.toml");
  const auto origins = readProvenance(folder + "/best.toml");
  ASSERT_EQ(origins.size(), 1U);
  const auto seeds = origins[0].seeds.all();
  const auto drawn = trialSeeds(four.seed, 4, SeedStream::Validation, four.validationTrials);
  ASSERT_GE(seeds.size(), drawn.size());
  EXPECT_TRUE(std::equal(drawn.rbegin(), drawn.rend(), seeds.rbegin()));
  EXPECT_EQ(report.trials, trials + 3 * four.validationTrials);
  EXPECT_DOUBLE_EQ(report.incumbent, origins[0].fitness);
  {
    auto again = OptimizationRun::resume(folder, "", std::nullopt);
    finish(again, 1);
  }
  EXPECT_EQ(bytes(folder + "/best.toml"), best);
}

TEST_F(RunFolder, ALongerRunForgetsTheLastValidationOfAShorterOne) {
  const std::string whole = ended("whole", 13);
  const std::string extended = ended("extended", 4);
  for (const int generations : {7, 13}) {
    auto run = OptimizationRun::resume(extended, "", generations);
    finish(run, 1);
  }
  expectSameRun(whole, extended);
}

TEST_F(RunFolder, CheckpointsWithoutThePopulationOfTheIncumbentAreRead) {
  const std::string folder = ended("run", 5);
  const std::string best = bytes(folder + "/best.toml");
  auto state = nlohmann::json::parse(bytes(folder + "/checkpoint.json"));
  ASSERT_EQ(state.at("incumbent").erase("population"), 1U);
  writeAtomically(folder + "/checkpoint.json", state.dump());
  OptimizationRun::resume(folder, "", std::nullopt);
  EXPECT_EQ(bytes(folder + "/best.toml"), best);
}

TEST_F(RunFolder, ImprovesAndItsProvenanceRepeats) {
  auto run = OptimizationRun::create(root_ + "/run", settings(), "");
  finish(run, 2);
  const std::string best = root_ + "/run/best.toml";
  const auto repetitions = repeatLearned(best, "", 2);
  ASSERT_EQ(repetitions.size(), 1U);
  EXPECT_DOUBLE_EQ(repetitions[0].recorded.fitness, repetitions[0].repeated.fitness);
  EXPECT_GE(repetitions[0].recorded.seeds.size(), 6U);

  // Better than the start on seeds that neither has seen.
  agent::AgentParameters learned;
  config::overlayFile(learned, best);
  const auto seeds = trialSeeds(77, 0, SeedStream::Candidates, 20);
  const Task& task = findTask("quadratic");
  EXPECT_GT(measure(task, learned, seeds, {}, 1).fitness,
            measure(task, agent::AgentParameters{}, seeds, {}, 1).fitness + 0.01);

  // The first line of the log can be measured again from what it holds.
  std::ifstream file(root_ + "/run/generations.jsonl");
  std::string text;
  std::getline(file, text);
  const auto line = nlohmann::json::parse(text);
  const auto point = line["candidates"][2]["point"].get<std::vector<double>>();
  const Eigen::VectorXd vector =
      Eigen::Map<const Eigen::VectorXd>(point.data(), static_cast<Eigen::Index>(point.size()));
  EXPECT_EQ(makeObjective(run.settings(), "")({vector, line["seeds"][0].get<std::uint64_t>()}),
            line["candidates"][2]["values"][0].get<double>());
}

TEST_F(RunFolder, RefusesToOverwriteARunAndToResumeNone) {
  auto run = OptimizationRun::create(root_ + "/run", settings(), "");
  EXPECT_THROW(OptimizationRun::create(root_ + "/run", settings(), ""), std::runtime_error);
  EXPECT_THROW(OptimizationRun::resume(root_ + "/other", "", std::nullopt), std::runtime_error);
}

// A search can be made longer, not shorter; who asks for that must not lose it.
TEST_F(RunFolder, ARefusedResumeLeavesTheRunAsItWas) {
  OptimizationSettings five = settings();
  five.generations = 5;
  const std::string folder = root_ + "/run";
  {
    auto run = OptimizationRun::create(folder, five, "");
    finish(run, 1);
  }
  const std::string config = bytes(folder + "/config.json");
  EXPECT_THROW(OptimizationRun::resume(folder, "", 3), std::runtime_error);
  EXPECT_EQ(bytes(folder + "/config.json"), config);
  EXPECT_NO_THROW(OptimizationRun::resume(folder, "", std::nullopt));
}

TEST_F(RunFolder, OneValidationTrialHasNoStandardError) {
  OptimizationSettings one = settings();
  one.validationTrials = 1;
  EXPECT_THROW(OptimizationRun::create(root_ + "/run", one, ""), std::runtime_error);
}

// When mpirun is killed its ranks may live on for a while.
TEST_F(RunFolder, IsHeldByOneProcess) {
  auto run = OptimizationRun::create(root_ + "/run", settings(), "");
  EXPECT_THROW(OptimizationRun::resume(root_ + "/run", "", std::nullopt), std::runtime_error);
  { const OptimizationRun last = std::move(run); }
  EXPECT_NO_THROW(OptimizationRun::resume(root_ + "/run", "", std::nullopt));
}

TEST_F(RunFolder, WritesAReportWithACurvePerParameter) {
  OptimizationSettings shortRun = settings();
  shortRun.generations = 12;
  auto run = OptimizationRun::create(root_ + "/run", shortRun, "");
  finish(run, 1);
  const std::string html = bytes(writeOptimizationReport(root_ + "/run", ""));
  for (const std::string& key : run.space().keys()) EXPECT_NE(html.find(key), std::string::npos) << key;
  EXPECT_EQ(html.find("nan"), std::string::npos);
  for (const char* text : {">Fitness<", ">generation<", ">fitness, higher is better<", ">best candidate<",
                           ">mean of the candidates<", ">incumbent<", ">log10 of sigma<", "&plusmn;"})
    EXPECT_NE(html.find(text), std::string::npos) << text;
  // A band for each of best, incumbent and every parameter.
  std::size_t bands = 0;
  for (std::size_t at = html.find("<polygon"); at != std::string::npos; at = html.find("<polygon", at + 1))
    ++bands;
  EXPECT_EQ(bands, run.space().keys().size() + 2);
}

// In a race a candidate that was lucky in its first trials may have the highest mean, but is not the best.
TEST_F(RunFolder, TheReportsBandIsOfTheBestOfThoseWithAllTrials) {
  OptimizationSettings shortRun = settings();
  shortRun.generations = 4;
  auto run = OptimizationRun::create(root_ + "/run", shortRun, "");
  finish(run, 1);
  const std::string lines = root_ + "/run/generations.jsonl";
  std::vector<nlohmann::json> generations;
  {
    std::ifstream file(lines);
    for (std::string text; std::getline(file, text);) generations.push_back(nlohmann::json::parse(text));
  }
  const auto reportWith = [&](const std::vector<double>& lucky) {
    std::ofstream file(lines, std::ios::trunc);
    for (nlohmann::json line : generations) {
      if (!lucky.empty()) line["candidates"].push_back({{"point", {0.0}}, {"values", lucky}});
      file << line.dump() << "\n";
    }
    file.close();
    return bytes(writeOptimizationReport(root_ + "/run", ""));
  };
  ASSERT_EQ(generations.size(), 4U);
  ASSERT_EQ(generations[0].at("seeds").size(), 3U);
  EXPECT_EQ(reportWith({500.0, 600.0}), reportWith({}));
  EXPECT_NE(reportWith({500.0, 600.0, 700.0}), reportWith({})) << "with all trials it counts";
}

TEST(Configuration, SurvivesItsFile) {
  OptimizationSettings settings;
  settings.task = "quadratic";
  settings.restarts = RestartScheme::Ipop;
  settings.keys = {"motion.walk.gait."};
  Provenance origin;
  origin.task = "sprint";
  origin.fitness = 0.1;
  origin.seeds.add(4294967295U);
  origin.seeds.add(SeedDraw{7, 5, 16});
  origin.standardError = std::numeric_limits<double>::quiet_NaN();  // of one trial
  settings.inherited.push_back(origin);
  const auto text = settings.toJson().dump();
  EXPECT_EQ(OptimizationSettings::fromJson(nlohmann::json::parse(text)).toJson().dump(), text);
}

TEST(TrialSeeds, DifferBetweenGenerationsAndStreams) {
  std::set<std::uint64_t> all;
  for (int generation = 0; generation < 50; ++generation) {
    for (const SeedStream stream : {SeedStream::Candidates, SeedStream::Validation}) {
      for (const std::uint64_t seed : trialSeeds(3, generation, stream, 10)) all.insert(seed);
    }
  }
  EXPECT_EQ(all.size(), 1000U);
  EXPECT_EQ(trialSeeds(3, 7, SeedStream::Validation, 10), trialSeeds(3, 7, SeedStream::Validation, 10));
}

// Files of before there were rules hold bare numbers; both may stand in one list.
TEST(SeedList, IsWhatItsRulesDraw) {
  SeedList list;
  list.add(4294967295U);
  list.add(SeedDraw{7, 5, 16});
  list.add(SeedDraw{7, 10, 4});
  std::vector<std::uint64_t> expected{4294967295U};
  for (const auto& drawn :
       {trialSeeds(7, 5, SeedStream::Validation, 16), trialSeeds(7, 10, SeedStream::Validation, 4)})
    expected.insert(expected.end(), drawn.begin(), drawn.end());
  EXPECT_EQ(list.all(), expected);
  EXPECT_EQ(list.size(), 21U);
  EXPECT_EQ(SeedList::fromJson(list.toJson()).all(), expected);
  EXPECT_EQ(
      list.toToml(),
      "[4294967295, { seed = 7, generation = 5, count = 16 }, { seed = 7, generation = 10, count = 4 }]");
}

TEST(LearnedFile, OpensWithWhatWasReachedAndKeepsTheRuleOfItsSeeds) {
  Provenance origin;
  origin.task = "quadratic";
  origin.fitness = -1.5;
  origin.standardError = 0.25;
  origin.date = "2026-11-22";
  origin.seeds.add(SeedDraw{1, 0, 100});
  const std::string text = learnedToml({}, {}, {"motion.walk.gait.maxStepX"}, {origin});
  EXPECT_LT(text.find("quadratic"), text.find("[motion."));
  EXPECT_LT(text.find("[motion."), text.find("[provenance.quadratic]"));
  EXPECT_NE(text.find("seeds = [{ seed = 1, generation = 0, count = 100 }]"), std::string::npos);
  const std::string path = testing::TempDir() + "/learned_" + std::to_string(::getpid()) + ".toml";
  writeAtomically(path, text);
  const std::vector<Provenance> read = readProvenance(path);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].seeds.all(), trialSeeds(1, 0, SeedStream::Validation, 100));
  agent::AgentParameters parameters;
  EXPECT_NO_THROW(config::overlayFile(parameters, path));
}

TEST(LearnedFile, KeepsTheHighestSeeds) {
  constexpr std::uint64_t kHighest = std::numeric_limits<std::uint64_t>::max();
  Provenance origin;
  origin.task = "quadratic";
  origin.runSeed = kHighest;
  origin.standardError = std::numeric_limits<double>::quiet_NaN();
  origin.seeds.add(kHighest - 1);
  origin.seeds.add(SeedDraw{kHighest, 0, 3});
  const std::string path = testing::TempDir() + "/highest_" + std::to_string(::getpid()) + ".toml";
  writeAtomically(path, learnedToml({}, {}, {"motion.walk.gait.maxStepX"}, {origin}));
  const std::vector<Provenance> read = readProvenance(path);
  fs::remove(path);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].runSeed, kHighest);
  EXPECT_EQ(read[0].seeds.all(), origin.seeds.all());
  EXPECT_TRUE(std::isnan(read[0].standardError));
}

// 1 - 6 sum d^2 / (n (n^2 - 1)), where there are no ties.
TEST(RankCorrelation, IsSpearmans) {
  EXPECT_DOUBLE_EQ(rankCorrelation({1, 2, 3, 4}, {10, 20, 30, 1000}), 1.0);
  EXPECT_DOUBLE_EQ(rankCorrelation({1, 2, 3, 4}, {4, 3, 2, 1}), -1.0);
  EXPECT_DOUBLE_EQ(rankCorrelation({1, 2, 3, 4, 5}, {2, 1, 4, 3, 5}), 1.0 - 6.0 * 4.0 / (5.0 * 24.0));
  EXPECT_NEAR(rankCorrelation({1, 1, 2}, {5, 6, 7}), 0.8660254037844387, 1e-12);
}

}  // namespace
}  // namespace nonet::lab
