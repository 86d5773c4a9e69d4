// A table of teams against each other: everybody against everybody, or one against all others, as the
// published comparisons have it [MacAlpine 2012a, table 1]. Each entry is a series of its own. A file says
// what is played:
//
//   title = "Formations"
//   against = "full"        # one against all others; without this line everybody against everybody
//   pairs = 50              # of games per entry, at most if there is an sprt
//   minutes = 10            # also: seed, players, kickOffWait, sprt = [0.0, 0.5], settings = ["A=b"], where,
//                           # serverCommand
//
//   [[side]]
//   name = "full"           # also its name on the field
//   side = "own"            # as on the command line of nonet series; without it a variant of that name
//
//   [[side]]
//   name = "boxes"
//   params = ["my.toml"]    # beside the file; further ones overlay earlier ones
//   set = ["team.ball.kick=false"]
//   types = [0, 2, 2, 2, 2, 2, 2, 2, 4]   # robot types from number 1 on
//
// docs/how-to.md explains every key.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nonet/lab/match/series.h"

namespace nonet::lab {

struct TableSettings {
  std::string title;
  std::vector<SideSettings> sides;
  std::optional<std::size_t> against;  // index of the one against all; empty: everybody against everybody
  SeriesSettings games;                // what all entries share: all but the sides
};

/// Throws std::runtime_error that names file and line, or the key that is wrong. Paths in the file are seen
/// from its folder.
TableSettings readTable(const std::string& path, const std::string& dataFolder);

/// One entry: A against B, indices of sides.
struct TableEntry {
  std::size_t a = 0;
  std::size_t b = 0;
  std::optional<SeriesResult> result;  // empty: not played yet
};

/// All entries, nothing played yet.
std::vector<TableEntry> tableEntries(const TableSettings& table);
/// The folder of each entry's series: A-B, with a number where an earlier entry has that name already ("a-b"
/// against "c", "a" against "b-c").
std::vector<std::string> entryFolders(const TableSettings& table, const std::vector<TableEntry>& entries);
SeriesSettings seriesOf(const TableSettings& table, const TableEntry& entry);

/// Goal difference per ten minutes with standard error, games won, tied and lost.
std::string tableText(const TableSettings& table, const std::vector<TableEntry>& entries);
nlohmann::ordered_json tableJson(const TableSettings& table, const std::vector<TableEntry>& entries);

}  // namespace nonet::lab
