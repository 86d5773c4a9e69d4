#include "nonet/lab/optimize/learned_file.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "nonet/config/parameters.h"
#include "nonet/config/toml.h"
#include "nonet/lab/common/statistics.h"
#include "nonet/lab/optimize/optimization_settings.h"

namespace nonet::lab {

using nlohmann::json;

namespace {

constexpr const char* kExact = "exact";
constexpr const char* kQuick = "quick";

template <class Value>
Value require(const toml::table& table, const char* key, const std::string& path) {
  const auto value = table[key].value<Value>();
  if (!value) throw std::runtime_error(fmt::format("{}: a provenance table has no proper '{}'", path, key));
  return *value;
}

Provenance provenanceFrom(const toml::table& table, const std::string& path) {
  Provenance origin;
  origin.task = require<std::string>(table, "task", path);
  origin.robotType = require<int>(table, "robotType", path);
  origin.quickSolver = require<std::string>(table, "solver", path) == kQuick;
  origin.runSeed = static_cast<std::uint64_t>(require<std::int64_t>(table, "runSeed", path));
  origin.population = require<int>(table, "population", path);
  origin.generation = require<int>(table, "generation", path);
  origin.budget = require<std::int64_t>(table, "budget", path);
  origin.fitness = require<double>(table, "fitness", path);
  origin.standardError = require<double>(table, "standardError", path);
  origin.date = require<std::string>(table, "date", path);
  origin.version = require<std::string>(table, "version", path);
  if (const toml::array* seeds = table["seeds"].as_array()) {
    for (const auto& seed : *seeds) {
      if (const toml::table* draw = seed.as_table()) {
        origin.seeds.add(SeedDraw{static_cast<std::uint64_t>(require<std::int64_t>(*draw, "seed", path)),
                                  require<int>(*draw, "generation", path),
                                  require<int>(*draw, "count", path)});
      } else {
        origin.seeds.add(static_cast<std::uint64_t>(seed.value_or<std::int64_t>(0)));
      }
    }
  }
  return origin;
}

std::string provenanceToml(const Provenance& origin) {
  const auto real = [](double value) {
    std::string text = fmt::format("{}", value);
    if (text.find_first_of(".en") == std::string::npos) text += ".0";
    return text;
  };
  // Whole numbers of TOML have 64 bits with a sign: the reader casts the seed back.
  return fmt::format(
      "[provenance.{}]\n"
      "task = \"{}\"\n"
      "robotType = {}\n"
      "solver = \"{}\"\n"
      "runSeed = {}\n"
      "population = {}\n"
      "generation = {}\n"
      "budget = {}\n"
      "fitness = {}\n"
      "standardError = {}\n"
      "seeds = {}\n"
      "date = \"{}\"\n"
      "version = \"{}\"\n",
      origin.task, origin.task, origin.robotType, origin.quickSolver ? kQuick : kExact,
      static_cast<std::int64_t>(origin.runSeed), origin.population, origin.generation, origin.budget,
      real(origin.fitness), real(origin.standardError), origin.seeds.toToml(), origin.date, origin.version);
}

// What a reader wants to know first.
std::string summary(const std::vector<Provenance>& origins) {
  std::string text =
      "# Learned values. Where they come from stands at the end; `nonet optimize --repeat FILE` measures\n"
      "# their fitness again.\n"
      "#\n"
      "#   task              fitness            trials  found\n";
  for (const Provenance& origin : origins) {
    text += fmt::format("#   {:<16} {:9.3f} +- {:<7} {:6}  {}\n", origin.task, origin.fitness,
                        errorText(origin.standardError), origin.seeds.size(), origin.date);
  }
  return text;
}

std::string tableOf(const std::string& key) {
  return key.substr(0, key.rfind('.'));
}

}  // namespace

json Provenance::toJson() const {
  return {{"task", task},
          {"robotType", robotType},
          {"quickSolver", quickSolver},
          {"runSeed", runSeed},
          {"population", population},
          {"generation", generation},
          {"budget", budget},
          {"fitness", fitness},
          {"standardError", standardError},
          {"seeds", seeds.toJson()},
          {"date", date},
          {"version", version}};
}

Provenance Provenance::fromJson(const json& value) {
  Provenance origin;
  value.at("task").get_to(origin.task);
  value.at("robotType").get_to(origin.robotType);
  value.at("quickSolver").get_to(origin.quickSolver);
  value.at("runSeed").get_to(origin.runSeed);
  value.at("population").get_to(origin.population);
  value.at("generation").get_to(origin.generation);
  value.at("budget").get_to(origin.budget);
  value.at("fitness").get_to(origin.fitness);
  const json& error = value.at("standardError");  // JSON has no NaN
  origin.standardError = error.is_null() ? std::numeric_limits<double>::quiet_NaN() : error.get<double>();
  origin.seeds = SeedList::fromJson(value.at("seeds"));
  value.at("date").get_to(origin.date);
  value.at("version").get_to(origin.version);
  return origin;
}

std::vector<Provenance> readProvenance(const std::string& path) {
  std::vector<Provenance> origins;
  const toml::table file = config::parseTomlFile(path);
  if (const toml::table* tables = file["provenance"].as_table()) {
    for (const auto& [name, node] : *tables) {
      if (const toml::table* table = node.as_table()) origins.push_back(provenanceFrom(*table, path));
    }
  }
  return origins;
}

void replaceProvenance(std::vector<Provenance>& list, const Provenance& origin) {
  std::erase_if(list, [&](const Provenance& other) { return other.task == origin.task; });
  list.push_back(origin);
}

std::string learnedToml(const agent::AgentParameters& parameters, const agent::AgentParameters& defaults,
                        const std::vector<std::string>& searchedKeys,
                        const std::vector<Provenance>& origins) {
  std::set<std::string> tables;
  for (const std::string& key : searchedKeys) tables.insert(tableOf(key));
  agent::AgentParameters copy = parameters;
  auto base = defaults;
  const auto fields = config::fieldsOf(copy);
  const auto baseFields = config::fieldsOf(base);
  std::vector<config::detail::Field> kept;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (tables.contains(tableOf(fields[i].key)) || !config::detail::sameValue(fields[i], baseFields[i]))
      kept.push_back(fields[i]);
  }
  std::string text = summary(origins) + "\n" + config::detail::toToml(kept, nullptr);
  for (const Provenance& origin : origins) text += "\n" + provenanceToml(origin);
  return text;
}

Measurement measure(const Task& task, const agent::AgentParameters& parameters,
                    const std::vector<std::uint64_t>& seeds, const TaskSettings& settings, int threads,
                    const MeasureProgress& progress) {
  std::vector<TaskResult> results(seeds.size());
  std::atomic<std::size_t> done{0};
  const std::string name(task.name());
  // The thread evaluator works on numbers, so the "point" says which seed it is.
  const auto evaluator = makeThreadEvaluator(
      [&](const Job& job) {
        TaskResult& result = results[static_cast<std::size_t>(job.point[0])];
        result = task.evaluate(parameters, job.seed, settings);
        if (progress) progress(name, ++done, seeds.size());
        return result.fitness;
      },
      threads);
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < seeds.size(); ++i)
    jobs.push_back({Eigen::VectorXd::Constant(1, static_cast<double>(i)), seeds[i]});
  const std::vector<double> values = evaluator->evaluate(jobs);

  Measurement measurement;
  if (values.empty()) return measurement;
  const auto count = static_cast<double>(values.size());
  measurement.fitness = mean(values);
  measurement.standardError = standardError(values);
  for (std::size_t m = 0; m < results[0].measures.size(); ++m) {
    double sum = 0.0;
    for (const TaskResult& result : results) sum += result.measures.at(m).second;
    measurement.measures.emplace_back(results[0].measures[m].first, sum / count);
  }
  return measurement;
}

std::vector<Repetition> repeatLearned(const std::string& file, const std::string& dataFolder, int threads,
                                      const MeasureProgress& progress) {
  agent::AgentParameters parameters = defaultParameters(dataFolder);
  config::overlayFile(parameters, file);
  std::vector<Repetition> repetitions;
  for (const Provenance& origin : readProvenance(file)) {
    const TaskSettings settings{
        .robotType = origin.robotType, .quickSolver = origin.quickSolver, .dataFolder = dataFolder};
    repetitions.push_back({origin, measure(findTask(origin.task), parameters, origin.seeds.all(), settings,
                                           threads, progress)});
  }
  return repetitions;
}

}  // namespace nonet::lab
