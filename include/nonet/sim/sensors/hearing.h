// Say and hear (server facts 1.7): what reaches whom, and how much each ear takes.
#pragma once

#include <optional>
#include <string_view>

#include "nonet/protocol/percept.h"

namespace nonet::sim {

/// One robot's ears. Messages wait here from the moment they are said until the next sense message.
class Ear {
 public:
  using Message = InlineString<64>;

  void hearSelf(std::string_view message) { self_ = Message(message); }
  /// Taken only while there is capacity: one message of a team mate and one of an opponent every two cycles.
  void hearOther(std::string_view message, const protocol::TeamName& team, float directionDegrees,
                 bool teamMate);
  /// Appends what was heard to `percept` (own message, team mate's, opponent's), forgets it and recovers
  /// capacity. `ownTeam` labels the own message, `time` is the game time.
  void deliver(const protocol::TeamName& ownTeam, float time, bool label, protocol::Percept& percept);

 private:
  static constexpr int kMaxCapacity = 2;
  static constexpr int kCost = 2;  // per message
  struct Channel {
    int capacity = kMaxCapacity;
    bool filled = false;
    Message message;
    protocol::TeamName team;
    float direction = 0.0F;  // degrees, bearing in the listener's field frame
  };
  static void deliverChannel(Channel& channel, float time, bool label, protocol::Percept& percept);

  std::optional<Message> self_;
  Channel teamMates_;
  Channel opponents_;
};

}  // namespace nonet::sim
