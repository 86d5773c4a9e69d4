#include "nonet/sim/referee/context.h"

namespace nonet::sim {

RuleTables::RuleTables() {
  for (int unum = 0; unum <= kMaxUnum; ++unum) {
    for (int side = 0; side < 3; ++side) {
      lastFoul[unum][side] = FoulType::None;
      sinceMoved[unum][side] = 50;
      lastSelfCollision[unum][side] = -1e5F;
      jointFrozenAt[unum][side].fill(kNeverFrozen);
      velocities[unum][side].fill(Vector3f::Zero());
      ballDistance[unum][side] = 1000.0F;
      goalDistance[unum][side] = 1000.0F;
    }
  }
}

bool RefereeContext::hasFoul(int unum, TeamSide side) const {
  const FoulType foul = tables.lastFoul[unum][index(side)];
  return foul != FoulType::None && (tables.foulTime[unum][index(side)] > 0 || foul == FoulType::Charging ||
                                    foul == FoulType::Touching || foul == FoulType::SelfCollision);
}

void RefereeContext::recordFoul(FoulType type, const Player& player) {
  fouls.push_back({static_cast<int>(fouls.size()) + 1, static_cast<int>(type), player.side, player.unum});
}

std::vector<Player*> RefereeContext::team(TeamSide side) {
  std::vector<Player*> members;
  for (Player& player : players) {
    if (side == TeamSide::None || player.side == side) members.push_back(&player);
  }
  return members;
}

std::vector<Player*> RefereeContext::shuffledTeam(TeamSide side) {
  std::vector<Player*> members = team(side);
  shuffle(members);
  return members;
}

Player* RefereeContext::find(TeamSide side, int unum) {
  if (side == TeamSide::None) return nullptr;
  for (Player& player : players) {
    if (player.side == side && player.unum == unum) return &player;
  }
  return nullptr;
}

}  // namespace nonet::sim
