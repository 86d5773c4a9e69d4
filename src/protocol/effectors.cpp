#include "nonet/protocol/effectors.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "nonet/math/angle.h"
#include "nonet/protocol/rounding.h"
#include "nonet/protocol/sexpr_reader.h"

#include "text_writer.h"

namespace nonet::protocol {
namespace {

constexpr std::string_view kTypedSceneFile = "rsg/agent/nao/nao_hetero.rsg";
constexpr std::string_view kUntypedSceneFile = "rsg/agent/nao/nao.rsg";

// As C's strtod for decimal numbers: the leading part that is a number, 0 if there is none.
double leadingNumber(std::string_view text) {
  if (!text.empty() && text.front() == '+') {
    text.remove_prefix(1);
  }
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

int leadingInteger(std::string_view text) {
  int value = 0;
  if (!text.empty() && text.front() == '+') {
    text.remove_prefix(1);
  }
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

// Printable ASCII characters without blank and brackets.
bool isWord(std::string_view text) {
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return c > ' ' && c <= '~' && c != '(' && c != ')'; });
}

// Each reads the values of a list whose name has been read and stores them if they are complete. Values that
// follow are left to the caller, who skips them.
bool readScene(CommandReader& reader, Effectors& effectors) {
  std::string_view file;
  if (!reader.atom(file)) {
    return false;
  }
  SceneEffector scene;
  if (file != kTypedSceneFile && !scene.file.assign(file)) {
    return false;
  }
  std::string_view type;
  if (reader.atom(type)) {
    scene.robotType = leadingInteger(type);
  }
  effectors.scene = scene;
  return true;
}

bool readInit(CommandReader& reader, Effectors& effectors, int& skipped) {
  InitEffector init;
  const int depth = reader.depth();
  while (reader.open()) {
    std::string_view name;
    std::string_view value;
    reader.atom(name);
    reader.atom(value);
    if (name == "unum") {
      init.unum = leadingInteger(value);
    } else if (name != "teamname") {
      ++skipped;
    } else if (!init.team.assign(value)) {
      init.team.clear();  // cut off it would be another team's
      ++skipped;
    }
    if (!reader.leaveTo(depth)) {
      return false;
    }
  }
  effectors.init = init;
  return true;
}

bool readBeam(CommandReader& reader, Effectors& effectors) {
  std::array<double, 3> values{};
  for (double& value : values) {
    std::string_view text;
    if (!reader.atom(text)) {
      return false;
    }
    value = leadingNumber(text);
  }
  if (!std::isfinite(values[0]) || !std::isfinite(values[1])) {
    return false;
  }
  effectors.beam = Pose2(values[0], values[1], toRadians(values[2]));
  return true;
}

bool readSay(CommandReader& reader, Effectors& effectors) {
  std::string_view message;
  if (!reader.atom(message) || !isSayable(message)) {
    return false;
  }
  effectors.addSay(message);
  return true;
}

bool readSpeed(CommandReader& reader, model::JointId joint, Effectors& effectors) {
  std::string_view value;
  if (!reader.atom(value)) {
    return false;
  }
  effectors.setSpeed(joint, leadingNumber(value));
  return true;
}

bool readCommand(CommandReader& reader, Effectors& effectors, int& skipped) {
  std::string_view name;
  if (!reader.atom(name)) {
    return false;
  }
  if (const auto joint = model::jointFromEffectorName(name)) {
    return readSpeed(reader, *joint, effectors);
  }
  if (name == "syn") {
    effectors.syn = true;
    return true;
  }
  if (name == "pass") {
    effectors.pass = true;
    return true;
  }
  if (name == "say") return readSay(reader, effectors);
  if (name == "beam") return readBeam(reader, effectors);
  if (name == "init") return readInit(reader, effectors, skipped);
  if (name == "scene") return readScene(reader, effectors);
  return false;
}

}  // namespace

bool isSayable(std::string_view message) {
  return !message.empty() && message.size() <= kMaxSayLength && isWord(message);
}

bool isTeamName(std::string_view name) {
  return isWord(name) && name.find_first_of("\"'") == std::string_view::npos;
}

int parseEffectors(std::string_view text, Effectors& effectors) {
  effectors.clear();
  CommandReader reader(text);
  int skipped = 0;
  while (!reader.atEnd()) {
    if (!reader.open()) {
      reader.skipOne();
      ++skipped;
      continue;
    }
    // An expression that the end of the text cuts off counts for nothing: it must not replace an earlier one.
    const CommandReader begin = reader;
    if (!reader.leaveTo(0)) {
      return skipped + 1;
    }
    CommandReader inside = begin;
    skipped += readCommand(inside, effectors, skipped) ? 0 : 1;
  }
  return skipped;
}

void writeEffectors(const Effectors& effectors, std::string& text) {
  text.clear();
  if (effectors.scene) {
    const bool typed = effectors.scene->file.empty();
    text += "(scene ";
    text += typed ? kTypedSceneFile : effectors.scene->file.view();
    if (effectors.scene->file != kUntypedSceneFile) {
      text += ' ';
      appendInteger(text, effectors.scene->robotType);
    }
    text += ')';
  }
  if (effectors.init) {
    text += "(init (unum ";
    appendInteger(text, effectors.init->unum);
    text += ")(teamname ";
    text += effectors.init->team.view();
    text += "))";
  }
  if (effectors.beam) {
    text += "(beam ";
    appendSixDigits(text, effectors.beam->translation.x());
    text += ' ';
    appendSixDigits(text, effectors.beam->translation.y());
    text += ' ';
    appendSixDigits(text, toDegrees(effectors.beam->rotation));
    text += ')';
  }
  for (std::size_t i = 0; i < model::kJointCount; ++i) {
    if (effectors.hasSpeed(model::jointAt(i))) {
      text += '(';
      text += model::effectorName(model::jointAt(i));
      text += ' ';
      appendSixDigits(text, effectors.speeds[i]);
      text += ')';
    }
  }
  for (const auto& said : {effectors.firstSay, effectors.say}) {
    if (!said) continue;
    text += "(say ";
    text += said->view();
    text += ')';
  }
  text += effectors.pass ? "(pass)" : "";
  text += effectors.syn ? "(syn)" : "";
}

void roundAsWritten(Effectors& effectors) {
  if (effectors.beam) {
    Pose2& beam = *effectors.beam;
    beam.translation = beam.translation.unaryExpr([](double value) { return roundToSixDigits(value); });
    beam.rotation = toRadians(roundToSixDigits(toDegrees(beam.rotation)));
  }
  for (std::size_t i = 0; i < model::kJointCount; ++i) {
    if (effectors.hasSpeed(model::jointAt(i))) {
      effectors.speeds[i] = roundToSixDigits(effectors.speeds[i]);
    }
  }
}

}  // namespace nonet::protocol
