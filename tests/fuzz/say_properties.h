// What must hold for any say message, heard or spoken. Each function returns what is wrong, or nothing.
#pragma once

#include <cmath>
#include <string>

#include "nonet/protocol/say_codec.h"

#include "byte_choices.h"

namespace nonet::fuzz {

inline std::string checkHeard(const protocol::SayMessage& message) {
  const auto within = [](double value, double reach) { return value >= -reach && value <= reach; };
  if (message.unum < 1 || message.unum > 11) return "unum";
  if (!within(message.X_FR.translation.x(), 17.0) || !within(message.X_FR.translation.y(), 12.0))
    return "place";
  if (!within(message.X_FR.rotation, 3.15)) return "heading";
  if (!(message.sigma > 0.0 && message.sigma <= 3.0)) return "sigma";
  if (message.ball && (!within(message.ball->p_FB.x(), 17.0) || !within(message.ball->p_FB.y(), 12.0) ||
                       !within(message.ball->v_FB.x(), 8.0) || !within(message.ball->v_FB.y(), 8.0) ||
                       !(message.ball->age >= 0.0 && message.ball->age <= 10.0))) {
    return "ball";
  }
  if (message.timeToBall && !(*message.timeToBall >= 0.0 && *message.timeToBall <= 12.4))
    return "time to the ball";
  if (message.vote && !protocol::permutationRank(*message.vote)) return "vote";
  return {};
}

/// Whatever is heard is in range, and said again it is the same.
inline std::string checkDecoding(std::string_view text) {
  const auto heard = protocol::decodeSay(text, "Team");
  if (!heard) return {};
  const std::string problem = checkHeard(*heard);
  if (!problem.empty()) return problem;
  const auto again = protocol::decodeSay(protocol::encodeSay(*heard, "Team"), "Team");
  if (!again) return "said again it is not understood";
  return again->unum == heard->unum && again->X_FR.translation == heard->X_FR.translation
             ? ""
             : "said again it differs";
}

/// Whatever a robot believes can be said, is understood, and said again gives the same letters.
inline std::string checkEncoding(ByteChoices choices) {
  protocol::SayMessage message;
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
  }
  if (choices.flag()) message.timeToBall = choices.anyDouble();
  if (choices.flag()) {
    protocol::RoleVote& vote = message.vote.emplace();
    for (std::uint8_t& position : vote) position = static_cast<std::uint8_t>(choices.below(12));
  }
  const auto said = protocol::encodeSay(message, "Team");
  const auto heard = protocol::decodeSay(said, "Team");
  if (!heard) return "not understood";
  const std::string problem = checkHeard(*heard);
  if (!problem.empty()) return problem;
  if (heard->unum != message.unum || heard->fallen != message.fallen) return "unum or fallen differs";
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
