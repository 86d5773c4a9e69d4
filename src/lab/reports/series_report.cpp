#include "nonet/lab/reports/series_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "nonet/lab/common/atomic_file.h"
#include "nonet/lab/common/json_lines.h"
#include "nonet/lab/match/statistics.h"

#include "lab/common/plot.h"
#include "lab/reports/field_drawing.h"

namespace nonet::lab {
namespace {

using nlohmann::json;

constexpr const char* kColorA = "#0066cc";
constexpr const char* kColorB = "#cc5500";
constexpr std::size_t kMostKicks = 600;  // drawn per team
constexpr const char* kResultRemedy = "the command of the series, given once more, writes it again";
constexpr const char* kMatchesRemedy = "play the series again in another folder";

std::string resultFile(const std::string& folder) {
  return folder + "/result.json";
}
std::string matchesFile(const std::string& folder) {
  return folder + "/matches.jsonl";
}

/// All games, with what belongs to A first.
struct Games {
  json result;
  std::vector<json> lines;

  static std::size_t teamOf(const json& line, bool sideB) {
    return (line.at("a") == "left") == sideB ? 1 : 0;
  }
  static const json& team(const json& line, bool sideB) {
    return line.at("statistics").at("teams").at(teamOf(line, sideB));
  }
  FieldSize field() const {
    const json& size = lines.front().at("statistics").at("field");
    return {size.at(0).get<double>(), size.at(1).get<double>(), size.at(2).get<double>()};
  }
};

Games readGames(const std::string& folder) {
  Games games;
  std::ifstream result(resultFile(folder));
  if (!result)
    throw std::runtime_error(fmt::format(
        "{} holds no finished series: play one with nonet series --out, or let it go on to its end", folder));
  games.result = readOrDamaged(resultFile(folder), kResultRemedy, [&result] { return json::parse(result); });
  std::ifstream file(matchesFile(folder));
  readOrDamaged(matchesFile(folder), kMatchesRemedy, [&] {
    for (std::string text; std::getline(file, text);) games.lines.push_back(json::parse(text));
  });
  if (games.lines.empty()) throw std::runtime_error(fmt::format("{} is empty", matchesFile(folder)));
  if (!games.lines.front().contains("statistics"))
    throw std::runtime_error(fmt::format("{}: its games were played without statistics", folder));
  return games;
}

// Bars upwards for A and downwards for B over a common axis; `labels` below each place.
std::string bars(const std::string& title, const std::string& axis, const std::vector<std::string>& labels,
                 const std::vector<double>& up, const std::vector<double>& down) {
  constexpr double kWidth = 460.0;
  constexpr double kHeight = 180.0;
  const double most = std::max({1.0, *std::max_element(up.begin(), up.end()),
                                down.empty() ? 0.0 : *std::max_element(down.begin(), down.end())});
  const double zero = down.empty() ? kHeight - 30.0 : kHeight / 2.0 - 5.0;
  const double scale = (zero - 14.0) / most;
  const double step = (kWidth - 40.0) / static_cast<double>(up.size());
  std::string svg = fmt::format(
      "<figure><figcaption>{}</figcaption><svg viewBox='0 0 {} {}' width='{}'>"
      "<text x='2' y='12'>{:.3g}</text><line x1='34' x2='{}' y1='{:.1f}' y2='{:.1f}' stroke='#555'/>\n",
      title, kWidth, kHeight, kWidth, most, kWidth, zero, zero);
  const std::size_t every = 1 + labels.size() / 14;
  for (std::size_t i = 0; i < up.size(); ++i) {
    const double x = 36.0 + step * static_cast<double>(i);
    svg += fmt::format("<rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}' fill='{}'/>", x,
                       zero - up[i] * scale, 0.8 * step, up[i] * scale, kColorA);
    if (!down.empty())
      svg += fmt::format("<rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}' fill='{}'/>", x, zero,
                         0.8 * step, down[i] * scale, kColorB);
    if (i % every == 0)
      svg += fmt::format("<text x='{:.1f}' y='{}' text-anchor='middle'>{}</text>", x + 0.4 * step,
                         kHeight - 16.0, labels[i]);
  }
  return svg + fmt::format("<text x='{}' y='{}' text-anchor='middle'>{}</text></svg></figure>\n",
                           kWidth / 2.0, kHeight - 3.0, axis);
}

std::string goalTimes(const Games& games) {
  const auto minutes = static_cast<std::size_t>(std::ceil(games.result.at("minutes").get<double>()));
  std::vector<double> a(std::max<std::size_t>(1, minutes), 0.0);
  std::vector<double> b = a;
  for (const json& line : games.lines) {
    for (const json& goal : line.at("statistics").at("goals")) {
      const auto minute = static_cast<std::size_t>(goal.at("time_s").get<double>() / 60.0);
      const bool ofA = goal.at("team").get<std::size_t>() == Games::teamOf(line, false);
      (ofA ? a : b)[std::min(minute, a.size() - 1)] += 1.0;
    }
  }
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < a.size(); ++i) labels.push_back(std::to_string(i + 1));
  return bars("Goals by minute, all games: A up, B down", "minute of the game", labels, a, b);
}

std::string differences(const Games& games) {
  std::map<int, double> count;
  for (const json& line : games.lines) ++count[line.at("score_a").get<int>() - line.at("score_b").get<int>()];
  std::vector<double> values;
  std::vector<std::string> labels;
  for (int d = count.begin()->first; d <= count.rbegin()->first; ++d) {
    values.push_back(count[d]);
    labels.push_back(fmt::format("{:+}", d));
  }
  return bars("Games by goal difference", "goals of A minus goals of B", labels, values, {});
}

// The mean, and its interval where there is one, on an axis around zero.
std::string differenceAxis(double mean, double low, double high) {
  const double reach = std::max({0.5, std::abs(low), std::abs(high)}) * 1.1;
  const auto x = [&](double value) { return 230.0 + value / reach * 210.0; };
  return fmt::format(
      "<svg viewBox='0 0 460 44' width='460'><line x1='20' x2='440' y1='18' y2='18' stroke='#bbb'/>"
      "<line x1='230' x2='230' y1='6' y2='30' stroke='#555'/><line x1='{:.1f}' x2='{:.1f}' y1='18' y2='18' "
      "stroke='{}' stroke-width='5'/><circle cx='{:.1f}' cy='18' r='5'/><text x='20' y='42'>{:+.2g}</text>"
      "<text x='222' y='42'>0</text><text x='415' y='42'>{:+.2g}</text></svg>\n",
      x(low), x(high), kColorA, x(mean), -reach, reach);
}

std::string headline(const Games& games) {
  const json& r = games.result;
  const auto text = [&](const char* key) { return xmlText(r.at(key).get<std::string>()); };
  const double mean = r.at("difference_per_10_min").get<double>();
  std::string html = fmt::format(
      "<h1>{} against {}</h1><p><b style='color:{}'>A</b>: {}<br><b style='color:{}'>B</b>: {}</p>"
      "<p>{} games of {:g} minutes: A won {}, tied {}, lost {}; goals {} : {}.<br>Goal difference per ten "
      "minutes: <b>{:+.2f}</b>",
      text("name_a"), text("name_b"), kColorA, text("a"), kColorB, text("b"), r.at("games").get<int>(),
      r.at("minutes").get<double>(), r.at("wins").get<int>(), r.at("ties").get<int>(),
      r.at("losses").get<int>(), r.at("goals_a").get<int>(), r.at("goals_b").get<int>(), mean);
  double low = mean;
  double high = mean;
  if (const json& interval = r.at("interval_95"); !interval.is_null()) {
    low = interval.at(0).get<double>();
    high = interval.at(1).get<double>();
    html += fmt::format(", standard error {:.2f}, 95&nbsp;% [{:+.2f}, {:+.2f}]",
                        r.at("standard_error").get<double>(), low, high);
    if (r.value("stopped_early", false))
      html += " (too narrow and too far out: the series ended because it had decided)";
  }
  html += ".</p>" + differenceAxis(mean, low, high);
  return html + fmt::format("<p><code>{}</code><br>{}, version {}, played in: {}</p>\n", text("command_line"),
                            text("date"), text("version"), text("place"));
}

std::string teamTable(const Games& games) {
  std::string html = "<h2>Means per game</h2><table><tr><th></th><th>A</th><th>B</th></tr>\n";
  const auto mean = [&](bool sideB, const char* key) {
    double sum = 0.0;
    for (const json& line : games.lines) sum += Games::team(line, sideB).at(key).get<double>();
    return sum / static_cast<double>(games.lines.size());
  };
  for (const auto& [key, name] :
       std::vector<std::pair<const char*, const char*>>{{"goals", "goals"},
                                                        {"shots", "shots"},
                                                        {"shots_on_target", "shots on target"},
                                                        {"kicks", "kicks"},
                                                        {"passes_tried", "passes tried"},
                                                        {"passes_completed", "passes completed"},
                                                        {"possession_percent", "possession, %"},
                                                        {"duels_won", "duels won"},
                                                        {"saves", "saves"},
                                                        {"falls", "falls"}}) {
    html += fmt::format("<tr><td>{}</td><td>{:.2f}</td><td>{:.2f}</td></tr>\n", name, mean(false, key),
                        mean(true, key));
  }
  return html + "</table>\n";
}

void addTo(std::vector<double>& sum, const json& values, bool turned) {
  sum.resize(values.size(), 0.0);
  for (std::size_t i = 0; i < sum.size(); ++i)
    sum[i] += values.at(turned ? sum.size() - 1 - i : i).get<double>();
}

std::string places(const Games& games) {
  const FieldSize field = games.field();
  std::vector<double> ball;
  std::array<std::vector<double>, 2> players;
  for (const json& line : games.lines) {
    // The ball is written down as team 0 sees it; half a turn is the same list backwards.
    addTo(ball, line.at("statistics").at("ball_places"), Games::teamOf(line, false) == 1);
    for (const bool sideB : {false, true}) {
      for (const json& player : Games::team(line, sideB).at("players"))
        addTo(players[sideB ? 1 : 0], player.at("places"), sideB);
    }
  }
  const int columns = static_cast<int>(std::lround(field.length));
  const int rows = static_cast<int>(std::lround(field.width));
  std::string html = "<h2>Where they were in play (A plays to the right)</h2>\n";
  html += heatFigure("Ball", field, {ball, columns, rows, "#333"});
  html += heatFigure("Players of A", field, {players[0], kPlaceColumns, kPlaceRows, kColorA});
  html += heatFigure("Players of B", field, {players[1], kPlaceColumns, kPlaceRows, kColorB});
  return html;
}

std::string ballPath(const Games& games) {
  const json& line = games.lines.front();
  const double sign = Games::teamOf(line, false) == 1 ? -1.0 : 1.0;
  std::string points;
  for (const json& place : line.at("statistics").at("ball_path"))
    points +=
        fmt::format("{:.1f},{:.1f} ", sign * place.at(1).get<double>(), -sign * place.at(2).get<double>());
  return fieldFigure(
      "The ball's way in the first game, once a second", games.field(), "",
      fmt::format("<polyline fill='none' stroke='#333' stroke-width='0.08' points='{}'/>", points));
}

std::string kickFan(const Games& games, bool sideB) {
  std::string lines;
  std::size_t count = 0;
  for (const json& line : games.lines) {
    for (const json& kick : Games::team(line, sideB).at("kick_list")) {
      if (++count > kMostKicks) continue;
      const char* color = kick.at("outcome") == "goal"  ? "#c00"
                          : kick.at("shot").get<bool>() ? "#e90"
                                                        : "#579";
      lines += fmt::format("<line x1='{:.2f}' y1='{:.2f}' x2='{:.2f}' y2='{:.2f}' stroke='{}'/>",
                           kick.at("from").at(0).get<double>(), -kick.at("from").at(1).get<double>(),
                           kick.at("to").at(0).get<double>(), -kick.at("to").at(1).get<double>(), color);
    }
  }
  return fieldFigure(fmt::format("Kicks of {} ({}{}): goals red, other shots orange; own goal on the left",
                                 sideB ? "B" : "A", count, count > kMostKicks ? ", the first 600 drawn" : ""),
                     games.field(), "", "<g stroke-width='0.06' opacity='0.7'>" + lines + "</g>\n");
}

std::string playerTable(const Games& games) {
  const std::vector<std::pair<const char*, const char*>> columns = {
      {"goals", "goals"},         {"kicks", "kicks"},
      {"touches", "touches"},     {"falls", "falls"},
      {"seconds_down", "s down"}, {"walked_m", "m walked"},
      {"mean_speed", "mean m/s"}, {"best_speed_3s", "best 3 s m/s"}};
  std::string html = "<h2>Players, means per game</h2><table><tr><th>side</th><th>number</th><th>type</th>";
  for (const auto& column : columns) html += fmt::format("<th>{}</th>", column.second);
  html += "</tr>\n";
  for (const bool sideB : {false, true}) {
    std::map<int, std::vector<const json*>> byNumber;
    for (const json& line : games.lines) {
      for (const json& player : Games::team(line, sideB).at("players"))
        byNumber[player.at("unum").get<int>()].push_back(&player);
    }
    for (const auto& [unum, records] : byNumber) {
      html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td>", sideB ? "B" : "A", unum,
                          records.front()->at("type").get<int>());
      for (const auto& column : columns) {
        double sum = 0.0;
        for (const json* record : records) sum += record->at(column.first).get<double>();
        html += fmt::format("<td>{:.2f}</td>", sum / static_cast<double>(records.size()));
      }
      html += "</tr>\n";
    }
  }
  return html + "</table>\n";
}

// Over a monitor stream kicks have no names.
std::string kickTable(const Games& games) {
  struct Kind {
    int count = 0;
    double distance = 0.0;
    std::map<std::string, int> outcomes;
  };
  std::string html =
      "<h3>Kicks by name</h3><table><tr><th>side</th><th>kick</th><th>number</th><th>mean m</th>"
      "<th>outcomes</th></tr>\n";
  for (const bool sideB : {false, true}) {
    std::map<std::string, Kind> kinds;
    for (const json& line : games.lines) {
      for (const json& kick : Games::team(line, sideB).at("kick_list")) {
        Kind& kind = kinds[kick.value("name", "")];
        ++kind.count;
        kind.distance += kick.at("distance").get<double>();
        ++kind.outcomes[kick.at("outcome").get<std::string>()];
      }
    }
    for (const auto& [name, kind] : kinds) {
      std::string outcomes;
      for (const auto& [outcome, count] : kind.outcomes)
        outcomes += fmt::format("{}{} {}", outcomes.empty() ? "" : ", ", outcome, count);
      html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{:.2f}</td><td>{}</td></tr>\n",
                          sideB ? "B" : "A", name.empty() ? "other" : xmlText(name), kind.count,
                          kind.distance / kind.count, outcomes);
    }
  }
  return html + "</table>\n";
}

// What the games' lines tell.
std::string aboutGames(const Games& games) {
  return goalTimes(games) + differences(games) + teamTable(games) + places(games) +
         "<h2>Kicks and the ball's way</h2>\n" + kickFan(games, false) + kickFan(games, true) +
         ballPath(games) + kickTable(games) + playerTable(games);
}

}  // namespace

std::string writeSeriesReport(const std::string& folder) {
  const Games games = readGames(folder);
  std::string html =
      "<!DOCTYPE html>\n<html><head><meta charset='utf-8'><title>Series</title><style>"
      "body{font:14px sans-serif;margin:2em;max-width:1500px} text{font:11px sans-serif}"
      "figure{display:inline-block;margin:0 1.5em 1em 0;vertical-align:top} figcaption{margin-bottom:.3em}"
      "table{border-collapse:collapse} td,th{padding:.15em .8em;text-align:right;border-bottom:1px solid "
      "#ddd}"
      "td:first-child{text-align:left}</style></head><body>\n";
  html += readOrDamaged(resultFile(folder), kResultRemedy, [&games] { return headline(games); });
  html += readOrDamaged(matchesFile(folder), kMatchesRemedy, [&games] { return aboutGames(games); });
  html += "</body></html>\n";
  std::string path = folder + "/report.html";
  writeAtomically(path, html);
  return path;
}

}  // namespace nonet::lab
