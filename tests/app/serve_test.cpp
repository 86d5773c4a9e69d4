// The server and agents as processes, as on a match day: started by the scripts, harmed in every way a
// network and an operating system can harm them.
#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <regex>
#include <thread>

#include <asio.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <poll.h>

#include "nonet/math/random.h"
#include "nonet/protocol/framing.h"

#include "app/program.h"
#include "sim/server/server_client.h"

namespace nonet::app {
namespace {

using asio::ip::tcp;

std::string command(const std::string& name) {
  return std::string(NONET_SOURCE_DIR) + "/scripts/" + name;
}

void pause(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

/// Passes one connection on to the server until it is cut.
class Proxy {
 public:
  explicit Proxy(int serverPort)
      : acceptor_(io_, {asio::ip::address_v4::loopback(), 0}), near_(io_), far_(io_) {
    acceptor_.async_accept(near_, [this, serverPort](std::error_code error) {
      if (error) return;
      far_.connect({asio::ip::address_v4::loopback(), static_cast<asio::ip::port_type>(serverPort)});
      far_.set_option(tcp::no_delay(true));
      near_.set_option(tcp::no_delay(true));
      pass(near_, far_, up_);
      pass(far_, near_, down_);
    });
    thread_ = std::thread([this] { io_.run(); });
  }
  ~Proxy() {
    cut();
    thread_.join();
  }
  Proxy(const Proxy&) = delete;
  Proxy& operator=(const Proxy&) = delete;

  int port() const { return acceptor_.local_endpoint().port(); }
  /// Both ends are reset, in the middle of whatever is under way.
  void cut() {
    asio::post(io_, [this] {
      std::error_code ignored;
      for (tcp::socket* socket : {&near_, &far_}) {
        socket->set_option(asio::socket_base::linger(true, 0), ignored);
        socket->close(ignored);
      }
      acceptor_.close(ignored);
    });
  }

 private:
  using Buffer = std::array<char, 4096>;

  void pass(tcp::socket& from, tcp::socket& to, Buffer& buffer) {
    from.async_read_some(asio::buffer(buffer), [&, this](std::error_code error, std::size_t size) {
      std::error_code failure;
      if (!error) asio::write(to, asio::buffer(buffer.data(), size), failure);
      if (!error && !failure) pass(from, to, buffer);
    });
  }

  asio::io_context io_{1};
  tcp::acceptor acceptor_;
  tcp::socket near_;
  tcp::socket far_;
  Buffer up_{};
  Buffer down_{};
  std::thread thread_;
};

class ServeCommand : public testing::Test {
 protected:
  /// The server on any free port; settings as for --set.
  void serve(const std::vector<std::string>& settings) {
    std::vector<std::string> arguments = {"serve", "--realtime", "--port", "0", "--monitor-port", "0"};
    arguments.emplace_back("--end-with-match");
    for (const std::string& setting : settings) {
      arguments.emplace_back("--set");
      arguments.push_back(setting);
    }
    server = std::make_unique<Program>(arguments, folder.file("server.txt"));
    ASSERT_TRUE(server->says("monitors on port")) << server->output();
    port = server->numberAfter("agents on port ");
  }
  std::unique_ptr<Program> play(const std::string& team, int unum, int atPort) {
    const std::string name = team + std::to_string(unum);
    return std::make_unique<Program>(
        std::vector<std::string>{"play", "--port", std::to_string(atPort), "--team", team, "--unum",
                                 std::to_string(unum), "--report", folder.file(name + ".json")},
        folder.file(name + ".txt"));
  }
  nlohmann::json report(const std::string& name) const {
    std::ifstream file(folder.file(name + ".json"));
    return nlohmann::json::parse(file, nullptr, false);
  }

  TestFolder folder{"nonet_serve_test"};
  std::unique_ptr<Program> server;
  int port = 0;
};

// One agent killed, one stopped for five seconds, one cut off, and a stranger that sends random bytes: the
// others play on, the server says what happened, the match ends with a result.
TEST_F(ServeCommand, TheOthersPlayOnWhenAgentsAreHarmed) {
  serve({"RuleHalfTime=4", "AutomaticKickOff=true", "WaitBeforeKickOff=2"});
  Proxy proxy(port);
  const auto healthy = play("Ours", 2, port);
  const auto other = play("Theirs", 2, port);
  const auto killed = play("Ours", 3, port);
  const auto stopped = play("Theirs", 3, port);
  const auto cutOff = play("Ours", 4, proxy.port());
  for (const auto* agent : {&healthy, &other, &killed, &stopped, &cutOff})
    ASSERT_TRUE((*agent)->says("connected to")) << (*agent)->output();

  ::kill(killed->pid(), SIGKILL);
  ::kill(stopped->pid(), SIGSTOP);
  proxy.cut();
  // Strangers with random bytes, in turns bare and as a well-formed frame, for as long as the other is
  // stopped.
  Random random(8);
  for (int stranger = 0; stranger < 10; ++stranger) {
    asio::io_context io;
    tcp::socket socket(io);
    socket.connect({asio::ip::address_v4::loopback(), static_cast<asio::ip::port_type>(port)});
    std::string bytes(1000, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random.below(256));
    std::string frame;
    protocol::appendFrame(frame, bytes);
    std::error_code refused;
    asio::write(socket, asio::buffer(stranger % 2 == 0 ? bytes : frame), refused);
    pause(0.5);
  }
  ::kill(stopped->pid(), SIGCONT);

  EXPECT_EQ(server->wait(), 0);
  const std::string said = server->output();
  const auto tells = [&said](const std::string& pattern) {
    return std::regex_search(said, std::regex(pattern));
  };
  EXPECT_TRUE(tells("player 3 of Ours .* is gone")) << said;
  EXPECT_TRUE(tells("player 4 of Ours .* is gone")) << said;
  EXPECT_TRUE(tells("player 3 of Theirs .* has sent nothing for 2 s")) << said;
  EXPECT_TRUE(tells("player 3 of Theirs .* sends again")) << said;
  EXPECT_TRUE(tells("agent 127.0.0.1:[0-9]+ is gone")) << "the stranger: " << said;
  EXPECT_NE(said.find("ended at 8.0"), std::string::npos) << said;

  EXPECT_EQ(cutOff->wait(), 3);
  for (const auto* agent : {&healthy, &other, &stopped}) EXPECT_EQ((*agent)->wait(), 3);
  for (const std::string name : {"Ours2", "Theirs2"}) {
    EXPECT_GT(report(name)["messages"], 500) << name;
    EXPECT_EQ(report(name)["unknown"], 0) << name;
  }
  // What was lost while it was stopped is counted; what came is still all it takes to go on.
  EXPECT_GT(report("Theirs3")["messages"], 200);
}

// Two cycles in a row would leave the agents no time to answer the first. The real server does not do so
// either (server facts 1.2).
TEST_F(ServeCommand, TimeThatTheServerLostIsNotCaughtUp) {
  serve({});
  sim::test::Client client(static_cast<std::uint16_t>(port));
  client.send("(scene rsg/agent/nao/nao.rsg)(syn)");
  ASSERT_TRUE(client.receive());
  int crowded = 0;
  for (int i = 0; i < 20; ++i) {
    pause(0.1 + 0.001 * i);
    ::kill(server->pid(), SIGSTOP);
    pause(0.06);
    while (client.receive(0.002)) {
    }
    ::kill(server->pid(), SIGCONT);
    ASSERT_TRUE(client.receive());
    const auto first = std::chrono::steady_clock::now();
    ASSERT_TRUE(client.receive());
    const std::chrono::duration<double> gap = std::chrono::steady_clock::now() - first;
    crowded += gap.count() < 0.012 ? 1 : 0;
  }
  // This process may itself have been woken late for the first of two.
  EXPECT_LE(crowded, 5);
}

TEST_F(ServeCommand, ARecordingThatFindsNoRoomIsTold) {
  Program recording(
      {"serve", "--realtime", "--port", "0", "--monitor-port", "0", "--record-monitor", "/dev/full"},
      folder.file("full.txt"));
  ASSERT_TRUE(recording.says("/dev/full: recording stops.*No space left")) << recording.output();
  ::kill(recording.pid(), SIGTERM);
  EXPECT_EQ(recording.wait(), 1);
  const std::string said = recording.output();
  EXPECT_EQ(said.find("recording stops"), said.rfind("recording stops")) << "said once";
}

/// A connection to the server from one of this machine's addresses.
class Caller {
 public:
  Caller(const char* from, const char* to, int port) {
    socket_.open(tcp::v4());
    socket_.bind({asio::ip::make_address(from), 0});
    socket_.connect({asio::ip::make_address(to), static_cast<asio::ip::port_type>(port)}, error_);
  }
  bool connected() const { return !error_; }
  /// Whether the server has closed it, as it does at once with one too many.
  bool closed() {
    pollfd descriptor{socket_.native_handle(), POLLIN, 0};
    if (::poll(&descriptor, 1, 1000) <= 0) return false;
    char byte = 0;
    std::error_code error;
    socket_.read_some(asio::buffer(&byte, 1), error);
    return static_cast<bool>(error);
  }

 private:
  asio::io_context io_;
  tcp::socket socket_{io_};
  std::error_code error_;
};

// The trainer's port obeys anybody, so nobody from outside gets there unasked.
TEST_F(ServeCommand, ListensForThisMachineOnlyAndSaysSo) {
  serve({});
  EXPECT_TRUE(server->says("monitors on port [0-9]+ of 127.0.0.1"));
  EXPECT_TRUE(Caller("127.0.0.1", "127.0.0.1", port).connected());
  EXPECT_FALSE(Caller("127.0.0.1", "127.0.0.2", port).connected()) << "another address of this machine";

  Program open({"serve", "--port", "0", "--monitor-port", "0", "--bind", "0.0.0.0"}, folder.file("open.txt"));
  ASSERT_TRUE(open.says("is obeyed as a trainer")) << open.output();
  const int openPort = open.numberAfter("agents on port ");
  EXPECT_TRUE(Caller("127.0.0.1", "127.0.0.2", openPort).connected());
}

TEST_F(ServeCommand, BoundsConnectionsPerAddressAndInAll) {
  Program bounded(
      {"serve", "--port", "0", "--monitor-port", "0", "--most-connections", "5", "--most-per-address", "3"},
      folder.file("bounded.txt"));
  ASSERT_TRUE(bounded.says("monitors on port")) << bounded.output();
  const int agents = bounded.numberAfter("agents on port ");
  const int monitors = bounded.numberAfter("monitors on port ");
  for (const int at : {agents, monitors}) {
    std::vector<std::unique_ptr<Caller>> callers;
    const auto call = [&](const char* from) -> Caller& {
      return *callers.emplace_back(std::make_unique<Caller>(from, "127.0.0.1", at));
    };
    for (int i = 0; i < 3; ++i) call("127.0.0.1");
    EXPECT_TRUE(call("127.0.0.1").closed()) << "the fourth of one address";
    EXPECT_TRUE(call("127.0.0.1").closed());
    for (int i = 0; i < 2; ++i) EXPECT_TRUE(call("127.0.0.2").connected());
    EXPECT_TRUE(call("127.0.0.3").closed()) << "the sixth in all";
  }
  const std::string said = bounded.output();
  const std::regex refusal("is refused, and more of them: 5 connections are the most, 3 from one address");
  EXPECT_GE(std::distance(std::sregex_iterator(said.begin(), said.end(), refusal), std::sregex_iterator()),
            2);
}

class Scripts : public ServeCommand {
 protected:
  Scripts() {
    ::setenv("NONET_BINARY", NONET_BINARY, 1);
    ::setenv("NONET_LOGS", folder.file("logs").c_str(), 1);
  }
  ~Scripts() override {
    ::unsetenv("NONET_BINARY");
    ::unsetenv("NONET_LOGS");
  }
  std::string run(const std::string& script, const std::vector<std::string>& arguments) {
    Program program(command(script), arguments, folder.file(script + ".txt"));
    EXPECT_EQ(program.wait(), 0) << program.output();
    return program.output();
  }
};

TEST_F(Scripts, StartTheAgentsThatTheLeagueAsksForAndStopExactlyThose) {
  serve({});
  const auto stranger = play("Others", 5, port);
  ASSERT_TRUE(stranger->says("connected to")) << stranger->output();
  run("start.sh", {"127.0.0.1", "-p", std::to_string(port), "-t", "Ours", "-n", "3", "-mh", "127.0.0.1"});
  for (const std::string unum : {"1", "2", "3"})
    EXPECT_TRUE(server->says("number " + unum + " of team Ours")) << server->output();
  setenv("NONET_TEAM", "Others", 1);  // a third team would be refused, and its player end after a second
  run("startChallengePlayer.sh", {"127.0.0.1", std::to_string(port), "-3.5", "2", "keepaway"});
  unsetenv("NONET_TEAM");
  EXPECT_TRUE(server->says("number 2 of team Others")) << server->output();
  EXPECT_TRUE(Program::fileSays(folder.file("logs/Others_challenge.log"), "challenge keepaway"));

  const std::string stopped = run("kill.sh", {});
  EXPECT_NE(stopped.find("stopped "), std::string::npos) << stopped;
  for (const std::string unum : {"1", "2", "3"})
    EXPECT_TRUE(server->says("player " + unum + " of Ours .* is gone")) << server->output();
  EXPECT_TRUE(stranger->running()) << "not started by the script, not stopped by it";
  EXPECT_NE(run("kill.sh", {}).find("nothing was started"), std::string::npos);
}

TEST_F(Scripts, EachAgentHasARecordAndATraceOfItsOwn) {
  serve({});
  const std::string records = folder.file("records"), traces = folder.file("a/b");
  run("start.sh", {"127.0.0.1", std::to_string(port), "-n", "2", "--record", records, "--trace", traces});
  EXPECT_TRUE(server->says("number 2 of team Nonet")) << server->output();
  pause(0.5);  // so that something is in them
  run("kill.sh", {});
  for (const std::string name : {"Nonet_1", "Nonet_2"}) {
    EXPECT_GT(fs::file_size(fs::path(traces) / (name + ".trace")), 0U);
    Program replay(NONET_BINARY, {"replay", (fs::path(records) / (name + ".zst")).string()},
                   folder.file("replay.txt"));
    EXPECT_EQ(replay.wait(), 0) << replay.output();
  }
}

TEST_F(Scripts, TheChallengePlayerBeamsToItsPlace) {
  serve({});
  run("startChallengePlayer.sh", {"127.0.0.1", std::to_string(port), "-3.5", "2", "keepaway"});
  EXPECT_TRUE(server->says("number 2 of team Nonet")) << server->output();
  EXPECT_TRUE(Program::fileSays(folder.file("logs/Nonet_challenge.log"), "challenge keepaway"));
  run("kill.sh", {});
}

TEST_F(Scripts, SayWhatTheyNeed) {
  Program wrongCount(command("start.sh"), {"127.0.0.1", "-n", "12"}, folder.file("count.txt"));
  EXPECT_EQ(wrongCount.wait(), 2);
  EXPECT_NE(wrongCount.output().find("1 to 11"), std::string::npos);
  Program missing(command("startChallengePlayer.sh"), {"127.0.0.1", "3100"}, folder.file("missing.txt"));
  EXPECT_EQ(missing.wait(), 2);
  EXPECT_NE(missing.output().find("HOST PORT X Y CHALLENGE"), std::string::npos);
}

// A source tree two levels below a folder with bin/nonet is no installation.
TEST_F(Scripts, ATreeRunsItsOwnBuildAndAnInstallationItsOwnProgram) {
  ::unsetenv("NONET_BINARY");
  const fs::path root = folder.file("above/share/nonet");
  const fs::path installed = root / "../../bin/nonet";
  const fs::path built = root / "build/release/nonet";
  fs::create_directories(root / "scripts");
  for (const fs::path& program : {installed, built}) {
    fs::create_directories(program.parent_path().lexically_normal());
    std::ofstream(program) << "#!/bin/sh\n";
    fs::permissions(program, fs::perms::owner_all);
  }
  fs::copy(command("common.sh"), root / "scripts");
  std::ofstream(root / "scripts/which.sh")
      << ". \"$(dirname \"$0\")/common.sh\"\nfindBinary\necho \"$binary\"\n";
  const auto found = [&] {
    Program which("/bin/bash", {(root / "scripts/which.sh").string()}, folder.file("which.txt"));
    EXPECT_EQ(which.wait(), 0);
    return which.output();
  };
  EXPECT_EQ(found(), installed.string() + "\n");
  std::ofstream(root / "CMakeLists.txt") << "";
  EXPECT_EQ(found(), built.string() + "\n");
}

// Wrong arguments are told before anything is started.
TEST_F(Scripts, RefuseWhatCannotWork) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
      {"start.sh", {"127.0.0.1", "99999"}},
      {"start.sh", {"127.0.0.1", "99999999999999999999"}},
      {"start.sh", {"127.0.0.1", "-t", "A/B"}},
      {"start.sh", {"127.0.0.1", "-t", "A B"}},
      {"start.sh", {"127.0.0.1", "-t", "A'B"}},
      {"start_penalty_kicker.sh", {"127.0.0.1", "x"}},
      {"startChallengePlayer.sh", {"127.0.0.1", "3100", "x", "y", "run"}},
      {"startChallengePlayer.sh", {"127.0.0.1", "3100", "1", "2m", "run"}},
      {"kill.sh", {"-t"}},
  };
  for (const auto& [script, arguments] : cases) {
    Program program(command(script), arguments, folder.file("refused.txt"));
    EXPECT_EQ(program.wait(), 2) << script << ": " << program.output();
    EXPECT_FALSE(program.output().empty());
    EXPECT_EQ(program.output().find("common.sh"), std::string::npos)
        << "the shell's own words: " << program.output();
  }
  EXPECT_FALSE(fs::exists(folder.file("logs/pids")));
}

TEST_F(Scripts, SayWhoDiedAtOnce) {
  // On a busy machine dying takes its time; the script waits no longer than it takes.
  setenv("NONET_WATCH", "60", 1);
  Program program(command("start.sh"), {"127.0.0.1", "-n", "2", "--", "--params", "/nosuch.toml"},
                  folder.file("died.txt"));
  EXPECT_EQ(program.wait(), 1) << program.output();
  EXPECT_NE(program.output().find("2 of 2 agents did not start"), std::string::npos) << program.output();
  EXPECT_NE(program.output().find("nosuch.toml"), std::string::npos) << "the reason";
  EXPECT_NE(run("kill.sh", {}).find("stopped 0 agents"), std::string::npos) << "the dead do not count";
  unsetenv("NONET_WATCH");
}

// awk reads when a process has started: here it waits until the agent is dead.
TEST_F(Scripts, SayWhoDiedBeforeTheyAsk) {
  const std::string path = std::getenv("PATH");
  const fs::path awk = folder.file("bin/awk");
  fs::create_directories(awk.parent_path());
  std::ofstream(awk) << "#!/bin/sh\nfor last; do :; done\nwhile [ -e \"$last\" ]; do sleep 0.05; done\n"
                     << "PATH='" << path << "' exec awk \"$@\"\n";
  fs::permissions(awk, fs::perms::owner_all);
  setenv("PATH", (awk.parent_path().string() + ":" + path).c_str(), 1);
  setenv("NONET_WATCH", "60", 1);
  setenv("NONET_BINARY", "/bin/false", 1);
  Program dies(command("start.sh"), {"127.0.0.1", "-n", "1"}, folder.file("dead.txt"));
  EXPECT_EQ(dies.wait(), 1) << dies.output();
  EXPECT_NE(dies.output().find("1 of 1 agents did not start"), std::string::npos) << dies.output();
  std::ifstream pids(folder.file("logs/pids"));
  long pid = 0;
  long began = -1;
  pids >> pid >> began;
  EXPECT_EQ(began, 0) << "asked while it lived: this test shows nothing";
  unsetenv("NONET_WATCH");
  setenv("PATH", path.c_str(), 1);
}

TEST_F(Scripts, StopOneTeam) {
  serve({});
  for (const std::string team : {"Ours", "Theirs"})
    run("start.sh", {"127.0.0.1", std::to_string(port), "-t", team, "-n", "1"});
  EXPECT_NE(run("kill.sh", {"-t", "Theirs"}).find("stopped 1 agents of team Theirs"), std::string::npos);
  EXPECT_TRUE(server->says("player 1 of Theirs .* is gone"));
  EXPECT_EQ(server->output().find("player 1 of Ours"), std::string::npos) << server->output();
  EXPECT_NE(run("kill.sh", {}).find("stopped 1 agents"), std::string::npos);
}

TEST_F(Scripts, StartThePenaltyPlayers) {
  serve({});
  run("start_penalty_kicker.sh", {"127.0.0.1", std::to_string(port), "-t", "Ours"});
  run("start_penalty_goalie.sh", {"127.0.0.1", "-p", std::to_string(port), "-t", "Theirs"});
  EXPECT_TRUE(server->says("number 9 of team Ours")) << server->output();
  EXPECT_TRUE(server->says("number 1 of team Theirs")) << server->output();
  EXPECT_NE(run("kill.sh", {}).find("stopped 2 agents"), std::string::npos);
}

}  // namespace
}  // namespace nonet::app
