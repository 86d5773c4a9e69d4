#include "nonet/team/radio.h"

#include <algorithm>
#include <cmath>

#include "nonet/world/ball_law.h"

namespace nonet::team {

namespace {

constexpr double kTurn = 2.0 * kCycleTime;

// How long until a turn begins, counted from the beginning of another.
double timeUntil(int slot, int from) {
  return kTurn * ((slot - from + world::kTeamSize) % world::kTeamSize);
}

}  // namespace

bool Radio::isFree(const world::WorldState& world, int slot) const {
  return world.time - world.radio[static_cast<std::size_t>(slot)].time > parameters_.absentAfter;
}

bool Radio::speaksOutOfTurn(const world::WorldState& world, const PassAnnouncement& pass, int slot) const {
  if (world.time - passSaid_ < parameters_.passAgain || world.time >= pass.kickAt) return false;
  if (isFree(world, slot)) return true;
  // Somebody else's: only if no better one comes in time.
  double wait = timeUntil(world.game.unum, slot);
  for (int other = 1; other <= world::kTeamSize; ++other)
    if (isFree(world, other)) wait = std::min(wait, timeUntil(other, slot));
  return world.time + wait > pass.kickAt - parameters_.passLead;
}

bool Radio::prefersSightings(const world::WorldState& world) const {
  const bool nearBall = world.ball.known && world.ball.p_RB.norm() < parameters_.nearBall;
  return parameters_.shareSightings && world.self.localized && !nearBall &&
         statusSaid_ >= parameters_.statusBetween;
}

// The nearest ones that one sees and nobody has told of. Their number.
int Radio::findSightings(const world::WorldState& world, protocol::SayMessage& message) const {
  std::array<double, protocol::kSaySightings> distances{};
  std::size_t count = 0;
  for (std::size_t unum = 1; unum < world.opponents.size(); ++unum) {
    const world::PlayerState& opponent = world.opponents[unum];
    const double age = world.time - opponent.lastSighted;
    if (!opponent.known || age > parameters_.sightingAge) continue;
    if (world.time - opponent.lastTold < parameters_.toldFor) continue;
    const double distance = (opponent.X_FP.translation - world.self.X_FR.translation).norm();
    std::size_t place = count;
    while (place > 0 && distances[place - 1] > distance) --place;
    if (place == distances.size()) continue;
    count = std::min(count + 1, distances.size());
    std::copy_backward(distances.begin() + place, distances.begin() + count - 1, distances.begin() + count);
    std::copy_backward(message.sightings.begin() + place, message.sightings.begin() + count - 1,
                       message.sightings.begin() + count);
    distances[place] = distance;
    message.sightings[place] = {static_cast<int>(unum), opponent.X_FP.translation, opponent.fallen, age};
  }
  return static_cast<int>(count);
}

protocol::SayMessage Radio::report(const world::WorldState& world, const Tidings& tidings) const {
  protocol::SayMessage message;
  message.unum = world.game.unum;
  message.X_FR = world.self.X_FR;
  message.sigma = world.self.localized ? std::sqrt(world.self.covariance.topLeftCorner<2, 2>().trace())
                                       : parameters_.lostSigma;
  message.fallen = world::isFallen(world.body.posture);
  const double age = world.time - world.ball.lastSeen;
  if (world.self.localized && world.ball.known && age < parameters_.oldestBall) {
    const world::BallState& ball = world.ball;
    message.ball = {ball.p_FB.head<2>(), ball.v_FB.head<2>(), std::max(age, 0.0),
                    world::landingTime({ball.p_FB, ball.v_FB})};
    message.timeToBall = tidings.timeToBall;
  }
  message.vote = tidings.vote;
  return message;
}

std::optional<InlineString<64>> Radio::update(const world::WorldState& world, const Tidings& tidings) {
  const int slot = protocol::saySlot(world.time);
  const bool begins = slot != slot_;
  slot_ = slot;
  // A listener hears one team mate in two cycles: the second message of a turn would be lost.
  if (!begins || world.game.unum == 0) return std::nullopt;
  const bool own = slot == world.game.unum;
  if (!own && !(tidings.pass && speaksOutOfTurn(world, *tidings.pass, slot))) return std::nullopt;

  protocol::SayMessage message = report(world, tidings);
  if (tidings.pass) {
    const PassAnnouncement& pass = *tidings.pass;
    message.kind = protocol::SayKind::Pass;
    message.pass = {pass.receiver, pass.p_FTarget, pass.kickAt - world.time, pass.thereAt - world.time};
    passSaid_ = world.time;
  } else if (prefersSightings(world) && findSightings(world, message) > 0) {
    message.kind = protocol::SayKind::Sightings;
    statusSaid_ = 0;
  } else {
    ++statusSaid_;
  }
  return protocol::encodeSay(message, world.game.team);
}

}  // namespace nonet::team
