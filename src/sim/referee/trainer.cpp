#include "nonet/sim/referee/trainer.h"

#include <charconv>
#include <cmath>
#include <optional>

#include <spdlog/spdlog.h>

#include "nonet/protocol/sexpr_reader.h"

namespace nonet::sim {

namespace {

// The leading part that is a number, 0 if there is none: the server reads numbers as C's library does.
double leadingNumber(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

// As an int has room for; elsewhere nothing is meant that this server knows.
std::optional<int> wholeNumber(std::optional<double> value) {
  constexpr double kMost = 1e9;
  if (!value || !(std::abs(*value) <= kMost)) return std::nullopt;
  return static_cast<int>(*value);
}

// Team words are case-sensitive; an unknown one counts as None.
TeamSide sideFromWord(std::string_view word) {
  return word == "Left" ? TeamSide::Left : word == "Right" ? TeamSide::Right : TeamSide::None;
}

}  // namespace

// (name atom... (list value...)...)
struct Trainer::Command {
  std::string_view name;
  std::vector<std::string_view> atoms;
  struct List {
    std::string_view name;
    std::vector<std::string_view> values;
  };
  std::vector<List> lists;

  static Command read(protocol::CommandReader& reader) {
    Command command;
    reader.atom(command.name);
    const int depth = reader.depth();
    while (true) {
      std::string_view atom;
      if (reader.atom(atom)) {
        command.atoms.push_back(atom);
      } else if (reader.open()) {
        List list;
        reader.atom(list.name);
        while (reader.atom(atom)) list.values.push_back(atom);
        command.lists.push_back(list);
        if (!reader.leaveTo(depth)) return command;
      } else {
        return command;
      }
    }
  }

  const List* list(std::string_view wanted) const {
    for (const List& candidate : lists) {
      if (candidate.name == wanted) return &candidate;
    }
    return nullptr;
  }
  std::optional<double> number(std::string_view wanted) const {
    const List* found = list(wanted);
    if (found == nullptr || found->values.empty()) return std::nullopt;
    return leadingNumber(found->values[0]);
  }
  /// Absent if the list is missing; with a log line if it holds fewer than `count` values.
  std::optional<std::vector<float>> numbers(std::string_view wanted, std::size_t count) const {
    const List* found = list(wanted);
    if (found == nullptr) return std::nullopt;
    if (found->values.size() < count) {
      spdlog::warn("trainer: ({} ...) in ({} ...) needs {} numbers", wanted, name, count);
      return std::nullopt;
    }
    // Physics that is a kilometre away or faster than a bullet ends in infinite numbers, for all.
    constexpr double kMost = 1e3;
    std::vector<float> values;
    for (std::size_t i = 0; i < count; ++i) {
      const double value = leadingNumber(found->values[i]);
      if (!(std::abs(value) <= kMost)) {
        spdlog::warn("trainer: ({} ...) in ({} ...) holds a number beyond {}", wanted, name, kMost);
        return std::nullopt;
      }
      values.push_back(static_cast<float>(value));
    }
    return values;
  }
};

Trainer::Outcome Trainer::execute(std::string_view message) {
  Outcome outcome;
  protocol::CommandReader reader(message);
  while (!reader.atEnd()) {
    if (!reader.open()) {
      reader.skipOne();
      continue;
    }
    const Command command = Command::read(reader);
    const bool complete = reader.leaveTo(0);
    if (!complete) break;  // an expression that the message ends within counts for nothing
    if (command.name == "agent") {
      agentCommand(command);
    } else if (command.name == "ball") {
      ballCommand(command);
    } else if (command.name == "playMode") {
      playModeCommand(command);
    } else if (command.name == "dropBall") {
      referee_.dropBall();
    } else if (command.name == "kickOff") {
      kickOffCommand(command);
    } else if (command.name == "select") {
      selectCommand(command);
    } else if (command.name == "kill") {
      bool specified = false;
      if (const Player* player = named(command, specified)) outcome.killed.push_back(player->agent);
    } else if (command.name == "repos") {
      reposition(command);
    } else if (command.name == "killsim") {
      outcome.endSimulation = true;
    } else if (command.name == "reqfullstate") {
      outcome.fullState = true;
    } else if (command.name == "time") {
      timeCommand(command);
    } else if (command.name == "score") {
      scoreCommand(command);
    }
  }
  return outcome;
}

Player* Trainer::named(const Command& command, bool& specified) {
  const auto number = command.number("unum");
  const std::optional<int> unum = wholeNumber(number);
  const Command::List* team = command.list("team");
  specified = number.has_value() && team != nullptr && !team->values.empty();
  const TeamSide side = specified ? sideFromWord(team->values[0]) : TeamSide::None;
  for (Player& player : players_) {
    if (specified ? unum == player.unum && player.side == side : player.selected) return &player;
  }
  return nullptr;
}

void Trainer::agentCommand(const Command& command) {
  bool specified = false;
  const Player* player = named(command, specified);
  if (!specified) {
    referee_.placing().moveSelected();
    return;
  }
  if (player == nullptr) {
    spdlog::warn("trainer: (agent ...) names a player who is not there");
    return;
  }
  if (const auto at = command.numbers("pos", 3)) {
    world_.moveRobot(player->robot, Vector3f((*at)[0], (*at)[1], (*at)[2]));
  }
  if (const auto at = command.numbers("move", 4)) {
    world_.placeRobot(player->robot, Vector3f((*at)[0], (*at)[1], (*at)[2]), (*at)[3]);
  }
}

void Trainer::ballCommand(const Command& command) {
  if (const auto at = command.numbers("pos", 3)) {
    world_.setBallPosition(Vector3f((*at)[0], (*at)[1], (*at)[2]));
  }
  if (const auto velocity = command.numbers("vel", 3)) {
    world_.setBallVelocity(Vector3f((*velocity)[0], (*velocity)[1], (*velocity)[2]));
  }
}

void Trainer::playModeCommand(const Command& command) {
  if (command.atoms.empty()) return;
  if (const auto mode = protocol::playModeFromName(command.atoms[0])) {
    referee_.game().setPlayMode(*mode);
  } else {
    spdlog::warn("trainer: unknown play mode '{}'", command.atoms[0]);
  }
}

void Trainer::kickOffCommand(const Command& command) {
  if (command.atoms.empty()) return;
  const std::string_view word = command.atoms[0];
  const TeamSide side = sideFromWord(word);
  if (side == TeamSide::None && word != "None") {
    spdlog::warn("trainer: unknown team '{}' in (kickOff ...): use Left, Right or None", word);
    return;
  }
  referee_.kickOff(side);
}

void Trainer::selectCommand(const Command& command) {
  const auto unum = command.number("unum");
  const auto unselectAll = [this] {
    for (Player& player : players_) player.selected = false;
  };
  if (wholeNumber(unum) == -1) return unselectAll();
  const Command::List* team = command.list("team");
  if (!unum || team == nullptr || team->values.empty()) return selectNext();
  bool specified = false;
  Player* player = named(command, specified);
  if (player == nullptr) {
    spdlog::warn("trainer: (select ...) names a player who is not there");
    return;
  }
  unselectAll();
  player->selected = true;
}

void Trainer::selectNext() {
  if (players_.empty()) return;
  for (std::size_t i = 0; i < players_.size(); ++i) {
    if (!players_[i].selected) continue;
    players_[i].selected = false;
    players_[(i + 1) % players_.size()].selected = true;
    return;
  }
  players_.front().selected = true;
}

void Trainer::reposition(const Command& command) {
  bool specified = false;
  const Player* player = named(command, specified);
  if (player != nullptr) world_.moveRobot(player->robot, referee_.placing().outsidePosition(*player));
}

void Trainer::timeCommand(const Command& command) {
  if (command.atoms.empty()) return;
  const double time = leadingNumber(command.atoms[0]);
  constexpr double kLatest = 5e5;  // s; a float that is larger hardly advances by a cycle any more
  if (time >= 0.0 && time <= kLatest) referee_.game().setTime(static_cast<float>(time));
}

void Trainer::scoreCommand(const Command& command) {
  const auto left = wholeNumber(command.number("left"));
  const auto right = wholeNumber(command.number("right"));
  if (!left || !right || *left < 0 || *right < 0) return;
  referee_.game().setScores(*left, *right);
}

}  // namespace nonet::sim
