#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "nonet/config/toml.h"
#include "nonet/lab/match/table.h"

namespace nonet::lab {
namespace {

namespace fs = std::filesystem;

// A table of the file, its keys taken one by one; what is left over at the end is an error.
class Reader {
 public:
  Reader(const toml::table& table, const std::string& where) : table_(table), where_(where) {}

  template <class Value>
  void take(const char* key, Value& value) {
    known_.insert(key);
    const toml::node* node = table_.get(key);
    if (node == nullptr) return;
    const auto found = node->value<Value>();
    if (!found) fail(*node, fmt::format("{}: of another type than expected", key));
    value = *found;
  }

  template <class Element>
  void takeList(const char* key, std::vector<Element>& values) {
    known_.insert(key);
    const toml::node* node = table_.get(key);
    if (node == nullptr) return;
    if (!node->is_array()) fail(*node, fmt::format("{}: expected a list, [...]", key));
    for (const toml::node& element : *node->as_array()) {
      const auto found = element.value<Element>();
      if (!found) fail(element, fmt::format("{}: an element of another type than expected", key));
      values.push_back(*found);
    }
  }

  void ignore(const char* key) { known_.insert(key); }

  void end() const {
    for (const auto& [key, node] : table_) {
      if (!known_.contains(std::string(key.str()))) fail(node, fmt::format("unknown key '{}'", key.str()));
    }
  }

  [[noreturn]] void fail(const toml::node& node, const std::string& message) const {
    throw std::runtime_error(fmt::format("{}:{}: {}", where_, node.source().begin.line, message));
  }

 private:
  const toml::table& table_;
  std::string where_;
  std::set<std::string> known_;
};

// Files and folders in the file are seen from where it lies.
std::string besideFile(const std::string& word, const fs::path& folder) {
  const fs::path beside = folder / word;
  return fs::exists(beside) ? fs::absolute(beside).lexically_normal().string() : word;
}

SideSettings readSide(const toml::table& table, const std::string& path, const std::string& dataFolder) {
  Reader reader(table, path);
  std::string name;
  std::string word;
  std::vector<std::string> files;
  std::vector<std::string> assignments;
  std::vector<int> robotTypes;
  reader.take("name", name);
  reader.take("side", word);
  reader.takeList("params", files);
  reader.takeList("set", assignments);
  reader.takeList("types", robotTypes);
  reader.end();
  if (name.empty()) reader.fail(table, "a side needs a name");
  const fs::path folder = fs::path(path).parent_path();
  if (word.empty()) word = name;
  const bool path_like = word.find("{port}") == std::string::npos && word.find('/') != std::string::npos;
  SideSettings side;
  try {
    side = sideFromWord(path_like ? besideFile(word, folder) : word, dataFolder);
  } catch (const std::runtime_error& error) {
    reader.fail(table, error.what());
  }
  side.name = name;
  side.assignments = assignments;
  side.robotTypes = robotTypes;
  for (const std::string& file : files) side.parameterFiles.push_back(besideFile(file, folder));
  if (!side.nonet() && side.hasOverlays())
    reader.fail(table, "a foreign command takes no parameters or robot types of ours");
  return side;
}

// As the options of a match are checked; settings are tried, so that none fails in the first game.
void checkGames(const SeriesSettings& games, const toml::table& file, const Reader& reader) {
  if (games.pairs < 1 || !(games.minutes > 0.0 && games.minutes < 1e4) || games.players < 1 ||
      games.players > 11)
    reader.fail(file, "pairs, minutes and players must be positive, players at most 11");
  if (!(games.kickOffWait >= 0.0 && games.kickOffWait <= 1e4))
    reader.fail(*file.get("kickOffWait"), "kickOffWait must be 0 to 10000 s");
  const toml::array* assignments = file["settings"].as_array();
  if (assignments == nullptr) return;
  sim::Settings tried;
  for (const toml::node& assignment : *assignments) {
    try {
      setServerSetting(tried, assignment.value_or(std::string()));
    } catch (const std::runtime_error& error) {
      reader.fail(assignment, error.what());
    }
  }
}

void checkSides(const TableSettings& table, const std::string& path) {
  std::set<std::string> names;
  for (const SideSettings& side : table.sides) {
    if (!names.insert(side.name).second)
      throw std::runtime_error(fmt::format("{}: two sides are called '{}'", path, side.name));
  }
  if (table.sides.size() < 2)
    throw std::runtime_error(fmt::format("{}: give at least two sides, each under [[side]]", path));
}

}  // namespace

TableSettings readTable(const std::string& path, const std::string& dataFolder) {
  const toml::table file = config::parseTomlFile(path);
  TableSettings table;
  SeriesSettings& games = table.games;
  games.place.clear();
  Reader reader(file, path);
  std::string against;
  std::int64_t seed = 1;
  std::vector<double> sprt;
  table.title = fs::path(path).stem().string();
  reader.take("title", table.title);
  reader.take("against", against);
  reader.take("pairs", games.pairs);
  reader.take("minutes", games.minutes);
  reader.take("seed", seed);
  reader.take("players", games.players);
  reader.take("kickOffWait", games.kickOffWait);
  reader.take("where", games.place);
  reader.take("serverCommand", games.serverCommand);
  reader.takeList("settings", games.settingAssignments);
  reader.takeList("sprt", sprt);
  reader.ignore("side");
  reader.end();
  games.seed = static_cast<std::uint64_t>(seed);
  checkGames(games, file, reader);
  if (!sprt.empty()) {
    if (sprt.size() != 2 || sprt[0] >= sprt[1])
      reader.fail(file, "sprt: expected two rising numbers, such as [0.0, 0.5]");
    games.sequential = SequentialBounds{sprt[0], sprt[1]};
  }
  if (const toml::array* sides = file["side"].as_array()) {
    for (const toml::node& side : *sides) {
      if (!side.is_table()) reader.fail(side, "expected [[side]]");
      table.sides.push_back(readSide(*side.as_table(), path, dataFolder));
    }
  }
  checkSides(table, path);
  for (std::size_t i = 0; i < table.sides.size(); ++i) {
    if (table.sides[i].name == against) table.against = i;
  }
  if (!against.empty() && !table.against)
    throw std::runtime_error(fmt::format("{}: against: no side is called '{}'", path, against));
  return table;
}

}  // namespace nonet::lab
