// The automatic referee's rules about robots (server facts 4.10): incapable, illegal defence, crowding,
// touching, charging, self-collision, and their punishment. They run in every mode but before kick-off and
// after a goal.
#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "nonet/sim/referee/context.h"
#include "nonet/sim/referee/placing.h"

namespace nonet::sim {

class Fouls {
 public:
  Fouls(RefereeContext& context, Placing& placing) : c_(context), placing_(placing) {}

  /// Notes which robots touch in the last step. Every cycle, before update().
  void collectContacts();
  /// One cycle of all rules.
  void update();
  /// While the game is paused: all counters start anew, frozen joints are released.
  void reset();
  /// Velocities for charging. Every cycle, after the set piece rules.
  void sampleVelocities();
  /// Forgets all contacts, when sides change; or those of a player who leaves or gets another number.
  void forgetContacts();
  void forgetContacts(const Player& player);
  /// Releases all joints of this robot, and forgets when they were frozen.
  void thaw(const Player& player);

  /// A pair of opponents in contact, with the mean of all contact points since the rules last looked.
  struct OpponentContact {
    int leftUnum = 0;
    int rightUnum = 0;
    Vector3f meanPosition = Vector3f::Zero();
    int count = 0;
  };
  std::vector<OpponentContact> opponentContacts;

 private:
  void measure(TeamSide side);
  void countPosture(const Player& player, float height, float y);
  void rank(const std::vector<Player*>& players, float PlayerRecord::*distance, int PlayerRecord::*rank);
  void resetPlayer(PlayerRecord& record) const;
  /// The player's foul begins, or goes on for another cycle.
  static void countFoul(PlayerRecord& record, FoulType foul);

  void judgeCharging();
  void judgeChargingPair(const Player& left, const Player& right, const Vector3f& contact, RuleRecords& next);
  void judgeSelfCollisions(TeamSide side);
  void selfCollision(const Player& player, model::BodyId first, model::BodyId second);
  void writeSelfCollision(const std::string& line);
  void thawJoints();
  void judgePositions(TeamSide side);
  bool isCrowding(TeamSide side, int unum) const;
  bool isIllegalDefence(TeamSide side, int unum) const;
  bool isIncapable(TeamSide side, int unum) const;
  void punishIllegalDefence(TeamSide side, int unum);
  void judgeTouching(TeamSide side, bool onlyNewcomers = true);
  void judgeTouchGroup(Player& player, TeamSide side);
  void punishTouching(Player& player, const Vector3f& groupCenter);
  int touchGroupSize(int group) const;
  void punish(TeamSide side);
  void renewTouchGroups();
  void joinTouchGroups(Player& a, Player& b);

  RefereeContext& c_;
  Placing& placing_;
  std::ofstream selfCollisionFile_;
};

}  // namespace nonet::sim
