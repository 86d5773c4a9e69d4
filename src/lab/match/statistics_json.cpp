#include <cmath>

#include "nonet/lab/match/statistics.h"

namespace nonet::lab {
namespace {

using nlohmann::ordered_json;

// Enough for people, and lines stay short.
double rounded(double value, double unit = 0.01) {
  return std::round(value / unit) * unit == 0.0 ? 0.0
                                                : std::round(std::round(value / unit) * unit * 1e6) / 1e6;
}

ordered_json pointJson(const Vector2& p) {
  return {rounded(p.x()), rounded(p.y())};
}

double percent(double part, double whole) {
  return whole > 0.0 ? rounded(100.0 * part / whole, 0.1) : 0.0;
}

ordered_json kickJson(const KickStatistics& kick) {
  return {{"time_s", rounded(kick.time)},
          {"unum", kick.unum},
          {"name", kick.name},
          {"speed", rounded(kick.speed)},
          {"distance", rounded(kick.distance())},
          {"from", pointJson(kick.from)},
          {"to", pointJson(kick.to)},
          {"shot", kick.shot},
          {"on_target", kick.onTarget},
          {"set_piece", kick.setPiece},
          {"outcome", kick.outcome}};
}

ordered_json playerJson(int unum, const PlayerStatistics& player) {
  ordered_json json = {
      {"unum", unum},
      {"type", player.robotType},
      {"falls", player.falls},
      {"seconds_down", rounded(player.secondsDown, 0.1)},
      {"walked_m", rounded(player.walked, 0.1)},
      {"mean_speed", rounded(player.secondsUp > 0.0 ? player.walked / player.secondsUp : 0.0)},
      {"best_speed_1s", rounded(player.bestSpeed1)},
      {"best_speed_3s", rounded(player.bestSpeed3)},
      {"touches", player.touches},
      {"kicks", player.kicks},
      {"goals", player.goals}};
  if (!player.secondsInRole.empty()) {
    json["seconds_in_role"] = ordered_json::object();
    for (const auto& [role, seconds] : player.secondsInRole)
      json["seconds_in_role"][role] = rounded(seconds, 0.1);
  }
  json["places"] = player.places;
  return json;
}

}  // namespace

ordered_json MatchStatistics::teamJson(TeamIndex index) const {
  const TeamStatistics& team = this->team(index);
  int goals = 0;
  int falls = 0;
  double afterKickOff = 0.0;
  int timed = 0;
  for (const GoalStatistics& goal : goals_) {
    if (goal.team != index) continue;
    ++goals;
    if (!goal.afterKickOff) continue;
    ++timed;
    afterKickOff += *goal.afterKickOff;
  }
  for (const auto& [unum, player] : team.players) falls += player.falls;
  const double possession = teams_[0].possession + teams_[1].possession;
  ordered_json json = {{"goals", goals},
                       {"shots", team.shots},
                       {"shots_on_target", team.shotsOnTarget},
                       {"kicks", team.kicks.size()},
                       {"passes_tried", team.passesTried},
                       {"passes_completed", team.passesCompleted},
                       {"possession_percent", percent(team.possession, possession)},
                       {"duels_won", team.duelsWon},
                       {"saves", team.saves},
                       {"falls", falls},
                       {"set_pieces", ordered_json::object()},
                       {"fouls", ordered_json::object()}};
  if (timed > 0) json["kick_off_to_goal_s"] = rounded(afterKickOff / timed);
  for (const auto& [kind, piece] : team.setPieces) {
    json["set_pieces"][kind] = {{"count", piece.count},
                                {"mean_s", rounded(piece.count > 0 ? piece.seconds / piece.count : 0.0)},
                                {"longest_s", rounded(piece.longest)}};
  }
  for (const auto& [kind, count] : team.fouls) json["fouls"][kind] = count;
  json["kicks_by_name"] = ordered_json::object();
  for (const auto& [name, kind] : team.kicksByName()) {
    json["kicks_by_name"][name.empty() ? "other" : name] = {
        {"count", kind.count}, {"mean_m", rounded(kind.distance / kind.count)}, {"outcomes", kind.outcomes}};
  }
  json["kick_list"] = ordered_json::array();
  for (const KickStatistics& kick : team.kicks) json["kick_list"].push_back(kickJson(kick));
  json["players"] = ordered_json::array();
  for (const auto& [unum, player] : team.players) json["players"].push_back(playerJson(unum, player));
  return json;
}

ordered_json MatchStatistics::toJson() const {
  ordered_json json = {{"seconds", rounded(endTime_)},
                       {"seconds_in_play", rounded(secondsInPlay_, 0.1)},
                       {"field", {field_.length, field_.width, field_.goalWidth}},
                       {"duels", duels_},
                       {"ball_thirds_percent", ordered_json::array()},
                       {"goals", ordered_json::array()},
                       {"teams", {teamJson(0), teamJson(1)}},
                       {"ball_places", ballPlaces_},
                       {"ball_path", ordered_json::array()}};
  for (const double seconds : thirds_)
    json["ball_thirds_percent"].push_back(percent(seconds, secondsInPlay_));
  for (const GoalStatistics& goal : goals_) {
    ordered_json entry = {
        {"time_s", rounded(goal.time)}, {"team", goal.team}, {"unum", goal.scorer}, {"own", goal.own}};
    if (goal.afterKickOff) entry["after_kick_off_s"] = rounded(*goal.afterKickOff);
    json["goals"].push_back(entry);
  }
  for (const auto& [time, x, y] : ballPath_)
    json["ball_path"].push_back({rounded(time, 0.1), rounded(x, 0.1), rounded(y, 0.1)});
  return json;
}

}  // namespace nonet::lab
