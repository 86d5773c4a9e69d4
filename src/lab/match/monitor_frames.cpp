#include <stdexcept>

#include <fmt/format.h>

#include "nonet/lab/match/frame_sources.h"

#include "protocol/byte_source.h"

namespace nonet::lab {
namespace {

void takeLength(const protocol::MonitorReader& reader, std::string_view name, double& length) {
  const auto found = reader.field().find(name);
  if (found != reader.field().end()) length = found->second;
}

// Cuts off the next message: a line, or what stands behind its length. Nothing if it is not whole.
std::optional<std::string_view> cutMessage(std::string_view& rest) {
  constexpr std::size_t kLengthSize = 4;
  std::size_t begin = 0;
  std::size_t size = rest.find('\n');
  std::size_t next = size == std::string_view::npos ? size : size + 1;
  // Lengths are far below 2^24, so their first byte is 0; lines begin with a bracket.
  if (rest.starts_with('\0')) {
    if (rest.size() < kLengthSize) return std::nullopt;
    begin = kLengthSize;
    size = 0;
    for (const char byte : rest.substr(0, kLengthSize)) size = size << 8U | static_cast<unsigned char>(byte);
    next = begin + size;
  }
  if (next > rest.size()) return std::nullopt;
  const std::string_view message = rest.substr(begin, size);
  rest.remove_prefix(next);
  return message;
}

}  // namespace

bool MonitorFrames::message(std::string_view text) {
  if (!reader_.feed(text) || reader_.ball()[15] == 0.0F) return false;  // no ball: no full scene yet
  const protocol::MonitorGame& game = reader_.game();
  if (teams_[0].empty()) teams_[0] = game.teamLeft;
  if (teams_[1].empty()) teams_[1] = game.teamRight;
  frame_.swapped = !teams_[0].empty() && game.teamLeft != teams_[0];
  frame_.time = game.time;
  frame_.mode = game.playMode;
  frame_.score = {game.scoreLeft, game.scoreRight};
  if (frame_.swapped) std::swap(frame_.score[0], frame_.score[1]);
  const protocol::MonitorMatrix& ball = reader_.ball();
  frame_.p_WBall = Vector3(ball[12], ball[13], ball[14]);
  takeLength(reader_, "FieldLength", field_.length);
  takeLength(reader_, "FieldWidth", field_.width);
  takeLength(reader_, "GoalWidth", field_.goalWidth);
  takeRobots();
  return true;
}

void MonitorFrames::takeRobots() {
  const auto teamOf = [this](protocol::TeamSide side) {
    return (side == protocol::TeamSide::Right) != frame_.swapped ? 1 : 0;
  };
  frame_.robots.clear();
  for (const protocol::MonitorRobot& body : reader_.robots()) {
    if (body.side == protocol::TeamSide::None || body.unum <= 0) continue;
    const protocol::MonitorMatrix& torso = body.bodies[static_cast<std::size_t>(model::BodyId::Torso)];
    FrameRobot robot;
    robot.team = teamOf(body.side);
    robot.unum = body.unum;
    robot.robotType = body.robotType;
    robot.p_W = Vector3(torso[12], torso[13], torso[14]);
    robot.up = torso[10];
    frame_.robots.push_back(robot);
  }
  frame_.fouls.clear();
  for (const protocol::MonitorFoul& foul : reader_.newFouls())
    frame_.fouls.push_back({foul.type, teamOf(foul.side), foul.unum});
}

MonitorLogEnd readMonitorLog(const std::string& path,
                             const std::function<void(const MonitorFrames& stream)>& use) {
  const auto source = protocol::openByteSource(path);
  constexpr std::size_t kBlock = 1 << 20;
  std::string buffer;
  MonitorFrames stream;
  long messages = 0;
  long frames = 0;
  for (bool more = true; more;) {
    const std::size_t size = buffer.size();
    buffer.resize(size + kBlock);
    const std::size_t read = source->read(buffer.data() + size, kBlock);
    buffer.resize(size + read);
    more = read > 0;
    std::string_view rest = buffer;
    while (const auto message = cutMessage(rest)) {
      if (message->empty()) continue;
      ++messages;
      if (!stream.message(*message)) continue;
      ++frames;
      use(stream);
    }
    buffer.erase(0, buffer.size() - rest.size());
  }
  const auto [end, what] = protocol::endOf(*source, !buffer.empty());
  if (frames == 0)
    throw std::runtime_error(
        fmt::format("{}: no monitor stream ({} lines or messages, none of them a scene{}{}): expected the "
                    "file of --monitor-log, a server's sparkmonitor.log, or messages with their length",
                    path, messages, what.empty() ? "" : "; ", what));
  if (what.empty()) return {};
  return {end, fmt::format("{}: {}; {} messages were read, up to {:.1f} s of the game", path, what, messages,
                           stream.frame().time)};
}

}  // namespace nonet::lab
