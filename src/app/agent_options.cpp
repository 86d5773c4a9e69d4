#include "nonet/app/agent_options.h"

#include "nonet/app/option_checks.h"

namespace nonet::app {

void addAgentOptions(CLI::App& command, agent::AgentChoice& choice, std::string& data) {
  command.add_option("--type", choice.robotType, "Robot type")->check(CLI::Range(0, 4));
  command
      .add_option("--params", choice.parameterFiles,
                  "A parameter file; given again, the later one lies over the earlier")
      ->allow_extra_args(false)
      ->check(CLI::ExistingFile);
  command
      .add_option("--set", choice.assignments,
                  "One parameter, name=value, such as team.ball.kick=false; set last")
      ->allow_extra_args(false);
  command.add_option("--data", data, "Folder with params/ and skills/")->check(CLI::ExistingDirectory);
}

std::optional<lab::ServerAddress> ServerChoice::chosen() const {
  return overTcp ? std::optional(address) : std::nullopt;
}

void addServerOptions(CLI::App& command, ServerChoice& server) {
  CLI::Option* tcp =
      command.add_flag("--tcp", server.overTcp, "Measure on a running, empty server instead of in process");
  command.add_option("--host", server.address.host, "Its host")->needs(tcp);
  command.add_option("--port", server.address.port, "Its agent port")->check(otherPort())->needs(tcp);
  command.add_option("--monitor-port", server.address.monitorPort, "Its monitor port")
      ->check(otherPort())
      ->needs(tcp);
}

}  // namespace nonet::app
