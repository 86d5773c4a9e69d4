// Follows a monitor stream (server facts 5.1 to 5.4), live or from a log: the game's state and where the ball
// and every part of every robot are. A full message names what the scene's nodes are; the differences after
// it keep their order, so a part is known by its place.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "nonet/math/types.h"
#include "nonet/protocol/percept.h"
#include "nonet/protocol/play_mode.h"
#include "nonet/protocol/sexpr_reader.h"

namespace nonet::protocol {

/// Pose of a body in the world as the stream has it: column-major, server axes of the body (x right, y
/// forward), metres.
using MonitorMatrix = std::array<float, 16>;

/// The same as a pose with the body's axes as everywhere else (x forward, y left, z up).
Pose3 poseFromMonitor(const MonitorMatrix& matrix);

struct MonitorRobot {
  TeamSide side = TeamSide::None;     // None until the server has accepted it
  int unum = 0;                       // 0 until then
  int robotType = 0;                  // 0..4
  std::vector<MonitorMatrix> bodies;  // in the order of model::robotModel(robotType).bodies()
};

struct MonitorFoul {
  int index = 0;  // counts from 1
  int type = 0;   // server facts 4.10
  TeamSide side = TeamSide::None;
  int unum = 0;
};

struct MonitorGame {
  double time = 0.0;  // of the game, s: stands still before the kick-off
  int half = 1;
  int scoreLeft = 0;
  int scoreRight = 0;
  PlayMode playMode = PlayMode::Unknown;
  std::string teamLeft;
  std::string teamRight;
};

class MonitorReader {
 public:
  /// Takes one message. False if it makes no sense: it is then as if it had not come, apart from what was
  /// read up to the place in question. A difference before the first full message makes no sense.
  bool feed(std::string_view message);

  const MonitorGame& game() const { return game_; }
  /// Numbers that only full messages bring: FieldLength, GoalWidth, BallRadius, ...
  const std::map<std::string, double, std::less<>>& field() const { return field_; }
  const MonitorMatrix& ball() const { return ball_; }
  /// In the order in which they connected.
  const std::vector<MonitorRobot>& robots() const { return robots_; }
  /// Fouls that came with the last message.
  const std::vector<MonitorFoul>& newFouls() const { return newFouls_; }
  bool lastWasFull() const { return full_; }

 private:
  // What a node at the top of the scene is.
  static constexpr int kNothing = -1;
  static constexpr int kBall = -2;  // others: index of the robot

  // What the meshes below a node have told.
  struct Look {
    bool ball = false;
    int robotType = -1;
    TeamSide side = TeamSide::None;
    int unum = 0;
  };

  bool readEnvironment();
  void readPredicate(std::string_view name);
  void readFoul();
  bool readScene();
  bool readFullNode();
  bool readDifferenceNode(std::size_t place);
  bool readMatrix(MonitorMatrix& matrix);
  void readLook(int depth, Look& look);
  void readMaterials(Look& look);

  SexprReader reader_{std::string_view()};
  MonitorGame game_;
  std::map<std::string, double, std::less<>> field_;
  std::vector<PlayMode> modes_;  // by the numbers of this stream
  MonitorMatrix ball_{};
  std::vector<MonitorRobot> robots_;
  std::vector<MonitorFoul> newFouls_;
  std::vector<int> plan_;  // per node at the top of the scene
  bool full_ = false;
};

}  // namespace nonet::protocol
