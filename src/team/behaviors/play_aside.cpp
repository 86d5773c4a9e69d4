#include "team/behaviors/play_aside.h"

#include <algorithm>
#include <limits>
#include <variant>

#include "nonet/math/angle.h"

#include "team/play_value.h"

namespace nonet::team {

namespace {

bool serves(const Situation& s, const BallPlay& play, const motion::KickOption& kick) {
  if (kick.head.isBackward() || !kick.head.hasRoom(s.nearestOpponent)) return false;
  return play.kick.empty() ? !kick.head.scales && !kick.head.onlyByName() : play.kick == kick.name;
}

// s; the kick that motion was asked for last is cheaper.
double costOf(const Situation& s, const BallPlay& straight, const motion::KickOption& kick, double longest) {
  const BallHandlingParameters& p = s.parameters.ball;
  const motion::KickHead& head = kick.head;
  const double wanted = std::min((straight.target - straight.ball).norm(), longest);
  const double shorter = std::max(0.0, wanted - s.parameters.choice.length * head.longest);
  const double heading = s.world.self.X_FR.rotation + straight.direction - head.direction;
  const double cost = timeToContact(s, head, heading) + p.sideLoss * shorter;
  const auto* present = std::get_if<motion::KickTo>(&s.motion.request);
  const bool keep = present != nullptr && !head.isStraight() && present->kick.view() == kick.name;
  return cost - (keep ? p.sideKeep : 0.0);
}

}  // namespace

double kickLength(const Situation& s, std::string_view kick) {
  double longest = 0.0;
  for (const motion::KickOption& option : s.motion.kicks)
    if (kick.empty() ? !option.head.isExact() : kick == option.name)
      longest = std::max(longest, option.head.longest);
  return s.parameters.choice.length * longest;
}

double contactTime(const Situation& s, const BallPlay& play) {
  const double heading = s.world.self.X_FR.rotation + play.direction;
  double least = std::numeric_limits<double>::infinity();
  for (const motion::KickOption& kick : s.motion.kicks) {
    const bool any = kick.head.isStraight() && !kick.head.isExact();
    const bool meant = play.kick.empty() ? any : play.kick == kick.name;
    if (meant) least = std::min(least, timeToContact(s, kick.head, heading));
  }
  return least;
}

std::optional<BallPlay> playAside(const Situation& s, const BallPlay& straight, bool mayStraight) {
  const double longest = kickLength(s, {});
  const motion::KickOption* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const motion::KickOption& kick : s.motion.kicks) {
    if (!serves(s, straight, kick) || (kick.head.isStraight() && !mayStraight)) continue;
    const double cost = costOf(s, straight, kick, longest);
    if (cost >= least) continue;
    least = cost;
    best = &kick;
  }
  if (best == nullptr || best->head.isStraight()) return std::nullopt;
  BallPlay play = straight;
  play.kick = best->name;
  play.face(wrapAngle(straight.direction - best->head.direction));
  return play;
}

}  // namespace nonet::team
