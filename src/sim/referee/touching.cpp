// Touching (server facts 4.10): robots in contact form groups, and a group must not be too large.
#include <algorithm>

#include "nonet/sim/referee/fouls.h"

namespace nonet::sim {

namespace {

// Feet and toes have no collision handler of their own in the server: a contact counts if either part has
// one.
bool records(const ContactParty& party) {
  using model::BodyId;
  return party.body != BodyId::RFoot && party.body != BodyId::LFoot && party.body != BodyId::RToe &&
         party.body != BodyId::LToe;
}

}  // namespace

void Fouls::joinTouchGroups(Player& a, Player& b) {
  if (a.touchGroup == b.touchGroup) return;
  const int first = a.touchGroup;
  const int second = b.touchGroup;
  const int joined = std::min(first, second);
  for (Player& player : c_.players) {
    if (player.inTouchGroup && (player.touchGroup == first || player.touchGroup == second))
      player.touchGroup = joined;
  }
}

void Fouls::collectContacts() {
  const auto playerOf = [this](RobotHandle robot) -> Player* {
    const auto it = std::find_if(c_.players.begin(), c_.players.end(),
                                 [robot](const Player& player) { return player.robot == robot; });
    return it == c_.players.end() ? nullptr : &*it;
  };
  for (const ContactPair& pair : c_.world.contacts()) {
    if (pair.first.kind != ContactParty::Kind::Robot || pair.second.kind != ContactParty::Kind::Robot)
      continue;
    // The handler of each part is called once per contact point.
    const int calls = pair.pointCount * ((records(pair.first) ? 1 : 0) + (records(pair.second) ? 1 : 0));
    Player* a = playerOf(pair.first.robot);
    Player* b = playerOf(pair.second.robot);
    if (calls == 0 || a == nullptr || b == nullptr || a == b) continue;
    joinTouchGroups(*a, *b);
    if (b->side == TeamSide::Left) std::swap(a, b);
    if (a->side != TeamSide::Left || b->side != TeamSide::Right) continue;
    auto contact = std::find_if(
        opponentContacts.begin(), opponentContacts.end(),
        [&](const OpponentContact& c) { return c.leftUnum == a->unum && c.rightUnum == b->unum; });
    if (contact == opponentContacts.end()) {
      opponentContacts.push_back({a->unum, b->unum, Vector3f::Zero(), 0});
      contact = opponentContacts.end() - 1;
    }
    const float before = static_cast<float>(contact->count);
    const float now = static_cast<float>(calls);
    contact->meanPosition = (contact->meanPosition * before + pair.meanPosition * now) / (before + now);
    contact->count += calls;
  }
}

void Fouls::forgetContacts() {
  opponentContacts.clear();
}

void Fouls::forgetContacts(const Player& player) {
  std::erase_if(opponentContacts, [&player](const OpponentContact& contact) {
    return (player.side == TeamSide::Left && contact.leftUnum == player.unum) ||
           (player.side == TeamSide::Right && contact.rightUnum == player.unum);
  });
}

void Fouls::renewTouchGroups() {
  for (Player& player : c_.players) {
    player.touchGroupSizeBefore = touchGroupSize(player.touchGroup);
  }
  for (Player& player : c_.players) {
    if (player.side == TeamSide::None) continue;
    player.touchGroup = c_.nextTouchGroup++;
    player.inTouchGroup = true;
  }
  opponentContacts.clear();
}

int Fouls::touchGroupSize(int group) const {
  return static_cast<int>(std::count_if(c_.players.begin(), c_.players.end(), [group](const Player& player) {
    return player.inTouchGroup && player.touchGroup == group;
  }));
}

void Fouls::judgeTouching(TeamSide side, bool onlyNewcomers) {
  const int allowed = c_.settings.maxTouchGroupSize;
  for (Player* player : c_.shuffledTeam(side)) {
    if (c_.hasFoul(*player)) {
      if (touchGroupSize(player->touchGroup) > 1) player->inTouchGroup = false;
      continue;
    }
    if (onlyNewcomers && player->touchGroupSizeBefore != 1) continue;
    if (touchGroupSize(player->touchGroup) > allowed) judgeTouchGroup(*player, side);
  }
  if (!onlyNewcomers) return;
  for (const Player* player : c_.team(side)) {
    if (touchGroupSize(player->touchGroup) > allowed) {
      judgeTouching(side, false);
      return;
    }
  }
}

void Fouls::judgeTouchGroup(Player& player, TeamSide side) {
  const int allowed = c_.settings.maxTouchGroupSize;
  std::vector<Player*> group;
  for (Player& other : c_.players) {
    if (other.inTouchGroup && other.touchGroup == player.touchGroup) group.push_back(&other);
  }
  c_.shuffle(group);
  Player* teamMate = nullptr;  // the last of each team that is not its goalkeeper
  Player* opponent = nullptr;
  int own = 0;
  int innocent = 0;
  Vector3f sum = Vector3f::Zero();
  for (Player* member : group) {
    if (c_.hasFoul(*member)) continue;
    ++innocent;
    sum += c_.sceneTorso(*member);
    if (member->side == side) ++own;
    if (member->unum != 1 || allowed < 2) (member->side == side ? teamMate : opponent) = member;
  }
  if (innocent <= allowed) return;
  const Vector3f center = sum / static_cast<float>(innocent);
  Player* guilty = opponent;
  if (own >= static_cast<int>(group.size()) - own) {
    guilty = player.unum == 1 && allowed > 1 ? teamMate : &player;
  }
  // Only goalkeepers in the group: the server would follow an invalid reference here.
  if (guilty == nullptr) return;
  punishTouching(*guilty, center);
  guilty->inTouchGroup = false;
}

void Fouls::punishTouching(Player& player, const Vector3f& groupCenter) {
  countFoul(c_.records.of(player), FoulType::Touching);
  if (c_.settings.touchingFoulBeamPenalty) return;
  Vector3f place = c_.sceneTorso(player);
  place.head<2>() += directionOf(place.head<2>() - groupCenter.head<2>()) * c_.agentRadius();
  placing_.move(player, place);
}

}  // namespace nonet::sim
