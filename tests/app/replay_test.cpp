// `nonet replay --localization` as a user runs it.
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "nonet/protocol/log_file.h"

#include "app/program.h"

namespace nonet::app {
namespace {

namespace fs = std::filesystem;

/// Standard output of the program.
std::string outputOf(const std::string& arguments) {
  const std::string command = std::string(NONET_BINARY) + " " + arguments;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  std::string output;
  std::array<char, 4096> buffer{};
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
    output.append(buffer.data(), count);
  }
  EXPECT_EQ(::pclose(pipe), 0) << command;
  return output;
}

TEST(ReplayCommand, LocalizationHasThePromisedKeysAndAMapPerLog) {
  const fs::path maps = fs::temp_directory_path() / ("nonet_maps_" + std::to_string(::getpid()));
  const std::string data = NONET_TEST_DATA "/replay/";
  std::istringstream lines(outputOf("replay --localization --json --maps " + maps.string() + " " + data +
                                    "crowd.log.gz " + data + "match_start.log.gz"));
  int logs = 0;
  for (std::string line; std::getline(lines, line); ++logs) {
    const auto json = nlohmann::json::parse(line);
    for (const char* error : {"position_error_m", "height_error_m", "heading_error_deg"}) {
      EXPECT_GT(json.at(error).at("median"), 0.0);
      EXPECT_GE(json.at(error).at("p95"), json.at(error).at("median"));
    }
    EXPECT_LT(json.at("position_error_m").at("median"), 0.01);
    EXPECT_LT(json.at("heading_error_deg").at("p95"), 0.5);
    EXPECT_GE(json.at("coverage95"), 0.0);
    EXPECT_LE(json.at("coverage95"), 1.0);
    EXPECT_EQ(json.at("frames"), logs == 0 ? 50 : 134);
    std::ifstream map(json.at("map").get<std::string>());
    std::string begin(4, ' ');
    map.read(begin.data(), 4);
    EXPECT_EQ(begin, "<svg");
  }
  EXPECT_EQ(logs, 2);
  fs::remove_all(maps);
}

TEST(ReplayCommand, LogsOfOneNameHaveMapsOfTheirOwn) {
  const TestFolder folder("nonet_maps_same");
  for (const char* half : {"first", "second"}) {
    fs::create_directories(folder.file(half));
    fs::copy(NONET_TEST_DATA "/replay/crowd.log.gz", folder.file(half) + "/3.log.gz");
  }
  std::istringstream lines(outputOf("replay --localization --json --maps " + folder.file("maps") + " " +
                                    folder.file("first/3.log.gz") + " " + folder.file("second/3.log.gz")));
  std::vector<std::string> maps;
  for (std::string line; std::getline(lines, line);)
    maps.push_back(fs::path(nlohmann::json::parse(line).at("map").get<std::string>()).filename().string());
  EXPECT_EQ(maps, (std::vector<std::string>{"3.log.gz.svg", "3.log.gz-2.svg"}));
  for (const std::string& map : maps) EXPECT_TRUE(fs::exists(folder.file("maps/" + map))) << map;
}

class ReplayFiles : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder.file(name), std::ios::binary) << text;
    return folder.file(name);
  }
  /// Exit code and output of `nonet replay ARGUMENTS`.
  std::pair<int, std::string> replay(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "replay");
    Program program(arguments, folder.file("out.txt"));
    const int code = program.wait();
    return {code, program.output()};
  }
  /// A log of our own, of three seconds of play, decompressed.
  std::string ownLog() const {
    Program match({"match", "--alone", "--players", "1", "--minutes", "0.05", "--kick-off-wait", "0.5",
                   "--logs", folder.file("logs"), "--json", folder.file("match.json")},
                  folder.file("match.txt"));
    EXPECT_EQ(match.wait(), 0) << match.output();
    protocol::LogReader reader(folder.file("logs/Nonet_1.zst"));
    std::string text;
    protocol::LogLine line;
    while (reader.next(line)) {
      constexpr std::string_view kMarks = "<>=#";
      text += fmt::format("{} {}\n", kMarks[static_cast<std::size_t>(line.kind)], line.text);
    }
    return text;
  }

  TestFolder folder{"nonet_replay"};
};

TEST_F(ReplayFiles, WhatIsNoLogEndsWithThreeAndALineThatSaysWhatItIs) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {write("empty", ""), "it is empty"},
      {write("random", std::string("\x01\x02\xff\x00\x07 garbage\n\x03\n", 17)), "line 1 is binary data"},
      {write("monitor", "((FieldLength 30)(FieldWidth 20))(RSG 0 1)\n"), "line 1 is of a monitor's stream"},
      {write("prose", "Dear diary,\n"), "line 1 is 'Dear diary,'"},
      {write("torn_prose", "Dear diary"), "line 1 is 'Dear diary'"},
  };
  for (const auto& [file, what] : cases) {
    const auto [code, output] = replay({file});
    EXPECT_EQ(code, 3) << output;
    EXPECT_NE(output.find(file + ": no log of an agent"), std::string::npos) << output;
    EXPECT_NE(output.find(what), std::string::npos) << output;
  }
}

TEST_F(ReplayFiles, ATornEndIsFineDamageIsNot) {
  const std::string whole = ownLog();
  EXPECT_EQ(replay({write("whole.log", whole)}).first, 0);
  const auto [torn, said] = replay({write("torn.log", whole.substr(0, whole.size() - 30))});
  EXPECT_EQ(torn, 0) << said;
  EXPECT_NE(said.find("the last line is torn"), std::string::npos) << said;
  // Within the header and within the first block of the compressed data.
  fs::copy(folder.file("logs/Nonet_1.zst"), folder.file("early.zst"));
  fs::resize_file(folder.file("early.zst"), 2000);
  for (const std::string& file : {write("early.log", whole.substr(0, 500)), folder.file("early.zst")}) {
    const auto [early, nothing] = replay({file});
    EXPECT_EQ(early, 0) << nothing;
    EXPECT_NE(nothing.find("0 whole lines were read"), std::string::npos) << nothing;
  }

  std::string damaged = whole;
  const std::size_t line = damaged.find("\n< ", damaged.size() / 2);
  damaged.replace(line + 1, 20, "####################");
  const auto [code, output] = replay({write("damaged.log", damaged)});
  EXPECT_EQ(code, 3) << output;
  EXPECT_NE(output.find("damaged, 1 lines are neither message nor answer"), std::string::npos) << output;

  const auto [wrong, header] = replay({write("header.log", "# nonet-log 1 {\"version\":}\n")});
  EXPECT_EQ(wrong, 3);
  EXPECT_NE(header.find(folder.file("header.log") + ": the header line cannot be read"), std::string::npos);
}

TEST_F(ReplayFiles, ValuesInTheHeaderAreNamedWithTheFile) {
  const std::string file =
      write("values.log",
            "# nonet-log 1 {\"version\":\"\",\"team\":\"A\",\"unum\":1,\"type\":0,\"seed\":1,"
            "\"parameters\":\"nosuch = 1\"}\n< (time (now 1.00))\n");
  const auto [code, output] = replay({file});
  EXPECT_EQ(code, 2);
  EXPECT_NE(output.find(file + ": parameters in the header:1: unknown key 'nosuch'"), std::string::npos)
      << output;
}

TEST_F(ReplayFiles, OptionsApplyOrAreRefused) {
  const std::string file = write("own.log", ownLog());
  const std::string parameters = write("slow.toml", "[motion.head]\n");
  EXPECT_EQ(replay({file, "--params", parameters}).first, 0) << "nothing in it";
  EXPECT_EQ(replay({file, "--set", "team.ball.kick=false"}).first & ~1, 0);
  EXPECT_EQ(replay({file, "--set", "team.ball.kick=2"}).first, 1) << "a wrong option, not a file";
  std::ofstream(parameters) << "[world]\nusePoseFit = false\nuseParticleFilter = false\n";
  EXPECT_EQ(replay({file, "--params", parameters}).first, 1) << "the answers must differ";
  EXPECT_EQ(replay({file, "--type", "3"}).first, 1);
  EXPECT_EQ(replay({file, "--maps", folder.file("maps")}).first, 1) << "only with --localization";
}

}  // namespace
}  // namespace nonet::app
