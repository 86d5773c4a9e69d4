// A recorded experiment's server, as far as it matters to the physics: connection and birth of the robots,
// the delay between a command and its effect, trainer commands, and the referee's hand on the ball.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "nonet/sim/fidelity/fidelity.h"

namespace nonet::sim {

class ReplayServer {
 public:
  /// Sent in answer to one message, by all agents and by the trainer.
  struct Answer {
    std::vector<std::vector<std::pair<model::JointId, float>>> speeds;  // by robot
    std::string trainer;
    std::string extra;  // effectors of the first robot: "(beam x y angle)"
  };

  ReplayServer(const WorldSettings& settings, int robotType, int robotCount);

  /// Connects the robots one after the other as the recording agents did, up to the first free message in
  /// PlayOn.
  void connectRobots();
  /// Adds the robots at once, without any history.
  void addRobots();

  /// One cycle: the answer to the message before the newest one takes effect, `answer` is kept for the next
  /// cycle. (A command is seen in the second message after the one that it answers: server facts 1.2.)
  void step(const Answer& answer);
  void setPending(const Answer& answer) { pending_ = answer; }
  /// Keeps the ball in the middle after each step (BeforeKickOff), or not.
  void holdBall(bool hold) { ballHeld_ = hold; }
  void ballToCentre();

  World& world() { return world_; }
  RobotHandle robot(std::size_t index) const { return robots_[index]; }
  std::size_t robotCount() const { return robots_.size(); }
  /// Joint angle of the newest message, degrees as printed.
  double printedAngle(std::size_t robot, model::JointId joint) const;

 private:
  void cycle(const Answer& answer);
  void trainer(std::string_view command);
  void deferBeam(std::string_view effectors);
  void plainCycles(int count);
  void birth();

  World world_;
  int robotType_;
  int robotTotal_;
  std::vector<RobotHandle> robots_;
  Answer pending_;
  bool ballHeld_ = false;
  bool newRobot_ = false;
};

/// Replays what happened before the recording of a known scenario; false if the scenario is not known.
bool replayHistory(const std::string& scenario, ReplayServer& server);

/// Places the robots and the ball where the cycle has them (to the millimetre and a tenth of a degree) and
/// lets them stand for a second with straight joints; false if the robots in the cycle do not stand like
/// that.
bool replayStanding(const RecordedCycle& start, ReplayServer& server);

}  // namespace nonet::sim
