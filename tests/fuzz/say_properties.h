// What must hold for any say message, heard or spoken. Each function returns what is wrong, or nothing.
#pragma once

#include <cmath>
#include <string>

#include "nonet/protocol/say_codec.h"

#include "byte_choices.h"

namespace nonet::fuzz {

inline std::string checkHeard(const protocol::SayMessage& message) {
  const auto within = [](double value, double reach) { return value >= -reach && value <= reach; };
  const auto inField = [&](const Vector2& place) {
    return within(place.x(), 17.0) && within(place.y(), 12.0);
  };
  if (message.unum < 1 || message.unum > 11) return "unum";
  if (!inField(message.X_FR.translation)) return "place";
  if (!within(message.X_FR.rotation, 3.15)) return "heading";
  if (!(message.sigma > 0.0 && message.sigma <= 3.0)) return "sigma";
  if (message.timeToBall && !(*message.timeToBall >= 0.0 && *message.timeToBall <= 12.0))
    return "time to the ball";
  if (message.vote && !protocol::permutationRank(*message.vote)) return "vote";
  const bool status = message.kind == protocol::SayKind::Status;
  if (message.ball &&
      (!status || !inField(message.ball->p_FB) || !within(message.ball->v_FB.x(), 14.0) ||
       !within(message.ball->v_FB.y(), 14.0) || !(message.ball->age >= 0.0 && message.ball->age <= 5.0) ||
       !(message.ball->landsIn >= 0.0 && message.ball->landsIn <= 1.41))) {
    return "ball";
  }
  const protocol::SayPass& pass = message.pass;
  const bool isPass = message.kind == protocol::SayKind::Pass;
  if (isPass != (pass.receiver != 0) || pass.receiver < 0 || pass.receiver > 11 || !inField(pass.p_FTarget) ||
      !(pass.untilKick >= 0.0 && pass.untilKick < 3.11) ||
      !(pass.untilThere >= 0.0 && pass.untilThere < 6.31)) {
    return "pass";
  }
  bool ended = message.kind != protocol::SayKind::Sightings;
  for (const protocol::SaySighting& sighting : message.sightings) {
    if (sighting.unum == 0) ended = true;
    if (sighting.unum != 0 && (ended || sighting.unum < 1 || sighting.unum > 11 || !inField(sighting.p_FP) ||
                               !(sighting.age > 0.0 && sighting.age <= protocol::kOldestSighting))) {
      return "sighting";
    }
  }
  return {};
}

/// Whatever is heard is in range, and said again it is the same, letter by letter.
inline std::string checkDecoding(std::string_view text) {
  const auto heard = protocol::decodeSay(text, "Team");
  if (!heard) return {};
  const std::string problem = checkHeard(*heard);
  if (!problem.empty()) return problem;
  return protocol::encodeSay(*heard, "Team").view() == text ? "" : "said again it differs";
}

/// Any message that may be asked for.
inline protocol::SayMessage anyMessage(ByteChoices& choices) {
  protocol::SayMessage message;
  message.kind = static_cast<protocol::SayKind>(choices.below(3));
  message.unum = 1 + choices.below(11);
  message.fallen = choices.flag();
  message.sigma = choices.anyDouble();
  message.X_FR = Pose2(choices.anyDouble(), choices.anyDouble(), 0.0);
  message.X_FR.rotation = choices.anyDouble();
  if (choices.flag()) {
    protocol::SayBall& ball = message.ball.emplace();
    ball.p_FB = {choices.anyDouble(), choices.anyDouble()};
    ball.v_FB = {choices.anyDouble(), choices.anyDouble()};
    ball.age = choices.anyDouble();
    ball.landsIn = choices.anyDouble();
  }
  if (choices.flag()) message.timeToBall = choices.anyDouble();
  if (choices.flag()) {
    protocol::RoleVote& vote = message.vote.emplace();
    for (std::uint8_t& position : vote) position = static_cast<std::uint8_t>(choices.below(12));
  }
  message.pass.receiver = choices.below(14) - 1;
  message.pass.p_FTarget = {choices.anyDouble(), choices.anyDouble()};
  message.pass.untilKick = choices.anyDouble();
  message.pass.untilThere = choices.anyDouble();
  for (protocol::SaySighting& sighting : message.sightings) {
    sighting.unum = choices.below(14) - 1;
    sighting.p_FP = {choices.anyDouble(), choices.anyDouble()};
    sighting.fallen = choices.flag();
    sighting.age = choices.anyDouble();
  }
  return message;
}

/// Whatever a robot believes can be said, is understood, and said again gives the same letters.
inline std::string checkEncoding(ByteChoices choices) {
  const protocol::SayMessage message = anyMessage(choices);
  const auto said = protocol::encodeSay(message, "Team");
  const auto heard = protocol::decodeSay(said, "Team");
  if (!heard) return "not understood";
  const std::string problem = checkHeard(*heard);
  if (!problem.empty()) return problem;
  if (heard->unum != message.unum || heard->fallen != message.fallen || heard->kind != message.kind)
    return "unum, fallen or kind differs";
  if (std::string_view(protocol::encodeSay(*heard, "Team")) != std::string_view(said))
    return "letters differ";
  return protocol::decodeSay(said, "Others") ? "taken for another team's" : "";
}

/// The first byte tells whether the rest is heard or believed.
inline std::string checkSay(std::string_view bytes) {
  ByteChoices choices(bytes);
  return choices.flag() ? checkDecoding(choices.rest()) : checkEncoding(choices);
}

}  // namespace nonet::fuzz
