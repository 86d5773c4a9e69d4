#include "nonet/lab/match/table.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace nonet::lab {
namespace {

using nlohmann::ordered_json;

std::string difference(const PairSummary& summary) {
  return summary.pairs < 2 ? fmt::format("{:+.2f}", summary.mean)
                           : fmt::format("{:+.2f} ({:.2f})", summary.mean, summary.standardError);
}

std::string interval(const PairSummary& summary) {
  return summary.pairs < 2 ? "" : fmt::format("[{:+.2f}, {:+.2f}]", summary.low, summary.high);
}

std::string verdict(const TableSettings& table, const SeriesResult& result) {
  if (!table.games.sequential) return "";
  if (result.verdict == Verdict::Open) return "undecided";
  const SequentialBounds& bounds = *table.games.sequential;
  return fmt::format("{:+g} accepted", result.verdict == Verdict::Low ? bounds.low : bounds.high);
}

// Of one against all only the others are named.
std::string entryName(const TableSettings& table, const TableEntry& entry) {
  const std::string& other = table.sides[entry.b].name;
  return table.against ? other : fmt::format("{} - {}", table.sides[entry.a].name, other);
}

// As the published table of one agent against its variants: the smallest difference first.
std::string entryLines(const TableSettings& table, std::vector<const TableEntry*> entries) {
  std::stable_sort(entries.begin(), entries.end(), [](const TableEntry* left, const TableEntry* right) {
    if (!left->result || !right->result) return left->result.has_value() && !right->result;
    return left->result->difference.mean < right->result->difference.mean;
  });
  std::size_t width = 8;
  for (const TableEntry* entry : entries) width = std::max(width, entryName(table, *entry).size());
  std::string text = fmt::format("{:<{}}  {:<14} {:<16} {:>5} {:>4} {:>5} {:>5}  {:<9} {}\n",
                                 table.against ? "against" : "", width, "difference", "95 %", "games", "won",
                                 "tied", "lost", "goals", table.games.sequential ? "verdict" : "");
  for (const TableEntry* entry : entries) {
    const std::string name = entryName(table, *entry);
    if (!entry->result) {
      text += fmt::format("{:<{}}  not played yet\n", name, width);
      continue;
    }
    const SeriesResult& result = *entry->result;
    text += fmt::format("{:<{}}  {:<14} {:<16} {:>5} {:>4} {:>5} {:>5}  {:<9} {}\n", name, width,
                        difference(result.difference), interval(result.difference), result.games, result.wins,
                        result.ties, result.losses, fmt::format("{} : {}", result.goalsA, result.goalsB),
                        verdict(table, result));
  }
  return text;
}

// Row against column.
std::string matrix(const TableSettings& table, const std::vector<TableEntry>& entries) {
  std::size_t width = 14;  // of a difference
  for (const SideSettings& side : table.sides) width = std::max(width, side.name.size());
  std::string text = fmt::format("{:<{}}", "", width);
  for (const SideSettings& side : table.sides) text += fmt::format("  {:<{}}", side.name, width);
  text += "\n";
  for (std::size_t row = 0; row < table.sides.size(); ++row) {
    text += fmt::format("{:<{}}", table.sides[row].name, width);
    for (std::size_t column = 0; column < table.sides.size(); ++column) {
      std::string cell = row == column ? "-" : "";
      for (const TableEntry& entry : entries) {
        if (!entry.result) continue;
        PairSummary summary = entry.result->difference;
        if (entry.a == column && entry.b == row) summary.mean = 0.0 - summary.mean;
        if ((entry.a == row && entry.b == column) || (entry.a == column && entry.b == row))
          cell = difference(summary);
      }
      text += fmt::format("  {:<{}}", cell, width);
    }
    text += "\n";
  }
  return text;
}

std::vector<const TableEntry*> pointersTo(const std::vector<TableEntry>& entries) {
  std::vector<const TableEntry*> pointers;
  pointers.reserve(entries.size());
  for (const TableEntry& entry : entries) pointers.push_back(&entry);
  return pointers;
}

}  // namespace

std::vector<TableEntry> tableEntries(const TableSettings& table) {
  std::vector<TableEntry> entries;
  for (std::size_t a = 0; a < table.sides.size(); ++a) {
    for (std::size_t b = table.against ? 0 : a + 1; b < table.sides.size(); ++b) {
      if (a != b && (!table.against || a == *table.against)) entries.push_back({a, b, {}});
    }
  }
  return entries;
}

std::vector<std::string> entryFolders(const TableSettings& table, const std::vector<TableEntry>& entries) {
  std::vector<std::string> folders;
  std::set<std::string> plain;
  for (const TableEntry& entry : entries) {
    folders.push_back(table.sides[entry.a].name + "-" + table.sides[entry.b].name);
    plain.insert(folders.back());
  }
  std::set<std::string> taken;
  for (std::string& folder : folders) {
    const std::string name = folder;
    // "-2" and so on could be the end of another entry's name.
    for (int i = 2; taken.contains(folder) || (folder != name && plain.contains(folder)); ++i)
      folder = fmt::format("{}-{}", name, i);
    taken.insert(folder);
  }
  return folders;
}

SeriesSettings seriesOf(const TableSettings& table, const TableEntry& entry) {
  SeriesSettings settings = table.games;
  settings.a = table.sides[entry.a];
  settings.b = table.sides[entry.b];
  settings.place = placeFor(settings);
  return settings;
}

std::string tableText(const TableSettings& table, const std::vector<TableEntry>& entries) {
  const SeriesSettings& games = table.games;
  std::string text = fmt::format("\n{}\n", table.title);
  if (table.against)
    text += fmt::format("goals per ten minutes by which {} is better (standard error), ",
                        table.sides[*table.against].name);
  else
    text += "goals per ten minutes by which the row is better than the column (standard error), ";
  text += fmt::format("games of {:g} minutes, {} a side\n{}, {}: {}\n\n", games.minutes, games.players,
                      games.date, games.version, games.commandLine);
  if (!table.against) text += matrix(table, entries) + "\n";
  text += entryLines(table, pointersTo(entries));
  if (games.sequential)
    text += "Differences of entries with a verdict lie too far out: these ended when they had decided.\n";
  return text;
}

ordered_json tableJson(const TableSettings& table, const std::vector<TableEntry>& entries) {
  const SeriesSettings& games = table.games;
  ordered_json json = {{"title", table.title},
                       {"date", games.date},
                       {"version", games.version},
                       {"command_line", games.commandLine},
                       {"minutes", games.minutes},
                       {"players", games.players},
                       {"against", nullptr},
                       {"sides", ordered_json::array()},
                       {"entries", ordered_json::array()}};
  if (table.against) json["against"] = table.sides[*table.against].name;
  for (const SideSettings& side : table.sides)
    json["sides"].push_back({{"name", side.name}, {"side", side.describe()}});
  for (const TableEntry& entry : entries) {
    ordered_json line = {{"a", table.sides[entry.a].name}, {"b", table.sides[entry.b].name}};
    if (entry.result) {
      const SeriesResult& result = *entry.result;
      line.update({{"games", result.games},
                   {"wins", result.wins},
                   {"ties", result.ties},
                   {"losses", result.losses},
                   {"goals_a", result.goalsA},
                   {"goals_b", result.goalsB}});
      line.update(result.differenceJson());
      if (games.sequential) line["verdict"] = verdictName(result.verdict);
    }
    json["entries"].push_back(line);
  }
  return json;
}

}  // namespace nonet::lab
