// nonet env: the trials for programs that learn by reinforcement, over standard input and output.
#include <cstdio>
#include <ctime>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/app/agent_options.h"
#include "nonet/app/commands.h"
#include "nonet/app/data_folder.h"
#include "nonet/app/option_checks.h"
#include "nonet/lab/env/env.h"
#include "nonet/math/random.h"

namespace nonet::app {

namespace {

struct EnvArguments {
  agent::AgentChoice choice;
  std::string task;
  std::string data;
  int count = 1;
  int threads = 0;
  double bench = 0.0;  // s
  bool quick = false;
  bool list = false;
};

int listTasks() {
  for (const lab::EnvTask& task : lab::envTasks()) fmt::print("{:<10} {}\n", task.name, task.description);
  return 0;
}

// Steps with random actions; processor time, so that the figure is that of a core however busy the machine
// is.
int measure(lab::EnvBatch& batch, double seconds, std::uint64_t seed) {
  Random random(seed);
  std::vector<float> actions(batch.size() * batch.actions());
  const std::clock_t begin = std::clock();
  const auto used = [&] { return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC; };
  std::size_t steps = 0;
  while (used() < seconds) {
    for (float& action : actions) action = static_cast<float>(random.uniform(-0.3, 0.3));
    batch.step(actions);
    steps += batch.size();
  }
  const double rate = static_cast<double>(steps) / used();
  fmt::print("{:.0f} steps a second of one core, {:.0f} times real time; episodes begin anew within this\n",
             rate, rate * batch.secondsPerStep());
  return 0;
}

void write(const void* data, std::size_t bytes) {
  if (std::fwrite(data, 1, bytes, stdout) != bytes) throw std::runtime_error("the reader has gone away");
}

// False at the end; within a batch nobody ends who means to.
bool readActions(std::vector<float>& actions) {
  const std::size_t bytes = actions.size() * sizeof(float);
  const std::size_t read = std::fread(actions.data(), 1, bytes, stdin);
  if (read == 0 || read == bytes) return read > 0;
  throw std::runtime_error(
      fmt::format("standard input: ended within a batch of actions, after {} of its {} bytes: expected {} "
                  "32-bit floats a step",
                  read, bytes, actions.size()));
}

// The header as a line of JSON, the first observations; then for every batch of actions observations, rewards
// and ends. Numbers are 32-bit floats in the machine's order, ends are bytes.
int serve(lab::EnvBatch& batch, const std::string& task) {
  const nlohmann::ordered_json header = {{"task", task},
                                         {"envs", batch.size()},
                                         {"observations", batch.observations()},
                                         {"actions", batch.actions()},
                                         {"seconds_per_step", batch.secondsPerStep()}};
  const std::string line = header.dump() + "\n";
  write(line.data(), line.size());
  write(batch.observation().data(), batch.observation().size_bytes());
  std::fflush(stdout);
  std::vector<float> actions(batch.size() * batch.actions());
  while (readActions(actions)) {
    batch.step(actions);
    write(batch.observation().data(), batch.observation().size_bytes());
    write(batch.rewards().data(), batch.rewards().size_bytes());
    write(batch.done().data(), batch.done().size_bytes());
    std::fflush(stdout);
  }
  return 0;
}

int run(const EnvArguments& arguments) {
  spdlog::set_level(spdlog::level::warn);  // who enters the field is no news here
  if (arguments.list) return listTasks();
  if (arguments.task.empty()) throw std::runtime_error("which environment? nonet env --list names them");
  lab::EnvSettings settings;
  settings.agent = agent::makeAgentSettings(arguments.choice, dataFolder(arguments.data));
  settings.server.quickSolver = arguments.quick;
  lab::EnvBatch batch(arguments.task, settings, arguments.count, arguments.threads, arguments.choice.seed);
  if (arguments.bench > 0.0) return measure(batch, arguments.bench, arguments.choice.seed);
  return serve(batch, arguments.task);
}

}  // namespace

void addEnvCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand(
      "env", "Trials as batched environments for learners, over standard input and output");
  const auto arguments = std::make_shared<EnvArguments>();
  command->add_option("task", arguments->task, "Name of the environment");
  command->add_flag("--list", arguments->list, "List the environments");
  command->add_option("--envs", arguments->count, "Environments in the batch")->check(CLI::Range(1, 10000));
  command->add_option("--threads", arguments->threads, "Threads, 0 = all processors")->check(threadCount());
  command->add_option("--seed", arguments->choice.seed, "Seed of all episodes");
  addAgentOptions(*command, arguments->choice, arguments->data);
  command->add_flag("--quick", arguments->quick, "Quick stepper instead of the exact one");
  command->add_option("--bench", arguments->bench, "Steps with random actions for so many seconds instead")
      ->check(CLI::Range(0.0, 3600.0));
  command->footer(
      "A program that learns starts this command and talks to it: PipeEnv in scripts/nonet_env.py.\n"
      "libnonet_env.so is the same without a pipe: VectorEnv there.\nExamples:\n  nonet env --list\n"
      "  nonet env run --type 4 --envs 8 --threads 1 --bench 5\n  python3 scripts/env_example.py dribble");
  command->callback([arguments, &exitCode] { exitCode = run(*arguments); });
}

}  // namespace nonet::app
