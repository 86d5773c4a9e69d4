#include "nonet/sim/sensors/hearing.h"

#include <algorithm>

#include "nonet/protocol/rounding.h"

namespace nonet::sim {

void Ear::hearOther(std::string_view message, const protocol::TeamName& team, float directionDegrees,
                    bool teamMate) {
  Channel& channel = teamMate ? teamMates_ : opponents_;
  if (channel.capacity < kCost) return;
  channel.capacity -= kCost;
  channel.filled = true;
  channel.message.assign(message);
  channel.team = team;
  channel.direction = directionDegrees;
}

void Ear::deliver(const protocol::TeamName& ownTeam, float time, bool label, protocol::Percept& percept) {
  if (self_) {
    protocol::Heard heard;
    if (label) heard.team = ownTeam;
    heard.time = protocol::roundToWire(time);
    heard.self = true;
    heard.message = *self_;
    percept.order.push_back({protocol::PerceptKind::Hear, static_cast<std::uint8_t>(percept.heard.size())});
    percept.heard.push_back(heard);
    self_.reset();
  }
  deliverChannel(teamMates_, time, label, percept);
  deliverChannel(opponents_, time, label, percept);
}

void Ear::deliverChannel(Channel& channel, float time, bool label, protocol::Percept& percept) {
  channel.capacity = std::min(channel.capacity + 1, kMaxCapacity);
  if (!channel.filled) return;
  channel.filled = false;
  protocol::Heard heard;
  if (label) heard.team = channel.team;
  heard.time = protocol::roundToWire(time);
  heard.direction = protocol::radiansOnWire(channel.direction);
  heard.message = channel.message;
  percept.order.push_back({protocol::PerceptKind::Hear, static_cast<std::uint8_t>(percept.heard.size())});
  percept.heard.push_back(heard);
}

}  // namespace nonet::sim
