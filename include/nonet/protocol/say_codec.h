// What team mates tell each other: one message in the 20 characters of a say effector (server facts 1.7), of
// one of three kinds.
//
// Twenty characters of a 64-letter alphabet carry 120 bits. Layout, version 2, most significant bit first:
//
//   bits  field              range and step                      largest error
//   3     version            2
//   2     kind               0 status, 1 pass, 2 sightings
//   4     unum               1..11
//   95    of the kind, see below
//   16    check              CRC-16 (polynomial 0x1021), started from the team's name
//
// All kinds begin with what the others need of everybody, 48 bits:
//
//   9     own x              +-17 m, 67 mm                       34 mm
//   9     own y              +-12 m, 47 mm                       24 mm
//   1     fallen
//   2     own accuracy       below 0.1, 0.3, 1 m, worse          -
//   5     time to the ball   0..12.0 s in 0.4 s; 31: none        0.2 s
//   22    role vote          rank of a permutation of ten; 2^22 - 1: none
//
// Status, 47 bits:
//
//   6     heading            360 degrees / 64                    2.8 degrees
//   4     age of the ball    5 s * (k / 14)^2; 15: not known     0.36 s (0.17 s below 1 s)
//   10    ball x             +-17 m, 33 mm                       17 mm
//   10    ball y             +-12 m, 23 mm                       12 mm
//   7     ball velocity x    14 m/s * s^2, s in +-1 by 1/63      0.07 m/s below 1.2 m/s, 0.23 m/s at most
//   7     ball velocity y    likewise
//   3     flight             0: rolls; else on the ground in k * 0.2 s, 1.4 s and more   0.1 s
//
// Pass, 41 bits, then 6 zeros:
//
//   6     heading            as above
//   4     receiver           1..11
//   10    place x            +-17 m, 33 mm                       17 mm
//   10    place y            +-12 m, 23 mm                       12 mm
//   5     until the kick     0..3.1 s in 0.1 s                   50 ms
//   6     until it is there  0..6.3 s in 0.1 s                   50 ms
//
// Sightings, 2 * 23 bits, then a zero. The first are used first; a number 0 is none, and all its bits are
// zero:
//
//   4     unum of the opponent 1..11
//   8     x                  +-17 m, 134 mm                      67 mm
//   8     y                  +-12 m, 94 mm                       47 mm
//   1     fallen
//   2     age                up to 0.1, 0.25, 0.5, 1 s           told as the upper end
//
// A change of one character changes at most six neighbouring bits, and this check finds every burst of up to
// sixteen: no damaged message is taken for a good one. A message of another team is taken once in 65536, or
// more seldom. Values beyond their range are clipped.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "nonet/math/inline_string.h"
#include "nonet/math/pose2.h"

namespace nonet::protocol {

inline constexpr std::size_t kSayLength = 20;
inline constexpr int kSayVersion = 2;
inline constexpr int kVoteSize = 10;
inline constexpr std::size_t kSaySightings = 2;  // most opponents in one message
inline constexpr double kOldestSighting = 1.0;   // s, older ones cannot be told

/// vote[player] = position, a permutation of 0..9.
using RoleVote = std::array<std::uint8_t, kVoteSize>;

/// The ball as told to the team mates: as it is now, though seen some time ago.
struct SayBall {
  Vector2 p_FB = Vector2::Zero();  // m
  Vector2 v_FB = Vector2::Zero();  // m/s
  double age = 0.0;                // s since the sender saw it
  double landsIn = 0.0;            // s from now; 0: it rolls
};

/// The sender will kick the ball to a team mate.
struct SayPass {
  int receiver = 0;                     // number, 1..11
  Vector2 p_FTarget = Vector2::Zero();  // where the ball can be met, m
  double untilKick = 0.0;               // s from speaking to the contact of the foot
  double untilThere = 0.0;              // s from speaking until the ball is there
};

/// An opponent that the sender sees.
struct SaySighting {
  int unum = 0;                    // of the opponent, 1..11; 0: none
  Vector2 p_FP = Vector2::Zero();  // m
  bool fallen = false;
  double age = 0.0;  // s; older than kOldestSighting: left out. Decoded: 0.1, 0.25, 0.5 or 1
};

enum class SayKind : std::uint8_t { Status, Pass, Sightings };

struct SayMessage {
  using Ball = SayBall;
  SayKind kind = SayKind::Status;
  int unum = 0;        // of the sender, 1..11
  Pose2 X_FR;          // own pose, field frame of the team. Sightings: decoded with heading 0
  double sigma = 0.0;  // m; decoded: 0.1, 0.3, 1 or 3
  bool fallen = false;
  std::optional<double> timeToBall;  // s, estimate of the sender for itself
  std::optional<RoleVote> vote;
  std::optional<Ball> ball;                            // only in a status
  SayPass pass;                                        // only in a pass
  std::array<SaySighting, kSaySightings> sightings{};  // only in sightings
};

/// Exactly kSayLength characters that the server accepts. unum must be 1..11; NaN becomes 0. A receiver that
/// is no number is sent as 1; sightings without a number are left out.
InlineString<64> encodeSay(const SayMessage& message, std::string_view team);

/// Empty if the text is not a whole message of this team and version, as encodeSay makes them.
std::optional<SayMessage> decodeSay(std::string_view text, std::string_view team);

/// Whose turn it is to speak at this server time: one number of 1..11 for two cycles each, because a listener
/// hears only one team mate in two cycles.
int saySlot(double serverTime);

/// Rank of a permutation of 0..9 in lexicographic order (0 .. 10! - 1), and back. Not a permutation: empty.
std::optional<std::uint32_t> permutationRank(const RoleVote& vote);
std::optional<RoleVote> permutationOfRank(std::uint32_t rank);

}  // namespace nonet::protocol
