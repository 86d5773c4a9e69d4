// Where a kick is tried: a robot that wants to kick, the ball, and the truth about both.
#pragma once

#include <memory>

#include "nonet/lab/trial/server_address.h"
#include "nonet/sim/settings/settings.h"
#include "nonet/world/ball_law.h"

#include "lab/trial/kicker.h"

namespace nonet::lab {

class KickStage {
 public:
  virtual ~KickStage() = default;
  /// One cycle of 20 ms.
  virtual void step() = 0;
  virtual double time() const = 0;  // s since the trial began
  virtual world::BallMotion ball() const = 0;
  /// The robot lies or kneels.
  virtual bool down() const = 0;
  /// The referee has frozen limbs of the robot since the trial began, because they collided.
  virtual bool selfCollided() const = 0;
  /// The ball is in play: in the field, where nobody has put it.
  virtual bool playsOn() const = 0;
};

/// In this process.
std::unique_ptr<KickStage> makeKickStage(const sim::Settings& settings, const KickGame& game,
                                         std::uint64_t seed);

/// On a server that is otherwise empty. Throws std::runtime_error when it cannot be reached or refuses.
std::unique_ptr<KickStage> connectKickStage(const KickGame& game, const ServerAddress& address,
                                            std::uint64_t seed);

}  // namespace nonet::lab
