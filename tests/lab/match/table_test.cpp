#include "nonet/lab/match/table.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace nonet::lab {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class TableFile {
 public:
  explicit TableFile(const std::string& text)
      : path_(fs::temp_directory_path() / ("nonet_table_" + std::to_string(::getpid()) + ".toml")) {
    std::ofstream(path_) << text;
  }
  ~TableFile() { fs::remove(path_); }
  TableFile(const TableFile&) = delete;
  TableFile& operator=(const TableFile&) = delete;
  TableSettings read() const { return readTable(path_.string(), NONET_SOURCE_DIR); }
  std::string error() const {
    try {
      read();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

 private:
  fs::path path_;
};

constexpr const char* kThree = R"(
pairs = 7
minutes = 4
sprt = [0, 0.5]
[[side]]
name = "full"
side = "own"
[[side]]
name = "boxes"
[[side]]
name = "high"
side = "own"
set = ["team.formation.stopperBehind=3"]
types = [0, 3, 3, 3, 3, 3, 3, 3, 4]
)";

SeriesResult resultOf(std::vector<double> pairs, int wins, int losses) {
  SeriesResult result;
  result.pairs = std::move(pairs);
  result.games = static_cast<int>(2 * result.pairs.size());
  result.wins = wins;
  result.losses = losses;
  result.ties = result.games - wins - losses;
  result.difference = summarizePairs(result.pairs, 0.5);
  return result;
}

TEST(Table, IsReadFromAFile) {
  const TableSettings table = TableFile(kThree).read();
  ASSERT_EQ(table.sides.size(), 3U);
  EXPECT_FALSE(table.against);
  EXPECT_EQ(table.games.pairs, 7);
  EXPECT_EQ(table.games.minutes, 4.0);
  ASSERT_TRUE(table.games.sequential);
  EXPECT_EQ(table.games.sequential->high, 0.5);
  EXPECT_EQ(table.sides[1].name, "boxes");
  ASSERT_EQ(table.sides[1].parameterFiles.size(), 1U);
  EXPECT_THAT(table.sides[1].parameterFiles[0], HasSubstr("params/variants/boxes.toml"));
  EXPECT_EQ(table.sides[2].assignments.at(0), "team.formation.stopperBehind=3");
  EXPECT_EQ(table.sides[2].robotTypes, (std::vector<int>{0, 3, 3, 3, 3, 3, 3, 3, 4}));
  EXPECT_THAT(table.sides[2].describe(), HasSubstr("types 0,3,3,3,3,3,3,3,4"));
}

TEST(Table, EverybodyAgainstEverybodyOrOneAgainstAll) {
  TableSettings table = TableFile(kThree).read();
  EXPECT_EQ(tableEntries(table).size(), 3U);
  table = TableFile(std::string("against = 'boxes'\n") + kThree).read();
  const std::vector<TableEntry> entries = tableEntries(table);
  ASSERT_EQ(entries.size(), 2U);
  for (const TableEntry& entry : entries) EXPECT_EQ(seriesOf(table, entry).a.name, "boxes");
  EXPECT_EQ(seriesOf(table, entries[0]).b.name, "full");
  EXPECT_EQ(seriesOf(table, entries[1]).b.name, "high");
  EXPECT_EQ(seriesOf(table, entries[1]).place, "process");
}

// "low" against "line-x" and "low-line" against "x" would both be low-line-x.
TEST(Table, EveryEntryHasAFolderOfItsOwn) {
  TableSettings table;
  for (const char* name : {"low", "low-line", "line-x", "x", "x-2"}) {
    table.sides.emplace_back();
    table.sides.back().name = name;
  }
  const std::vector<TableEntry> entries = tableEntries(table);
  const std::vector<std::string> folders = entryFolders(table, entries);
  EXPECT_THAT(folders,
              ::testing::ElementsAre("low-low-line", "low-line-x", "low-x", "low-x-2", "low-line-line-x",
                                     "low-line-x-3", "low-line-x-2", "line-x-x", "line-x-x-2", "x-x-2"));
}

TEST(Table, ErrorsNameTheLine) {
  EXPECT_THAT(TableFile("pears = 7\n").error(), HasSubstr(".toml:1: unknown key 'pears'"));
  EXPECT_THAT(TableFile("pairs = 7\nminutes = 'x'\n").error(), HasSubstr(".toml:2: minutes"));
  EXPECT_THAT(TableFile("[[side]]\nname='a'\nside='nowhere'\n").error(), HasSubstr("'nowhere' is no side"));
  EXPECT_THAT(TableFile("[[side]]\nname='a'\nside='own'\n").error(), HasSubstr("at least two sides"));
  EXPECT_THAT(TableFile(std::string("against='x'\n") + kThree).error(), HasSubstr("no side is called 'x'"));
  EXPECT_THAT(TableFile(std::string("sprt2=[1]\n") + kThree).error(), HasSubstr("sprt2"));
  EXPECT_THAT(TableFile("pairs = \n").error(), HasSubstr(".toml:1"));
  for (const char* wait : {"-5.0", "nan", "20000.0"})
    EXPECT_THAT(TableFile(std::string("pairs = 7\nkickOffWait = ") + wait + "\n").error(),
                HasSubstr(".toml:2: kickOffWait must be 0 to 10000 s"));
  EXPECT_THAT(TableFile("[[!a]]\n").error(), HasSubstr(".toml:1: not TOML: somewhere"));
  EXPECT_THAT(TableFile("pairs = 7\n\xC3\xB6 = 1\n").error(), HasSubstr(".toml:2: not TOML: a letter"));
  EXPECT_THAT(TableFile("title = '\xC3\xB6'\npears = 1\n").error(), HasSubstr("'pears'"));
}

// Not only when the first game begins.
TEST(Table, SettingsOfTheServerAreTriedWhenItIsRead) {
  EXPECT_THAT(TableFile("settings = ['QuickSolver=true',\n'Foo=1']\n").error(),
              HasSubstr(".toml:2: unknown setting 'Foo'"));
  EXPECT_THAT(TableFile("pairs = 1\nsettings = ['RuleHalfTime=15']\n").error(),
              HasSubstr(".toml:2: RuleHalfTime=15: the match decides this itself"));
  const TableSettings table = TableFile(std::string("settings = ['QuickSolver=true']\n") + kThree).read();
  EXPECT_EQ(table.games.settingAssignments, (std::vector<std::string>{"QuickSolver=true"}));
}

TEST(Table, ShowsDifferencesFromTheSideOfTheRow) {
  const TableSettings table = TableFile(kThree).read();
  std::vector<TableEntry> entries = tableEntries(table);
  entries[0].result = resultOf({1.0, 2.0, 3.0}, 5, 1);
  entries[0].result->verdict = Verdict::High;
  const std::string text = tableText(table, entries);
  // mean 2, standard deviation 1 of three pairs
  EXPECT_THAT(text, HasSubstr("+2.00 (0.58)"));
  EXPECT_THAT(text, HasSubstr("-2.00 (0.58)")) << "boxes against full";
  EXPECT_THAT(text, HasSubstr("not played yet"));
  EXPECT_THAT(text, HasSubstr("+0.5 accepted"));
  const auto json = tableJson(table, entries);
  EXPECT_EQ(json.at("entries").size(), 3U);
  EXPECT_EQ(json.at("entries").at(0).at("difference_per_10_min"), 2.0);
  EXPECT_EQ(json.at("entries").at(0).at("wins"), 5);
  EXPECT_FALSE(json.at("entries").at(1).contains("wins"));
}

// The lines of the entries below their titles; all are played.
std::vector<std::string> entryLinesOf(const TableSettings& table) {
  std::vector<TableEntry> entries = tableEntries(table);
  for (TableEntry& entry : entries) entry.result = resultOf({10.0, 2.0, -3.5}, 4, 1);
  std::istringstream text(tableText(table, entries));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) {
    if (lines.empty() ? line.find("95 %") != std::string::npos : line.find(" : ") != std::string::npos)
      lines.push_back(line);
  }
  return lines;
}

TEST(Table, ColumnsStandUnderTheirTitles) {
  TableSettings table = TableFile(kThree).read();
  table.sides[0].name = "rather-a-long-name";
  for (const bool everybody : {true, false}) {
    if (!everybody) table.against = 2;
    const std::vector<std::string> lines = entryLinesOf(table);
    ASSERT_EQ(lines.size(), everybody ? 4U : 3U);
    for (std::size_t i = 1; i < lines.size(); ++i) {
      const auto below = [&](std::string_view title) { return lines[i].substr(lines[0].find(title)); };
      EXPECT_THAT(below("difference"), StartsWith("+2.83 (")) << lines[i];
      EXPECT_THAT(below("games"), StartsWith("    6    4     1     1  0 : 0 ")) << lines[i];
      EXPECT_THAT(below("goals"), StartsWith("0 : 0 ")) << lines[i];
    }
  }
}

TEST(Table, OneAgainstAllBeginsWithTheSmallestDifference) {
  const TableSettings table = TableFile(std::string("against = 'full'\n") + kThree).read();
  std::vector<TableEntry> entries = tableEntries(table);
  entries[0].result = resultOf({1.0, 2.0, 3.0}, 5, 1);
  entries[1].result = resultOf({0.5, 0.5, 0.2}, 3, 1);
  const std::string text = tableText(table, entries);
  EXPECT_LT(text.find("\nhigh"), text.find("\nboxes"));
  EXPECT_THAT(text, Not(HasSubstr("not played yet")));
}

}  // namespace
}  // namespace nonet::lab
