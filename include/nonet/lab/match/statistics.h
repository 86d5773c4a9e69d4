// What happened in a match, counted from plain frames (frame.h), so that matches in this process, on the
// embedded server and on any other server are counted by the same code. Frames may come at 5 to 50 Hz; ball
// and robots are looked at every 0.1 s of game time, or as often as frames come.
//
// What the words mean:
//   touch      the ball changes its way, or moves, next to a robot; the nearest one has touched it
//   kick       a touch that makes the ball 1 m/s faster, to 1.5 m/s or more
//   shot       a kick whose ball would reach the goal line within 1 m of the goal; on target: within the
//   goal.
//              Every goal is a shot on target
//   pass       in play, the ball goes 2 m or more from a player's touch to the next touch of another player,
//              or out, and was no shot and no set piece; completed: that player is a mate
//   goal       of whom the ball came last; deflected, it is the shooter's and no own goal: a shot on target
//              that the other team touched less than 3 s before without kicking it
//              Its time is also told from the last kick-off on, taken or dropped
//   save       the goalkeeper (number 1) is the next to touch a shot on target, and it does not become a goal
//   possession share of the time in play in which a team was the last to touch the ball
//   duel       robots of both teams on their feet within 0.7 m of the ball for 0.5 s or more; won by the team
//              that is nearer to the ball when the other one is 1 m away
//   fall       the torso's up axis goes below 0.5; up again above 0.9
//   walked     distance between places half a second apart, on the feet
#pragma once

#include <array>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "nonet/lab/match/frame.h"

namespace nonet::lab {

/// Sizes that decide what is in and on target, m.
struct StatisticsField {
  double length = 30.0;
  double width = 20.0;
  double goalWidth = 2.1;
};

/// One player's part.
struct PlayerStatistics {
  int robotType = 0;
  int falls = 0;
  double secondsDown = 0.0;
  double walked = 0.0;      // m, in play
  double secondsUp = 0.0;   // in play, on the feet
  double bestSpeed1 = 0.0;  // m/s, best mean over one second in play, on the feet
  double bestSpeed3 = 0.0;  // over three seconds
  int touches = 0;
  int kicks = 0;
  int goals = 0;
  std::map<std::string, double> secondsInRole;
  std::vector<int> places;  // samples per cell of the field, own team towards +x: kPlaceColumns x kPlaceRows
};
inline constexpr int kPlaceColumns = 15;
inline constexpr int kPlaceRows = 10;

struct KickStatistics {
  double time = 0.0;  // s
  int unum = 0;
  double speed = 0.0;              // m/s, greatest after the touch
  Vector2 from = Vector2::Zero();  // own team towards +x, m
  Vector2 to = Vector2::Zero();    // where it was touched again, went out or lay still
  bool shot = false;
  bool onTarget = false;
  bool setPiece = false;
  std::string name;     // of the kick in skills/; empty: a push, or not known
  std::string outcome;  // "goal", "saved", "mate", "opponent", "self", "out", "open"

  double distance() const { return (to - from).norm(); }
};

/// All kicks of one name.
struct KickKind {
  int count = 0;
  double distance = 0.0;  // m, all together
  std::map<std::string, int> outcomes;
};

struct SetPieceStatistics {
  int count = 0;
  double seconds = 0.0;  // until play goes on, all together
  double longest = 0.0;
};

struct TeamStatistics {
  int shots = 0;
  int shotsOnTarget = 0;
  int passesTried = 0;
  int passesCompleted = 0;
  int saves = 0;
  int duelsWon = 0;
  double possession = 0.0;  // s
  std::vector<KickStatistics> kicks;
  std::map<std::string, SetPieceStatistics> setPieces;
  std::map<std::string, int> fouls;
  std::map<int, PlayerStatistics> players;  // by number

  /// The kicks by name; "" are those without one.
  std::map<std::string, KickKind> kicksByName() const;
};

struct GoalStatistics {
  double time = 0.0;  // s
  TeamIndex team = 0;
  int scorer = 0;  // number; 0: not known
  bool own = false;
  std::optional<double> afterKickOff;  // s since play went on from a kick-off, taken or dropped
};

/// The name of a foul of that number: "touching", "charging", ...
std::string_view foulName(int type);

class MatchStatistics {
 public:
  explicit MatchStatistics(const StatisticsField& field = {});

  void add(const Frame& frame);

  const TeamStatistics& team(TeamIndex index) const { return teams_[static_cast<std::size_t>(index)]; }
  const std::vector<GoalStatistics>& goals() const { return goals_; }
  int duels() const { return duels_; }
  double secondsInPlay() const { return secondsInPlay_; }
  /// Seconds in play that the ball was in each third, seen from team 0: own, middle, the other's.
  const std::array<double, 3>& thirds() const { return thirds_; }
  nlohmann::ordered_json toJson() const;

 private:
  struct Track {  // of one robot
    std::optional<bool> down;
    struct Place {
      double time = 0.0;
      Vector2 p_W = Vector2::Zero();
    };
    std::deque<Place> places;   // the last three seconds without a break
    std::optional<Place> step;  // where half a second began
  };
  struct Touch {
    TeamIndex team = 0;
    int unum = 0;
    double begin = 0.0;
    double last = 0.0;                   // newest moment of contact, s
    Vector2 p_W = Vector2::Zero();       // of the ball, at the newest moment
    double before = 0.0;                 // speed of the ball before, m/s
    double speed = 0.0;                  // greatest after
    Vector2 velocity = Vector2::Zero();  // at that greatest speed
    bool setPiece = false;
    bool swapped = false;
    std::string kick;  // name

    bool isKick() const;
  };
  // A shot on target that the other team has touched, until it is sure that it does not go in all the same.
  struct Deflected {
    TeamIndex team = 0;
    int unum = 0;
    double time = 0.0;       // of the other team's touch, s
    std::size_t record = 0;  // in the kicks of its team
  };

  void newMode(const Frame& frame);
  void newGoals(const Frame& frame);
  void countFoul(const FrameFoul& foul, double time);
  void sample(const Frame& frame, double step);
  void sampleRobots(const Frame& frame, double step, bool inPlay);
  void samplePace(const FrameRobot& robot, Track& track, PlayerStatistics& player, double time);
  void sampleBall(const Frame& frame, double step);
  void sampleDuel(const Frame& frame);
  void touched(const Frame& frame, const FrameRobot& robot, const Vector2& velocity, double before);
  void refreshTouch(const Frame& frame, const Vector2& velocity);
  bool sameContact(const Frame& frame, const FrameRobot& robot, const Vector2& velocity, double step) const;
  /// The ball's way after the last touch is over: the next touch, a goal, out, or the end.
  void closeTouch(const std::string& outcome, const Vector2& p_WEnd, TeamIndex nextTeam, int nextUnum);
  bool isShot(const Touch& touch, double margin) const;
  void scored(TeamIndex team, GoalStatistics& goal, const Frame& frame);
  PlayerStatistics& player(TeamIndex team, int unum);
  TeamStatistics& teamAt(TeamIndex index) { return teams_[static_cast<std::size_t>(index)]; }
  nlohmann::ordered_json teamJson(TeamIndex index) const;

  StatisticsField field_;
  std::map<std::tuple<TeamIndex, int, int>, double> fouledAt_;  // team, number, kind: newest record, s
  std::array<TeamStatistics, 2> teams_;
  std::vector<GoalStatistics> goals_;
  int duels_ = 0;
  double secondsInPlay_ = 0.0;
  std::array<double, 3> thirds_{};
  std::vector<int> ballPlaces_;                  // cells of 1 m, seen from team 0
  std::vector<std::array<double, 3>> ballPath_;  // time, x, y once a second in play, seen from team 0
  double endTime_ = 0.0;

  bool any_ = false;
  protocol::PlayMode mode_ = protocol::PlayMode::BeforeKickOff;
  std::array<int, 2> score_{};
  double modeSince_ = 0.0;
  TeamIndex modeTeam_ = -1;
  double playSince_ = 0.0;              // play goes on since, s
  bool fromSetPiece_ = false;           // and came from a set piece
  std::optional<double> kickOffSince_;  // play went on from the last kick-off at, s

  std::optional<double> sampleTime_;
  Vector2 p_WBall_ = Vector2::Zero();  // at sampleTime_
  std::optional<Vector2> velocity_;    // of the ball, before sampleTime_
  std::map<std::pair<TeamIndex, int>, Track> tracks_;
  std::optional<Touch> touch_;  // the last one, while its ball is on the way
  std::optional<Deflected> deflected_;
  std::optional<double> duelSince_;
};

}  // namespace nonet::lab
