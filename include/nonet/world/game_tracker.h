// Percept -> GameState: play modes as seen from the own side, score, half, and the silent change of sides.
#pragma once

#include "nonet/math/pose2.h"
#include "nonet/protocol/percept.h"
#include "nonet/world/world_state.h"

namespace nonet::world {

class GameTracker {
 public:
  explicit GameTracker(const protocol::TeamName& team);

  void update(const protocol::Percept& percept, GameState& state);

  /// Tells where the torso is by landmarks (x in world axes, L at -x). The server changes the sides at half
  /// time without a word, but until the kick-off it puts every robot that stands in the opponents' half back
  /// at once (server facts 4.3): who stands there after half time has changed sides. Its first message of the
  /// half still shows the robots where they were, so that one proves nothing.
  void noticePlace(double x_W, double time, GameState& state);

  /// False from half time until it has become clear whether the sides were changed.
  bool sideKnown() const { return sideKnown_; }

 private:
  void setPhase(Phase phase, double time, GameState& state) const;

  protocol::TeamName team_;
  bool started_ = false;  // the first message was seen
  bool played_ = false;   // the game has been under way in this half
  bool sideKnown_ = true;
  double halfSince_ = 0.0;  // server time at which half time was noticed, s
  int scoreLeft_ = 0;
  int scoreRight_ = 0;
};

/// True if the own team defends the goal at world +x (landmarks named R).
constexpr bool playsFromRight(const GameState& game) {
  return (game.side == protocol::TeamSide::Right) != game.sidesSwapped;
}

}  // namespace nonet::world
