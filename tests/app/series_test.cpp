// A series from the command line, and the page about it.
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <signal.h>

#include "nonet/lab/match/frame_sources.h"
#include "nonet/protocol/framing.h"

#include "app/browser.h"
#include "app/fake_server.h"
#include "app/program.h"

namespace nonet::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

int occurrences(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(SeriesCommand, PlaysPairsAndReportsThem) {
  const TestFolder folder("nonet_series");
  const std::string out = folder.file("games");
  Program series({"series", "own", "own", "--b-set", "team.ball.kick=false", "--b-name", "walkers", "--set",
                  "world.useLines=true", "--pairs", "1", "--minutes", "0.1", "--players", "2", "--jobs", "2",
                  "--out", out},
                 folder.file("1.txt"));
  ASSERT_EQ(series.wait(), 0) << series.output();
  EXPECT_THAT(series.output(), HasSubstr("2 games"));
  std::ifstream resultFile(out + "/result.json");
  const auto result = nlohmann::json::parse(resultFile);
  for (const char* side : {"a", "b"})
    EXPECT_THAT(result.at(side).get<std::string>(), HasSubstr("world.useLines=true")) << "--set is for both";

  Program report({"report", out}, folder.file("2.txt"));
  ASSERT_EQ(report.wait(), 0) << report.output();
  std::ifstream file(out + "/report.html");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(page, HasSubstr("A against walkers"));
  EXPECT_THAT(page, HasSubstr("team.ball.kick=false"));
  EXPECT_THAT(page, Not(HasSubstr("http://"))) << "it needs nothing else";
  EXPECT_THAT(page, Not(HasSubstr("nan")));
  for (const char* tag : {"svg", "table", "figure", "tr"}) {
    const std::string open = std::string("<") + tag;
    EXPECT_EQ(occurrences(page, open + ">") + occurrences(page, open + " "),
              occurrences(page, std::string("</") + tag + ">"))
        << tag;
  }
  if (const auto browser = Browser::find()) {
    const Picture picture =
        browser->screenshot("file://" + out + "/report.html", folder.file("profile"), folder.file("1.png"));
    EXPECT_GT(picture.share([](int r, int g, int b) { return r < 100 && g < 100 && b < 100; }), 0.002)
        << "text is drawn";
  }
}

std::string textOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// What is the same wherever the games are played: everything but who knows roles and names of kicks.
std::vector<std::string> signatures(const std::string& folder) {
  std::vector<std::string> found;
  std::ifstream file(folder + "/matches.jsonl");
  for (std::string line; std::getline(file, line);) {
    const auto json = nlohmann::json::parse(line);
    found.push_back(json.value("signature", "") + " " + json.at("score_a").dump() + ":" +
                    json.at("score_b").dump());
  }
  return found;
}

const std::vector<std::string> kShort = {"--pairs", "1", "--minutes",       "0.05", "--players", "2",
                                         "--jobs",  "2", "--kick-off-wait", "1"};

std::vector<std::string> seriesOf(const std::vector<std::string>& more, const std::string& out) {
  std::vector<std::string> arguments = {"series"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  arguments.insert(arguments.end(), kShort.begin(), kShort.end());
  arguments.insert(arguments.end(), {"--out", out});
  return arguments;
}

// This very executable stands in for an older one: the games over TCP are then those in this process.
TEST(SeriesCommand, AnotherExecutablePlaysOverTcp) {
  const TestFolder folder("nonet_series_binary");
  const std::string here = folder.file("here");
  const std::string there = folder.file("there");
  Program process(seriesOf({"own", "own"}, here), folder.file("1.txt"));
  ASSERT_EQ(process.wait(), 0) << process.output();
  Program tcp(seriesOf({"own", "--b-binary", NONET_BINARY}, there), folder.file("2.txt"));
  ASSERT_EQ(tcp.wait(), 0) << tcp.output();
  EXPECT_EQ(signatures(there), signatures(here));
  const auto result = nlohmann::json::parse(textOf(there + "/result.json"));
  EXPECT_EQ(result.at("place"), "tcp");
  EXPECT_EQ(result.at("crashed"), nlohmann::json({0, 0}));
  EXPECT_EQ(result.at("gone"), nlohmann::json({0, 0}));
  EXPECT_THAT(textOf(there + "/times.jsonl"), HasSubstr("\"late_b\":0"));
}

// A program that says how it was called, and plays no game: NONET_DATA is of this program, --data of that
// one.
TEST(SeriesCommand, AnotherExecutableIsToldItsOwnData) {
  const TestFolder folder("nonet_series_data");
  for (const char* part : {"older/params", "older/skills", "older/build"})
    fs::create_directories(folder.file(part));
  const std::string older = folder.file("older/build/nonet");
  std::ofstream(older)
      << "#!/bin/sh\n[ \"$2\" = --help ] && echo ' --host --port --unum --team --type --data '\n"
         "[ \"$2\" = --help ] || echo \"$@\" >> '" +
             folder.file("calls") + "'\nexit 9\n";
  fs::permissions(older, fs::perms::owner_all);
  std::vector<std::string> arguments = seriesOf({"own", "--b-binary", older}, folder.file("games"));
  arguments.insert(arguments.begin(), {std::string("NONET_DATA=") + NONET_SOURCE_DIR, NONET_BINARY});
  Program series("/usr/bin/env", arguments, folder.file("1.txt"));
  EXPECT_EQ(series.wait(), 1);
  EXPECT_THAT(textOf(folder.file("calls")),
              HasSubstr("--data " + fs::canonical(folder.file("older")).string()));
}

TEST(SeriesCommand, OptionsThatDoNothingOnAServerApartAreRefused) {
  const TestFolder folder("nonet_series_apart");
  const std::vector<std::string> apart = {"own", "own", "--where", "127.0.0.1:1:2"};
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--set", "QuickSolver=true"}, {"--monitor-logs"}}) {
    std::vector<std::string> arguments = apart;
    arguments.insert(arguments.end(), more.begin(), more.end());
    Program series(seriesOf(arguments, folder.file("games")), folder.file("1.txt"));
    ASSERT_EQ(series.wait(), 1);
    EXPECT_THAT(series.output(), HasSubstr(more.front()));
  }
  std::ofstream(folder.file("t.toml")) << "pairs = 1\nserverCommand = 'start'\n[[side]]\nname = 'full'\n"
                                          "side = 'own'\n[[side]]\nname = 'boxes'\n";
  Program table({"table", folder.file("t.toml"), "--out", folder.file("out")}, folder.file("2.txt"));
  ASSERT_EQ(table.wait(), 1);
  EXPECT_THAT(table.output(), HasSubstr("serverCommand"));
}

// Foreign agents are started by a shell command, in the background, as teams of the league do; all of them
// are stopped afterwards.
TEST(SeriesCommand, AShellCommandStartsForeignAgents) {
  const TestFolder folder("nonet_series_command");
  const std::string out = folder.file("games");
  const std::string command = std::string("for i in 1 2; do setsid ") + NONET_BINARY +
                              " play --port {port} --team {team} --unum $i --type $((4*(i-1))) --sync on "
                              ">/dev/null 2>&1 </dev/null & done; sleep 600 & echo $! > " +
                              folder.file("pid");
  Program series(seriesOf({"own", command}, out), folder.file("1.txt"));
  ASSERT_EQ(series.wait(), 0) << series.output();
  EXPECT_EQ(signatures(out).size(), 2U);
  const int left = std::stoi(textOf(folder.file("pid")));
  EXPECT_EQ(textOf("/proc/" + std::to_string(left) + "/cmdline"), "") << "what the command started is gone";
}

TEST(SeriesCommand, ACommandThatStartsNobodyIsToldWithItsWords) {
  const TestFolder folder("nonet_series_nobody");
  Program series(seriesOf({"own", "echo no such team on {port}; exit 3"}, folder.file("games")),
                 folder.file("1.txt"));
  EXPECT_EQ(series.wait(), 1);
  EXPECT_THAT(series.output(), HasSubstr("exit code 3: no such team on"));
  Program wrong(seriesOf({"own", "--b-binary", "/bin/true"}, folder.file("other")), folder.file("2.txt"));
  EXPECT_EQ(wrong.wait(), 1);
  EXPECT_THAT(wrong.output(), HasSubstr("is no executable of Nonet"));
}

// Kicked off through its monitor port, counted from its monitor stream; the second game on the same server
// begins at 0 : 0 again.
TEST(SeriesCommand, PlaysOnAServerThatRuns) {
  const TestFolder folder("nonet_series_server");
  Program server({"serve", "--sync", "--port", "0", "--monitor-port", "0"}, folder.file("server.txt"));
  ASSERT_TRUE(server.says("agents on port \\d+, monitors on port \\d+"));
  const std::string text = server.output();
  std::smatch ports;
  ASSERT_TRUE(std::regex_search(text, ports, std::regex("agents on port (\\d+), monitors on port (\\d+)")));
  const std::string out = folder.file("games");
  Program series(
      seriesOf({"own", "own", "--where", "127.0.0.1:" + ports[1].str() + ":" + ports[2].str()}, out),
      folder.file("1.txt"));
  ASSERT_EQ(series.wait(), 0) << series.output();
  ASSERT_EQ(signatures(out).size(), 2U);
  std::ifstream file(out + "/matches.jsonl");
  for (std::string line; std::getline(file, line);) {
    const auto game = nlohmann::json::parse(line);
    EXPECT_NEAR(game.at("game_time_s").get<double>(), 3.0, 0.5);
    const auto& teams = game.at("statistics").at("teams");
    for (const auto& team : teams) EXPECT_EQ(team.at("players").size(), 2U);
  }
  EXPECT_TRUE(server.running());
}

// What a monitor sees of the play mode, each once.
class ModeWatch {
 public:
  explicit ModeWatch(const std::string& port) {
    asio::connect(socket_, asio::ip::tcp::resolver(io_).resolve("127.0.0.1", port));
    thread_ = std::jthread([this] { read(); });
  }
  /// Ends when the server does.
  std::vector<protocol::PlayMode> modes() {
    thread_.join();
    return modes_;
  }

 private:
  void read() {
    protocol::FrameReader frames;
    lab::MonitorFrames stream;
    std::error_code error;
    while (!error) {
      const std::span<char> room = frames.prepare(65536);
      frames.received(socket_.read_some(asio::buffer(room.data(), room.size()), error));
      while (const auto message = frames.next()) {
        if (!stream.message(*message)) continue;
        if (modes_.empty() || modes_.back() != stream.frame().mode) modes_.push_back(stream.frame().mode);
      }
    }
  }

  asio::io_context io_;
  asio::ip::tcp::socket socket_{io_};
  std::vector<protocol::PlayMode> modes_;
  std::jthread thread_;
};

// The second half belongs to the team that did not begin.
TEST(SeriesCommand, TheOtherTeamKicksOffTheSecondHalf) {
  const TestFolder folder("nonet_series_halves");
  Program server({"serve", "--sync", "--port", "0", "--monitor-port", "0", "--set", "RuleHalfTime=2"},
                 folder.file("server.txt"));
  ASSERT_TRUE(server.says("agents on port \\d+, monitors on port \\d+"));
  const std::string text = server.output();
  std::smatch ports;
  ASSERT_TRUE(std::regex_search(text, ports, std::regex("agents on port (\\d+), monitors on port (\\d+)")));
  ModeWatch watch(ports[2].str());
  Program series(seriesOf({"own", "own", "--where", "127.0.0.1:" + ports[1].str() + ":" + ports[2].str()},
                          folder.file("games")),
                 folder.file("1.txt"));
  EXPECT_EQ(series.wait(), 0) << series.output();
  ::kill(server.pid(), SIGTERM);
  server.wait();
  std::vector<protocol::PlayMode> kickOffs;
  for (const protocol::PlayMode mode : watch.modes()) {
    if (mode == protocol::PlayMode::KickOffLeft || mode == protocol::PlayMode::KickOffRight)
      kickOffs.push_back(mode);
  }
  ASSERT_GE(kickOffs.size(), 2U);
  EXPECT_EQ(kickOffs[0], protocol::PlayMode::KickOffLeft);
  EXPECT_EQ(kickOffs[1], protocol::PlayMode::KickOffRight);
}

TEST(SeriesCommand, SaysAtOnceThatItWaitsForAServer) {
  const TestFolder folder("nonet_series_waits");
  const ClosedPort nobody;
  const std::string port = std::to_string(nobody.port());
  Program series(seriesOf({"own", "own", "--where", "127.0.0.1:" + port + ":" + port}, folder.file("games")),
                 folder.file("1.txt"));
  EXPECT_TRUE(series.says("waiting up to 90 s for a server at 127.0.0.1, monitor port " + port))
      << series.output();
  ::kill(series.pid(), SIGTERM);
  EXPECT_EQ(series.wait(), 1);
}

// SIGKILL in the middle, then the same command again: the same files as without.
TEST(SeriesCommand, KilledAndResumedItEndsInTheSameResult) {
  const TestFolder folder("nonet_series_kill");
  std::map<std::string, std::string> results;
  for (const std::string name : {"whole", "killed"}) {
    const std::vector<std::string> arguments = {
        "series",    "own",   "no-kick",         "--pairs",   "3",
        "--minutes", "0.1",   "--kick-off-wait", "1",         "--jobs",
        "1",         "--out", folder.file(name), "--players", "2"};
    if (name == "killed") {
      Program first(arguments, folder.file("first.txt"));
      // Two games to wait for: half a minute in a sanitized build on a busy machine.
      ASSERT_TRUE(Program::fileSays(folder.file(name) + "/matches.jsonl", "\"pair\":1,\"game\":2", 300.0));
      ASSERT_EQ(::kill(first.pid(), SIGKILL), 0);
      EXPECT_EQ(first.wait(), -1);
    }
    Program program(arguments, folder.file(name + ".txt"));
    ASSERT_EQ(program.wait(), 0) << program.output();
    if (name == "killed") {
      EXPECT_THAT(program.output(), HasSubstr("resumed: "));
    }
    results[name] = textOf(folder.file(name) + "/matches.jsonl");
    auto result = nlohmann::json::parse(textOf(folder.file(name) + "/result.json"));
    for (const char* key : {"date", "command_line"}) result.erase(key);
    results[name] += result.dump();
  }
  EXPECT_EQ(results["whole"], results["killed"]);
}

TEST(TableCommand, PlaysAFileAndGoesOnWithIt) {
  const TestFolder folder("nonet_table");
  std::ofstream(folder.file("t.toml")) << "title = 'Two variants'\nagainst = 'full'\npairs = 1\n"
                                          "minutes = 0.05\nplayers = 2\nkickOffWait = 1\n"
                                          "[[side]]\nname = 'full'\nside = 'own'\n"
                                          "[[side]]\nname = 'boxes'\n[[side]]\nname = 'no-kick'\n";
  const std::vector<std::string> arguments = {"table", folder.file("t.toml"), "--out", folder.file("out")};
  Program first(arguments, folder.file("1.txt"));
  ASSERT_EQ(first.wait(), 0) << first.output();
  EXPECT_THAT(first.output(), HasSubstr("Two variants"));
  EXPECT_THAT(first.output(), HasSubstr("\nboxes"));
  const auto table = nlohmann::json::parse(textOf(folder.file("out/table.json")));
  EXPECT_EQ(table.at("entries").size(), 2U);
  EXPECT_EQ(table.at("entries").at(1).at("games"), 2);
  Program again(arguments, folder.file("2.txt"));
  ASSERT_EQ(again.wait(), 0);
  EXPECT_THAT(again.output(), HasSubstr("resumed: 2 games are there"));
}

TEST(SeriesCommand, ReportWantsAFinishedSeries) {
  const TestFolder folder("nonet_report");
  Program report({"report", folder.file("")}, folder.file("1.txt"));
  EXPECT_EQ(report.wait(), 1);
  EXPECT_THAT(report.output(), HasSubstr("holds no finished series: play one with nonet series"));
  for (const char* text : {"", "{}"}) {
    std::ofstream(folder.file("result.json")) << text;
    std::ofstream(folder.file("matches.jsonl")) << "{\"a\": \"left\", \"statistics\": {}}\n";
    Program damaged({"report", folder.file("")}, folder.file("1.txt"));
    EXPECT_EQ(damaged.wait(), 1);
    EXPECT_THAT(damaged.output(), HasSubstr("result.json: is damaged: the command of the series"));
  }
}

}  // namespace
}  // namespace nonet::app
