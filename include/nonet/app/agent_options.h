// The options that choose the agent of a measurement: the same in every command.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "nonet/agent/agent_setup.h"

namespace nonet::app {

/// --type, --params, --set and --data.
void addAgentOptions(CLI::App& command, agent::AgentChoice& choice, std::string& data);

}  // namespace nonet::app
