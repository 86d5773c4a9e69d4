#include "nonet/team/role_voting.h"

#include <algorithm>

namespace nonet::team {

namespace {

constexpr int kFirstField = 2;  // number 1 is the goalie, which has no vote to win

// The field players that are there, in the order of their numbers.
struct Squad {
  std::array<Vector2, kMaxAssigned> places{};
  std::array<double, kMaxAssigned> times{};  // s to the ball
  std::array<int, kMaxAssigned> unums{};
  std::size_t count = 0;
};

int playerOnBall(const protocol::RoleVote& vote) {
  const auto* found = std::find(vote.begin(), vote.end(), static_cast<std::uint8_t>(Role::OnBall));
  return static_cast<int>(found - vote.begin()) + kFirstField;
}

// Everybody has the role of its number, but the one on the ball. There is one number more than roles, so the
// last one takes the role that is left.
protocol::RoleVote fixedVote(int onBall) {
  protocol::RoleVote vote{};
  const auto ball = static_cast<std::size_t>(onBall - kFirstField);
  for (std::size_t i = 0; i < vote.size(); ++i) vote[i] = static_cast<std::uint8_t>(i + 1);
  vote.back() = static_cast<std::uint8_t>(ball + 1);
  vote[ball] = static_cast<std::uint8_t>(Role::OnBall);
  return vote;
}

// s by which another one must be sooner: less when it is still far, nothing when it lies.
double keepsFor(const Situation& situation, int unum) {
  const auto number = static_cast<std::size_t>(unum);
  if (situation.world.teammates[number].fallen) return 0.0;
  const double near = 1.5 - 0.5 * situation.timeToBall[number];  // 1 when it is a second away
  return situation.parameters.keepBallTime * std::clamp(near, situation.parameters.keepBallFar, 1.0);
}

// Votes from before a player fell do not know of that. All that are there if each names one that lies.
std::size_t withoutVotesForWhoLies(const world::WorldState& world,
                                   std::span<const protocol::RoleVote*> votes) {
  const auto lies = [&](const protocol::RoleVote* vote) {
    return world.teammates[static_cast<std::size_t>(playerOnBall(*vote))].fallen;
  };
  if (std::all_of(votes.begin(), votes.end(), lies)) return votes.size();
  return static_cast<std::size_t>(std::remove_if(votes.begin(), votes.end(), lies) - votes.begin());
}

}  // namespace

void RoleVoting::update(const Situation& situation, int banned) {
  const world::WorldState& world = situation.world;
  // A vote is cast when it is one's turn to speak, so that everybody counts the same votes.
  const bool inOwnSlot = protocol::saySlot(world.time) == world.game.unum;
  if (!world.self.localized || !world.ball.known) {
    vote_.reset();
  } else if (inOwnSlot && !inOwnSlot_) {
    vote(situation, banned);
  }
  inOwnSlot_ = inOwnSlot;
  count(situation, banned);
  if (situation.parameters.variant.allBall) {
    onBall_ = world.game.unum;
    role_ = Role::OnBall;
  }
}

void RoleVoting::vote(const Situation& situation, int banned) {
  const world::WorldState& world = situation.world;
  const AgreementParameters& parameters = situation.parameters.agreement;
  Squad squad;
  for (int unum = kFirstField; unum <= world::kTeamSize; ++unum) {
    const auto number = static_cast<std::size_t>(unum);
    const world::PlayerState& player = world.teammates[number];
    if (!player.known) continue;
    const std::size_t i = squad.count++;
    squad.unums[i] = unum;
    squad.places[i] = player.X_FP.translation;
    squad.times[i] = situation.timeToBall[number];
    const world::RadioReport& report = world.radio[number];
    const double since = world.time - report.time;
    const bool silent = since < parameters.voteAge && !report.message.timeToBall;
    if (silent) squad.times[i] += parameters.silentPenalty;
    if (unum == banned || situation.hasGone(unum)) squad.times[i] += parameters.bannedPenalty;
    // Before a kick-off players come in one by one, and nobody is on its way yet.
    if (unum == onBall_ && !situation.waitsForKickOff()) squad.times[i] -= keepsFor(situation, unum);
  }
  if (squad.count == 0) return;

  // The player soonest at the ball takes it; the others share the rest so that nobody has far to go.
  const auto* soonest = std::min_element(squad.times.begin(), squad.times.begin() + squad.count);
  const auto onBall = static_cast<std::size_t>(soonest - squad.times.begin());
  protocol::RoleVote vote;
  vote.fill(protocol::kVoteSize);
  std::array<Vector2, kMaxAssigned> places{};
  std::array<std::size_t, kMaxAssigned> index{};
  std::size_t others = 0;
  for (std::size_t i = 0; i < squad.count; ++i) {
    index[others] = static_cast<std::size_t>(squad.unums[i] - kFirstField);
    if (i == onBall)
      vote[index[others]] = static_cast<std::uint8_t>(Role::OnBall);
    else
      places[others++] = squad.places[i];
  }
  if (situation.parameters.variant.fixedRoles) {
    vote_ = fixedVote(squad.unums[onBall]);
    return;
  }
  const Assignment assignment =
      assigner_.assign({places.data(), others}, {situation.formation.positions.data() + 1, others});
  for (std::size_t i = 0; i < others; ++i) vote[index[i]] = static_cast<std::uint8_t>(assignment[i] + 1);
  // Whoever is not there gets what is left: a vote is a whole permutation.
  auto next = static_cast<std::uint8_t>(squad.count);
  for (std::uint8_t& role : vote)
    if (role == protocol::kVoteSize) role = next++;
  vote_ = vote;
}

void RoleVoting::count(const Situation& situation, int banned) {
  const world::WorldState& world = situation.world;
  const double voteAge = situation.parameters.agreement.voteAge;
  std::array<const protocol::RoleVote*, world::kTeamSize> votes{};
  std::size_t number = 0;
  for (int unum = 1; unum <= world::kTeamSize; ++unum) {
    const world::RadioReport& report = world.radio[static_cast<std::size_t>(unum)];
    const bool own = unum == world.game.unum;
    const bool heard = !own && world.time - report.time < voteAge && report.message.vote;
    const protocol::RoleVote* vote = nullptr;
    if (own && vote_) vote = &*vote_;
    if (heard) vote = &*report.message.vote;
    // Votes from before a set piece was taken do not know of the ban.
    if (vote != nullptr && (banned == 0 || playerOnBall(*vote) != banned)) votes[number++] = vote;
  }
  number = withoutVotesForWhoLies(world, {votes.data(), number});
  if (number == 0) return;

  // First the player on the ball, then the most common of the votes that agree on that; the earlier speaker
  // wins a draw, but whoever is on the ball already stays.
  const int before = onBall_;
  int best = -1;
  for (std::size_t i = 0; i < number; ++i) {
    const int player = playerOnBall(*votes[i]);
    int supporters = 0;
    for (std::size_t j = 0; j < number; ++j) supporters += playerOnBall(*votes[j]) == player ? 2 : 0;
    if (player == before) ++supporters;
    if (supporters > best) onBall_ = player;
    best = std::max(best, supporters);
  }
  const protocol::RoleVote* winner = nullptr;
  long most = 0;
  for (std::size_t i = 0; i < number; ++i) {
    if (playerOnBall(*votes[i]) != onBall_) continue;
    const long same = std::count_if(votes.begin(), votes.begin() + number,
                                    [&](const auto* vote) { return *vote == *votes[i]; });
    if (same > most) winner = votes[i];
    most = std::max(most, same);
  }
  if (winner == nullptr) return;
  agreed_ = *winner;
  const int me = world.game.unum - kFirstField;
  if (me >= 0) role_ = static_cast<Role>((*winner)[static_cast<std::size_t>(me)]);
}

}  // namespace nonet::team
