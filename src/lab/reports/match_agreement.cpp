#include "nonet/lab/reports/match_agreement.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace nonet::lab {
namespace {

constexpr int kFirstField = 2;
constexpr std::size_t kFewest = 2;  // players that can disagree

int onBallOf(const protocol::RoleVote& vote) {
  return static_cast<int>(std::find(vote.begin(), vote.end(), 0) - vote.begin());
}

nlohmann::ordered_json json(const MatchAgreement::Count& count) {
  return {{"cycles", count.cycles},
          {"assignment", count.share(count.assignment)},
          {"on_ball", count.share(count.onBall)},
          {"distinct", count.share(count.distinct)}};
}

}  // namespace

Unity unityOf(const AgreedRoles& players) {
  Unity unity{true, true, true};
  std::set<int> taken;
  const protocol::RoleVote* first = nullptr;
  for (const auto& [unum, vote] : players) {
    if (!vote) return {};
    if (first == nullptr) first = &*vote;
    unity.onBall = unity.onBall && onBallOf(*vote) == onBallOf(*first);
    unity.distinct =
        unity.distinct && taken.insert((*vote)[static_cast<std::size_t>(unum - kFirstField)]).second;
    for (const auto& [other, unused] : players) {
      const auto i = static_cast<std::size_t>(other - kFirstField);
      unity.assignment = unity.assignment && (*vote)[i] == (*first)[i];
    }
  }
  return unity;
}

void MatchAgreement::afterThought(const Thought& thought) {
  const agent::AgentSettings& settings = thought.agent.settings();
  if (settings.unum >= kFirstField) thoughts_[settings.team][settings.unum] = thought.agent.agreedRoles();
}

void MatchAgreement::afterCycle(const sim::Simulation& simulation) {
  using protocol::PlayMode;
  const PlayMode mode = simulation.match().playMode;
  const bool runs = mode != PlayMode::BeforeKickOff && mode != PlayMode::GameOver &&
                    mode != PlayMode::GoalLeft && mode != PlayMode::GoalRight;
  for (auto& [team, players] : thoughts_) {
    if (runs && players.size() >= kFewest) {
      const Unity unity = unityOf(players);
      Count& count = counts_[team];
      ++count.cycles;
      count.assignment += unity.assignment ? 1 : 0;
      count.onBall += unity.onBall ? 1 : 0;
      count.distinct += unity.distinct ? 1 : 0;
    }
    players.clear();
  }
}

MatchAgreement::Count MatchAgreement::all() const {
  Count sum;
  for (const auto& [team, count] : counts_) {
    sum.cycles += count.cycles;
    sum.assignment += count.assignment;
    sum.onBall += count.onBall;
    sum.distinct += count.distinct;
  }
  return sum;
}

nlohmann::ordered_json MatchAgreement::toJson() const {
  nlohmann::ordered_json result = {{"all", json(all())}};
  for (const auto& [team, count] : counts_) result["teams"][team] = json(count);
  return result;
}

std::string MatchAgreement::toText() const {
  std::string text = fmt::format("\nagreement, share of cycles in %\n{:<14} {:>8} {:>16} {:>13} {:>15}\n", "",
                                 "cycles", "same assignment", "same on ball", "distinct roles");
  const auto row = [&](const std::string& name, const Count& count) {
    text += fmt::format("{:<14} {:>8} {:>16.1f} {:>13.1f} {:>15.1f}\n", name, count.cycles,
                        100.0 * count.share(count.assignment), 100.0 * count.share(count.onBall),
                        100.0 * count.share(count.distinct));
  };
  for (const auto& [team, count] : counts_) row(team, count);
  row("both", all());
  return text;
}

}  // namespace nonet::lab
