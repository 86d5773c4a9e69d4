// nonet params: every parameter of an agent with its value, what it may be, what it means and who says so.
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/app/commands.h"
#include "nonet/app/data_folder.h"
#include "nonet/config/assignment.h"
#include "nonet/config/layers.h"

namespace nonet::app {

namespace {

using config::ParameterView;
using Layers = config::Layers<agent::AgentParameters>;

struct ParamsArguments {
  int robotType = 0;
  std::vector<std::string> files;
  std::vector<std::string> assignments;
  std::string data;
  std::string word;
  bool differing = false;
};

constexpr const char* kCode = "code";

/// The same layers as those of agent::makeAgentConfig().
Layers layersOf(const ParamsArguments& arguments, const std::string& data) {
  agent::AgentParameters defaults;
  defaults.motion.skills = motion::declareSkillParameters(data + "/skills");
  Layers layers(defaults, kCode);
  const auto file = [&layers](const std::string& path) {
    layers.add(path, [&path](agent::AgentParameters& parameters) { config::overlayFile(parameters, path); });
  };
  file(fmt::format("{}/params/type{}.toml", data, arguments.robotType));
  for (const std::string& path : arguments.files) file(path);
  for (const std::string& text : arguments.assignments) {
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
  std::size_t shown = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const ParameterView& view = values[i];
    if (arguments.differing && view.value == initial[i].value) continue;
    const std::string_view text = view.declaration.text;
    if (view.key.find(arguments.word) == std::string::npos &&
        text.find(arguments.word) == std::string_view::npos)
      continue;
    // What the code does not say itself, it has from the skill files.
    const bool skill = layers.origins()[i] == kCode && view.key.starts_with("motion.skills.");
    print(view, initial[i], skill ? data + "/skills" : layers.origins()[i]);
    ++shown;
  }
  fmt::print("{} of {} parameters, robot type {}\n", shown, values.size(), arguments.robotType);
  return shown > 0 ? 0 : 1;
}

}  // namespace

void addParamsCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand(
      "params", "List an agent's parameters: value, unit, range, meaning and the file that sets each");
  const auto arguments = std::make_shared<ParamsArguments>();
  command->add_option("--type", arguments->robotType, "Robot type")
      ->capture_default_str()
      ->check(CLI::Range(0, 4));
  command->add_option("--params", arguments->files, "Parameter files, overlaid in this order")
      ->check(CLI::ExistingFile);
  command->add_option("--set", arguments->assignments, "One parameter, name=value; set last")
      ->allow_extra_args(false);
  command->add_option("--data", arguments->data, "Folder with params/ and skills/")
      ->check(CLI::ExistingDirectory);
  command->add_option("--grep", arguments->word, "Only those with this in their name or sentence");
  command->add_flag("--diff", arguments->differing, "Only those that differ from the default");
  command->footer("Exit code 1 if there is no such parameter.");
  command->callback([arguments, &exitCode] { exitCode = run(*arguments); });
}

}  // namespace nonet::app
