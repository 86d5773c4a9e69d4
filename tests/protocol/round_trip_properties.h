// What must hold for any bytes whatever; checked by the fuzz targets and by the short run in the tests. Each
// function returns what is wrong, or nothing.
#pragma once

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstdint>
#include <string>
#include <string_view>

#include "nonet/protocol/effectors.h"
#include "nonet/protocol/percept_text.h"
#include "nonet/protocol/sexpr_reader.h"

namespace nonet::protocol {

inline std::size_t longestNumber(std::string_view text) {
  std::size_t longest = 0;
  std::size_t run = 0;
  for (const char c : text) {
    run = std::isdigit(static_cast<unsigned char>(c)) != 0 ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  return longest;
}

/// What was understood of a message is written so that it is understood again, and writing that gives the
/// same.
inline std::string checkPercept(std::string_view text) {
  Percept first;
  Percept second;
  std::string written;
  std::string again;
  parsePercept(text, first);
  writePercept(first, written);
  parsePercept(written, second);
  writePercept(second, again);
  if (first.unknownTokens < 0 || second.unknownTokens > first.unknownTokens) return "unknown tokens appeared";
  if (first.order.size() != second.order.size() || first.heard.size() != second.heard.size() ||
      first.jointsPresent != second.jointsPresent || first.vision.has_value() != second.vision.has_value()) {
    return "predicates were lost";
  }
  if (first.vision && (first.vision->order.size() != second.vision->order.size() ||
                       first.vision->players.size() != second.vision->players.size() ||
                       first.vision->lines.size() != second.vision->lines.size())) {
    return "sightings were lost";
  }
  // Degrees to radians and back is not exact for numbers with more digits than a double holds.
  constexpr std::size_t kExactDigits = 12;
  if (longestNumber(written) <= kExactDigits && written != again) return "not stable";
  return {};
}

inline bool plainWord(std::string_view text) {
  return !text.empty() && std::none_of(text.begin(), text.end(), [](char c) {
    return c <= ' ' || c == '(' || c == ')' || c == '"' || c == '\'' || c == ';';
  });
}

inline bool sameBits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// Empty if equal to the last bit.
inline std::string difference(const Effectors& a, const Effectors& b) {
  if (a.speedsPresent != b.speedsPresent) return "joints";
  for (std::size_t i = 0; i < a.speeds.size(); ++i) {
    if (!sameBits(a.speeds[i], b.speeds[i])) return "speed";
  }
  if (a.scene.has_value() != b.scene.has_value() ||
      (a.scene && (a.scene->file != b.scene->file || a.scene->robotType != b.scene->robotType))) {
    return "scene";
  }
  if (a.init.has_value() != b.init.has_value() ||
      (a.init && (a.init->unum != b.init->unum || a.init->team != b.init->team))) {
    return "init";
  }
  if (a.beam.has_value() != b.beam.has_value() ||
      (a.beam && (!sameBits(a.beam->translation.x(), b.beam->translation.x()) ||
                  !sameBits(a.beam->translation.y(), b.beam->translation.y()) ||
                  !sameBits(a.beam->rotation, b.beam->rotation)))) {
    return "beam";
  }
  if (a.say != b.say || a.firstSay != b.firstSay || a.pass != b.pass || a.syn != b.syn)
    return "say, pass or syn";
  return {};
}

/// Effectors written and read are the effectors rounded as written.
inline std::string checkEffectors(std::string_view text) {
  Effectors first;
  Effectors second;
  std::string written;
  if (parseEffectors(text, first) < 0) return "negative count";
  // Names that were quoted cannot be written bare.
  if (first.init && !plainWord(first.init->team)) first.init.reset();
  if (first.scene && !first.scene->file.empty() && !plainWord(first.scene->file)) first.scene.reset();
  if (first.scene && first.scene->file == "rsg/agent/nao/nao.rsg") first.scene->robotType = 0;
  if (first.firstSay && !plainWord(*first.firstSay)) first.firstSay.reset();
  if (first.say && !plainWord(*first.say)) {
    first.say.reset();
    first.firstSay.reset();
  }
  writeEffectors(first, written);
  if (parseEffectors(written, second) != 0) return "our own text was not understood: " + written;
  roundAsWritten(first);
  return difference(first, second);
}

/// Any sequence of questions to the reader ends, and every view lies within the text. The first bytes choose
/// the questions.
template <SexprDialect kDialect>
std::string checkReader(std::string_view bytes) {
  const std::size_t half = std::min<std::size_t>(bytes.size() / 2, 64);
  const std::string_view questions = bytes.substr(0, half);
  const std::string_view text = bytes.substr(half);
  BasicSexprReader<kDialect> reader(text);
  std::size_t steps = 0;
  for (std::size_t i = 0; !reader.atEnd(); ++i) {
    std::string_view view = text;
    double number = 0.0;
    int integer = 0;
    bool consumed = false;
    switch (questions.empty() ? 0 : questions[i % questions.size()] % 8) {
      case 0:
        consumed = reader.open();
        break;
      case 1:
        consumed = reader.close();
        break;
      case 2:
        consumed = reader.atom(view);
        break;
      case 3:
        consumed = reader.number(number);
        break;
      case 4:
        consumed = reader.integer(integer);
        break;
      case 5:
        consumed = reader.literal("pol");
        break;
      case 6:
        consumed = reader.leaveTo(reader.depth() / 2) && false;
        break;
      default:
        break;
    }
    if (view.data() < text.data() || view.data() + view.size() > text.data() + text.size()) {
      return "view outside";
    }
    if (!consumed) {
      reader.skipOne();
    }
    if (reader.depth() < 0) return "negative depth";
    if (++steps > text.size()) return "no progress";
  }
  return {};
}

}  // namespace nonet::protocol
