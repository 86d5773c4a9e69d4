// What must hold for any stream of monitor messages. Returns what is wrong, or nothing.
#pragma once

#include <cmath>
#include <string>

#include "nonet/model/robot_model.h"
#include "nonet/protocol/monitor_reader.h"

namespace nonet::fuzz {

inline std::string checkMonitorState(const protocol::MonitorReader& reader) {
  for (const protocol::MonitorRobot& robot : reader.robots()) {
    if (robot.robotType < 0 || robot.robotType >= model::kRobotTypeCount) return "robot type";
    if (robot.bodies.size() != model::robotModel(robot.robotType).bodies().size()) return "number of bodies";
  }
  return {};
}

/// One message per line. A robot always has all its bodies; a full message that was taken is taken again by a
/// fresh reader.
inline std::string checkMonitorStream(std::string_view bytes) {
  protocol::MonitorReader reader;
  while (!bytes.empty()) {
    const std::string_view message = bytes.substr(0, bytes.find('\n'));
    bytes.remove_prefix(std::min(bytes.size(), message.size() + 1));
    const bool taken = reader.feed(message);
    const std::string problem = checkMonitorState(reader);
    if (!problem.empty()) return problem;
    if (!taken || !reader.lastWasFull()) continue;
    protocol::MonitorReader fresh;
    if (!fresh.feed(message)) return "a full message depends on what came before";
    if (fresh.robots().size() != reader.robots().size()) return "robots differ";
  }
  return {};
}

}  // namespace nonet::fuzz
