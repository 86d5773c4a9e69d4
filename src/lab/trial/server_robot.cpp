// A trial robot over TCP: agent port for senses and commands, monitor port for placing and the true pose
// (server facts 1.3, 5.1-5.5).
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>

#include <asio.hpp>
#include <fmt/format.h>

#include "nonet/lab/trial/measured_robot.h"
#include "nonet/protocol/framing.h"
#include "nonet/protocol/percept_text.h"

namespace nonet::lab {

namespace {

using asio::ip::tcp;

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

  void send(const std::string& message) {
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
      const std::span<char> room = frames_.prepare(65536);
      const std::size_t size = socket_.read_some(asio::buffer(room.data(), room.size()), error);
      if (error) throw std::runtime_error(fmt::format("{}: {}", name_, error.message()));
      frames_.received(size);
    }
  }

 private:
  std::string name_;
  tcp::socket socket_;
  protocol::FrameReader frames_;
};

struct TruePose {
  Pose2 onGround;
  double height = 0.0;
};

// The torso of the only robot in a full scene: its transform stands two before the mesh `naobody`
// (facts 5.2).
std::optional<TruePose> findTorso(std::string_view scene) {
  const std::size_t mesh = scene.find("models/naobody");
  if (mesh == std::string_view::npos) return std::nullopt;
  const std::size_t inner = scene.rfind("(SLT ", mesh);
  if (inner == std::string_view::npos || inner == 0) return std::nullopt;
  const std::size_t outer = scene.rfind("(SLT ", inner - 1);
  if (outer == std::string_view::npos) return std::nullopt;
  std::array<double, 16> m{};
  const char* at = scene.data() + outer + 5;
  const char* end = scene.data() + scene.size();
  for (double& value : m) {
    while (at != end && *at == ' ') ++at;
    const auto [rest, error] = std::from_chars(at, end, value);
    if (error != std::errc()) return std::nullopt;
    at = rest;
  }
  // Column major; the second column is the torso's y axis, forward.
  return TruePose{Pose2(m[12], m[13], std::atan2(m[5], m[4])), m[14]};
}

class ServerRobot final : public MeasuredRobot {
 public:
  ServerRobot(const TrialSettings& setup, const ServerAddress& address)
      : robot_(setup),
        agent_(io_, address.host, address.port),
        monitor_(io_, address.host, address.monitorPort) {
    protocol::Effectors hello;
    hello.scene.emplace();
    hello.scene->robotType = setup.robotType;
    answer(hello);
    listen();
    protocol::Effectors init;
    init.init.emplace();
    init.init->unum = 2;
    init.init->team.assign(setup.team);
    answer(init);
    constexpr int kPatience = 50;  // messages without team and number after which we were refused
    for (int i = 0; i < kPatience && !percept_.game.unum; ++i) {
      listen();
      if (!percept_.game.unum) answer({});
    }
    if (!percept_.game.unum) throw std::runtime_error("the server refused the robot: is it empty?");
    monitor_.send("(playMode PlayOn)");
    monitor_.send("(ball (pos 0 -9.5 0.042)(vel 0 0 0))");
    step({});
  }

  void settle(const Pose2& X_FR) override {
    constexpr double kWait = 1.5;  // s
    run({}, kWait);
    for (int i = 0; i < 600 && belief().body.posture != world::Posture::Upright; ++i) step({});
    const double height = robot_.model().standingHeight() + 0.02;
    monitor_.send(fmt::format("(agent (team Left)(unum 2)(move {:.4f} {:.4f} {:.4f} {:.3f}))",
                              X_FR.translation.x(), X_FR.translation.y(), height,
                              toDegrees(X_FR.rotation) - 90.0));
    run({}, kWait);
  }

  void step(const motion::MotionRequest& request) override {
    effectors_.clear();
    team::Action action;
    action.motion = request;
    robot_.act(action, effectors_);
    answer(effectors_);
    listen();
    monitor_.send("(reqfullstate)");
    while (const auto scene = monitor_.receive(false)) {
      if (const auto pose = findTorso(*scene)) truth_ = *pose;
    }
  }

  Pose2 pose() const override { return truth_.onGround; }
  bool down() const override { return truth_.height < 0.55 * robot_.model().standingHeight(); }
  const world::WorldState& belief() const override { return robot_.world(); }

 private:
  void answer(const protocol::Effectors& effectors) {
    protocol::Effectors own = effectors;
    own.syn = true;
    text_.clear();
    protocol::writeEffectors(own, text_);
    agent_.send(text_);
  }
  // Absorbs all messages that are there, at least one.
  void listen() {
    bool wait = true;
    while (const auto message = agent_.receive(wait)) {
      wait = false;
      protocol::parsePercept(*message, percept_);
      robot_.sense(percept_);
    }
  }

  agent::Robot robot_;
  asio::io_context io_;
  Connection agent_;
  Connection monitor_;
  protocol::Percept percept_;
  protocol::Effectors effectors_;
  std::string text_;
  TruePose truth_;
};

}  // namespace

std::unique_ptr<MeasuredRobot> connectMeasuredRobot(const TrialSettings& setup,
                                                    const ServerAddress& address) {
  return std::make_unique<ServerRobot>(setup, address);
}

}  // namespace nonet::lab
