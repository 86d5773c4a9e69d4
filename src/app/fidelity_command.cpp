#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "nonet/app/commands.h"
#include "nonet/lab/common/atomic_file.h"
#include "nonet/lab/common/folder_lock.h"
#include "nonet/sim/fidelity/fidelity.h"

namespace nonet::app {
namespace {

struct FidelityArguments {
  std::filesystem::path folder;
  std::filesystem::path jsonFile;
  std::filesystem::path svgFolder;
  std::string solver = "exact";
  sim::WorldSettings settings;
};

/// The recordings in a folder (or the one file), sorted by name.
std::vector<std::filesystem::path> recordingsIn(const std::filesystem::path& folder) {
  if (std::filesystem::is_regular_file(folder)) return {folder};
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".jsonl") || name.ends_with(".jsonl.gz")) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) {
    throw std::runtime_error(fmt::format("{}: no recordings (*.jsonl, *.jsonl.gz) there", folder.string()));
  }
  return files;
}

std::string timeOrNever(const std::optional<double>& seconds) {
  return seconds ? fmt::format("{:.2f} s", *seconds) : "never";
}

nlohmann::ordered_json toJson(const sim::FidelityResult& result) {
  const auto time = [&result](std::size_t i) -> nlohmann::ordered_json {
    if (!result.firstOver[i]) return nullptr;
    return *result.firstOver[i];
  };
  return {{"scenario", result.scenario},
          {"first_over_0.1mm_s", time(0)},
          {"first_over_1mm_s", time(1)},
          {"first_over_1cm_s", time(2)},
          {"max_error_m", result.worst.position()},
          {"max_joint_error_deg", result.worst.joints}};
}

void printHead() {
  fmt::print("{:<22} {:>6}  {:>9} {:>9} {:>9}  {:>9} {:>8} {:>8} {:>8} {:>8}\n", "scenario", "cycles",
             ">0.1 mm", ">1 mm", ">1 cm", "position", "joints", "gyro", "acc", "force");
}

void printRow(const sim::FidelityResult& result) {
  const sim::CycleError& worst = result.worst;
  fmt::print(
      "{:<22} {:>6}  {:>9} {:>9} {:>9}  {:>7.1e} m {:>5.2f} deg {:>4.2f} deg/s {:>4.2f} m/s2 {:>4.2f} "
      "N{}\n",
      result.scenario, result.cycles.size(), timeOrNever(result.firstOver[0]),
      timeOrNever(result.firstOver[1]), timeOrNever(result.firstOver[2]), worst.position(), worst.joints,
      worst.gyro, worst.accelerometer, worst.footForce,
      result.knownHistory ? "" : "  (start taken from the recording)");
}

void draw(const std::vector<sim::FidelityResult>& results, const std::filesystem::path& folder) {
  for (const sim::FidelityResult& result : results)
    lab::writeAtomically(folder / (result.scenario + ".svg"), sim::drawFidelity(result));
}

int runFidelity(FidelityArguments& arguments) {
  arguments.settings.solver =
      arguments.solver == "quick" ? sim::WorldSettings::Solver::Quick : sim::WorldSettings::Solver::Exact;
  if (!arguments.svgFolder.empty()) lab::makeFolder(arguments.svgFolder.string());
  printHead();
  std::vector<sim::FidelityResult> results;
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const auto& file : recordingsIn(arguments.folder)) {
    results.push_back(sim::replay(sim::readRecording(file), arguments.settings));
    printRow(results.back());
    all.push_back(toJson(results.back()));
  }
  // Last, so that nothing is lost by a file that cannot be written.
  if (!arguments.jsonFile.empty()) lab::writeAtomically(arguments.jsonFile, all.dump(2) + "\n");
  if (!arguments.svgFolder.empty()) draw(results, arguments.svgFolder);
  return 0;
}

}  // namespace

void addFidelityCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand(
      "fidelity", "Replays recorded experiments of the real server and compares the physics");
  auto arguments = std::make_shared<FidelityArguments>();
  command
      ->add_option("recordings", arguments->folder, "Folder of recordings (*.jsonl, *.jsonl.gz), or one file")
      ->required()
      ->check(CLI::ExistingPath);
  command->add_option("--json", arguments->jsonFile, "Also writes the table to this file");
  command->add_option("--svg", arguments->svgFolder,
                      "Also draws each scenario's error over time into this folder");
  command->add_option("--solver", arguments->solver, "Stepper of the simulation")
      ->check(CLI::IsMember({"exact", "quick"}));
  command->footer(
      "Example: nonet fidelity tests/data/physics --svg logs/fidelity\n"
      "The columns >0.1 mm, >1 mm, >1 cm tell when the position of any body or of the ball is first that far "
      "off;\n"
      "the others are the largest differences of the whole recording. Positions in recordings have six "
      "digits,\n"
      "so differences up to 0.05 mm are rounding where a coordinate is beyond 10 m.");
  command->callback([arguments, &exitCode] { exitCode = runFidelity(*arguments); });
}

}  // namespace nonet::app
