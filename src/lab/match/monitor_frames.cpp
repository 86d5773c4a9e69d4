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

void readMonitorLog(const std::string& path, const std::function<void(const MonitorFrames& stream)>& use) {
  const auto source = protocol::openByteSource(path);
  constexpr std::size_t kBlock = 1 << 20;
  std::string buffer;
  std::size_t at = 0;  // of the next message
  MonitorFrames stream;
  long messages = 0;
  long frames = 0;
  const auto give = [&](std::string_view text) {
    ++messages;
    if (!stream.message(text)) return;
    ++frames;
    use(stream);
  };
  for (bool more = true; more;) {
    buffer.erase(0, at);
    at = 0;
    const std::size_t size = buffer.size();
    buffer.resize(size + kBlock);
    const std::size_t read = source->read(buffer.data() + size, kBlock);
    buffer.resize(size + read);
    more = read > 0;
    while (at < buffer.size()) {
      // Lengths are far below 2^24, so their first byte is 0; lines begin with a bracket.
      if (buffer[at] == '\0') {
        if (buffer.size() - at < 4) break;
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i)
          length = length << 8U | static_cast<unsigned char>(buffer[at + i]);
        if (buffer.size() - at - 4 < length) break;
        give(std::string_view(buffer).substr(at + 4, length));
        at += 4 + length;
      } else {
        const std::size_t end = buffer.find('\n', at);
        if (end == std::string::npos) break;
        if (end > at) give(std::string_view(buffer).substr(at, end - at));
        at = end + 1;
      }
    }
  }
  if (frames == 0)
    throw std::runtime_error(
        fmt::format("{}: no monitor stream ({} lines or messages, none of them a scene): expected the file "
                    "of --monitor-log, a "
                    "server's sparkmonitor.log, or messages with their length",
                    path, messages));
}

}  // namespace nonet::lab
