// Who plays which role. Every player works out a whole assignment from its own view and tells it with its
// radio message; what most of the last messages say is what everybody does. First formation, then the mapping
// f_v, then votes [MacAlpine 2012a, section 6]. So one wrong view of the world changes nothing, and two
// players do not both go to the ball.
#pragma once

#include <optional>
#include <span>

#include "nonet/protocol/say_codec.h"
#include "nonet/team/formation.h"
#include "nonet/team/role_assignment.h"
#include "nonet/team/situation.h"

namespace nonet::team {

class RoleVoting {
 public:
  /// Needs the situation up to the formation. `banned`: number of the team mate that must leave the ball to
  /// others, 0 for none.
  void update(const Situation& situation, int banned);

  /// The own role as agreed; a field player's (number 2 to 11).
  Role role() const { return role_; }
  /// Number of the field player on the ball as agreed, 0 if there was no vote yet.
  int onBall() const { return onBall_; }
  /// The whole assignment as agreed: role of players 2 to 11; empty if there was no vote yet.
  const std::optional<protocol::RoleVote>& agreed() const { return agreed_; }
  /// For the own next message: role of players 2 to 11; empty without a view of the field.
  const std::optional<protocol::RoleVote>& vote() const { return vote_; }

 private:
  void vote(const Situation& situation, int banned);
  void count(const Situation& situation, int banned);

  RoleAssigner assigner_;
  std::optional<protocol::RoleVote> vote_;
  std::optional<protocol::RoleVote> agreed_;
  bool inOwnSlot_ = false;
  Role role_ = Role::Stopper;
  int onBall_ = 0;
};

}  // namespace nonet::team
