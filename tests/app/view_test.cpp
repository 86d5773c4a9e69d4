// The viewer: the stream against the simulation's truth, the page in a browser.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>
#include <regex>
#include <stdexcept>
#include <string>
#include <thread>

#include <asio.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "nonet/app/view/http_server.h"
#include "nonet/app/view/trace_folder.h"
#include "nonet/app/view/track.h"
#include "nonet/app/view/web_files.h"
#include "nonet/math/random.h"
#include "nonet/model/kinematics.h"
#include "nonet/protocol/log_file.h"
#include "nonet/sim/server/monitor.h"
#include "nonet/sim/simulation.h"

#include "app/browser.h"
#include "app/program.h"

namespace nonet::app {
namespace {

using protocol::TeamSide;

protocol::MonitorMatrix toMonitor(const Pose3& pose) {
  protocol::MonitorMatrix matrix{};
  for (int row = 0; row < 3; ++row) {
    matrix[row] = static_cast<float>(-pose.linear()(row, 1));
    matrix[4 + row] = static_cast<float>(pose.linear()(row, 0));
    matrix[8 + row] = static_cast<float>(pose.linear()(row, 2));
    matrix[12 + row] = static_cast<float>(pose.translation()[row]);
  }
  return matrix;
}

TEST(Track, JointAnglesAreTheInverseOfForwardKinematics) {
  for (int type = 0; type < model::kRobotTypeCount; ++type) {
    const model::RobotModel& shape = model::robotModel(type);
    Random random(static_cast<std::uint64_t>(type) + 1);
    model::JointArray angles{};
    for (const model::JointSpec& joint : shape.joints()) {
      angles[model::index(joint.id)] = random.uniform(joint.low, joint.high);
    }
    model::BodyPoses poses;
    model::forwardKinematics(shape, angles, poses);
    Pose3 torso = Pose3::Identity();
    torso.linear() = Eigen::AngleAxisd(1.3, Vector3(1, 2, 3).normalized()).toRotationMatrix();
    torso.translation() = Vector3(3, -4, 0.4);
    protocol::MonitorRobot robot;
    robot.robotType = type;
    for (const model::BodySpec& body : shape.bodies()) {
      robot.bodies.push_back(toMonitor(torso * poses[model::index(body.id)]));
    }
    const model::JointArray found = jointAngles(robot);
    for (std::size_t i = 0; i < angles.size(); ++i)
      EXPECT_NEAR(found[i], angles[i], 1e-4) << type << " " << i;
  }
}

// A short game: one robot a side, the left one is laid down, a foul-free goal and a ball that rolls.
class RecordedGame {
 public:
  explicit RecordedGame(const std::string& path) : simulation_(settings(), 3) {
    enter("Reds", 5, 0);
    enter("Blues", 7, 4);
    sim::MonitorLog log(simulation_, path);
    const auto run = [&](int cycles) {
      for (int i = 0; i < cycles; ++i) {
        simulation_.step();
        log.cycle();
      }
    };
    simulation_.trainer("(playMode PlayOn)(ball (pos 2 0 0.05)(vel 0 0 0))");
    run(100);
    simulation_.trainer("(agent (team Left)(unum 5)(move 1.8 0.3 0.4 -90))(ball (vel 6 0.2 0))");
    run(100);
    simulation_.trainer("(ball (pos 14.8 0 0.05)(vel 4 0 0))");
    run(200);
    torso_ = simulation_.world().bodyPose(simulation_.agents()[0].robot, model::BodyId::Torso).position;
    ball_ = simulation_.world().ballPose().position;
  }

  Eigen::Vector3f torso() const { return torso_; }
  Eigen::Vector3f ball() const { return ball_; }

 private:
  static sim::Settings settings() {
    sim::Settings settings;
    settings.removeNoise();
    return settings;
  }
  void enter(const char* team, int unum, int type) {
    protocol::SceneEffector scene;
    scene.robotType = type;
    protocol::InitEffector init;
    init.unum = unum;
    init.team.assign(team);
    simulation_.enter(scene, init);
    simulation_.step();
  }

  sim::Simulation simulation_;
  Eigen::Vector3f torso_;
  Eigen::Vector3f ball_;
};

int count(const Track& track, TrackEvent::Kind kind) {
  return static_cast<int>(std::count_if(track.events().begin(), track.events().end(),
                                        [&](const TrackEvent& event) { return event.kind == kind; }));
}

TEST(Track, ALogCompressedOrPlainTellsWhatTheSimulationKnows) {
  const TestFolder folder("nonet_view_track");
  const RecordedGame game(folder.file("game.mon"));
  const RecordedGame same(folder.file("game.log"));
  const Track track = readMonitorLog(folder.file("game.mon"));
  const Track plain = readMonitorLog(folder.file("game.log"));
  EXPECT_LT(4 * fs::file_size(folder.file("game.mon")), fs::file_size(folder.file("game.log")));
  ASSERT_EQ(track.frames(), 40U);
  EXPECT_TRUE(std::ranges::equal(track.rows(0), plain.rows(0)));
  EXPECT_DOUBLE_EQ(track.step(), 0.2);
  const auto row = track.rows(39);
  const auto torso = row.subspan(Track::kGameFloats + 4 * Track::kRobotFloats, Track::kRobotFloats);
  EXPECT_EQ(torso[0], 1.0F) << "type 0, left 5";
  // The last message lies nine cycles before the end, and differences below 5 mm are not sent.
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(torso[1 + i], game.torso()[i], 0.02) << i;
  EXPECT_EQ(row[Track::kGameFloats + (11 + 6) * Track::kRobotFloats], 5.0F) << "type 4, right 7";
  EXPECT_EQ(count(track, TrackEvent::Kind::Goal), 1);
  EXPECT_EQ(count(track, TrackEvent::Kind::Kick), 1);
  for (const TrackEvent& event : track.events()) {
    if (event.kind == TrackEvent::Kind::Kick) {
      EXPECT_EQ(event.unum, 5);
      EXPECT_EQ(event.side, TeamSide::Left);
    }
    if (event.kind == TrackEvent::Kind::Goal) {
      EXPECT_EQ(event.side, TeamSide::Left);
    }
  }
  EXPECT_THROW(readMonitorLog(NONET_BINARY), protocol::LogError);
}

TEST(Track, TeamsThatChangeSidesAreNamedByRow) {
  protocol::MonitorReader reader;
  Track track(0.2);
  const auto add = [&](const std::string& state, const char* scene) {
    ASSERT_TRUE(reader.feed("(" + state + ")" + scene));
    track.add(reader);
  };
  const char* ball =
      "(RSG 0 1)((nd TRF (SLT 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0.04 1)(nd StaticMesh (setVisible 1)"
      "(load models/soccerball.obj)(sSc 1 1 1)(resetMaterials soccerball_rcs-soccerball.png))))";
  add("(time 0)(half 1)(play_mode 0)", ball);
  add("(time 0.2)(team_left Reds)", "(RDS 0 1)((nd (nd)))");
  add("(time 0.4)(team_right Blues)", "(RDS 0 1)((nd (nd)))");
  add("(time 0.6)(half 2)(team_left Blues)(team_right Reds)", "(RDS 0 1)((nd (nd)))");
  add("(time 0.8)", "(RDS 0 1)((nd (nd)))");
  ASSERT_EQ(track.names().size(), 2U) << "a name that becomes known is no change";
  EXPECT_EQ(track.names()[0].frame, 0U);
  EXPECT_EQ(track.names()[0].left, "Reds");
  EXPECT_EQ(track.names()[0].right, "Blues");
  EXPECT_EQ(track.names()[1].frame, 3U);
  EXPECT_EQ(track.names()[1].left, "Blues");
  const std::string message = track.message(0, 0, "log", "");
  EXPECT_NE(message.find(R"("teams":[[0,"Reds","Blues"],[3,"Blues","Reds"]])"), std::string::npos);
}

TEST(HttpRequest, OnlyBrowsersOfThisMachineGetAnAnswer) {
  HttpRequest request;
  HttpResponse refusal;
  EXPECT_TRUE(parseHttpRequest("GET /track?from=12&events=3 HTTP/1.1\r\nHost: localhost:8017\r\n\r\n",
                               request, refusal));
  EXPECT_EQ(request.path, "/track");
  EXPECT_EQ(request.number("from"), 12U);
  EXPECT_EQ(request.number("events"), 3U);
  EXPECT_EQ(request.number("nothing"), 0U);
  EXPECT_TRUE(parseHttpRequest("GET / HTTP/1.1\r\nhost: [::1]:80\r\n\r\n", request, refusal));
  EXPECT_FALSE(parseHttpRequest("GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n", request, refusal));
  EXPECT_EQ(refusal.status, 403);
  EXPECT_FALSE(parseHttpRequest("GET / HTTP/1.1\r\n\r\n", request, refusal));
  EXPECT_FALSE(parseHttpRequest("POST / HTTP/1.1\r\nHost: localhost\r\n\r\n", request, refusal));
  EXPECT_EQ(refusal.status, 405);
}

// The head of a page on this port, and more of it perhaps.
std::string headOfPage(int port, const std::string& path) {
  asio::io_context io;
  asio::ip::tcp::socket socket(io);
  socket.connect({asio::ip::address_v4::loopback(), static_cast<std::uint16_t>(port)});
  asio::write(socket, asio::buffer("GET " + path + " HTTP/1.1\r\nHost: localhost\r\n\r\n"));
  std::string head;
  asio::read_until(socket, asio::dynamic_buffer(head), "\r\n\r\n");
  return head;
}

TEST(HttpServer, TroubleWithAPageIsToldAndTheNextIsServed) {
  asio::io_context io;
  const HttpServer server(io, 0, [](const HttpRequest& request) -> HttpResponse {
    if (request.path == "/torn") throw std::runtime_error("it is torn");
    return {200, "text/plain", "whole\n"};
  });
  const std::jthread thread([&io] { io.run(); });
  EXPECT_THAT(headOfPage(server.port(), "/torn"),
              ::testing::StartsWith("HTTP/1.1 500 Internal Server Error"));
  EXPECT_THAT(headOfPage(server.port(), "/"), ::testing::StartsWith("HTTP/1.1 200 OK"));
  io.stop();
}

TEST(TraceFolder, LinesOfOthersAreLeftOutAndAFileThatIsGoneIsNamed) {
  const TestFolder folder("nonet_view_traces");
  const std::string ours = R"({"time":1.5,"game_time":0.5,"unum":3,"team":"A"})";
  std::ofstream(folder.file("ours.trace")) << ours << "\n"
                                           << R"({"time":"2","game_time":1,"unum":3,"team":"A"})"
                                           << "\n"
                                           << R"({"game_time":1,"unum":3,"team":"A"})"
                                           << "\n"
                                           << R"({"time":2,"game_time":1,"unum":"3","team":0})"
                                           << "\n";
  std::ofstream(folder.file("others.trace")) << R"({"time":1,"game_time":1,"unum":"4","team":"A"})"
                                             << "\n";
  const TraceFolder traces(folder.file(""));
  EXPECT_EQ(traces.size(), 1U);
  EXPECT_EQ(traces.cycles("A", 3), "[" + ours + "]");
  EXPECT_EQ(traces.cycles("A", 4), "[]");
  EXPECT_EQ(traces.cycles("B", 3), "[]");
  std::string problem = "?";
  traces.cycles("A", 3, &problem);
  EXPECT_EQ(problem, "");
  std::ofstream(folder.file("ours.trace"), std::ios::app) << R"({"time":2,"game_t)";
  EXPECT_EQ(traces.cycles("A", 3, &problem), "[" + ours + "]") << "as far as it goes";
  EXPECT_THAT(problem, ::testing::HasSubstr("ours.trace"));
  fs::remove(folder.file("ours.trace"));
  EXPECT_THROW(traces.cycles("A", 3), protocol::LogError);
}

// A player's trace is his on both sides, and goes on when a server is started anew.
TEST(TraceFolder, ATraceIsAPlayersWhateverSideAndServer) {
  const TestFolder folder("nonet_view_sides");
  std::string all;
  for (const char* line : {R"({"time":700,"game_time":300,"unum":3,"team":"A","left":true})",
                           R"({"time":700.2,"game_time":300.2,"unum":3,"team":"A","left":false})",
                           R"({"time":1,"game_time":0,"unum":3,"team":"A","left":true})",
                           R"({"time":1.2,"game_time":0.2,"unum":3,"team":"A","left":true})"}) {
    std::ofstream(folder.file("a.trace"), std::ios::app) << line << "\n";
    all += (all.empty() ? "" : ",") + std::string(line);
  }
  std::ofstream(folder.file("b.trace")) << R"({"time":1,"game_time":0,"unum":3,"team":"B","left":false})"
                                        << "\n";
  const TraceFolder traces(folder.file(""));
  EXPECT_EQ(traces.size(), 2U);
  EXPECT_EQ(traces.cycles("A", 3), "[" + all + "]");
  EXPECT_THAT(traces.cycles("B", 3), ::testing::HasSubstr("\"B\""));
}

TEST(HttpRequest, TextIsDecoded) {
  HttpRequest request;
  HttpResponse refusal;
  ASSERT_TRUE(parseHttpRequest("GET /trace?team=A%26%3D%25b%zz%4&unum=7 HTTP/1.1\r\nHost: localhost\r\n\r\n",
                               request, refusal));
  EXPECT_EQ(request.text("team"), "A&=%b%zz%4");
  EXPECT_EQ(request.number("unum"), 7U);
  EXPECT_EQ(request.text("none"), "");
}

// `nonet view` in the background, on a port of its own.
class RunningView {
 public:
  RunningView(const TestFolder& folder, const std::string& source)
      : program_({"view", source, "--port", "0"}, folder.file("view.txt")) {
    if (!program_.says("localhost:[0-9]+/")) return;
    std::smatch match;
    const std::string output = program_.output();
    std::regex_search(output, match, std::regex("localhost:([0-9]+)/"));
    port_ = std::stoi(match[1]);
  }
  int port() const { return port_; }
  bool says(const std::string& pattern) const { return program_.says(pattern); }
  std::string address(const std::string& rest) const {
    return "http://localhost:" + std::to_string(port_) + rest;
  }
  std::string get(const std::string& path) const { return headOfPage(port_, path); }

 private:
  Program program_;
  int port_ = 0;
};

TEST(ViewCommand, ServesItsFilesAndNothingElse) {
  const TestFolder folder("nonet_view_serve");
  const RecordedGame game(folder.file("game.mon"));
  const RunningView view(folder, folder.file("game.mon"));
  ASSERT_GT(view.port(), 0);
  for (const WebFile& file : webFiles()) {
    EXPECT_THAT(view.get(std::string(file.path)), ::testing::HasSubstr("200 OK"));
  }
  EXPECT_THAT(view.get("/"), ::testing::HasSubstr("text/html"));
  EXPECT_THAT(view.get("/three/build/three.module.js"), ::testing::HasSubstr("200 OK"));
  EXPECT_THAT(view.get("/three/../../../../etc/hosts.js"), ::testing::HasSubstr("404"));
  EXPECT_THAT(view.get("/nothing"), ::testing::HasSubstr("404"));

  Program second({"view", folder.file("game.mon"), "--port", std::to_string(view.port())},
                 folder.file("2.txt"));
  EXPECT_EQ(second.wait(), 1);
  EXPECT_THAT(second.output(), ::testing::HasSubstr("choose another with --port"));
  Program missing({"view", folder.file("no.mon")}, folder.file("3.txt"));
  EXPECT_EQ(missing.wait(), 1);
  EXPECT_THAT(missing.output(), ::testing::HasSubstr("neither a file nor HOST:PORT"));
}

// A torn log is shown and counted as far as it goes, and so is a damaged one; both are told.
TEST(ViewCommand, ALogThatEndsEarlyIsToldAsByStatistics) {
  const TestFolder folder("nonet_view_torn");
  const std::string log = folder.file("game.mon");
  const RecordedGame game(log);
  const auto statistics = [&] {
    Program program({"statistics", log}, folder.file("statistics.txt"));
    const int code = program.wait();
    return std::pair(code, program.output());
  };
  EXPECT_EQ(statistics().first, 0);
  EXPECT_THAT(statistics().second, ::testing::Not(::testing::HasSubstr("nonet statistics:")));

  const auto size = fs::file_size(log);
  std::fstream(log, std::ios::binary | std::ios::in | std::ios::out).seekp(-4, std::ios::end) << "sums";
  EXPECT_EQ(statistics().first, 3);
  EXPECT_THAT(statistics().second,
              ::testing::HasSubstr("nonet statistics: " + log + ": the compressed data are damaged"));
  fs::resize_file(log, size - 8);
  EXPECT_EQ(statistics().first, 0);
  EXPECT_THAT(statistics().second, ::testing::HasSubstr(log + ": the file was not closed"));
  EXPECT_THAT(statistics().second, ::testing::HasSubstr("Reds"));
  const RunningView view(folder, log);
  ASSERT_GT(view.port(), 0);
  EXPECT_TRUE(view.says("nonet view: .*the file was not closed.*whole lines were read"));
}

bool isGrass(int r, int g, int b) {
  return g > 60 && g > r + 20 && g > b + 20;
}

TEST(ViewPage, LoadsSeeksAndShowsFieldRobotsAndBall) {
  const auto browser = Browser::find();
  if (!browser) GTEST_SKIP() << "no Chromium here: apt-get install chromium";
  const TestFolder folder("nonet_view_page");
  const RecordedGame game(folder.file("game.mon"));
  const RunningView view(folder, folder.file("game.mon"));
  ASSERT_GT(view.port(), 0);

  const auto begin = browser->visit(view.address("/?paused=1&t=0.5"), folder.file("profile"));
  EXPECT_THAT(begin.page, ::testing::HasSubstr("data-state=\"ready\"")) << begin.log;
  EXPECT_THAT(begin.page, ::testing::Not(::testing::HasSubstr("data-errors")));
  EXPECT_THAT(begin.page, ::testing::HasSubstr("Reds"));
  EXPECT_THAT(begin.page, ::testing::HasSubstr("data-score=\"0:0\""));
  EXPECT_THAT(begin.log, ::testing::Not(::testing::ContainsRegex("CONSOLE.*(rror|arning)")));
  const auto end = browser->visit(view.address("/?paused=1&t=7.8&follow=left5"), folder.file("profile"));
  EXPECT_THAT(end.page, ::testing::HasSubstr("data-score=\"1:0\""))
      << "the page has gone to the place asked for";
  EXPECT_THAT(end.page, ::testing::HasSubstr("type 0"));

  const Picture first = browser->screenshot(view.address("/?paused=1&camera=above&t=2"),
                                            folder.file("profile"), folder.file("1.png"));
  ASSERT_EQ(first.width(), 1200U);
  EXPECT_GT(first.share(isGrass), 0.4);
  // White lines and goals; the colours of the two teams on robots, numbers and the board.
  EXPECT_GT(first.share([](int r, int g, int b) { return r > 200 && g > 200 && b > 200; }), 0.004);
  EXPECT_GT(first.share([](int r, int g, int b) { return b > r + 90 && b > 180 && g > 80; }), 0.0001);
  EXPECT_GT(first.share([](int r, int g, int b) { return r > b + 90 && r > 180 && g < 170; }), 0.0001);
  // Pictures of the same moment differ in a few pixels of edges and numbers; what the page says does not.
  const auto ballSeenBy5 = [&](const std::string& time) {
    const std::string page =
        browser->visit(view.address("/?paused=1&follow=left5&t=" + time), folder.file("profile")).page;
    const std::size_t at = page.find("to the ball");
    return at == std::string::npos ? "not there" : page.substr(at, 60);
  };
  const std::string two = ballSeenBy5("2");
  EXPECT_EQ(two, ballSeenBy5("2")) << "the same moment looks the same";
  EXPECT_NE(two, ballSeenBy5("3")) << "the ball has rolled";
}

double gameTimeIn(const std::string& page) {
  const std::string before = "data-time=\"";
  const std::size_t at = page.find(before);
  return at == std::string::npos ? -1.0 : std::stod(page.substr(at + before.size()));
}

// A match that is being played: the page shows who is there now; when the server ends it keeps what was
// played and says what it waits for. Paused at the newest moment, because software draws sixty pictures a
// second slowly.
TEST(ViewPage, FollowsAServerThatRuns) {
  const auto browser = Browser::find();
  if (!browser) GTEST_SKIP() << "no Chromium here: apt-get install chromium";
  const TestFolder folder("nonet_view_live");
  const Program server({"serve", "--realtime", "--port", "0", "--monitor-port", "0", "--set",
                        "AutomaticKickOff=true", "--set", "WaitBeforeKickOff=0.5"},
                       folder.file("server.txt"));
  ASSERT_TRUE(server.says("monitors on port [0-9]+")) << server.output();
  const RunningView view(folder, "localhost:" + std::to_string(server.numberAfter("monitors on port ")));
  ASSERT_TRUE(view.says("live from localhost"));
  const Program agent({"play", "--port", std::to_string(server.numberAfter("agents on port ")), "--team",
                       "Reds", "--unum", "5", "--type", "3"},
                      folder.file("agent.txt"));
  ASSERT_TRUE(server.says("Reds")) << server.output();

  const std::string kNow = "/?paused=1&t=9999";
  const auto live = browser->visit(view.address(kNow), folder.file("profile"), 1.5);
  EXPECT_THAT(live.page, ::testing::HasSubstr("data-state=\"ready\"")) << live.log;
  EXPECT_THAT(live.page, ::testing::Not(::testing::HasSubstr("data-errors")));
  EXPECT_THAT(live.page, ::testing::HasSubstr("Reds"));
  EXPECT_GT(gameTimeIn(live.page), 0.0) << "kicked off";

  ::kill(server.pid(), SIGTERM);
  ASSERT_TRUE(view.says("live from.*\n.*waiting for a server"));
  const auto ended = browser->visit(view.address(kNow), folder.file("profile"), 1.5);
  EXPECT_THAT(ended.page, ::testing::HasSubstr("waiting for a server at localhost"));
  EXPECT_THAT(ended.page, ::testing::HasSubstr("Reds")) << "what was played is still there";
  EXPECT_GT(gameTimeIn(ended.page), gameTimeIn(live.page));
}

}  // namespace
}  // namespace nonet::app
