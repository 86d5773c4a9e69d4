#include <algorithm>

#include <fmt/format.h>

#include "nonet/lab/match/match.h"

namespace nonet::lab {

namespace {

nlohmann::ordered_json jsonOf(const DurationCounts& counts) {
  nlohmann::ordered_json json = {{"count", counts.count()}, {"longest_ms", 1000.0 * counts.longest()}};
  for (std::size_t i = 0; i < DurationCounts::kBounds.size(); ++i) {
    json[fmt::format("longer_than_{:.0f}_ms", 1000.0 * DurationCounts::kBounds[i])] = counts.longerThan(i);
  }
  return json;
}

std::string textOf(const DurationCounts& counts) {
  std::string text;
  for (std::size_t i = 0; i < DurationCounts::kBounds.size(); ++i) {
    text += fmt::format("{}{} over {:.0f}", i == 0 ? "" : ", ", counts.longerThan(i),
                        1000.0 * DurationCounts::kBounds[i]);
  }
  return text + fmt::format(" ms, the longest {:.1f} ms", 1000.0 * counts.longest());
}

}  // namespace

int MatchResult::falls(bool rightTeam) const {
  int sum = 0;
  for (const PlayerRecord& player : players) {
    if (player.rightTeam == rightTeam) sum += player.falls;
  }
  return sum;
}

bool MatchResult::flawless() const {
  return finished && timeouts == 0 && droppedMessages == 0 && warnings.empty() &&
         std::all_of(players.begin(), players.end(), [](const PlayerRecord& player) {
           return player.connected && !player.gone && player.ending.empty() && player.passedOver == 0 &&
                  player.lostCycles == 0;
         });
}

nlohmann::ordered_json MatchResult::toJson() const {
  nlohmann::ordered_json json = {
      {"left", teamLeft},
      {"right", teamRight},
      {"score_left", scoreLeft},
      {"score_right", scoreRight},
      {"game_time_s", gameTime},
      {"finished", finished},
      {"flawless", flawless()},
      {"seed", seed},
      {"signature", fmt::format("{:016x}", signature)},
      {"cycles", cycles},
      {"wall_time_s", wallTime},
      {"times_real_time", wallTime > 0.0 ? static_cast<double>(cycles) * kCycleTime / wallTime : 0.0},
      {"falls_left", falls(false)},
      {"falls_right", falls(true)},
      {"timeouts", timeouts},
      {"dropped_messages", droppedMessages},
      {"violations", violations},
      {"warnings", warnings},
      {"players", nlohmann::ordered_json::array()},
  };
  if (answers.count() > 0) json["answers"] = jsonOf(answers);
  if (delays.count() > 0) json["cycle_delays"] = jsonOf(delays);
  for (const PlayerRecord& player : players) {
    json["players"].push_back({{"team", player.team},
                               {"side", player.rightTeam ? "right" : "left"},
                               {"unum", player.unum},
                               {"type", player.robotType},
                               {"connected", player.connected},
                               {"gone", player.gone},
                               {"falls", player.falls},
                               {"standing_after_kickoff_s", player.standingAfterKickOff},
                               {"messages", player.messages},
                               {"passed_over", player.passedOver},
                               {"lost_cycles", player.lostCycles},
                               {"ending", player.ending}});
  }
  return json;
}

std::string MatchResult::toText() const {
  std::string text = fmt::format("\n{} {} : {} {}   after {:.1f} s of the game{}\n", teamLeft, scoreLeft,
                                 scoreRight, teamRight, gameTime, finished ? "" : " (not played to the end)");
  text += fmt::format("{} cycles in {:.1f} s, {:.2f} times real time; seed {}, signature {:016x}\n\n", cycles,
                      wallTime, wallTime > 0.0 ? static_cast<double>(cycles) * kCycleTime / wallTime : 0.0,
                      seed, signature);
  text += fmt::format("{:<14} {:>4} {:>4} {:>5} {:>11} {:>8} {:>4} {:>6}  {}\n", "team", "unum", "type",
                      "falls", "stood for s", "messages", "late", "missed", "");
  for (const PlayerRecord& player : players) {
    text += fmt::format("{:<14} {:>4} {:>4} {:>5} {:>11.1f} {:>8} {:>4} {:>6}  {}\n", player.team,
                        player.unum, player.robotType, player.falls, player.standingAfterKickOff,
                        player.messages, player.passedOver, player.lostCycles, player.ending);
  }
  const auto crashed = std::count_if(players.begin(), players.end(),
                                     [](const PlayerRecord& player) { return !player.ending.empty(); });
  text += fmt::format(
      "\nfalls {} : {}; {} agents did not play to the end, the server waited in vain {} times, slow "
      "readers lost {} messages\n",
      falls(false), falls(true), crashed, timeouts, droppedMessages);
  if (answers.count() > 0) {
    text += fmt::format("of {} answers {}\nof {} cycles that began late {}\n", answers.count(),
                        textOf(answers), delays.count(), textOf(delays));
  }
  for (const std::string& warning : warnings) text += fmt::format("warning: {}\n", warning);
  return text + invariants;
}

}  // namespace nonet::lab
