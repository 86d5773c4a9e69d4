// The options that choose the agent of a measurement, and where it is measured: the same in every command.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "nonet/agent/agent_setup.h"
#include "nonet/lab/trial/server_address.h"

namespace nonet::app {

/// --type, --params, --set and --data.
void addAgentOptions(CLI::App& command, agent::AgentChoice& choice, std::string& data);

/// Whether to measure on a running server, and on which.
struct ServerChoice {
  bool overTcp = false;
  lab::ServerAddress address;

  /// Empty: in this process.
  std::optional<lab::ServerAddress> chosen() const;
};

/// --tcp, --host, --port and --monitor-port.
void addServerOptions(CLI::App& command, ServerChoice& server);

}  // namespace nonet::app
