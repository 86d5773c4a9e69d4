// The program as it is installed: elsewhere, in a folder with blanks, read-only, run by somebody else.
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "nonet/app/data_folder.h"

#include "app/program.h"

namespace nonet::app {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

/// Exit code and output of a shell command.
std::pair<int, std::string> shell(const TestFolder& folder, const std::string& command) {
  Program program("/bin/sh", {"-c", command}, folder.file("shell.txt"));
  const int code = program.wait();
  return {code, program.output()};
}

class Installed : public testing::Test {
 protected:
  void SetUp() override {
    const auto [code, output] =
        shell(folder, "cmake --install '" + fs::path(NONET_BINARY).parent_path().string() + "' --prefix '" +
                          prefix + "' && chmod -R a-w,a+rX '" + prefix + "' && mkdir -m 777 '" +
                          folder.file("work") + "'");
    ASSERT_EQ(code, 0) << output;
  }
  ~Installed() override { shell(folder, "chmod -R u+w '" + prefix + "'"); }
  /// As somebody who owns nothing of it, if this test runs as root.
  std::pair<int, std::string> asNobody(const std::string& command) {
    const std::string other = ::geteuid() == 0 ? "setpriv --reuid 65534 --regid 65534 --clear-groups " : "";
    return shell(folder, "cd '" + folder.file("work") + "' && " + other +
                             "env -u NONET_DATA HOME=/nonexistent " + "TMPDIR='" + folder.file("work") +
                             "' " + command);
  }

  TestFolder folder{"nonet installed here"};
  std::string prefix = folder.file("a folder/nonet");
  std::string binary = "'" + prefix + "/bin/nonet' ";
};

TEST_F(Installed, PlaysWithItsOwnData) {
  const auto [listed, parameters] = asNobody(binary + "params --type 4");
  EXPECT_EQ(listed, 0) << parameters;
  EXPECT_THAT(parameters, HasSubstr("from " + prefix + "/share/nonet/params/type4.toml"));
  EXPECT_THAT(parameters, Not(HasSubstr(std::string("from ") + NONET_SOURCE_DIR)));
  const auto [played, match] = asNobody(
      binary + "match --players 2 --minutes 0.05 --kick-off-wait 0.5 --seed 3 --json match.json --logs logs");
  EXPECT_EQ(played, 0) << match;
  std::ifstream file(folder.file("work/match.json"));
  const std::string json{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(json, HasSubstr("\"flawless\": true"));
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they want to be loaded first
// From Python, with the installation's own data.
TEST_F(Installed, ItsLibraryServesLearners) {
  const auto [code, output] =
      asNobody("python3 '" + prefix + "/share/nonet/scripts/nonet_env.py' --self-test");
  EXPECT_EQ(code, 0) << output;
  EXPECT_THAT(output, HasSubstr("the library does what it should"));
  // Where it looks shows when something is missing there.
  const std::string file = prefix + "/share/nonet/params/type0.toml";
  ASSERT_EQ(shell(folder, "chmod -R u+w '" + prefix + "' && rm '" + file + "'").first, 0);
  const auto [failed, error] =
      asNobody("python3 '" + prefix + "/share/nonet/scripts/nonet_env.py' run --bench 0.1");
  EXPECT_EQ(failed, 1);
  EXPECT_THAT(error, HasSubstr(file + ": is missing"));
}
#endif

TEST_F(Installed, ItsScriptsStartAndStopAgents) {
  Program server({"serve", "--port", "0", "--monitor-port", "0"}, folder.file("server.txt"));
  ASSERT_TRUE(server.says("agents on port "));
  const std::string port = std::to_string(server.numberAfter("agents on port "));
  const std::string scripts = "'" + prefix + "/share/nonet/scripts/";
  const auto [started, output] = asNobody(scripts + "start.sh' 127.0.0.1 " + port + " -t Ours -n 2");
  EXPECT_EQ(started, 0) << output;
  EXPECT_TRUE(server.says("number 2 of team Ours")) << server.output();
  EXPECT_THAT(asNobody(scripts + "kill.sh'").second, HasSubstr("stopped 2 agents"));
}

std::set<std::string> linesOf(const std::string& text) {
  std::set<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.insert(line);
  return lines;
}

// What is packed is what would be installed, with its rights; and the Debian package asks for what the
// program is linked with.
TEST_F(Installed, IsWhatThePackagesHold) {
  const std::string config = fs::path(NONET_BINARY).parent_path() / "CPackConfig.cmake";
  const std::string list = " && find . -type f -perm -100 -printf 'x %P\\n' -o -type f -printf '- %P\\n'";
  const auto [found, installed] = shell(folder, "cd '" + prefix + "'" + list);
  ASSERT_EQ(found, 0) << installed;
  EXPECT_THAT(installed, HasSubstr("x share/nonet/scripts/start.sh\n"));
  EXPECT_THAT(installed, HasSubstr("- share/nonet/scripts/nonet_env.py\n"));
  EXPECT_THAT(installed, HasSubstr("- include/nonet/env/nonet_env.h\n"));
  EXPECT_THAT(installed, ContainsRegex("/libnonet_env\\.so\\.1\n"));
  EXPECT_THAT(installed, HasSubstr("- share/nonet/three/build/three.module.js\n"));
  for (const auto& [kind, ending, unpack] :
       {std::tuple{"TGZ", ".tar.gz", "tar xz --strip-components=1 -f ../package"},
        std::tuple{"DEB", ".deb", "dpkg-deb -x ../package ."}}) {
    const std::string out = folder.file(kind);
    const auto [packed, output] =
        shell(folder, std::string("cpack -G ") + kind + " --config '" + config + "' -B '" + out +
                          "' && mv '" + out + "'/*" + ending + " '" + out + "/package'");
    ASSERT_EQ(packed, 0) << output;
    const std::string inside = kind == std::string("DEB") ? "/usr" : "";
    const auto [read, held] = shell(folder, "mkdir '" + out + "/content' && cd '" + out + "/content' && " +
                                                unpack + " && cd ." + inside + list);
    ASSERT_EQ(read, 0) << held;
    EXPECT_EQ(linesOf(held), linesOf(installed)) << kind;
  }
  const auto [linked, libraries] = shell(folder, std::string("ldd '") + NONET_BINARY + "'");
  const auto [told, depends] = shell(folder, "dpkg-deb -f '" + folder.file("DEB/package") + "' Depends");
  EXPECT_EQ(told, 0) << depends;
  for (const auto& [library, package] :
       {std::pair{"libode.so.8", "libode8"}, std::pair{"libzstd.so.1", "libzstd1"},
        std::pair{"libc.so.6", "libc6"}}) {
    EXPECT_THAT(libraries, HasSubstr(library));
    EXPECT_THAT(depends, HasSubstr(package));
  }
}

// Without Debian's libjs-three too: what the page loads is there, and found first.
TEST_F(Installed, BringsWhatTheViewersPageLoads) {
  const std::string three = findThree(prefix + "/bin/nonet", "/of/the/system");
  EXPECT_EQ(three, prefix + "/share/nonet/three");
  EXPECT_EQ(findThree(NONET_BINARY, "/of/the/system"), "/of/the/system");
  const auto [code, loaded] = shell(folder, "grep -oh \"from '/three/[^']*\" '" NONET_SOURCE_DIR
                                            "'/src/app/view/web/*.js | sed 's#^from ./three##' | sort -u");
  EXPECT_EQ(code, 0);
  EXPECT_THAT(loaded, HasSubstr("/build/three.module.js\n"));
  for (const std::string& path : linesOf(loaded)) EXPECT_TRUE(fs::exists(three + path)) << path;
}

TEST(Version, NamesTheCommit) {
  const TestFolder folder("nonet_version");
  Program program({"--version"}, folder.file("version.txt"));
  EXPECT_EQ(program.wait(), 0);
  EXPECT_TRUE(std::regex_search(program.output(),
                                std::regex("^nonet [0-9]+\\.[0-9]+\\.[0-9]+, commit ([0-9a-f]{7,}|unknown)")))
      << program.output();
}

class Params : public testing::Test {
 protected:
  std::pair<int, std::string> list(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "params");
    Program program(arguments, folder.file("params.txt"));
    const int code = program.wait();
    return {code, program.output()};
  }
  TestFolder folder{"nonet_params"};
};

TEST_F(Params, TellsWhereEachValueComesFrom) {
  // The same value again: the file has said it all the same.
  std::ofstream(folder.file("mine.toml")) << "[world]\nusePoseFit = true\nuseLines = false\n";
  const std::string type = NONET_SOURCE_DIR "/params/type2.toml";
  const auto [code, all] =
      list({"--type", "2", "--params", folder.file("mine.toml"), "--set", "world.useParticleFilter=false"});
  EXPECT_EQ(code, 0);
  const auto says = [&text = all](const std::string& pattern) {
    return std::regex_search(text, std::regex(pattern));
  };
  EXPECT_TRUE(says("world.usePoseFit = true\n +range true or false, search -, from [^\n]*mine.toml"));
  EXPECT_TRUE(says("world.useLines = false \\(default true\\)\n[^\n]*from [^\n]*mine.toml"));
  EXPECT_TRUE(says("world.useParticleFilter = false \\(default true\\)\n[^\n]*from --set"));
  EXPECT_THAT(all, HasSubstr(", from " + type));
  EXPECT_TRUE(says("\nworld.[^\n]*\n[^\n]*from code"));
  EXPECT_TRUE(says("motion.skills.[^\n]*\n[^\n]*from [^\n]*(skills|toml)"));
}

TEST_F(Params, FindsByWordAndByDifference) {
  const auto [found, lines] = list({"--grep", "usePoseFit"});
  EXPECT_EQ(found, 0);
  EXPECT_THAT(lines, HasSubstr("\n1 of "));
  EXPECT_EQ(list({"--grep", "nothing is called so"}).first, 1);
  const auto [differ, some] = list({"--diff", "--grep", "world.use", "--set", "world.useLines=false"});
  EXPECT_EQ(differ, 0);
  EXPECT_THAT(some, HasSubstr("world.useLines = false (default true)"));
  EXPECT_THAT(some, Not(HasSubstr("usePoseFit")));
  EXPECT_EQ(list({"--grep", "POSEfit"}).first, 0) << "upper and lower case are the same";
}

TEST_F(Params, SpeaksJson) {
  const auto [code, text] = list({"--json", "--grep", "world.useLines", "--set", "world.useLines=false"});
  EXPECT_EQ(code, 0);
  const auto json = nlohmann::json::parse(text);
  ASSERT_EQ(json.size(), 1U);
  EXPECT_EQ(json[0]["name"], "world.useLines");
  EXPECT_EQ(json[0]["value"], false);
  EXPECT_EQ(json[0]["default"], true);
  EXPECT_EQ(json[0]["from"], "--set");
  EXPECT_TRUE(json[0]["range"].is_null()) << "true or false";
}

}  // namespace
}  // namespace nonet::app
