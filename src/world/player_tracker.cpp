#include "nonet/world/player_tracker.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nonet/math/angle.h"
#include "nonet/world/vision_frame.h"

namespace nonet::world {

namespace {

using protocol::BodyPart;

constexpr double kFallenHeadHeight = 0.33;  // m; a walking head is at 0.5, a lying one below 0.2
constexpr double kWalkSpeed = 0.5;          // m/s, growth of the uncertainty of an unseen player
constexpr double kSpeedMemory = 0.4;        // s, smoothing of the velocity
constexpr double kForget = 8.0;             // s
constexpr double kForgetSigma = 3.0;        // m
constexpr double kHeadingSigma = 0.35;      // rad, worst heading that is worth telling
constexpr double kOwnSight = 0.3;           // s by which a mate's sighting must be newer than the own one
constexpr double kOwnSpeed = 0.6;           // s for which the speed that one saw oneself is believed
constexpr double kOwnWord = 0.6;            // s for which a mate's own word on lying is believed
constexpr double kJump = 1.5;               // m, farther than any player walks between two sightings
constexpr double kAgility = 0.9;            // m/s, what it may have done otherwise than its speed said
constexpr double kInSight = 0.1;            // s between two sightings of one that is seen in every message
constexpr double kRun = 2.0;                // m/s, faster than any player
constexpr double kLimbs = 0.25;             // m by which the middle of what is seen of it may change
constexpr double kRoom = 0.3;               // m around a player in which its parts are, beside two sigmas
constexpr double kMiddle = 0.3;             // m, height of a player's middle

std::size_t at(BodyPart part) {
  return static_cast<std::size_t>(part);
}

}  // namespace

void PlayerTracker::predict(double dt, WorldState& state) const {
  const auto move = [&](PlayerState& player) {
    if (!player.known) return;
    // A velocity is believed for about a second.
    const double age = state.time - player.lastSeen;
    if (age < 1.0) player.X_FP.translation += dt * player.v_FP;
    if (age > 0.1) player.sigma += kWalkSpeed * dt;
    if (age > kForget || player.sigma > kForgetSigma) player.known = false;
  };
  for (PlayerState& player : state.teammates) move(player);
  for (PlayerState& player : state.opponents) move(player);
}

std::optional<PlayerTracker::Sighting> PlayerTracker::evaluate(const protocol::SeenPlayer& seen,
                                                               const Vector3& offset, const SelfState& self) {
  std::array<std::optional<Vector3>, protocol::kBodyPartCount> parts;
  Vector2 sum = Vector2::Zero();
  int count = 0;
  double distance = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!seen.parts[i] || !seen.parts[i]->isFinite()) continue;
    parts[i] = self.X_FC * (ObservedPoint(*seen.parts[i]).p_CP - offset);
    distance = std::max(distance, seen.parts[i]->distance);
  }
  // Pairs that are seen whole have the body between them; single limbs are only near it.
  const auto pairMean = [&](BodyPart right, BodyPart left) {
    if (!parts[at(right)] || !parts[at(left)]) return;
    sum += 0.5 * (*parts[at(right)] + *parts[at(left)]).head<2>();
    ++count;
  };
  if (parts[at(BodyPart::Head)]) {
    sum += parts[at(BodyPart::Head)]->head<2>();
    ++count;
  }
  pairMean(BodyPart::RFoot, BodyPart::LFoot);
  pairMean(BodyPart::RLowerArm, BodyPart::LLowerArm);
  Sighting sighting;
  sighting.sigma = 0.05 + VisionNoise::kAzimuthSigma * distance;
  if (count == 0) {
    for (const auto& part : parts) {
      if (!part) continue;
      sum += part->head<2>();
      ++count;
    }
    sighting.sigma += 0.1;
  }
  if (count == 0) return std::nullopt;
  sighting.p_FP = sum / count;
  if (parts[at(BodyPart::Head)]) sighting.fallen = parts[at(BodyPart::Head)]->z() < kFallenHeadHeight;

  // Right to left limb, turned by -90 degrees, points forward. Feet and arms add up.
  Vector2 left = Vector2::Zero();
  const auto addPair = [&](BodyPart right, BodyPart leftPart) {
    if (parts[at(right)] && parts[at(leftPart)]) {
      left += (*parts[at(leftPart)] - *parts[at(right)]).head<2>();
    }
  };
  addPair(BodyPart::RFoot, BodyPart::LFoot);
  addPair(BodyPart::RLowerArm, BodyPart::LLowerArm);
  const double noise = 2.0 * VisionNoise::kAzimuthSigma * distance;
  if (left.norm() > 0.05 && noise / left.norm() < kHeadingSigma && !sighting.fallen.value_or(false)) {
    sighting.heading = std::atan2(-left.x(), left.y());
    sighting.headingKnown = true;
  }
  return sighting;
}

PlayerState* PlayerTracker::nearestOpponent(const Sighting& sighting, WorldState& state) {
  PlayerState* nearest = nullptr;
  double best = kJump;
  for (std::size_t i = 1; i < state.opponents.size(); ++i) {
    PlayerState& player = state.opponents[i];
    const double distance = (player.X_FP.translation - sighting.p_FP).norm();
    if (player.known && player.lastSeen < state.time && distance < best) {
      best = distance;
      nearest = &player;
    }
  }
  if (nearest != nullptr) return nearest;
  for (std::size_t i = state.opponents.size() - 1; i > 0; --i) {
    if (!state.opponents[i].known) return &state.opponents[i];
  }
  return nullptr;
}

void PlayerTracker::merge(const Sighting& sighting, double time, PlayerState& player) {
  const double dt = time - player.lastSeen;
  const Vector2 innovation = sighting.p_FP - player.X_FP.translation;
  // The referee puts players aside, from one sighting to the next.
  const double walks = kLimbs + kRun * std::max(0.0, dt) + 3.0 * (player.sigma + sighting.sigma);
  const bool moved = dt < kInSight && innovation.norm() > walks;
  const bool jumped = !player.known || dt > 2.0 || innovation.norm() > kJump || moved;
  if (jumped) {
    player.X_FP.translation = sighting.p_FP;
    player.v_FP.setZero();
    player.sigma = sighting.sigma;
    player.headingKnown = false;
  } else {
    const double otherwise = kAgility * std::clamp(dt, 0.0, kInSight);
    const double variance = player.sigma * player.sigma + 1e-4 + otherwise * otherwise;
    const double gain = variance / (variance + sighting.sigma * sighting.sigma);
    player.X_FP.translation += gain * innovation;
    player.sigma = std::sqrt((1.0 - gain) * variance);
    // From a place that another told to the one that is seen is no way that was walked.
    const bool told = player.lastTold > player.lastSighted && time - player.lastSighted > kOwnSpeed;
    if (dt > 0.5 * kCycleTime && !told) {
      const double memory = std::exp(-dt / kSpeedMemory);
      player.v_FP += (1.0 - memory) * gain / std::max(dt, 0.06) * innovation;
    }
    constexpr double kTopSpeed = 1.5;  // m/s
    if (player.v_FP.norm() > kTopSpeed) player.v_FP *= kTopSpeed / player.v_FP.norm();
  }
  if (sighting.headingKnown) {
    player.X_FP.rotation =
        player.headingKnown
            ? wrapAngle(player.X_FP.rotation + 0.5 * angleDifference(sighting.heading, player.X_FP.rotation))
            : sighting.heading;
    player.headingKnown = true;
  }
  if (sighting.fallen) player.lies(*sighting.fallen, time);
  player.known = true;
  player.lastSeen = time;
}

void PlayerTracker::missOpponents(WorldState& state) {
  for (std::size_t i = 1; i < state.opponents.size(); ++i) {
    PlayerState& player = state.opponents[i];
    const Vector2& p_FP = player.X_FP.translation;
    const Vector3 p_CP = state.self.X_FC.inverse() * Vector3(p_FP.x(), p_FP.y(), kMiddle);
    const bool missed =
        player.known && player.lastSighted < state.time && clearlyInView(p_CP, kRoom + 2.0 * player.sigma);
    absences_[i] = missed ? absences_[i] + 1 : 0;
    if (missed) missed_[i] = state.time;
    if (absences_[i] >= kAbsencesToForget) player.known = false;
  }
}

void PlayerTracker::see(const protocol::Vision& vision, const Vector3& offset, WorldState& state) {
  if (!state.self.localized && state.self.covariance(0, 0) > 1.0) return;
  // First those with numbers, so that the others find the free tracks.
  for (int pass = 0; pass < 2; ++pass) {
    for (const protocol::SeenPlayer& seen : vision.players) {
      const bool numbered = seen.unum >= 1 && seen.unum <= kTeamSize;
      const bool own = seen.team == state.game.team;
      if ((pass == 0) != numbered) continue;
      if (own && (seen.unum == state.game.unum || !numbered)) continue;  // the own arms
      auto sighting = evaluate(seen, offset, state.self);
      if (!sighting) continue;
      // Who rises has its head up before it stands, and says itself when it does.
      const bool up = sighting->fallen && !*sighting->fallen;
      if (own && up && state.time - state.radio[static_cast<std::size_t>(seen.unum)].time < kOwnWord)
        sighting->fallen.reset();
      PlayerState* player = nullptr;
      if (!numbered) {
        player = nearestOpponent(*sighting, state);
      } else {
        player = &(own ? state.teammates : state.opponents)[static_cast<std::size_t>(seen.unum)];
      }
      if (player == nullptr) continue;
      merge(*sighting, state.time, *player);
      player->lastSighted = state.time;
    }
  }
  if (state.self.localized) missOpponents(state);
}

void PlayerTracker::hear(const Report& report, WorldState& state) const {
  if (report.unum < 1 || report.unum > kTeamSize || report.unum == state.game.unum) return;
  PlayerState& player = state.teammates[static_cast<std::size_t>(report.unum)];
  Sighting sighting;
  sighting.p_FP = report.X_FP.translation;
  sighting.sigma = report.sigma;
  sighting.heading = report.X_FP.rotation;
  sighting.headingKnown = report.headingKnown;
  sighting.fallen = report.fallen;
  // A good sighting of this cycle beats a poor report, and so does any place one that is not worth keeping,
  // but the number's own word on falling always counts.
  const bool seenNow = player.lastSeen == state.time && player.sigma < report.sigma;
  if (player.known && (seenNow || report.sigma > kForgetSigma)) {
    player.lies(report.fallen, state.time);
    return;
  }
  merge(sighting, state.time, player);
}

void PlayerTracker::hear(const OpponentReport& report, WorldState& state) const {
  if (report.unum < 1 || report.unum > kTeamSize) return;
  PlayerState& player = state.opponents[static_cast<std::size_t>(report.unum)];
  player.lastTold = std::max(player.lastTold, report.seenAt);
  // Told by somebody who saw it before it was carried away.
  if (!player.known && report.seenAt < missed_[static_cast<std::size_t>(report.unum)]) return;
  const bool older = report.seenAt < player.lastSighted + kOwnSight || report.seenAt < player.lastSeen;
  if (player.known && older) return;
  const double sigma = report.sigma + kWalkSpeed * std::max(0.0, state.time - report.seenAt);
  const Vector2 innovation = report.p_FP - player.X_FP.translation;
  if (!player.known || innovation.norm() > kJump) {
    player.X_FP.translation = report.p_FP;
    player.sigma = sigma;
    player.headingKnown = false;
  } else {
    const double variance = player.sigma * player.sigma;
    const double gain = variance / (variance + sigma * sigma);
    player.X_FP.translation += gain * innovation;
    player.sigma = std::sqrt((1.0 - gain) * variance);
  }
  // Two places told by different eyes are no speed; nobody tells one.
  if (state.time - player.lastSighted > kOwnSpeed) player.v_FP.setZero();
  player.lies(report.fallen, state.time);
  player.known = true;
  player.lastSeen = report.seenAt;
}

void PlayerTracker::mirror(WorldState& state) const {
  const auto turn = [](PlayerState& player) {
    player.X_FP = Pose2(-player.X_FP.translation, wrapAngle(player.X_FP.rotation + kPi));
    player.v_FP *= -1.0;
  };
  for (PlayerState& player : state.teammates) turn(player);
  for (PlayerState& player : state.opponents) turn(player);
}

}  // namespace nonet::world
