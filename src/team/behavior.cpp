#include "nonet/team/behavior.h"

#include <cmath>

#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/team/behaviors.h"
#include "nonet/team/charging.h"
#include "nonet/team/pass_mode.h"
#include "nonet/team/strategy.h"

namespace nonet::team {

namespace {

// Of who looks for the ball, s.
constexpr double kSeen = 2.0;       // it is where it was seen so lately
constexpr double kTold = 0.6;       // or where a mate has told so lately:
constexpr double kLookEvery = 3.0;  // once in this time
constexpr double kLookFor = 1.0;    // it looks there for so long

motion::HeadRequest lookTowards(const Vector2& p_R) {
  motion::HeadRequest head;
  head.kind = motion::HeadRequest::Kind::Look;
  head.pan = directionOf(p_R);
  return head;
}

// The nearest opponent close by that is out of sight and may be run into. The constants come from traces of
// charging fouls and were never varied.
std::optional<motion::HeadRequest> glanceAtOpponent(const Situation& s) {
  constexpr double kEvery = 0.4;        // s
  constexpr double kLength = 0.2;       // s
  constexpr double kUnseen = 0.15;      // s
  constexpr double kBallSeen = 0.5;     // s
  constexpr double kFarFromBall = 1.0;  // m
  const world::WorldState& world = s.world;
  if (std::fmod(world.time, kEvery) >= kLength) return std::nullopt;
  if (world.time - world.ball.lastSeen > kBallSeen || world.ball.p_RB.norm() < kFarFromBall)
    return std::nullopt;
  const Pose2 X_RF = world.self.X_FR.inverse();
  double nearest = s.parameters.glance.nearOpponent;
  std::optional<Vector2> there;
  for (const world::PlayerState& opponent : world.opponents) {
    if (!opponent.known || world.time - opponent.lastSighted < kUnseen) continue;
    const Vector2 p_RP = X_RF * opponent.X_FP.translation;
    if (p_RP.norm() > nearest) continue;
    nearest = p_RP.norm();
    there = p_RP;
  }
  return there ? std::optional(lookTowards(*there)) : std::nullopt;
}

// Along the way, for a moment, if the ball lies elsewhere and may be left unseen.
std::optional<motion::HeadRequest> glance(const Situation& s, const Action& action) {
  const GlanceParameters& p = s.parameters.glance;
  const auto* walk = std::get_if<motion::WalkTo>(&action.motion);
  if (walk == nullptr || s.role == Role::OnBall || s.role == Role::Goalie) return std::nullopt;
  if (auto head = glanceAtOpponent(s)) return head;
  const Vector2 way = walk->target.translation;
  const Vector2 ball = s.world.ball.p_RB;
  if (way.norm() < p.farToGo || ball.norm() < p.farFromBall) return std::nullopt;
  if (std::abs(angleDifference(directionOf(way), directionOf(ball))) < p.aside) return std::nullopt;
  if (std::fmod(s.world.time, p.every) >= p.length) return std::nullopt;
  return lookTowards(way);
}

Tidings tidingsOf(const Situation& situation) {
  Tidings tidings;
  const bool goes = situation.role == Role::Goalie ? situation.claims : situation.mayTouch;
  if (goes) tidings.timeToBall = situation.timeToBall[static_cast<std::size_t>(situation.world.game.unum)];
  return tidings;
}

}  // namespace

// In level axes, though the torso leans: the camera sees 60 degrees up and down, and the lean added the ball
// was in sight no more often.
motion::HeadRequest lookAtBall(const world::WorldState& world) {
  motion::HeadRequest head;
  const double unseen = world.time - world.ball.lastSeen;
  // Where mates say it is, by turns with looking around: they may be wrong.
  const bool told =
      world.time - world.ball.lastReported < kTold && std::fmod(unseen - kSeen, kLookEvery) < kLookFor;
  const bool recently = world.ball.known && (unseen < kSeen || told);
  const bool lost = !world.self.localized && world.time - world.self.lastCorrection > 1.0;
  if (!recently || lost) return head;
  head.kind = motion::HeadRequest::Kind::Point;
  head.p_RP = Vector3(world.ball.p_RB.x(), world.ball.p_RB.y(), world.ball.p_FB.z() - world.self.height);
  return head;
}

Behavior::Behavior(const TeamParameters& parameters, Challenge challenge)
    : tracker_(parameters), radio_(parameters.radio), challenge_(challenge) {}

const Action& Behavior::update(const world::WorldState& world, const motion::MotionState& motion) {
  const Situation situation = tracker_.update(world, motion);
  role_ = situation.role;
  const std::optional<Action> own = challenge_.update(situation);
  action_ = own ? *own : decide(situation);
  if (const auto slowly = spareOpponents(situation, action_.motion)) action_.motion = *slowly;
  if (!action_.head) action_.head = glance(situation, action_);
  if (!action_.head) action_.head = lookAtBall(world);
  action_.passMode = wantsPassMode(situation);
  if (action_.beam) tracker_.noticeBeam(world.time);
  Tidings tidings = tidingsOf(situation);
  tidings.vote = tracker_.vote();
  tidings.pass = action_.pass;
  action_.say = radio_.update(world, tidings);
  return action_;
}

}  // namespace nonet::team
