#include "nonet/sim/referee/context.h"

namespace nonet::sim {

bool RefereeContext::hasFoul(TeamSide side, int unum) const {
  const PlayerRecord& record = records.of(side, unum);
  const FoulType foul = record.lastFoul;
  return foul != FoulType::None && (record.foulTime > 0 || foul == FoulType::Charging ||
                                    foul == FoulType::Touching || foul == FoulType::SelfCollision);
}

void RefereeContext::recordFoul(FoulType type, const Player& player) {
  fouls.push_back({static_cast<int>(fouls.size()) + 1, static_cast<int>(type), player.side, player.unum});
}

std::vector<Player*> RefereeContext::team(TeamSide side) {
  std::vector<Player*> members;
  members.reserve(players.size());
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
