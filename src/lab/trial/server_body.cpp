#include "lab/trial/server_body.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include <asio.hpp>
#include <fmt/format.h>
#include <poll.h>

#include "nonet/lab/trial/true_pose.h"
#include "nonet/math/angle.h"
#include "nonet/protocol/framing.h"
#include "nonet/protocol/monitor_reader.h"
#include "nonet/protocol/percept_text.h"
#include "nonet/sim/referee/player.h"

namespace nonet::lab {

namespace {

using asio::ip::tcp;

constexpr int kUnum = 2;
constexpr int kLongestSilence = 10;      // s without a message of the server
constexpr int kCyclesToFirstView = 500;  // of the agent, without a message of the monitor port

class Connection {
 public:
  Connection(asio::io_context& io, const std::string& host, int port)
      : name_(fmt::format("{}:{}", host, port)), socket_(io) {
    std::error_code error;
    tcp::resolver resolver(io);
    const auto endpoints = resolver.resolve(host, std::to_string(port), error);
    if (!error) asio::connect(socket_, endpoints, error);
    if (error)
      throw std::runtime_error(fmt::format("{}: {} (is a server running there?)", name_, error.message()));
    socket_.set_option(tcp::no_delay(true));
  }

  const std::string& name() const { return name_; }

  void send(std::string_view message) {
    std::string stream;
    protocol::appendFrame(stream, message);
    std::error_code error;
    asio::write(socket_, asio::buffer(stream), error);
    if (error) throw std::runtime_error(fmt::format("{}: {}", name_, error.message()));
  }

  /// The next message; waits for it if `wait`.
  std::optional<std::string_view> receive(bool wait) {
    for (;;) {
      if (const auto message = frames_.next()) return message;
      if (frames_.failed()) throw std::runtime_error(fmt::format("{}: {}", name_, frames_.error()));
      std::error_code error;
      if (!wait && socket_.available(error) == 0) return std::nullopt;
      awaitBytes();
      const std::span<char> room = frames_.prepare(65536);
      const std::size_t size = socket_.read_some(asio::buffer(room.data(), room.size()), error);
      if (error) throw std::runtime_error(fmt::format("{}: {}", name_, error.message()));
      frames_.received(size);
    }
  }

 private:
  void awaitBytes() {
    pollfd waiting{socket_.native_handle(), POLLIN, 0};
    const auto wait = [&waiting] { return ::poll(&waiting, 1, 1000 * kLongestSilence); };
    int ready = wait();
    while (ready < 0 && errno == EINTR) ready = wait();
    if (ready == 0)
      throw std::runtime_error(fmt::format(
          "{}: no message in {} s: is it an empty server for agents? Check --port", name_, kLongestSilence));
  }

  std::string name_;
  tcp::socket socket_;
  protocol::FrameReader frames_;
};

// What the monitor stream says about the only robot and the ball.
class Truth {
 public:
  void take(std::string_view message) {
    if (!stream_.feed(message)) return;
    known_ = true;
    for (const protocol::MonitorRobot& robot : stream_.robots()) {
      if (robot.unum == kUnum && !robot.bodies.empty())
        torso_ = protocol::poseFromMonitor(robot.bodies.front());
    }
    takeBall();
    for (const protocol::MonitorFoul& foul : stream_.newFouls())
      selfCollisions_ += foul.type == static_cast<int>(sim::FoulType::SelfCollision) ? 1 : 0;
  }

  bool known() const { return known_; }
  const Pose3& torso() const { return torso_; }
  const world::BallMotion& ball() const { return ball_; }
  int selfCollisions() const { return selfCollisions_; }
  bool playsOn() const { return stream_.game().playMode == protocol::PlayMode::PlayOn; }

 private:
  void takeBall() {
    const protocol::MonitorMatrix& m = stream_.ball();
    const Vector3 place(m[12], m[13], m[14]);
    // The game's clock is told to a hundredth of a second, and can be put back.
    const double cycles = std::round((stream_.game().time - time_) / kCycleTime);
    if (cycles == 0.0) return;
    ball_.v_FB = cycles < 0.0 ? Vector3::Zero() : Vector3((place - ball_.p_FB) / (cycles * kCycleTime));
    ball_.p_FB = place;
    time_ = stream_.game().time;
  }

  protocol::MonitorReader stream_;
  bool known_ = false;
  Pose3 torso_ = Pose3::Identity();
  world::BallMotion ball_{};
  double time_ = 0.0;  // s, game time of the last picture
  int selfCollisions_ = 0;
};

}  // namespace

struct ServerBody::Implementation {
  Implementation(const agent::RobotSettings& settings, const ServerAddress& address)
      : robot(settings),
        agent(io, address.host, address.port),
        monitor(io, address.host, address.monitorPort) {
    protocol::Effectors hello;
    hello.scene.emplace();
    hello.scene->robotType = settings.robotType;
    answer(hello);
    listen();
    protocol::Effectors init;
    init.init.emplace();
    init.init->unum = kUnum;
    init.init->team.assign(settings.team);
    answer(init);
    constexpr int kPatience = 50;  // messages without team and number after which we were refused
    for (int i = 0; i < kPatience && !percept.game.unum; ++i) {
      listen();
      if (!percept.game.unum) answer({});
    }
    if (!percept.game.unum)
      throw std::runtime_error(
          fmt::format("{}:{}: the server refused the robot: is it empty?", address.host, address.port));
  }

  void answer(const protocol::Effectors& effectors) {
    protocol::Effectors own = effectors;
    own.syn = true;
    text.clear();
    protocol::writeEffectors(own, text);
    agent.send(text);
  }

  // Absorbs all messages that are there, at least one.
  void listen() {
    bool wait = true;
    while (const auto message = agent.receive(wait)) {
      wait = false;
      protocol::parsePercept(*message, percept);
      robot.sense(percept);
    }
  }

  void look() {
    monitor.send("(reqfullstate)");
    while (const auto scene = monitor.receive(false)) truth.take(*scene);
    if (!truth.known() && ++cyclesBlind > kCyclesToFirstView)
      throw std::runtime_error(
          fmt::format("{}: no message of the monitor port: check --monitor-port", monitor.name()));
  }

  agent::Robot robot;
  asio::io_context io;
  Connection agent;
  Connection monitor;
  int cyclesBlind = 0;
  protocol::Percept percept;
  protocol::Effectors effectors;
  std::string text;
  Truth truth;
};

ServerBody::ServerBody(const agent::RobotSettings& settings, const ServerAddress& address)
    : implementation_(std::make_unique<Implementation>(settings, address)) {}
ServerBody::~ServerBody() = default;

void ServerBody::step(const team::Action& action) {
  Implementation& body = *implementation_;
  body.effectors.clear();
  body.robot.act(action, body.effectors);
  body.answer(body.effectors);
  body.listen();
  body.look();
}

void ServerBody::train(std::string_view command) {
  implementation_->monitor.send(command);
}

void ServerBody::move(const Pose2& X_FR) {
  const double height = robot().model().standingHeight() + 0.02;
  train(fmt::format("(agent (team Left)(unum {})(move {:.4f} {:.4f} {:.4f} {:.3f}))", kUnum,
                    X_FR.translation.x(), X_FR.translation.y(), height, toDegrees(X_FR.rotation) - 90.0));
}

const agent::Robot& ServerBody::robot() const {
  return implementation_->robot;
}
Pose2 ServerBody::pose() const {
  const Pose3& torso = implementation_->truth.torso();
  const Vector3 forward = torso.linear().col(0);
  return {torso.translation().x(), torso.translation().y(), std::atan2(forward.y(), forward.x())};
}
bool ServerBody::down() const {
  return isDown(implementation_->truth.torso().translation().z(), robot().model());
}
const world::BallMotion& ServerBody::ball() const {
  return implementation_->truth.ball();
}
bool ServerBody::playsOn() const {
  return implementation_->truth.playsOn();
}
int ServerBody::selfCollisions() const {
  return implementation_->truth.selfCollisions();
}

}  // namespace nonet::lab
