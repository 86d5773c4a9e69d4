// A robot's body on a server, over TCP: agent port for senses and commands, monitor port for placing things
// and for the truth about them (server facts 1.3, 5.1-5.5).
#pragma once

#include <memory>
#include <string_view>

#include "nonet/agent/robot.h"
#include "nonet/lab/trial/server_address.h"
#include "nonet/world/ball_law.h"

namespace nonet::lab {

class ServerBody {
 public:
  /// Enters as number 2 of the left team. The server must be otherwise empty, and works in lock-step or by
  /// the clock. Throws std::runtime_error that names the address when it cannot be reached or refuses.
  ServerBody(const agent::RobotSettings& settings, const ServerAddress& address);
  ~ServerBody();

  /// Answers one message, and waits for the next one.
  void step(const team::Action& action);
  /// One command for the server's trainer.
  void train(std::string_view command);
  /// Puts it there upright, at rest, a little above the ground.
  void move(const Pose2& X_FR);

  const agent::Robot& robot() const;

  // -- truth, of the server's last picture
  Pose2 pose() const;  // torso on the ground, heading
  /// Torso below 0.55 of the standing height: it lies or kneels.
  bool down() const;
  /// Its velocity is the way between two pictures; told only while the game's clock runs.
  const world::BallMotion& ball() const;
  /// The game goes on: the referee has put the ball nowhere.
  bool playsOn() const;
  /// Fouls for self-collision that the referee has given until then.
  int selfCollisions() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace nonet::lab
