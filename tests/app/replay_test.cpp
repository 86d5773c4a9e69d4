// `nonet replay --localization` as a user runs it.
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

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

}  // namespace
}  // namespace nonet::app
