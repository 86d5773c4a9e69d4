#include "nonet/app/view/trace_folder.h"

#include <filesystem>
#include <optional>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "nonet/protocol/log_file.h"

namespace nonet::app {
namespace {

namespace fs = std::filesystem;

constexpr int kLinesToLookAt = 500;  // the server names the robot after a few cycles
constexpr double kStep = 0.1;        // s between two cycles that are shown

// One cycle of a trace, discarded if the line is none.
nlohmann::json parseLine(const protocol::LogLine& line) {
  nlohmann::json json = nlohmann::json::parse(line.text, nullptr, false);
  const auto has = [&json](const char* key, auto is) {
    const auto found = json.find(key);
    return found != json.end() && is(*found);
  };
  const auto number = [](const nlohmann::json& value) { return value.is_number(); };
  const bool whole = json.is_object() && has("game_time", number) && has("time", number) &&
                     has("unum", [](const nlohmann::json& value) { return value.is_number_integer(); }) &&
                     has("team", [](const nlohmann::json& value) { return value.is_string(); });
  return whole ? json : nlohmann::json(nlohmann::json::value_t::discarded);
}

}  // namespace

// Whose trace this file holds.
std::optional<TraceFolder::Player> TraceFolder::playerOf(const std::string& path) {
  protocol::LogReader reader(path);
  protocol::LogLine line;
  for (int i = 0; i < kLinesToLookAt && reader.next(line); ++i) {
    const nlohmann::json cycle = parseLine(line);
    if (cycle.is_discarded()) return std::nullopt;
    const int unum = cycle["unum"];
    if (unum >= 1 && unum <= 11) return Player(cycle["team"].get<std::string>(), unum);
  }
  return std::nullopt;
}

TraceFolder::TraceFolder(const std::string& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    if (const auto player = playerOf(entry.path().string())) files_[*player] = entry.path().string();
  }
  if (files_.empty())
    throw std::runtime_error(folder + ": no traces in it; nonet match --trace FOLDER writes them");
}

std::string TraceFolder::cycles(const std::string& team, int unum, std::string* problem) const {
  const auto file = files_.find({team, unum});
  if (file == files_.end()) return "[]";
  protocol::LogReader reader(file->second);
  protocol::LogLine line;
  std::string text = "[";
  double last = -1.0;
  while (reader.next(line)) {
    const nlohmann::json cycle = parseLine(line);
    if (cycle.is_discarded()) continue;
    const double time = cycle["time"];
    // Where the time goes back the server was started anew, and the trace goes on.
    if (last <= time && time < last + kStep) continue;
    last = time;
    if (text.size() > 1) text += ',';
    text += line.text;
  }
  if (problem != nullptr) *problem = reader.problem();
  return text + "]";
}

}  // namespace nonet::app
