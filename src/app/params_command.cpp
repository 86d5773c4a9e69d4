// nonet params: every parameter of an agent with its value, what it may be, what it means and who says so.
#include <algorithm>
#include <cctype>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "nonet/agent/agent_setup.h"
#include "nonet/app/agent_options.h"
#include "nonet/app/commands.h"
#include "nonet/app/data_folder.h"
#include "nonet/config/assignment.h"
#include "nonet/config/layers.h"

namespace nonet::app {

namespace {

using config::ParameterView;
using Layers = config::Layers<agent::AgentParameters>;

struct ParamsArguments {
  agent::AgentChoice choice;
  std::string data;
  std::string word;
  bool differing = false;
  bool json = false;
};

constexpr const char* kCode = "code";

/// The same layers as those of agent::makeAgentSettings().
Layers layersOf(const ParamsArguments& arguments, const std::string& data) {
  agent::AgentParameters defaults;
  defaults.motion.skills = motion::declareSkillParameters(data + "/skills");
  Layers layers(defaults, kCode);
  const auto file = [&layers](const std::string& path) {
    layers.add(path, [&path](agent::AgentParameters& parameters) { config::overlayFile(parameters, path); });
  };
  file(fmt::format("{}/params/type{}.toml", data, arguments.choice.robotType));
  for (const std::string& path : arguments.choice.parameterFiles) file(path);
  for (const std::string& text : arguments.choice.assignments) {
    layers.add("--set",
               [&text](agent::AgentParameters& parameters) { config::assignParameter(parameters, text); });
  }
  return layers;
}

std::string valueText(const ParameterView& view, double value) {
  if (view.kind == ParameterView::Kind::Boolean) return value != 0.0 ? "true" : "false";
  return fmt::format("{}", value);
}

std::string rangeText(const std::optional<config::Range>& range) {
  return range ? fmt::format("{} .. {}", range->low, range->high) : "-";
}

/// Upper and lower case are the same.
bool contains(std::string_view text, std::string_view word) {
  const auto same = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
  return std::search(text.begin(), text.end(), word.begin(), word.end(), same) != text.end();
}

nlohmann::ordered_json jsonOf(const std::optional<config::Range>& range) {
  if (!range) return nullptr;
  return {range->low, range->high};
}

nlohmann::ordered_json jsonOf(const ParameterView& view, const ParameterView& initial,
                              const std::string& origin) {
  const bool isSwitch = view.kind == ParameterView::Kind::Boolean;
  const auto value = [isSwitch](double number) {
    return isSwitch ? nlohmann::ordered_json(number != 0.0) : nlohmann::ordered_json(number);
  };
  return {{"name", view.key},
          {"value", value(view.value)},
          {"unit", std::string(config::unitName(view.declaration.unit))},
          {"default", value(initial.value)},
          {"range", isSwitch ? nlohmann::ordered_json() : jsonOf(view.declaration.range)},
          {"search", jsonOf(view.declaration.searchRange)},
          {"from", origin},
          {"text", std::string(view.declaration.text)}};
}

/// Two lines: numbers, and below what they mean.
void print(const ParameterView& view, const ParameterView& initial, const std::string& origin) {
  const bool isSwitch = view.kind == ParameterView::Kind::Boolean;
  const std::string unit(config::unitName(view.declaration.unit));
  const std::string before =
      view.value == initial.value ? "" : fmt::format(" (default {})", valueText(initial, initial.value));
  fmt::print("{} = {}{}{}{}\n", view.key, valueText(view, view.value), unit.empty() ? "" : " ", unit, before);
  fmt::print("    range {}, search {}, from {}\n",
             isSwitch ? "true or false" : rangeText(view.declaration.range),
             rangeText(view.declaration.searchRange), origin);
  if (!view.declaration.text.empty()) fmt::print("    {}\n", view.declaration.text);
}

int run(const ParamsArguments& arguments) {
  const std::string data = dataFolder(arguments.data);
  const Layers layers = layersOf(arguments, data);
  const auto values = config::listParameters(layers.parameters());
  agent::AgentParameters defaults;
  defaults.motion.skills = motion::declareSkillParameters(data + "/skills");
  const auto initial = config::listParameters(defaults);
  nlohmann::ordered_json shown = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const ParameterView& view = values[i];
    if (arguments.differing && view.value == initial[i].value) continue;
    if (!contains(view.key, arguments.word) && !contains(view.declaration.text, arguments.word)) continue;
    // What the code does not say itself, it has from the skill files.
    const bool skill = layers.origins()[i] == kCode && view.key.starts_with("motion.skills.");
    const std::string origin = skill ? data + "/skills" : layers.origins()[i];
    if (!arguments.json) print(view, initial[i], origin);
    shown.push_back(jsonOf(view, initial[i], origin));
  }
  if (arguments.json) {
    fmt::print("{}\n", shown.dump(1));
  } else {
    fmt::print("{} of {} parameters, robot type {}\n", shown.size(), values.size(),
               arguments.choice.robotType);
  }
  return shown.empty() ? 1 : 0;
}

}  // namespace

void addParamsCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand(
      "params", "List an agent's parameters: value, unit, range, meaning and the file that sets each");
  const auto arguments = std::make_shared<ParamsArguments>();
  addAgentOptions(*command, arguments->choice, arguments->data);
  command->add_option("--grep", arguments->word,
                      "Only those with this in their name or sentence, upper or lower case");
  command->add_flag("--diff", arguments->differing, "Only those that differ from the default");
  command->add_flag("--json", arguments->json, "Print a JSON list");
  command->footer(
      "Examples:\n  nonet params --grep kick --type 4\n  nonet params --diff --params my.toml\n"
      "  nonet params --json --grep team.pace\nExit code 1 if there is no such parameter.");
  command->callback([arguments, &exitCode] { exitCode = run(*arguments); });
}

}  // namespace nonet::app
