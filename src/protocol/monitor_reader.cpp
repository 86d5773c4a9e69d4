#include "nonet/protocol/monitor_reader.h"

#include <charconv>
#include <utility>

#include "nonet/model/robot_model.h"

namespace nonet::protocol {
namespace {

// "naobody3.obj" below any folder gives 3, anything else -1.
int torsoType(std::string_view file) {
  constexpr std::string_view kName = "naobody";
  const std::size_t at = file.rfind(kName);
  if (at == std::string_view::npos || at + kName.size() >= file.size()) return -1;
  const int type = file[at + kName.size()] - '0';
  return type >= 0 && type < model::kRobotTypeCount ? type : -1;
}

TeamSide sideFrom(int number) {
  return number == 1 ? TeamSide::Left : number == 2 ? TeamSide::Right : TeamSide::None;
}

}  // namespace

Pose3 poseFromMonitor(const MonitorMatrix& matrix) {
  Pose3 pose = Pose3::Identity();
  // Columns of the server's rotation: the body's right, forward and up.
  for (int row = 0; row < 3; ++row) {
    pose.linear()(row, 0) = matrix[4 + row];
    pose.linear()(row, 1) = -matrix[row];
    pose.linear()(row, 2) = matrix[8 + row];
    pose.translation()[row] = matrix[12 + row];
  }
  return pose;
}

bool MonitorReader::feed(std::string_view message) {
  // RoboViz' own recordings have drawings in square brackets in front.
  const std::size_t begin = message.find('(');
  if (begin == std::string_view::npos) return false;
  reader_ = SexprReader(message.substr(begin));
  newFouls_.clear();
  if (!readEnvironment()) return false;
  if (!reader_.open()) return false;
  std::string_view kind;
  if (!reader_.atom(kind) || (kind != "RSG" && kind != "RDS")) return false;
  full_ = kind == "RSG";
  if (!full_ && plan_.empty()) return false;
  return reader_.leaveTo(0) && readScene();
}

bool MonitorReader::readEnvironment() {
  if (!reader_.open()) return false;
  while (!reader_.close()) {
    std::string_view name;
    if (!reader_.open() || !reader_.atom(name)) return false;
    readPredicate(name);
    if (!reader_.leaveTo(1)) return false;
  }
  return true;
}

void MonitorReader::readPredicate(std::string_view name) {
  std::string_view word;
  int number = 0;
  double value = 0.0;
  if (name == "time") {
    reader_.number(game_.time);
  } else if (name == "team_left") {
    if (reader_.atom(word)) game_.teamLeft = word;
  } else if (name == "team_right") {
    if (reader_.atom(word)) game_.teamRight = word;
  } else if (name == "half") {
    reader_.integer(game_.half);
  } else if (name == "score_left") {
    reader_.integer(game_.scoreLeft);
  } else if (name == "score_right") {
    reader_.integer(game_.scoreRight);
  } else if (name == "play_modes") {
    modes_.clear();
    while (reader_.atom(word)) modes_.push_back(playModeFromName(word).value_or(PlayMode::Unknown));
  } else if (name == "play_mode") {
    if (!reader_.integer(number) || number < 0) return;
    const auto place = static_cast<std::size_t>(number);
    game_.playMode = place < modes_.size() ? modes_[place] : PlayMode::Unknown;
  } else if (name == "foul") {
    readFoul();
  } else if (reader_.number(value)) {
    field_.insert_or_assign(std::string(name), value);
  }
}

void MonitorReader::readFoul() {
  MonitorFoul foul;
  int side = 0;
  if (reader_.integer(foul.index) && reader_.integer(foul.type) && reader_.integer(side) &&
      reader_.integer(foul.unum)) {
    foul.side = sideFrom(side);
    newFouls_.push_back(foul);
  }
}

bool MonitorReader::readScene() {
  if (!reader_.open()) return false;
  if (full_) {
    plan_.clear();
    robots_.clear();
  }
  std::size_t place = 0;
  while (!reader_.close()) {
    if (!reader_.open()) return false;
    // Only nodes count: other lists have no place of their own.
    if (reader_.literal("nd")) {
      if (!(full_ ? readFullNode() : readDifferenceNode(place))) return false;
      ++place;
    }
    if (!reader_.leaveTo(1)) return false;
  }
  return true;
}

// A node at the top with all that is below it: "(nd TRF (SLT ...) (nd TRF (SLT ...) ...) ...)".
bool MonitorReader::readFullNode() {
  std::string_view kind;
  reader_.atom(kind);
  MonitorMatrix own{};
  Look look;
  MonitorRobot robot;
  const int depth = reader_.depth();
  while (!reader_.close()) {
    if (reader_.openNamed("SLT")) {
      if (!readMatrix(own)) return false;
    } else if (reader_.open()) {
      if (reader_.literal("nd")) {
        reader_.literal("TRF");
        if (reader_.openNamed("SLT") && !readMatrix(robot.bodies.emplace_back())) return false;
        readLook(depth, look);
      }
      if (!reader_.leaveTo(depth)) return false;
    } else if (!reader_.skipOne()) {
      return false;
    }
  }
  // The closing bracket of this node is gone; readScene() finds itself at depth 1.
  plan_.push_back(kNothing);
  if (look.ball) {
    ball_ = own;
    plan_.back() = kBall;
  } else if (look.robotType >= 0 &&
             robot.bodies.size() == model::robotModel(look.robotType).bodies().size()) {
    plan_.back() = static_cast<int>(robots_.size());
    robot.side = look.side;
    robot.unum = look.unum;
    robot.robotType = look.robotType;
    robots_.push_back(std::move(robot));
  }
  return true;
}

bool MonitorReader::readDifferenceNode(std::size_t place) {
  const int what = place < plan_.size() ? plan_[place] : kNothing;
  if (what == kNothing) return true;
  if (what == kBall) {
    return !reader_.openNamed("SLT") || readMatrix(ball_);
  }
  std::vector<MonitorMatrix>& bodies = robots_[static_cast<std::size_t>(what)].bodies;
  const int depth = reader_.depth();
  std::size_t body = 0;
  while (reader_.open()) {
    if (reader_.literal("nd")) {
      if (body < bodies.size() && reader_.openNamed("SLT") && !readMatrix(bodies[body])) return false;
      ++body;
    }
    if (!reader_.leaveTo(depth)) return false;
  }
  return true;
}

// Behind "(SLT": sixteen numbers and the bracket.
bool MonitorReader::readMatrix(MonitorMatrix& matrix) {
  MonitorMatrix read{};
  for (float& element : read) {
    double value = 0.0;
    if (!reader_.number(value)) return false;
    element = static_cast<float>(value);
  }
  matrix = read;
  return reader_.close();
}

// Looks through all that is deeper than `depth` for meshes, and leaves to there.
void MonitorReader::readLook(int depth, Look& look) {
  while (reader_.depth() > depth) {
    std::string_view file;
    if (reader_.openNamed("load")) {
      if (reader_.atom(file)) {
        look.ball = look.ball || file.ends_with("soccerball.obj");
        if (const int type = torsoType(file); type >= 0) look.robotType = type;
      }
    } else if (reader_.openNamed("resetMaterials")) {
      readMaterials(look);
    } else if (!reader_.skipOne()) {
      return;
    }
  }
}

void MonitorReader::readMaterials(Look& look) {
  std::string_view material;
  while (reader_.atom(material)) {
    if (material == "matLeft") look.side = TeamSide::Left;
    if (material == "matRight") look.side = TeamSide::Right;
    if (material.starts_with("matNum")) {
      material.remove_prefix(6);
      std::from_chars(material.data(), material.data() + material.size(), look.unum);
    }
  }
}

}  // namespace nonet::protocol
