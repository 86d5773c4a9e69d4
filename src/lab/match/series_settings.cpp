#include "nonet/lab/match/series_settings.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/agent/data_folder.h"
#include "nonet/model/robot_model.h"

namespace nonet::lab {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* kVariants = "/params/variants";  // in the data folder

ordered_json sideJson(const SideSettings& side) {
  return {{"name", side.name},        {"data", side.dataFolder},        {"executable", side.executable},
          {"command", side.command},  {"params", side.parameterFiles},  {"set", side.assignments},
          {"types", side.robotTypes}, {"fingerprint", side.fingerprint}};
}

SideSettings sideFromJson(const ordered_json& json) {
  SideSettings side;
  side.name = json.at("name").get<std::string>();
  side.dataFolder = json.at("data").get<std::string>();
  side.executable = json.at("executable").get<std::string>();
  side.command = json.at("command").get<std::string>();
  side.parameterFiles = json.at("params").get<std::vector<std::string>>();
  side.assignments = json.at("set").get<std::vector<std::string>>();
  side.robotTypes = json.value("types", std::vector<int>());  // series of before have none
  side.fingerprint = json.at("fingerprint").get<std::string>();
  return side;
}

// A number as TOML has it, which is less than what people write: not .5, 5. or 007. Empty: it is none.
std::string numberToml(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);  // from_chars knows no plus
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole ? fmt::format("{}", number) : "";
}

// "key=value" as a line of TOML: numbers and truth values bare, anything else is a text with a unit.
std::string assignmentToml(const std::string& assignment) {
  const std::size_t equal = assignment.find('=');
  if (equal == std::string::npos || equal == 0 || equal + 1 == assignment.size())
    throw std::runtime_error(
        fmt::format("'{}': expected key=value, such as team.formation.stopperBehind=2m", assignment));
  const std::string value = assignment.substr(equal + 1);
  std::string bare = value == "true" || value == "false" ? value : numberToml(value);
  if (bare.empty()) bare = "\"" + value + "\"";
  return fmt::format("{} = {}\n", assignment.substr(0, equal), bare);
}

std::string overlayFile(const std::string& folder, bool sideB) {
  return folder + (sideB ? "/set-b.toml" : "/set-a.toml");
}

TeamSettings teamOf(const SeriesSettings& settings, bool sideB, const std::string& overlayFolder) {
  const SideSettings& side = sideB ? settings.b : settings.a;
  TeamSettings team;
  team.name = side.name;
  team.players = settings.players;
  team.parameterFiles = side.parameterFiles;
  if (!side.assignments.empty()) team.parameterFiles.push_back(overlayFile(overlayFolder, sideB));
  team.dataFolder = side.dataFolder;
  team.robotTypes = side.robotTypes;
  return team;
}

// Of our own server, for every game. Throws if it would not take them.
sim::Settings gameSettings(const SeriesSettings& settings) {
  sim::Settings server;
  for (const std::string& file : settings.settingFiles) server.overlayFile(file);
  for (const std::string& assignment : settings.settingAssignments) setServerSetting(server, assignment);
  return server;
}

// FNV-1a, 64 bits.
void hashFile(const std::string& path, std::uint64_t& hash) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 65536> block{};
  while (file.read(block.data(), block.size()) || file.gcount() > 0) {
    for (std::streamsize i = 0; i < file.gcount(); ++i) {
      hash = (hash ^ static_cast<unsigned char>(block[static_cast<std::size_t>(i)])) * 0x100000001b3ULL;
    }
  }
}

// Where the side's program reads params/ and skills/; empty: it will say itself that it finds none.
std::string dataOf(const SideSettings& side, const std::string& dataFolder) {
  if (!side.dataFolder.empty()) return side.dataFolder;
  if (side.executable.empty()) return dataFolder;
  if (std::string own = dataBeside(side.executable); !own.empty()) return own;
  try {
    return agent::dataFolder("", "", side.executable, "");
  } catch (const agent::DataError&) {
    return "";
  }
}

}  // namespace

std::string dataBeside(const std::string& executable) {
  std::error_code error;
  const fs::path real = fs::canonical(executable, error);  // as the program sees itself
  try {
    return error ? "" : agent::findData(real.string(), "", "");
  } catch (const agent::DataError&) {
    return "";
  }
}

std::string fingerprintOfFiles(const std::vector<std::string>& files) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const std::string& file : files) hashFile(file, hash);
  return fmt::format("{:016x}", hash);
}

std::string fingerprintOf(const SideSettings& side, const std::string& dataFolder) {
  if (!side.command.empty()) return "";
  std::vector<std::string> files = {side.executable.empty() ? "/proc/self/exe" : side.executable};
  const std::string data = dataOf(side, dataFolder);
  for (const char* folder : {"/params", "/skills"}) {
    if (!fs::is_directory(data + folder)) continue;
    for (const auto& entry : fs::directory_iterator(data + folder)) files.push_back(entry.path().string());
  }
  std::sort(files.begin() + 1, files.end());
  files.insert(files.end(), side.parameterFiles.begin(), side.parameterFiles.end());
  return fingerprintOfFiles(files);
}

void takeFingerprints(SeriesSettings& settings, const std::string& dataFolder) {
  for (SideSettings* side : {&settings.a, &settings.b}) side->fingerprint = fingerprintOf(*side, dataFolder);
  settings.settingsFingerprint =
      settings.settingFiles.empty() ? "" : fingerprintOfFiles(settings.settingFiles);
}

std::string SideSettings::describe() const {
  std::string text = !command.empty()      ? command
                     : !executable.empty() ? executable
                     : !dataFolder.empty() ? dataFolder
                                           : "own";
  for (const std::string& file : parameterFiles) text += " + " + file;
  for (const std::string& assignment : assignments) text += " + " + assignment;
  if (!robotTypes.empty()) text += fmt::format(" + types {}", fmt::join(robotTypes, ","));
  return text;
}

std::vector<std::string> variantsIn(const std::string& dataFolder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(dataFolder + kVariants, error)) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

SideSettings sideFromWord(const std::string& word, const std::string& dataFolder) {
  SideSettings side;
  if (word == "own") return side;
  if (word.find("{port}") != std::string::npos) {
    side.command = word;
    return side;
  }
  const std::vector<std::string> variants = variantsIn(dataFolder);
  if (std::find(variants.begin(), variants.end(), word) != variants.end()) {
    side.parameterFiles.push_back(dataFolder + kVariants + "/" + word + ".toml");
    return side;
  }
  std::error_code error;
  const std::string path = fs::absolute(word, error).lexically_normal().string();
  if (fs::is_directory(path, error)) {
    if (!fs::is_directory(path + "/skills", error))
      throw std::runtime_error(fmt::format("{}: a side's folder must hold skills/ (and params/)", word));
    side.dataFolder = path;
    return side;
  }
  if (fs::is_regular_file(path, error) && ::access(path.c_str(), X_OK) == 0) {
    side.executable = path;
    return side;
  }
  throw std::runtime_error(fmt::format(
      "'{}' is no side: expected own, a variant ({}), a folder with skills/ and params/, an executable of "
      "Nonet, or a command that contains {{port}}",
      word, fmt::join(variants, ", ")));
}

ordered_json SeriesSettings::toJson() const {
  ordered_json json = {{"a", sideJson(a)},
                       {"b", sideJson(b)},
                       {"pairs", pairs},
                       {"seed", seed},
                       {"minutes", minutes},
                       {"kick_off_wait_s", kickOffWait},
                       {"players", players},
                       {"setting_files", settingFiles},
                       {"settings", settingAssignments},
                       {"settings_fingerprint", settingsFingerprint},
                       {"sprt", nullptr},
                       {"place", place},
                       {"server_command", serverCommand},
                       {"command_line", commandLine},
                       {"date", date},
                       {"version", version}};
  if (sequential) json["sprt"] = {sequential->low, sequential->high};
  return json;
}

SeriesSettings SeriesSettings::fromJson(const ordered_json& json) {
  SeriesSettings settings;
  settings.a = sideFromJson(json.at("a"));
  settings.b = sideFromJson(json.at("b"));
  json.at("pairs").get_to(settings.pairs);
  json.at("seed").get_to(settings.seed);
  json.at("minutes").get_to(settings.minutes);
  json.at("kick_off_wait_s").get_to(settings.kickOffWait);
  json.at("players").get_to(settings.players);
  json.at("setting_files").get_to(settings.settingFiles);
  json.at("settings").get_to(settings.settingAssignments);
  settings.settingsFingerprint = json.value("settings_fingerprint", "");
  if (!json.at("sprt").is_null())
    settings.sequential =
        SequentialBounds{json.at("sprt").at(0).get<double>(), json.at("sprt").at(1).get<double>()};
  json.at("place").get_to(settings.place);
  json.at("server_command").get_to(settings.serverCommand);
  json.at("command_line").get_to(settings.commandLine);
  json.at("date").get_to(settings.date);
  json.at("version").get_to(settings.version);
  return settings;
}

bool SeriesSettings::sameGames(const SeriesSettings& other) const {
  return a == other.a && b == other.b && seed == other.seed && minutes == other.minutes &&
         kickOffWait == other.kickOffWait && players == other.players && settingFiles == other.settingFiles &&
         settingAssignments == other.settingAssignments && settingsFingerprint == other.settingsFingerprint &&
         place == other.place && serverCommand == other.serverCommand;
}

std::string placeFor(const SeriesSettings& settings) {
  const bool ours = settings.a.ours() && settings.b.ours();
  if (settings.place.empty()) return ours ? "process" : "tcp";
  if (settings.place == "process" && !ours)
    throw std::runtime_error(fmt::format(
        "{} against {}: in one process only this program can play: give tcp as the place, or none",
        settings.a.name, settings.b.name));
  return settings.place;
}

bool playedHere(const std::string& place) {
  return place == "process" || place == "tcp" || place == "realtime";
}

void checkPlace(const SeriesSettings& settings) {
  const auto demand = [](bool holds, const std::string& what) {
    if (!holds) throw std::runtime_error(what);
  };
  if (playedHere(settings.place)) {
    (void)gameSettings(settings);
    return demand(settings.serverCommand.empty(),
                  "--server-command (serverCommand of a table) needs --where HOST:PORT:MONITORPORT (where): "
                  "the server that it starts");
  }
  // A server apart has settings of its own, and its monitor stream is only counted.
  demand(settings.settingAssignments.empty(),
         fmt::format("--set {} (settings of a table) does nothing on a server at {}: give it to that server",
                     fmt::join(settings.settingAssignments, " --set "), settings.place));
  demand(settings.settingFiles.empty(),
         fmt::format("--settings {} does nothing on a server at {}: give it to that server",
                     fmt::join(settings.settingFiles, " "), settings.place));
  demand(!settings.monitorLogs,
         fmt::format("--monitor-logs keeps nothing of a server at {}: record there, or leave --where out",
                     settings.place));
}

SeriesGame gameOf(const SeriesSettings& settings, int index) {
  return {.pair = index / 2 + 1,
          .game = index % 2 + 1,
          .seed = settings.seed + static_cast<std::uint64_t>(index / 2)};
}

MatchSettings matchOf(const SeriesSettings& settings, const SeriesGame& game,
                      const std::string& overlayFolder) {
  MatchSettings match;
  match.left = teamOf(settings, !game.aLeft(), overlayFolder);
  match.right = teamOf(settings, game.aLeft(), overlayFolder);
  match.seed = game.seed;
  match.minutes = settings.minutes;
  match.kickOffWait = settings.kickOffWait;
  if (settings.monitorLogs)
    match.monitorLog = fmt::format("{}/game-{}-{}.mon", overlayFolder, game.pair, game.game);
  match.settings = gameSettings(settings);
  return match;
}

void checkSide(const SideSettings& side, const std::string& dataFolder) {
  if (!side.ours()) return;
  for (int robotType = 0; robotType < model::kRobotTypeCount; ++robotType) {
    agent::AgentChoice agent;
    agent.robotType = robotType;
    agent.parameterFiles = side.parameterFiles;
    agent.assignments = side.assignments;
    (void)agent::makeAgentSettings(agent, side.dataFolder.empty() ? dataFolder : side.dataFolder);
  }
  for (const std::string& assignment : side.assignments) (void)assignmentToml(assignment);
}

void writeOverlays(const SeriesSettings& settings, const std::string& overlayFolder) {
  for (const bool sideB : {false, true}) {
    const SideSettings& side = sideB ? settings.b : settings.a;
    if (!side.assignments.empty()) {
      std::ofstream file(overlayFile(overlayFolder, sideB));
      for (const std::string& assignment : side.assignments) file << assignmentToml(assignment);
      if (!file.flush())
        throw std::runtime_error(fmt::format("cannot write {}", overlayFile(overlayFolder, sideB)));
    }
  }
}

}  // namespace nonet::lab
