// A robot as the rules see it, and what is written down about fouls.
#pragma once

#include "nonet/protocol/percept.h"
#include "nonet/sim/physics/world.h"

namespace nonet::sim {

/// A connected agent. Never reused within a simulation.
using AgentHandle = int;
inline constexpr AgentHandle kNoAgent = -1;

struct Player {
  AgentHandle agent = kNoAgent;
  RobotHandle robot = kNoRobot;
  protocol::TeamSide side = protocol::TeamSide::None;
  int unum = 0;  // 0: not (or not successfully) initialised
  int robotType = 0;
  protocol::TeamName team;
  bool selected = false;  // by the trainer

  // Groups of robots in contact (server facts 4.10, touching): all members of a group have its number. A
  // robot that was taken out of its group for a foul keeps the number but is no member.
  int touchGroup = -1;
  bool inTouchGroup = false;
  int touchGroupSizeBefore = 0;  // in the previous cycle
};

/// The numbers under which monitors know fouls (server facts 4.10).
enum class FoulType : int {
  Crowding = 0,
  Touching = 1,
  IllegalDefence = 2,
  IllegalAttack = 3,
  Incapable = 4,
  KickOff = 5,
  Charging = 6,
  SelfCollision = 7,
  None = 8,
};

struct FoulRecord {
  int index = 0;  // from 1
  int type = 0;   // numbers of server facts 4.10
  protocol::TeamSide side = protocol::TeamSide::None;
  int unum = 0;
};

}  // namespace nonet::sim
