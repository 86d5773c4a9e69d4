#include "nonet/team/radio.h"

#include <algorithm>
#include <cmath>

#include "nonet/protocol/say_codec.h"

namespace nonet::team {

std::optional<InlineString<64>> Radio::update(const world::WorldState& world, const Tidings& tidings) {
  const bool before = inOwnSlot_;
  inOwnSlot_ = world.game.unum > 0 && protocol::saySlot(world.time) == world.game.unum;
  // A listener hears one team mate in two cycles: the second message of a slot would be lost.
  if (!inOwnSlot_ || before) return std::nullopt;

  protocol::SayMessage message;
  message.unum = world.game.unum;
  message.X_FR = world.self.X_FR;
  message.sigma = world.self.localized ? std::sqrt(world.self.covariance.topLeftCorner<2, 2>().trace())
                                       : parameters_.lostSigma;
  message.fallen = world::isFallen(world.body.posture);
  const double age = world.time - world.ball.lastSeen;
  if (world.self.localized && world.ball.known && age < parameters_.oldestBall) {
    message.ball = {world.ball.p_FB.head<2>(), world.ball.v_FB.head<2>(), std::max(age, 0.0)};
    message.timeToBall = tidings.timeToBall;
  }
  message.vote = tidings.vote;
  return protocol::encodeSay(message, world.game.team);
}

}  // namespace nonet::team
