#include "nonet/lab/optimize/optimization_settings.h"

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

json OptimizationSettings::toJson() const {
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
          {"version", version},
          {"fingerprint", fingerprint}};
}

OptimizationSettings OptimizationSettings::fromJson(const json& value) {
  OptimizationSettings settings;
  value.at("task").get_to(settings.task);
  value.at("robotType").get_to(settings.robotType);
  value.at("quickSolver").get_to(settings.quickSolver);
  value.at("seed").get_to(settings.seed);
  value.at("population").get_to(settings.population);
  value.at("generations").get_to(settings.generations);
  value.at("sigma").get_to(settings.sigma);
  value.at("trials").get_to(settings.trials);
  value.at("racing").get_to(settings.racing);
  value.at("validationEvery").get_to(settings.validationEvery);
  value.at("validationTrials").get_to(settings.validationTrials);
  settings.restarts = restartSchemeOf(value.at("restarts").get<std::string>());
  value.at("keys").get_to(settings.keys);
  value.at("parameters").get_to(settings.parameters);
  for (const json& origin : value.at("inherited")) settings.inherited.push_back(Provenance::fromJson(origin));
  value.at("date").get_to(settings.date);
  value.at("version").get_to(settings.version);
  settings.fingerprint = value.value("fingerprint", "");
  return settings;
}

std::vector<std::string> OptimizationSettings::searchedKeys() const {
  return keys.empty() ? findTask(task).searchedKeys() : keys;
}

agent::AgentParameters OptimizationSettings::startParameters(const std::string& dataFolder) const {
  agent::AgentParameters start = defaultParameters(dataFolder);
  config::overlayText(start, parameters, "start parameters of the run");
  findTask(task).prepare(start);
  return start;
}

TaskSettings OptimizationSettings::taskSettings(const std::string& dataFolder) const {
  return {.robotType = robotType, .quickSolver = quickSolver, .dataFolder = dataFolder};
}

agent::AgentParameters defaultParameters(const std::string& dataFolder) {
  agent::AgentParameters defaults;
  const std::string skills = dataFolder + "/skills";
  if (std::filesystem::is_directory(skills)) defaults.motion.skills = motion::declareSkillParameters(skills);
  return defaults;
}

void setStart(OptimizationSettings& settings, const std::string& dataFolder,
              const std::vector<std::string>& files) {
  agent::AgentParameters start = defaultParameters(dataFolder);
  settings.inherited.clear();
  const auto overlay = [&](const std::string& file) {
    config::overlayFile(start, file);
    for (const Provenance& origin : readProvenance(file)) replaceProvenance(settings.inherited, origin);
  };
  const std::string typeFile = fmt::format("{}/params/type{}.toml", dataFolder, settings.robotType);
  if (std::filesystem::exists(typeFile)) overlay(typeFile);
  for (const std::string& file : files) overlay(file);
  settings.parameters = config::toToml(start);
}

Objective makeObjective(const OptimizationSettings& settings, const std::string& dataFolder) {
  const Task& task = findTask(settings.task);
  auto space =
      std::make_shared<const SearchSpace>(settings.startParameters(dataFolder), settings.searchedKeys());
  return [&task, space = std::move(space), settings = settings.taskSettings(dataFolder)](const Job& job) {
    return task.evaluate(space->apply(job.point), job.seed, settings).fitness;
  };
}

}  // namespace nonet::lab
