#include <cmath>

#include <fmt/format.h>

#include "nonet/lab/match/series.h"

namespace nonet::lab {
namespace {

using nlohmann::ordered_json;

std::string interval(const PairSummary& difference) {
  if (difference.pairs < 2) return "interval not known yet";
  return fmt::format("[{:+.2f}, {:+.2f}]", difference.low, difference.high);
}

std::string duration(double seconds) {
  const auto whole = static_cast<long>(std::lround(seconds));
  if (whole >= 3600) return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
  return fmt::format("{}:{:02} min", whole / 60, whole % 60);
}

std::string verdictText(const SeriesResult& result, const SeriesSettings& settings) {
  const SequentialBounds& bounds = *settings.sequential;
  std::string text = fmt::format("sequential test of {:+.2f} against {:+.2f}: ", bounds.low, bounds.high);
  if (result.verdict == Verdict::Open)
    text += "open";
  else
    text += fmt::format("{:+.2f} is accepted", result.verdict == Verdict::Low ? bounds.low : bounds.high);
  return text + fmt::format(" after {} pairs (log ratio {:.2f} of +-{:.2f})", result.pairs.size(),
                            result.logLikelihoodRatio, SequentialTest::bound());
}

}  // namespace

ordered_json SeriesResult::differenceJson() const {
  const bool known = difference.pairs > 1;
  return {{"difference_per_10_min", difference.mean},
          {"standard_error", known ? ordered_json(difference.standardError) : ordered_json()},
          {"interval_95", known ? ordered_json({difference.low, difference.high}) : ordered_json()},
          {"stopped_early", verdict != Verdict::Open}};
}

ordered_json SeriesResult::toJson(const SeriesSettings& settings) const {
  ordered_json json = {{"a", settings.a.describe()},
                       {"b", settings.b.describe()},
                       {"name_a", settings.a.name},
                       {"name_b", settings.b.name},
                       {"place", settings.place},
                       {"command_line", settings.commandLine},
                       {"date", settings.date},
                       {"version", settings.version},
                       {"minutes", settings.minutes},
                       {"games", games},
                       {"wins", wins},
                       {"ties", ties},
                       {"losses", losses},
                       {"goals_a", goalsA},
                       {"goals_b", goalsB},
                       {"crashed", {crashedA, crashedB}},
                       {"gone", {goneA, goneB}},
                       {"pairs", pairs}};
  json.update(differenceJson());
  if (settings.sequential) {
    json["sprt"] = {{"low", settings.sequential->low},
                    {"high", settings.sequential->high},
                    {"verdict", verdictName(verdict)},
                    {"log_ratio", logLikelihoodRatio}};
  }
  return json;
}

std::string SeriesResult::toText(const SeriesSettings& settings) const {
  std::string text = fmt::format("\nA: {}\nB: {}\n", settings.a.describe(), settings.b.describe());
  text += fmt::format("{} games of {:g} minutes ({} pairs): A won {}, tied {}, lost {}; goals {} : {}\n",
                      games, settings.minutes, pairs.size(), wins, ties, losses, goalsA, goalsB);
  text += fmt::format(
      "goal difference per ten minutes, A minus B: {:+.3f}{}, 95 % {}{}\n", difference.mean,
      difference.pairs < 2 ? "" : fmt::format(" (standard error {:.3f})", difference.standardError),
      interval(difference),
      verdict == Verdict::Open ? "" : " (too narrow and too far out: it ended because it had decided)");
  if (crashedA + crashedB + goneA + goneB > 0)
    text += fmt::format("agents that crashed {} : {}, players not there at the end of a game {} : {}\n",
                        crashedA, crashedB, goneA, goneB);
  if (settings.sequential) text += verdictText(*this, settings) + "\n";
  return text;
}

std::string SeriesProgress::line(const SeriesSettings& settings) const {
  std::string text = fmt::format("{} of {} games  +{} ={} -{}  goals {} : {}", gamesPlayed, gamesAtMost,
                                 result.wins, result.ties, result.losses, result.goalsA, result.goalsB);
  if (!result.pairs.empty())
    text += fmt::format("  difference {:+.2f} {}", result.difference.mean, interval(result.difference));
  if (settings.sequential && !result.pairs.empty())
    text +=
        fmt::format("  log ratio {:+.2f} of +-{:.2f}", result.logLikelihoodRatio, SequentialTest::bound());
  if (secondsLeft >= 0.0)
    text += fmt::format("  {}{} left", settings.sequential ? "at most " : "", duration(secondsLeft));
  return text;
}

}  // namespace nonet::lab
