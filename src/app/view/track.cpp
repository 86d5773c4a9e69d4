#include "nonet/app/view/track.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "nonet/model/robot_model.h"
#include "nonet/protocol/log_file.h"

namespace nonet::app {
namespace {

static_assert(std::endian::native == std::endian::little, "the browser reads little-endian numbers");

using protocol::MonitorMatrix;
using protocol::poseFromMonitor;
using protocol::TeamSide;

constexpr double kFallenBelow = 0.5;   // of the torso's up axis: leans by more than 60 degrees
constexpr double kUprightAbove = 0.8;  // and stands again
constexpr double kKickGain = 1.0;      // m/s that a kick adds at least
constexpr double kKickReach = 0.8;     // m between the ball and the torso of who kicked it
constexpr double kKickPause = 0.5;     // s after a kick that belong to it
constexpr double kBallJump = 12.0;     // m/s: faster than any ball, it has been carried

// What the fouls' numbers mean: server facts 4.10.
constexpr std::array<const char*, 9> kFoulNames = {"crowding",       "touching",       "illegal defence",
                                                   "illegal attack", "incapable",      "kick-off",
                                                   "charging",       "self-collision", "no foul"};
constexpr std::array<const char*, 5> kEventNames = {"goal", "fall", "kick", "foul", "mode"};

std::optional<std::size_t> slotOf(TeamSide side, int unum) {
  if (side == TeamSide::None || unum < 1 || unum > 11) return std::nullopt;
  return static_cast<std::size_t>(unum - 1 + (side == TeamSide::Right ? 11 : 0));
}

void putQuaternion(const Matrix3& rotation, float* out) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(rotation).normalized();
  const std::array<double, 4> elements = {q.x(), q.y(), q.z(), q.w()};
  std::copy(elements.begin(), elements.end(), out);
}

Vector2 groundPlace(const MonitorMatrix& matrix) {
  return {matrix[12], matrix[13]};
}

}  // namespace

model::JointArray jointAngles(const protocol::MonitorRobot& robot) {
  const model::RobotModel& shape = model::robotModel(robot.robotType);
  std::array<Matrix3, model::kBodyCount> rotations;
  model::JointArray angles{};
  for (std::size_t i = 0; i < robot.bodies.size(); ++i) {
    const model::BodySpec& body = shape.bodies()[i];
    rotations[model::index(body.id)] = poseFromMonitor(robot.bodies[i]).linear();
    if (!body.joint) continue;
    const model::JointSpec& joint = shape.joint(*body.joint);
    const Matrix3 turn =
        rotations[model::index(joint.parent)].transpose() * rotations[model::index(joint.child)];
    // R - R^T holds 2 sin(q) times the axis, the trace 1 + 2 cos(q).
    const Vector3 sine(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
    angles[model::index(*body.joint)] = std::atan2(sine.dot(joint.axis.normalized()), turn.trace() - 1.0);
  }
  return angles;
}

void Track::add(const protocol::MonitorReader& reader) {
  rows_.resize(rows_.size() + kRowFloats, 0.0F);
  float* row = rows_.data() + rows_.size() - kRowFloats;
  const protocol::MonitorGame& game = reader.game();
  row[0] = static_cast<float>(game.time);
  row[1] = static_cast<float>(game.playMode);
  row[2] = static_cast<float>(game.half);
  row[3] = static_cast<float>(game.scoreLeft);
  row[4] = static_cast<float>(game.scoreRight);
  const Pose3 ball = poseFromMonitor(reader.ball());
  for (int i = 0; i < 3; ++i) row[5 + i] = static_cast<float>(ball.translation()[i]);
  putQuaternion(ball.linear(), row + 8);
  for (const protocol::MonitorRobot& robot : reader.robots()) addRobot(robot, row + kGameFloats);

  if (frames() > 1) {
    const int cycles = static_cast<int>(std::lround((game.time - game_.time) / kCycleTime));
    if (cycles > 0) ++steps_[cycles];
  }
  field_ = reader.field();
  addNames(game);
  findEvents(reader);
  game_ = game;
}

// A name that has only become known holds for the rows before it, too.
void Track::addNames(const protocol::MonitorGame& game) {
  const auto stays = [](const std::string& before, const std::string& now) {
    return before.empty() || before == now;
  };
  if (names_.empty() || !stays(names_.back().left, game.teamLeft) ||
      !stays(names_.back().right, game.teamRight))
    names_.push_back({names_.empty() ? 0 : frames() - 1, {}, {}});
  names_.back().left = game.teamLeft;
  names_.back().right = game.teamRight;
}

void Track::addRobot(const protocol::MonitorRobot& robot, float* row) {
  const auto slot = slotOf(robot.side, robot.unum);
  if (!slot || robot.bodies.empty()) return;
  float* out = row + *slot * kRobotFloats;
  out[0] = static_cast<float>(robot.robotType + 1);
  const Pose3 torso = poseFromMonitor(robot.bodies.front());
  for (int i = 0; i < 3; ++i) out[1 + i] = static_cast<float>(torso.translation()[i]);
  putQuaternion(torso.linear(), out + 4);
  const model::JointArray angles = jointAngles(robot);
  std::copy(angles.begin(), angles.end(), out + 8);
}

double Track::step() const {
  const auto most = std::max_element(steps_.begin(), steps_.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == steps_.end() ? step_ : most->first * kCycleTime;
}

std::span<const float> Track::rows(std::size_t from) const {
  return std::span(rows_).subspan(std::min(from, frames()) * kRowFloats);
}

void Track::event(TrackEvent::Kind kind, TeamSide side, int unum, std::string text) {
  events_.push_back({kind, frames() - 1, side, unum, std::move(text)});
}

void Track::findEvents(const protocol::MonitorReader& reader) {
  const protocol::MonitorGame& game = reader.game();
  const bool first = frames() == 1;
  if (first || game.playMode != game_.playMode) {
    event(TrackEvent::Kind::Mode, TeamSide::None, 0, std::string(playModeName(game.playMode)));
  }
  if (!first && game.scoreLeft > game_.scoreLeft) event(TrackEvent::Kind::Goal, TeamSide::Left, 0);
  if (!first && game.scoreRight > game_.scoreRight) event(TrackEvent::Kind::Goal, TeamSide::Right, 0);
  for (const protocol::MonitorFoul& foul : reader.newFouls()) {
    const bool known = foul.type >= 0 && foul.type < static_cast<int>(kFoulNames.size());
    event(TrackEvent::Kind::Foul, foul.side, foul.unum,
          known ? kFoulNames[static_cast<std::size_t>(foul.type)] : fmt::format("foul {}", foul.type));
  }
  for (const protocol::MonitorRobot& robot : reader.robots()) {
    const auto slot = slotOf(robot.side, robot.unum);
    if (!slot || robot.bodies.empty()) continue;
    const double up = robot.bodies.front()[10];
    if (!down_[*slot] && up < kFallenBelow) {
      event(TrackEvent::Kind::Fall, robot.side, robot.unum);
      down_[*slot] = true;
    } else if (up > kUprightAbove) {
      down_[*slot] = false;
    }
  }
  findKick(reader);
}

// A kick shows as a ball that is suddenly faster while a robot stands at it.
void Track::findKick(const protocol::MonitorReader& reader) {
  const Vector2 ball = groundPlace(reader.ball());
  const Vector2 before = ballBefore_.value_or(ball);
  ballBefore_ = ball;
  const Vector2 velocity = (ball - before) / step();
  const double gain = velocity.norm() - ballVelocity_.norm();
  ballVelocity_ = velocity;
  ++framesSinceKick_;
  if (velocity.norm() > kBallJump) {
    ballVelocity_.setZero();
    return;
  }
  if (gain < kKickGain || static_cast<double>(framesSinceKick_) * step() < kKickPause) return;
  const protocol::MonitorRobot* kicker = nullptr;
  double nearest = kKickReach;
  for (const protocol::MonitorRobot& robot : reader.robots()) {
    if (robot.bodies.empty() || !slotOf(robot.side, robot.unum)) continue;
    const double distance = (groundPlace(robot.bodies.front()) - before).norm();
    if (distance < nearest) {
      nearest = distance;
      kicker = &robot;
    }
  }
  if (kicker == nullptr) return;
  event(TrackEvent::Kind::Kick, kicker->side, kicker->unum, fmt::format("{:.1f} m/s", velocity.norm()));
  framesSinceKick_ = 0;
}

std::string Track::message(std::size_t from, std::size_t eventsFrom, std::string_view source,
                           std::string_view live) const {
  from = std::min(from, frames());
  nlohmann::json events = nlohmann::json::array();
  for (std::size_t i = std::min(eventsFrom, events_.size()); i < events_.size(); ++i) {
    const TrackEvent& event = events_[i];
    events.push_back({{"kind", kEventNames[static_cast<std::size_t>(event.kind)]},
                      {"frame", event.frame},
                      {"side", static_cast<int>(event.side)},
                      {"unum", event.unum},
                      {"text", event.text}});
  }
  nlohmann::json teams = nlohmann::json::array();
  for (const TeamNames& names : names_) teams.push_back({names.frame, names.left, names.right});
  const nlohmann::json header = {{"source", source},    {"live", live},          {"from", from},
                                 {"frames", frames()},  {"step", step()},        {"row", kRowFloats},
                                 {"game", kGameFloats}, {"robot", kRobotFloats}, {"slots", kSlots},
                                 {"teams", teams},      {"field", field_},       {"eventsFrom", eventsFrom},
                                 {"events", events}};
  std::string json = header.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);  // foreign names
  json.resize((json.size() + 3) / 4 * 4, ' ');  // numbers lie at multiples of their size
  const auto length = static_cast<std::uint32_t>(json.size());
  const std::span<const float> numbers = rows(from);
  std::string text(sizeof length + json.size() + numbers.size_bytes(), '\0');
  std::memcpy(text.data(), &length, sizeof length);
  std::memcpy(text.data() + sizeof length, json.data(), json.size());
  if (!numbers.empty()) {
    std::memcpy(text.data() + sizeof length + json.size(), numbers.data(), numbers.size_bytes());
  }
  return text;
}

nlohmann::json robotShapes() {
  const auto vector = [](const Vector3& v) { return nlohmann::json{v.x(), v.y(), v.z()}; };
  nlohmann::json types = nlohmann::json::array();
  for (int type = 0; type < model::kRobotTypeCount; ++type) {
    const model::RobotModel& shape = model::robotModel(type);
    nlohmann::json bodies = nlohmann::json::array();
    for (const model::BodySpec& body : shape.bodies()) {
      constexpr std::array<const char*, 3> kKinds = {"box", "sphere", "capsule"};
      nlohmann::json entry = {{"name", bodyName(body.id)},
                              {"parent", bodyName(body.parent)},
                              {"shape", kKinds[static_cast<std::size_t>(body.shape.kind)]},
                              {"size", vector(body.shape.size)},
                              {"offset", vector(body.offset)}};
      if (body.joint) {
        const model::JointSpec& joint = shape.joint(*body.joint);
        entry["joint"] = model::index(joint.id);
        entry["anchor"] = vector(joint.anchor);
        entry["axis"] = vector(joint.axis.normalized());
      }
      bodies.push_back(std::move(entry));
    }
    types.push_back(std::move(bodies));
  }
  return types;
}

Track readMonitorLog(const std::string& path, std::string* problem) {
  constexpr double kLogStep = 0.2;  // s, server facts 5.4
  Track track(kLogStep);
  protocol::LogReader log(path);
  protocol::MonitorReader reader;
  protocol::LogLine line;
  while (log.next(line)) {
    if (reader.feed(line.text)) track.add(reader);
  }
  if (track.frames() == 0) {
    throw protocol::LogError(
        fmt::format("{}: no monitor messages in it; nonet match --monitor-log FILE records one", path));
  }
  if (problem != nullptr) *problem = log.problem();
  return track;
}

}  // namespace nonet::app
