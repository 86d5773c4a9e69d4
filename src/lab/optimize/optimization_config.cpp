#include "nonet/lab/optimize/optimization_config.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "nonet/config/parameters.h"

namespace nonet::lab {

using nlohmann::json;

RestartScheme restartSchemeOf(const std::string& name) {
  if (name == "none") return RestartScheme::None;
  if (name == "ipop") return RestartScheme::Ipop;
  if (name == "bipop") return RestartScheme::Bipop;
  throw std::runtime_error(fmt::format("unknown restart scheme '{}': use none, ipop or bipop", name));
}

std::string nameOf(RestartScheme scheme) {
  switch (scheme) {
    case RestartScheme::Ipop:
      return "ipop";
    case RestartScheme::Bipop:
      return "bipop";
    case RestartScheme::None:
      break;
  }
  return "none";
}

json OptimizationConfig::toJson() const {
  json origins = json::array();
  for (const Provenance& origin : inherited) origins.push_back(origin.toJson());
  return {{"task", task},
          {"robotType", robotType},
          {"quickSolver", quickSolver},
          {"seed", seed},
          {"population", population},
          {"generations", generations},
          {"sigma", sigma},
          {"trials", trials},
          {"racing", racing},
          {"validationEvery", validationEvery},
          {"validationTrials", validationTrials},
          {"restarts", nameOf(restarts)},
          {"keys", keys},
          {"parameters", parameters},
          {"inherited", std::move(origins)},
          {"date", date},
          {"version", version}};
}

OptimizationConfig OptimizationConfig::fromJson(const json& value) {
  OptimizationConfig config;
  value.at("task").get_to(config.task);
  value.at("robotType").get_to(config.robotType);
  value.at("quickSolver").get_to(config.quickSolver);
  value.at("seed").get_to(config.seed);
  value.at("population").get_to(config.population);
  value.at("generations").get_to(config.generations);
  value.at("sigma").get_to(config.sigma);
  value.at("trials").get_to(config.trials);
  value.at("racing").get_to(config.racing);
  value.at("validationEvery").get_to(config.validationEvery);
  value.at("validationTrials").get_to(config.validationTrials);
  config.restarts = restartSchemeOf(value.at("restarts").get<std::string>());
  value.at("keys").get_to(config.keys);
  value.at("parameters").get_to(config.parameters);
  for (const json& origin : value.at("inherited")) config.inherited.push_back(Provenance::fromJson(origin));
  value.at("date").get_to(config.date);
  value.at("version").get_to(config.version);
  return config;
}

std::vector<std::string> OptimizationConfig::searchedKeys() const {
  return keys.empty() ? findTask(task).searchedKeys() : keys;
}

agent::AgentParameters OptimizationConfig::startParameters(const std::string& dataFolder) const {
  agent::AgentParameters start = defaultParameters(dataFolder);
  config::overlayText(start, parameters, "start parameters of the run");
  findTask(task).prepare(start);
  return start;
}

TaskSettings OptimizationConfig::taskSettings(const std::string& dataFolder) const {
  return {.robotType = robotType, .quickSolver = quickSolver, .dataFolder = dataFolder};
}

agent::AgentParameters defaultParameters(const std::string& dataFolder) {
  agent::AgentParameters defaults;
  const std::string skills = dataFolder + "/skills";
  if (std::filesystem::is_directory(skills)) defaults.motion.skills = motion::declareSkillParameters(skills);
  return defaults;
}

void setStart(OptimizationConfig& config, const std::string& dataFolder,
              const std::vector<std::string>& files) {
  agent::AgentParameters start = defaultParameters(dataFolder);
  config.inherited.clear();
  const auto overlay = [&](const std::string& file) {
    config::overlayFile(start, file);
    for (const Provenance& origin : readProvenance(file)) replaceProvenance(config.inherited, origin);
  };
  const std::string typeFile = fmt::format("{}/params/type{}.toml", dataFolder, config.robotType);
  if (std::filesystem::exists(typeFile)) overlay(typeFile);
  for (const std::string& file : files) overlay(file);
  config.parameters = config::toToml(start);
}

Objective makeObjective(const OptimizationConfig& config, const std::string& dataFolder) {
  const Task& task = findTask(config.task);
  auto space = std::make_shared<const SearchSpace>(config.startParameters(dataFolder), config.searchedKeys());
  return [&task, space = std::move(space), settings = config.taskSettings(dataFolder)](const Job& job) {
    return task.evaluate(space->apply(job.point), job.seed, settings).fitness;
  };
}

}  // namespace nonet::lab
