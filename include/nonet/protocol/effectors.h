// Everything an agent can send in one cycle, typed, with its text form (server facts 1.8).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "nonet/math/inline_string.h"
#include "nonet/math/pose2.h"
#include "nonet/model/joints.h"
#include "nonet/protocol/percept.h"

namespace nonet::protocol {

struct SceneEffector {
  int robotType = 0;
  InlineString<96> file;  // empty: the Nao description that belongs to robotType
};

struct InitEffector {
  int unum = 0;
  TeamName team;
};

struct Effectors {
  std::optional<SceneEffector> scene;
  std::optional<InitEffector> init;
  std::optional<Pose2> beam;   // own field frame, m and rad
  model::JointArray speeds{};  // rad/s; valid where the bit in speedsPresent is set
  std::uint32_t speedsPresent = 0;
  std::optional<InlineString<64>> say;  // sent by us: at most 20 allowed characters
  // Of several, `say` is the last and this the first: others hear the first (server facts 1.7).
  std::optional<InlineString<64>> firstSay;
  bool pass = false;
  bool syn = false;

  void clear() { *this = Effectors{}; }
  /// Leaves only the speeds, which hold until others come.
  void keepSpeeds() {
    scene.reset();
    init.reset();
    beam.reset();
    say.reset();
    firstSay.reset();
    pass = false;
  }
  void setSpeed(model::JointId joint, double radPerSecond) {
    speeds[model::index(joint)] = radPerSecond;
    speedsPresent |= 1U << model::index(joint);
  }
  /// One more message, said after those that are there.
  void addSay(std::string_view message) {
    if (say && !firstSay) firstSay = say;
    say = message;
  }
  bool hasSpeed(model::JointId joint) const { return (speedsPresent >> model::index(joint)) & 1U; }
};

inline constexpr std::size_t kMaxSayLength = 20;

/// What the server lets pass in (say ..): 1 to 20 printable ASCII characters without blank and brackets
/// (server facts 1.7).
bool isSayable(std::string_view message);

/// What a team may be called: printable ASCII characters without blank, brackets and quotes, since the name
/// stands as it is in everybody's messages. Empty, too (server facts 1.3).
bool isTeamName(std::string_view name);

/// Replaces `text` by the message: numbers as printf("%.6g") writes them, beam angle in degrees. An empty
/// scene file stands for rsg/agent/nao/nao_hetero.rsg with the robot type.
void writeEffectors(const Effectors& effectors, std::string& text);

/// Reads an agent's message with the server's tolerance. Extra values are ignored, unknown names counted,
/// numbers read as in C. Of equal effectors the last one wins (see firstSay), and an incomplete expression at
/// the end is dropped. `effectors` is cleared first. Returns how many things were skipped, messages that are
/// not sayable among them.
int parseEffectors(std::string_view text, Effectors& effectors);

/// Rounds all numbers to the last bit as writeEffectors() and parseEffectors() would. So a server in the same
/// process gets what a server at the other end of a socket gets.
void roundAsWritten(Effectors& effectors);

}  // namespace nonet::protocol
