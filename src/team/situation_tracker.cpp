#include "nonet/team/situation_tracker.h"

#include <algorithm>
#include <utility>

#include "nonet/math/direction.h"

namespace nonet::team {

namespace {

// One of ours on its feet, that plays, is nearer to the ball than the goalie, which is busy.
bool mateIsNearer(const Situation& s) {
  if (s.phase() == world::Phase::OwnGoalKick) return false;
  const auto& mates = s.world.teammates;
  const double own = (s.world.self.X_FR.translation - s.ball()).norm();
  return std::any_of(mates.begin() + 2, mates.end(), [&](const world::PlayerState& mate) {
    const auto unum = static_cast<int>(&mate - mates.data());
    if (unum == s.banned || s.hasGone(unum)) return false;
    return mate.known && !mate.fallen && (mate.X_FP.translation - s.ball()).norm() < own;
  });
}

}  // namespace

SituationTracker::SituationTracker(const TeamParameters& parameters)
    : parameters_(parameters), touches_(parameters.touch) {}

// Who is on the ball and who stands where is reckoned also while one lies on the ground or waits for the
// kick-off: the others need the votes.
Situation SituationTracker::update(const world::WorldState& world, const motion::MotionState& motion) {
  touches_.update(world);
  Situation situation = assess(world, parameters_, motion, direction_, recording_ ? &targets_ : nullptr);
  direction_ = directionOf(situation.p_FTarget - situation.ball());
  const int banned = touches_.banned();
  voting_.update(situation, banned);
  situation.role = world.game.unum == 1 ? Role::Goalie : voting_.role();
  situation.onBall = voting_.onBall();
  situation.banned = banned;
  situation.mayTouch = banned != world.game.unum;
  if (touches_.barred() == world.game.unum) situation.mayScore = false;
  if (situation.role == Role::Goalie) {
    // In the middle of a kick or a fall it holds on to a ball that is still near.
    claims_ = situation.mayTouch &&
              (situation.acts() ? goalieWantsBall(situation, claims_)
                                : claims_ && goalieReaches(situation, true) && !mateIsNearer(situation));
  }
  situation.claims = claims_;
  situation.lastBeam = lastBeam_;
  situation.planned = std::exchange(planned_, {});
  if (!intent_) {
    situation.play = ownTurn(situation, recording_ ? &targets_ : nullptr);
    if (situation.setPlay && situation.play)
      planned_ = directionOf(situation.play->p_FTarget - situation.ball());
  } else if (situation.acts()) {
    situation.play = playTowards(situation, intent_->p_FTarget, intent_->use);
    situation.play->keep = intent_->keep;
  }
  return situation;
}

}  // namespace nonet::team
