#include "nonet/lab/match/series.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>
#include <unistd.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/config/parameters.h"
#include "nonet/math/random.h"

namespace nonet::lab {
namespace {

namespace fs = std::filesystem;

class Folder {
 public:
  explicit Folder(const std::string& name)
      : path_(fs::temp_directory_path() / ("nonet_series_" + name + "_" + std::to_string(::getpid()))) {
    fs::remove_all(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string path() const { return path_.string(); }
  std::string text(const std::string& file) const {
    std::ifstream stream(path_ / file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

 private:
  fs::path path_;
};

SeriesSettings settingsOf(int pairs) {
  SeriesSettings settings;
  settings.a.name = "A";
  settings.b.name = "B";
  settings.pairs = pairs;
  settings.date = "today";
  return settings;
}

// Goals from the seed alone, A about one goal better.
GameRecord fakeGame(const SeriesGame& game) {
  Random random = Random(game.seed).fork(static_cast<std::uint64_t>(game.game));
  const int a = static_cast<int>(random.below(4));
  const int b = static_cast<int>(random.below(3));
  GameRecord record = gameRecord(game, game.aLeft() ? a : b, game.aLeft() ? b : a, 600.0, true);
  record.times["wall_time_s"] = 1.0;
  return record;
}

const PlayGame kFake = [](const SeriesGame& game, const std::function<bool(double)>& goOn) {
  goOn(300.0);
  return fakeGame(game);
};
const auto kGoOn = [](const SeriesProgress&) { return true; };

TEST(Series, CountsWhatWasPlayed) {
  const Folder folder("count");
  Series series(folder.path(), settingsOf(7));
  EXPECT_EQ(series.open().size(), 14U);
  EXPECT_TRUE(playSeries(series, 3, kFake, kGoOn));
  const SeriesResult result = series.finish();
  int goals = 0;
  int wins = 0;
  double sum = 0.0;
  for (int i = 0; i < 14; ++i) {
    const GameRecord record = fakeGame(gameOf(series.settings(), i));
    goals += record.scoreA();
    wins += record.scoreA() > record.scoreB() ? 1 : 0;
    sum += record.scoreA() - record.scoreB();
  }
  EXPECT_EQ(result.games, 14);
  EXPECT_EQ(result.goalsA, goals);
  EXPECT_EQ(result.wins, wins);
  EXPECT_EQ(result.wins + result.ties + result.losses, 14);
  EXPECT_NEAR(result.difference.mean, sum / 14.0, 1e-12) << "ten-minute games";
  EXPECT_NE(result.toText(series.settings()).find("14 games"), std::string::npos);
}

// A goes left first; both games of a pair share their seed, and no other pair has it.
TEST(Series, GamesComeInPairs) {
  const SeriesSettings settings = settingsOf(3);
  for (int pair = 0; pair < 3; ++pair) {
    const SeriesGame first = gameOf(settings, 2 * pair);
    const SeriesGame second = gameOf(settings, 2 * pair + 1);
    EXPECT_EQ(first.seed, second.seed);
    EXPECT_EQ(first.seed, settings.seed + static_cast<std::uint64_t>(pair));
    EXPECT_TRUE(first.aLeft());
    EXPECT_FALSE(second.aLeft());
  }
  const std::string nowhere;
  EXPECT_EQ(matchOf(settings, gameOf(settings, 0), nowhere).left.name, "A");
  EXPECT_EQ(matchOf(settings, gameOf(settings, 1), nowhere).left.name, "B");
  EXPECT_EQ(matchOf(settings, gameOf(settings, 1), nowhere).right.name, "A");
}

// The folder as a killed process leaves it: some games, half a line.
TEST(Series, KilledAndResumedItEndsInTheSameBytes) {
  const Folder whole("whole");
  const Folder killed("killed");
  for (const Folder* folder : {&whole, &killed}) {
    SeriesSettings settings = settingsOf(10);
    if (folder == &killed) {
      Series series(folder->path(), settings);
      for (const int index : {0, 3, 1, 7}) series.add(fakeGame(gameOf(settings, index)));
      std::ofstream(folder->path() + "/matches.jsonl", std::ios::app) << R"({"pair":3,"game":1,"se)";
      EXPECT_THROW(Series(folder->path(), settings), std::runtime_error) << "another process works on it";
    }
    settings.date = folder == &killed ? "tomorrow" : "today";
    Series series(folder->path(), settings);
    EXPECT_EQ(series.played(), folder == &killed ? 4 : 0);
    EXPECT_TRUE(playSeries(series, 2, kFake, kGoOn));
    series.finish();
  }
  for (const char* file : {"matches.jsonl", "result.json", "series.json", "times.jsonl"}) {
    EXPECT_EQ(whole.text(file), killed.text(file)) << file;
    EXPECT_FALSE(whole.text(file).empty()) << file;
  }
}

// Whoever watches may fail, as a terminal that was closed does: the games end and the exception comes out.
TEST(Series, AnExceptionOfTheWatcherEndsTheGamesAndComesOut) {
  const Folder folder("watcher");
  Series series(folder.path(), settingsOf(200));
  const PlayGame slow = [](const SeriesGame& game, const std::function<bool(double)>& goOn) {
    for (int i = 0; i < 100 && goOn(3.0 * i); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return fakeGame(game);
  };
  const auto fails = [](const SeriesProgress& now) -> bool {
    if (now.gamesPlayed >= 2) throw std::runtime_error("nobody looks");
    return true;
  };
  EXPECT_THROW(playSeries(series, 2, slow, fails), std::runtime_error);
  EXPECT_GE(series.played(), 2);
  EXPECT_LT(series.played(), 400) << "the other games are not played any more";
}

TEST(Series, TheSequentialTestStopsAtTheSameGameOnAnyNumberOfThreads) {
  const Folder one("one");
  const Folder four("four");
  SeriesSettings settings = settingsOf(400);
  settings.sequential = SequentialBounds{0.0, 0.5};
  for (const Folder* folder : {&one, &four}) {
    Series series(folder->path(), settings);
    EXPECT_TRUE(playSeries(series, folder == &one ? 1 : 4, kFake, kGoOn));
    const SeriesResult result = series.finish();
    EXPECT_EQ(result.verdict, Verdict::High);
    EXPECT_LT(result.games, 200);
  }
  EXPECT_EQ(one.text("matches.jsonl"), four.text("matches.jsonl"));
  EXPECT_EQ(one.text("result.json"), four.text("result.json"));
}

TEST(Series, OtherGamesAreNotMixedIn) {
  const Folder folder("other");
  SeriesSettings settings = settingsOf(2);
  { const Series series(folder.path(), settings); }
  settings.pairs = 5;
  EXPECT_EQ(Series(folder.path(), settings).open().size(), 10U) << "more pairs are the same series";
  settings.b.assignments = {"team.x=1"};
  EXPECT_EQ(Series(folder.path(), settings).played(), 0) << "nothing was played yet: the choice may change";
  { Series(folder.path(), settings).add(fakeGame(gameOf(settings, 0))); }
  settings.b.assignments = {"team.x=2"};
  EXPECT_THROW(Series(folder.path(), settings), std::runtime_error);
}

// Who forgets an option must not lose what was played.
TEST(Series, FewerPairsOrAnotherTestLeaveWhatIsThere) {
  const Folder folder("fewer");
  const SeriesSettings ten = settingsOf(10);
  {
    Series series(folder.path(), ten);
    ASSERT_TRUE(playSeries(series, 2, kFake, kGoOn));
    series.finish();
  }
  const std::string before = folder.text("matches.jsonl");
  EXPECT_THROW(Series(folder.path(), settingsOf(2)), std::runtime_error);
  SeriesSettings tested = ten;
  tested.sequential = SequentialBounds{-9.0, -8.0};  // decided after the fewest pairs
  EXPECT_THROW(Series(folder.path(), tested), std::runtime_error);
  EXPECT_EQ(folder.text("matches.jsonl"), before);
  EXPECT_FALSE(folder.text("result.json").empty());
  {
    // Stopped with games under way: what counts has a gap, what is there goes beyond it.
    const Folder gap("gap");
    { Series(gap.path(), ten).add(fakeGame(gameOf(ten, 12))); }
    EXPECT_THROW(Series(gap.path(), settingsOf(6)), std::runtime_error);
    EXPECT_EQ(Series(gap.path(), settingsOf(7)).played(), 1);
  }
  EXPECT_EQ(Series(folder.path(), settingsOf(12)).open().size(), 4U);
  EXPECT_TRUE(folder.text("result.json").empty()) << "it tells of ten pairs";
}

TEST(Series, DamagedFilesAreNamedWithTheRemedy) {
  const Folder folder("damaged");
  const SeriesSettings settings = settingsOf(2);
  { Series(folder.path(), settings).add(fakeGame(gameOf(settings, 0))); }
  const auto errorWith = [&](const std::string& file, const std::string& text) {
    const std::string whole = folder.text(file);
    std::ofstream(folder.path() + "/" + file) << text;
    std::string said;
    try {
      const Series series(folder.path(), settings);
    } catch (const std::runtime_error& error) {
      said = error.what();
    }
    std::ofstream(folder.path() + "/" + file) << whole;
    return said;
  };
  const std::string seedOnly = R"({"pair":1,"game":1,"seed":1})";
  for (const auto& [file, text] :
       std::vector<std::pair<std::string, std::string>>{{"series.json", ""},
                                                        {"series.json", "{}"},
                                                        {"matches.jsonl", "{}\n"},
                                                        {"matches.jsonl", seedOnly + "\n"},
                                                        {"times.jsonl", "[]\n"}}) {
    const std::string said = errorWith(file, text);
    EXPECT_EQ(said.find(folder.path() + "/" + file + ": is damaged: "), 0U) << said;
    EXPECT_NE(said.find("choose another folder with --out"), std::string::npos) << said;
  }
  EXPECT_EQ(Series(folder.path(), settings).played(), 1);
}

// How the whole is played, not its first part; a mere resumption keeps the words of the beginning.
TEST(Series, MorePairsBringTheirCommandLine) {
  const Folder folder("words");
  SeriesSettings settings = settingsOf(1);
  settings.commandLine = "--pairs 1";
  { const Series series(folder.path(), settings); }
  settings.commandLine = "--pairs 1 --jobs 2";
  EXPECT_EQ(Series(folder.path(), settings).settings().commandLine, "--pairs 1");
  settings.pairs = 2;
  settings.commandLine = "--pairs 2";
  EXPECT_EQ(Series(folder.path(), settings).settings().commandLine, "--pairs 2");
  EXPECT_NE(folder.text("series.json").find("--pairs 2"), std::string::npos);
}

TEST(Series, AFileIsNoFolder) {
  const Folder folder("file");
  std::ofstream(folder.path()) << "a file";
  for (const std::string& place : {folder.path(), folder.path() + "/below"}) {
    try {
      const Series series(place, settingsOf(1));
      ADD_FAILURE() << place;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()),
                "cannot make the folder " + place + ": " + folder.path() + " is a file: name a folder");
    }
  }
}

// Somebody edits a side's file while the series runs.
TEST(Series, AGameDuringWhichASideChangedDoesNotCount) {
  const Folder data("changed_data");
  const Folder folder("changed");
  for (const char* name : {"/params", "/skills"}) fs::create_directories(data.path() + name);
  SeriesSettings settings = settingsOf(5);
  settings.a.dataFolder = data.path();
  takeFingerprints(settings, "");
  Series series(folder.path(), settings);
  const PlayGame play = [&](const SeriesGame& game, const std::function<bool(double)>&) {
    if (game.pair == 2) std::ofstream(data.path() + "/params/type0.toml") << "x = 1";
    return fakeGame(game);
  };
  EXPECT_THROW(playSeries(series, 1, unlessChanged(settings, "", play), kGoOn), std::runtime_error);
  EXPECT_EQ(series.played(), 2);
}

TEST(Series, TheIntervalOfOnePairIsNotKnown) {
  SeriesResult result;
  result.pairs = {1.0};
  result.difference = summarizePairs(result.pairs, 0.5);
  EXPECT_TRUE(result.differenceJson().at("interval_95").is_null());
  EXPECT_TRUE(result.differenceJson().at("standard_error").is_null());
}

TEST(Series, OnlyThisProgramPlaysInThisProcess) {
  SeriesSettings settings = settingsOf(1);
  settings.place.clear();
  EXPECT_EQ(placeFor(settings), "process");
  settings.b.executable = "/bin/sh";
  EXPECT_EQ(placeFor(settings), "tcp");
  settings.place = "process";
  EXPECT_THROW(placeFor(settings), std::runtime_error);
}

TEST(Series, AChangedSideHasAnotherFingerprint) {
  const Folder folder("fingerprint");
  for (const char* name : {"/params", "/skills"}) fs::create_directories(folder.path() + name);
  SideSettings side;
  side.dataFolder = folder.path();
  const std::string before = fingerprintOf(side, "");
  EXPECT_EQ(fingerprintOf(side, ""), before);
  std::ofstream(folder.path() + "/params/type0.toml") << "x = 1";
  const std::string after = fingerprintOf(side, "");
  EXPECT_NE(after, before);
  std::ofstream(folder.path() + "/params/type0.toml") << "x = 2";
  EXPECT_NE(fingerprintOf(side, ""), after);
}

TEST(Series, AnErrorInAGameEndsTheSeries) {
  const Folder folder("error");
  Series series(folder.path(), settingsOf(5));
  const PlayGame fails = [](const SeriesGame& game, const std::function<bool(double)>&) {
    if (game.pair == 2) throw std::runtime_error("no server");
    return fakeGame(game);
  };
  EXPECT_THROW(playSeries(series, 2, fails, kGoOn), std::runtime_error);
  EXPECT_FALSE(series.open().empty());
}

TEST(Series, SidesAreReadFromWords) {
  const auto side = [](const char* word) { return sideFromWord(word, NONET_SOURCE_DIR); };
  EXPECT_TRUE(side("own").ours());
  EXPECT_EQ(side(NONET_SOURCE_DIR).dataFolder, NONET_SOURCE_DIR);
  EXPECT_EQ(side("start.sh {host} {port}").command, "start.sh {host} {port}");
  EXPECT_EQ(side("/bin/sh").executable, "/bin/sh");
  EXPECT_THROW(side("/nowhere/at/all"), std::runtime_error);
  EXPECT_THROW(side("/tmp"), std::runtime_error) << "no skills/ there";
}

// Every file there is a team that can play, and another one than the full team.
TEST(Series, VariantsAreSides) {
  const std::vector<std::string> names = variantsIn(NONET_SOURCE_DIR);
  for (const char* name : {"allball", "boxes", "defense", "static", "wall"})
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
  for (const std::string& name : names) {
    agent::AgentChoice settings;
    settings.unum = 5;
    settings.robotType = 3;
    const auto full = agent::makeAgentSettings(settings, NONET_SOURCE_DIR);
    const SideSettings side = sideFromWord(name, NONET_SOURCE_DIR);
    EXPECT_TRUE(side.ours());
    settings.parameterFiles = side.parameterFiles;
    const auto variant = agent::makeAgentSettings(settings, NONET_SOURCE_DIR);
    EXPECT_NE(config::toToml(full.parameters), config::toToml(variant.parameters)) << name;
  }
}

// The variant without learned walk has the code's own values, whatever was learned.
TEST(Series, TheInitialWalkIsTheCodesOwn) {
  agent::AgentChoice settings;
  settings.unum = 5;
  settings.robotType = 3;
  settings.parameterFiles = sideFromWord("initial-walk", NONET_SOURCE_DIR).parameterFiles;
  const auto variant = agent::makeAgentSettings(settings, NONET_SOURCE_DIR);
  EXPECT_EQ(config::toToml(variant.parameters.motion.sets.goToTarget),
            config::toToml(motion::WalkParameters{}));
}

// The same team on both sides: the second game of a pair is the first with the names exchanged, so that every
// pair is a tie in sum. Another seed is another game.
TEST(Series, ATeamAgainstItselfInThisProcess) {
  SeriesSettings settings = settingsOf(2);
  settings.players = 2;
  settings.minutes = 2.0 / 60.0;
  settings.kickOffWait = 0.5;
  const Folder folder("itself");
  Series series(folder.path(), settings);
  writeOverlays(settings, folder.path());
  EXPECT_TRUE(playSeries(series, 2, inProcessGames(settings, folder.path(), NONET_SOURCE_DIR), kGoOn));
  const SeriesResult result = series.finish();
  EXPECT_EQ(result.games, 4);
  EXPECT_EQ(result.difference.mean, 0.0);
  EXPECT_EQ(result.pairs, (std::vector<double>{0.0, 0.0}));
}

// What --set takes as a number comes to the agents of a game as that number, however it is written.
TEST(Series, AssignmentsReachTheFileAsTheyWereMeant) {
  const Folder folder("overlay");
  fs::create_directories(folder.path());
  SeriesSettings settings = settingsOf(1);
  settings.a.assignments = {"a=.5", "b=5.", "c=007", "d=+5", "e=1e3", "f=-0.25", "g=true", "h=2m"};
  writeOverlays(settings, folder.path());
  EXPECT_EQ(folder.text("set-a.toml"),
            "a = 0.5\nb = 5\nc = 7\nd = 5\ne = 1000\nf = -0.25\ng = true\nh = \"2m\"\n");
}

std::string placeError(const SeriesSettings& settings) {
  try {
    checkPlace(settings);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(Series, WhatWouldDoNothingOnAServerApartIsRefusedByName) {
  SeriesSettings settings = settingsOf(1);
  settings.place = "localhost:3100:3200";
  settings.serverCommand = "start {port}";
  settings.a.assignments = {"team.ball.kick=false"};  // of the agents: these play
  EXPECT_EQ(placeError(settings), "");
  SeriesSettings other = settings;
  other.settingAssignments = {"QuickSolver=true"};
  EXPECT_NE(placeError(other).find("--set QuickSolver=true"), std::string::npos);
  other = settings;
  other.settingFiles = {"server.toml"};
  EXPECT_NE(placeError(other).find("--settings server.toml"), std::string::npos);
  other = settings;
  other.monitorLogs = true;
  EXPECT_NE(placeError(other).find("--monitor-logs"), std::string::npos);
  for (const char* place : {"process", "tcp", "realtime"}) {
    other.place = place;
    EXPECT_NE(placeError(other).find("--server-command"), std::string::npos) << place;
    other.serverCommand.clear();
    other.settingAssignments = {"QuickSolver=true"};
    EXPECT_EQ(placeError(other), "") << place;
    other.serverCommand = settings.serverCommand;
  }
}

// NONET_DATA is for this program: another one plays with what lies beside it.
TEST(Series, AnotherExecutablePlaysWithItsOwnData) {
  const Folder tree("older");
  const Folder elsewhere("elsewhere");
  for (const Folder* folder : {&tree, &elsewhere}) {
    for (const char* name : {"/params", "/skills", "/build"}) fs::create_directories(folder->path() + name);
  }
  SideSettings side;
  side.executable = tree.path() + "/build/nonet";
  std::ofstream(side.executable) << "older";
  EXPECT_EQ(dataBeside(side.executable), fs::canonical(tree.path()).string());
  EXPECT_EQ(dataBeside("/nowhere/nonet"), "");

  const std::string before = fingerprintOf(side, "");
  const char* set = std::getenv("NONET_DATA");
  const std::string kept = set != nullptr ? set : "";
  ::setenv("NONET_DATA", elsewhere.path().c_str(), 1);
  std::ofstream(elsewhere.path() + "/params/type0.toml") << "x = 1";
  EXPECT_EQ(fingerprintOf(side, ""), before);
  std::ofstream(tree.path() + "/params/type0.toml") << "x = 1";
  EXPECT_NE(fingerprintOf(side, ""), before);
  ::unsetenv("NONET_DATA");
  if (!kept.empty()) ::setenv("NONET_DATA", kept.c_str(), 1);
}

// An unknown parameter is an error before anything is played or written.
TEST(Series, SidesAreTriedBeforeTheFirstGame) {
  SideSettings side;
  checkSide(side, NONET_SOURCE_DIR);
  side.assignments = {"team.noSuchThing=1"};
  EXPECT_THROW(checkSide(side, NONET_SOURCE_DIR), std::runtime_error);
  side.assignments = {"nonsense"};
  EXPECT_THROW(checkSide(side, NONET_SOURCE_DIR), std::runtime_error);
}

// Whoever plays 30 s because a setting said so and was ignored plays 10 minutes.
TEST(Series, SettingsThatAMatchDecidesAreRefused) {
  SeriesSettings settings = settingsOf(1);
  settings.settingAssignments = {"RuleHalfTime=15"};
  EXPECT_THROW(matchOf(settings, gameOf(settings, 0), ""), std::runtime_error);
  settings.settingAssignments = {"Foo=1"};
  EXPECT_NE(placeError(settings).find("unknown setting 'Foo'"), std::string::npos) << "before the first game";
  settings.settingAssignments = {"SayLossShare=0.25"};
  EXPECT_EQ(placeError(settings), "");
  EXPECT_EQ(matchOf(settings, gameOf(settings, 0), "").settings.sayLossShare, 0.25);
}

}  // namespace
}  // namespace nonet::lab
