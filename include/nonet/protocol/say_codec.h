// What team mates tell each other: one report in the 20 characters of a say message (server facts 1.7).
//
// Twenty characters of a 64-letter alphabet carry 120 bits. Layout, version 1, most significant bit first:
//
//   bits  field             range and step                      largest error
//   3     version           1
//   4     unum              1..11
//   10    own x             +-17 m, 33 mm                       17 mm
//   10    own y             +-12 m, 23 mm                       12 mm
//   7     heading           360 degrees / 128                   1.4 degrees
//   1     fallen
//   2     own accuracy      below 0.1, 0.3, 1 m, worse          -
//   1     ball known
//   10    ball x            +-17 m, 33 mm                       17 mm
//   10    ball y            +-12 m, 23 mm                       12 mm
//   7     ball velocity x   +-8 m/s, 0.127 m/s (127 steps, 0 exact)  64 mm/s
//   7     ball velocity y   likewise
//   5     age of the ball   10 s * (k / 31)^2                   0.33 s (0.11 s below 1 s)
//   5     time to the ball  0..12.4 s in 0.4 s; 31: none        0.2 s
//   22    role vote         rank of a permutation of ten; 2^22 - 1: none
//   16    check             CRC-16 (polynomial 0x1021), started from the team's name
//
// A change of one character changes at most six neighbouring bits, and this check finds every burst of up to
// sixteen: no damaged message is taken for a good one. A message of another team is taken once in 65536.
// Values beyond their range are clipped.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "nonet/math/inline_string.h"
#include "nonet/math/pose2.h"

namespace nonet::protocol {

inline constexpr std::size_t kSayLength = 20;
inline constexpr int kSayVersion = 1;
inline constexpr int kVoteSize = 10;

/// vote[player] = position, a permutation of 0..9.
using RoleVote = std::array<std::uint8_t, kVoteSize>;

/// A sighting of the ball as told to the team mates.
struct SayBall {
  Vector2 p_FB = Vector2::Zero();  // m
  Vector2 v_FB = Vector2::Zero();  // m/s
  double age = 0.0;                // s since the sender saw it
};

struct SayMessage {
  using Ball = SayBall;
  int unum = 0;        // of the sender, 1..11
  Pose2 X_FR;          // own pose, field frame of the team
  double sigma = 0.0;  // m; decoded: 0.1, 0.3, 1 or 3
  bool fallen = false;
  std::optional<Ball> ball;
  std::optional<double> timeToBall;  // s, estimate of the sender for itself
  std::optional<RoleVote> vote;
};

/// Exactly kSayLength characters that the server accepts. unum must be 1..11; NaN becomes 0.
InlineString<64> encodeSay(const SayMessage& message, std::string_view team);

/// Empty if the text is not a whole message of this team and version.
std::optional<SayMessage> decodeSay(std::string_view text, std::string_view team);

/// Whose turn it is to speak at this server time: one number of 1..11 for two cycles each, because a listener
/// hears only one team mate in two cycles.
int saySlot(double serverTime);

/// Rank of a permutation of 0..9 in lexicographic order (0 .. 10! - 1), and back. Not a permutation: empty.
std::optional<std::uint32_t> permutationRank(const RoleVote& vote);
std::optional<RoleVote> permutationOfRank(std::uint32_t rank);

}  // namespace nonet::protocol
