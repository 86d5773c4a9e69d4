#include "nonet/team/behavior.h"

#include "nonet/team/strategy.h"

namespace nonet::team {

namespace {

motion::HeadRequest lookAtBall(const world::WorldState& world) {
  motion::HeadRequest head;
  const bool recently = world.ball.known && world.time - world.ball.lastSeen < 2.0;
  const bool lost = !world.self.localized && world.time - world.self.lastCorrection > 1.0;
  if (!recently || lost) return head;
  head.kind = motion::HeadRequest::Kind::Point;
  head.p_RP = Vector3(world.ball.p_RB.x(), world.ball.p_RB.y(), world.ball.p_FB.z() - world.self.height);
  return head;
}

Tidings tidingsOf(const Situation& situation) {
  Tidings tidings;
  const bool goes = situation.role == Role::Goalie ? situation.claims : situation.mayTouch;
  if (goes) tidings.timeToBall = situation.timeToBall[static_cast<std::size_t>(situation.world.game.unum)];
  return tidings;
}

}  // namespace

Behavior::Behavior(const TeamParameters& parameters, Challenge challenge)
    : tracker_(parameters), radio_(parameters.radio), challenge_(challenge) {}

const Action& Behavior::update(const world::WorldState& world, const motion::MotionState& motion) {
  const Situation situation = tracker_.update(world, motion);
  role_ = situation.role;
  const std::optional<Action> own = challenge_.update(situation);
  action_ = own ? *own : decide(situation);
  if (!action_.head) action_.head = lookAtBall(world);
  if (action_.beam) tracker_.noticeBeam(world.time);
  Tidings tidings = tidingsOf(situation);
  tidings.vote = tracker_.vote();
  action_.say = radio_.update(world, tidings);
  return action_;
}

}  // namespace nonet::team
