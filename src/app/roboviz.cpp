#include "nonet/app/roboviz.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include <asio.hpp>
#include <fmt/format.h>

#include "nonet/model/ball.h"
#include "nonet/world/ball_law.h"

namespace nonet::app {
namespace {

constexpr std::size_t kMaxPacket = 512;  // bytes
constexpr std::size_t kMaxText = 100;    // bytes of a name, far below the packet
constexpr int kStepsPerPicture = 5;

constexpr RobovizColor kBlue = {70, 150, 255};
constexpr RobovizColor kRed = {255, 110, 70};
constexpr RobovizColor kYellow = {255, 240, 80};
constexpr RobovizColor kPink = {255, 90, 214};
constexpr RobovizColor kGrey = {190, 190, 190};

void putKind(std::string& bytes, char group, char kind) {
  bytes += group;
  bytes += kind;
}

// Six characters: what does not fit is cut off.
void putNumber(std::string& bytes, double value) {
  constexpr double kLargest = 9999.0;  // so that the point is among the six
  bytes +=
      fmt::format("{:.5f}", std::isfinite(value) ? std::clamp(value, -kLargest, kLargest) : 0.0).substr(0, 6);
}

void putPlace(std::string& bytes, const Vector3& place) {
  for (const double coordinate : place) putNumber(bytes, coordinate);
}

void putColor(std::string& bytes, const RobovizColor& color) {
  for (const std::uint8_t channel : color) bytes += static_cast<char>(channel);
}

void putText(std::string& bytes, std::string_view text) {
  bytes += text.substr(0, kMaxText);
  bytes += '\0';
}

// Draws in the own team's field frame into the sets of one robot.
class Picture {
 public:
  explicit Picture(const world::WorldState& world)
      : left_(world.game.side != protocol::TeamSide::Right),
        turn_(left_ != world.game.sidesSwapped ? 1.0 : -1.0),
        prefix_(fmt::format("nonet.{}.{}.", left_ ? "left" : "right", world.game.unum)) {}

  RobovizColor ownColor() const { return left_ ? kBlue : kRed; }
  RobovizColor otherColor() const { return left_ ? kRed : kBlue; }

  void circle(const Vector2& center, double radius, const RobovizColor& color, std::string_view set) {
    robovizCircle(next(), turn_ * center, radius, 2.0, color, prefix_ + std::string(set));
  }
  void line(const Vector2& from, const Vector2& to, const RobovizColor& color, std::string_view set) {
    robovizLine(next(), raised(from), raised(to), 2.0, color, prefix_ + std::string(set));
  }
  void point(const Vector2& at, const RobovizColor& color, std::string_view set) {
    robovizPoint(next(), raised(at), 4.0, color, prefix_ + std::string(set));
  }
  void ball(const Vector3& at) {
    robovizSphere(next(), {turn_ * at.x(), turn_ * at.y(), std::max(at.z(), model::kBallRadius)}, 0.06, kPink,
                  prefix_ + "ball");
  }

  std::vector<std::string> finish() {
    robovizSwap(next(), prefix_);
    return std::move(commands_);
  }

 private:
  std::string& next() { return commands_.emplace_back(); }
  Vector3 raised(const Vector2& p) const { return {turn_ * p.x(), turn_ * p.y(), 0.02}; }

  bool left_;
  double turn_;
  std::string prefix_;
  std::vector<std::string> commands_;
};

void drawRequest(Picture& picture, const motion::MotionRequest& request, const Pose2& X_FR) {
  if (const auto* walk = std::get_if<motion::WalkTo>(&request)) {
    const Vector2 target = X_FR * walk->target.translation;
    picture.circle(target, 0.12, kYellow, "target");
    picture.line(X_FR.translation, target, kYellow, "path");
  } else if (const auto* kick = std::get_if<motion::KickTo>(&request)) {
    picture.line(X_FR * kick->ball, X_FR * kick->target, kPink, "pass");
  }
}

}  // namespace

void robovizCircle(std::string& bytes, const Vector2& center, double radius, double thickness,
                   const RobovizColor& color, std::string_view set) {
  putKind(bytes, 1, 0);
  for (const double value : {center.x(), center.y(), radius, thickness}) putNumber(bytes, value);
  putColor(bytes, color);
  putText(bytes, set);
}

void robovizLine(std::string& bytes, const Vector3& from, const Vector3& to, double thickness,
                 const RobovizColor& color, std::string_view set) {
  putKind(bytes, 1, 1);
  putPlace(bytes, from);
  putPlace(bytes, to);
  putNumber(bytes, thickness);
  putColor(bytes, color);
  putText(bytes, set);
}

void robovizPoint(std::string& bytes, const Vector3& at, double size, const RobovizColor& color,
                  std::string_view set) {
  putKind(bytes, 1, 2);
  putPlace(bytes, at);
  putNumber(bytes, size);
  putColor(bytes, color);
  putText(bytes, set);
}

void robovizSphere(std::string& bytes, const Vector3& center, double radius, const RobovizColor& color,
                   std::string_view set) {
  putKind(bytes, 1, 3);
  putPlace(bytes, center);
  putNumber(bytes, radius);
  putColor(bytes, color);
  putText(bytes, set);
}

void robovizSwap(std::string& bytes, std::string_view prefix) {
  putKind(bytes, 0, 0);
  putText(bytes, prefix);
}

std::vector<std::string> robovizPicture(const agent::Agent& agent) {
  const world::WorldState& world = agent.world();
  const Pose2& X_FR = world.self.X_FR;
  Picture picture(world);
  const double spread = std::sqrt(std::max(0.0, world.self.covariance.topLeftCorner<2, 2>().trace()));
  picture.circle(X_FR.translation, std::max(spread, 0.1), picture.ownColor(), "pose");
  picture.line(X_FR.translation, X_FR * Vector2(0.4, 0.0), picture.ownColor(), "pose");
  for (const Pose2& particle : agent.particles())
    picture.point(particle.translation, picture.ownColor(), "particles");
  if (world.ball.known) {
    picture.ball(world.ball.p_FB);
    picture.line(world.ball.p_FB.head<2>(), world::restPlace({world.ball.p_FB, world.ball.v_FB}), kGrey,
                 "ball");
  }
  drawRequest(picture, agent.action().motion, X_FR);
  for (int unum = 1; unum <= world::kTeamSize; ++unum) {
    const auto i = static_cast<std::size_t>(unum);
    if (world.teammates[i].known && unum != world.game.unum) {
      picture.circle(world.teammates[i].X_FP.translation, 0.2, picture.ownColor(), "players");
    }
    if (world.opponents[i].known) {
      picture.circle(world.opponents[i].X_FP.translation, 0.2, picture.otherColor(), "players");
    }
  }
  return picture.finish();
}

std::vector<std::string> robovizPackets(const std::vector<std::string>& commands) {
  std::vector<std::string> packets;
  for (const std::string& command : commands) {
    if (packets.empty() || packets.back().size() + command.size() > kMaxPacket) packets.emplace_back();
    packets.back() += command;
  }
  return packets;
}

RobovizPainter::RobovizPainter(const std::string& host, std::uint16_t port) : socket_(io_) {
  std::error_code error;
  asio::ip::udp::resolver resolver(io_);
  const auto found = resolver.resolve(host, std::to_string(port), error);
  if (error || found.empty()) {
    throw std::runtime_error(fmt::format("--draw: {} has no address ({})", host, error.message()));
  }
  target_ = found.begin()->endpoint();
  socket_.open(target_.protocol());
  socket_.non_blocking(true);
}

void RobovizPainter::show(const agent::Agent& agent) {
  if (steps_++ % kStepsPerPicture != 0 || agent.world().game.unum == 0) return;
  for (const std::string& packet : robovizPackets(robovizPicture(agent))) {
    std::error_code nobodyListens;
    socket_.send_to(asio::buffer(packet), target_, 0, nobodyListens);
  }
}

}  // namespace nonet::app
