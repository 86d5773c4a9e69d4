#include "nonet/app/agent_options.h"

namespace nonet::app {

void addAgentOptions(CLI::App& command, agent::AgentChoice& choice, std::string& data) {
  command.add_option("--type", choice.robotType, "Robot type")
      ->capture_default_str()
      ->check(CLI::Range(0, 4));
  command.add_option("--params", choice.parameterFiles, "Parameter files, overlaid in this order")
      ->check(CLI::ExistingFile);
  command
      .add_option("--set", choice.assignments,
                  "One parameter, name=value, such as team.ball.kick=false; set last")
      ->allow_extra_args(false);
  command.add_option("--data", data, "Folder with params/ and skills/")->check(CLI::ExistingDirectory);
}

}  // namespace nonet::app
