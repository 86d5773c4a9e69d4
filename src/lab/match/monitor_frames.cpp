#include <charconv>
#include <cstring>
#include <stdexcept>

#include <fmt/format.h>

#include "nonet/lab/match/frame_sources.h"
#include "nonet/protocol/sexpr_reader.h"

#include "protocol/byte_source.h"

namespace nonet::lab {
namespace {

using protocol::PlayMode;
using Reader = protocol::BasicSexprReader<protocol::SexprDialect::Plain>;

constexpr std::string_view kBody = "naobody";
constexpr std::string_view kBall = "soccerball.obj";

bool toInt(std::string_view text, int& value) {
  return std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc();
}

bool toReal(std::string_view text, double& value) {
  return std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc();
}

// "models/naobody4.obj" -> 4
int bodyType(std::string_view file) {
  int type = 0;
  toInt(file.substr(file.find(kBody) + kBody.size()), type);
  return type;
}

}  // namespace

// One pass over the nodes of a message. A node is counted when its list opens, so that it has the same number
// in a full scene and in the differences after it.
struct MonitorFrames::Scene {
  MonitorFrames& stream;
  bool full = false;
  int count = 0;
  std::vector<int> open = {};                         // numbers of the nodes around
  std::vector<std::array<double, 16>> matrices = {};  // of the nodes of a full scene, by number
  std::vector<std::string_view> materials = {};
  int torso = -1;  // node whose mesh was just named
  int robotType = 0;

  void place(int node, const std::array<double, 16>& matrix) const {
    if (node == stream.ballNode_) {
      stream.frame_.p_WBall = Vector3(matrix[12], matrix[13], matrix[14]);
      return;
    }
    const auto robot = stream.robotOfNode_.find(node);
    if (robot == stream.robotOfNode_.end()) return;
    FrameRobot& body = stream.frame_.robots[static_cast<std::size_t>(robot->second)];
    body.p_W = Vector3(matrix[12], matrix[13], matrix[14]);
    body.up = matrix[10];
  }

  // The body is known by its mesh, which hangs below a turned node below the torso's own.
  void meshNamed(std::string_view file) {
    if (file.ends_with(kBall)) {
      stream.ballNode_ = open.front();
      place(stream.ballNode_, matrices[static_cast<std::size_t>(stream.ballNode_)]);
    } else if (file.find(kBody) != std::string_view::npos && open.size() > 1) {
      torso = open[1];
      robotType = bodyType(file);
    }
  }

  void materialsNamed() {
    if (torso < 0) return;
    FrameRobot robot;
    robot.robotType = robotType;
    bool right = false;
    bool known = false;
    for (const std::string_view name : materials) {
      if (name == "matLeft" || name == "matRight") {
        known = true;
        right = name == "matRight";
      }
      if (name.starts_with("matNum")) toInt(name.substr(6), robot.unum);
    }
    if (known && robot.unum > 0) {
      stream.robotOfNode_[torso] = static_cast<int>(stream.frame_.robots.size());
      stream.frame_.robots.push_back(robot);
      stream.right_.push_back(right);
      place(torso, matrices[static_cast<std::size_t>(torso)]);
    }
    torso = -1;
  }
};

bool MonitorFrames::message(std::string_view text) {
  // Drawings in front (RoboViz' own recordings) are lists of numbers in square brackets.
  const std::size_t begin = text.find('(');
  if (begin == std::string_view::npos) return false;
  const auto listEnd = [&](std::size_t at) {
    int depth = 0;
    for (std::size_t i = at; i < text.size(); ++i) {
      depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
      if (depth == 0) return i + 1;
    }
    return text.size();
  };
  const std::size_t second = listEnd(begin);
  const std::size_t third = listEnd(second);
  if (!environment(text.substr(begin, second - begin))) return false;
  const std::string_view header = text.substr(second, third - second);
  const bool full = header.find("RSG") != std::string_view::npos;
  if (!full && header.find("RDS") == std::string_view::npos) return false;
  if (!full && ballNode_ < 0) return false;
  return nodes(text.substr(third), full);
}

bool MonitorFrames::environment(std::string_view text) {
  Reader reader(text);
  if (!reader.open()) return false;
  newFouls_.clear();
  std::vector<std::string_view> values;
  while (reader.open()) {
    std::string_view name;
    values.clear();
    if (!reader.atom(name)) return false;
    for (std::string_view value; reader.atom(value);) values.push_back(value);
    if (!reader.close()) return false;
    if (!values.empty()) predicate(name, values);
  }
  if (!sides_[0].empty() && teams_[0].empty()) teams_[0] = sides_[0];
  if (!sides_[1].empty() && teams_[1].empty()) teams_[1] = sides_[1];
  frame_.swapped = !teams_[0].empty() && sides_[0] != teams_[0];
  frame_.score = frame_.swapped ? std::array{scores_[1], scores_[0]} : scores_;
  frame_.fouls = newFouls_;
  for (FrameFoul& foul : frame_.fouls) foul.team = (foul.team == 1) != frame_.swapped ? 1 : 0;
  return true;
}

void MonitorFrames::predicate(std::string_view name, const std::vector<std::string_view>& values) {
  int number = 0;
  if (name == "time") {
    toReal(values[0], frame_.time);
  } else if (name == "team_left") {
    sides_[0] = values[0];
  } else if (name == "team_right") {
    sides_[1] = values[0];
  } else if (name == "score_left") {
    toInt(values[0], scores_[0]);
  } else if (name == "score_right") {
    toInt(values[0], scores_[1]);
  } else if (name == "play_mode") {
    if (toInt(values[0], number) && number >= 0 && number < protocol::kPlayModeCount)
      frame_.mode = static_cast<PlayMode>(number);
  } else if (name == "FieldLength") {
    toReal(values[0], field_.length);
  } else if (name == "FieldWidth") {
    toReal(values[0], field_.width);
  } else if (name == "GoalWidth") {
    toReal(values[0], field_.goalWidth);
  } else if (name == "foul" && values.size() == 4) {
    FrameFoul foul;
    int side = 0;
    if (toInt(values[1], foul.type) && toInt(values[2], side) && toInt(values[3], foul.unum)) {
      foul.team = side == 2 ? 1 : 0;
      newFouls_.push_back(foul);
    }
  }
}

bool MonitorFrames::nodes(std::string_view text, bool full) {
  if (full) {
    frame_.robots.clear();
    right_.clear();
    robotOfNode_.clear();
    ballNode_ = -1;
  }
  Scene scene{.stream = *this, .full = full};
  Reader reader(text);
  if (!reader.open()) return false;
  std::vector<int> depths;  // at which the open nodes began
  while (reader.depth() > 0) {
    if (reader.close()) {
      if (!depths.empty() && reader.depth() < depths.back()) {
        depths.pop_back();
        scene.open.pop_back();
      }
      continue;
    }
    std::string_view atom;
    if (!reader.open()) {
      if (!reader.atom(atom)) return false;  // the message is cut off
      continue;
    }
    if (!reader.atom(atom)) continue;
    if (atom == "nd") {
      scene.open.push_back(scene.count++);
      depths.push_back(reader.depth());
      if (full) scene.matrices.emplace_back();
    } else if (atom == "SLT" && !scene.open.empty()) {
      std::array<double, 16> matrix{};
      for (double& value : matrix) {
        if (!reader.number(value)) return false;
      }
      if (full)
        scene.matrices[static_cast<std::size_t>(scene.open.back())] = matrix;
      else
        scene.place(scene.open.back(), matrix);
    } else if (full && atom == "load" && reader.atom(atom)) {
      scene.meshNamed(atom);
    } else if (full && atom == "resetMaterials") {
      scene.materials.clear();
      for (std::string_view name; reader.atom(name);) scene.materials.push_back(name);
      scene.materialsNamed();
    }
  }
  for (std::size_t i = 0; i < frame_.robots.size(); ++i)
    frame_.robots[i].team = right_[i] != frame_.swapped ? 1 : 0;
  return ballNode_ >= 0;
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
