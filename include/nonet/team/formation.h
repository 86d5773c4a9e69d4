// Where the team should stand: role positions from the ball [MacAlpine 2012a, section 6.1], and the
// places at kick-off. Own team's field frame, metres.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "nonet/math/pose2.h"
#include "nonet/team/parameters.h"
#include "nonet/world/world_state.h"

namespace nonet::team {

/// The order is that of importance: a smaller team fills the first roles.
enum class Role : std::uint8_t {
  OnBall,
  Stopper,
  BackLeft,
  BackRight,
  WingLeft,
  WingRight,
  ForwardLeft,
  ForwardRight,
  Supporter,
  Sweeper,
  Goalie,
};

std::string_view roleName(Role role);  // "on ball", "back left", ...

inline constexpr int kFieldRoles = 10;  // all but the goalie's

using Places = std::array<Vector2, kFieldRoles>;

struct Formation {
  Places positions{};  // of roles OnBall ... , `count` of them
  int count = 0;
};

/// Positions of `count` field players (all but the goalie) when the ball is at p_FB. Near the own goal the
/// wings' are those that mark `opponents` (marking.cpp). `variant` may ask for another formation than the
/// team's own (formation_variants.cpp). At an own set piece the receiver's place is the stopper's, and the
/// others keep away from it.
Formation formationFor(const Vector2& p_FB, int count, const world::FieldGeometry& field,
                       const FormationParameters& parameters, const VariantParameters& variant = {},
                       std::span<const world::PlayerState> opponents = {},
                       const std::optional<Vector2>& p_FReceiver = {});

/// With the ball near the own goal the wings' places become those between the own goal and the one or two
/// most dangerous opponents, the nearest to the goal that are not at the ball.
void markOpponents(Places& places, std::span<const world::PlayerState> opponents,
                   const world::FieldGeometry& field, const FormationParameters& parameters);

/// The places that a variant wants, before they are spread; nothing if it leaves the formation as it is.
std::optional<Places> variantPlaces(const Vector2& p_FB, const world::FieldGeometry& field,
                                    const FormationParameters& parameters, const VariantParameters& variant);

/// Where player `unum` beams to before a kick-off; everybody is in the own half.
Pose2 kickOffPose(int unum, bool ownKickOff, const world::FieldGeometry& field,
                  const SetPlayParameters& parameters);

/// The places of the roles while we have the kick-off: where their players were beamed to.
Formation kickOffFormation(const Vector2& p_FB, const world::FieldGeometry& field,
                           const SetPlayParameters& parameters);

}  // namespace nonet::team
