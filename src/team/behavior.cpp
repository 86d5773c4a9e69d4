#include "nonet/team/behavior.h"

#include <algorithm>
#include <cmath>

#include "nonet/team/ball_handling.h"
#include "nonet/team/play_time.h"
#include "nonet/team/set_play.h"

namespace nonet::team {

namespace {

using motion::HeadRequest;
using motion::MotionRequest;
using world::Phase;
using world::WorldState;

bool isBeamPhase(Phase phase) {
  return phase == Phase::BeforeKickOff || phase == Phase::OwnGoal || phase == Phase::OpponentGoal;
}

void lookAtBall(const WorldState& world, HeadRequest& head) {
  const bool recently = world.ball.known && world.time - world.ball.lastSeen < 2.0;
  const bool lost = !world.self.localized && world.time - world.self.lastCorrection > 1.0;
  if (!recently || lost) {
    head.kind = HeadRequest::Kind::Scan;
    return;
  }
  head.kind = HeadRequest::Kind::Point;
  head.p_RP = Vector3(world.ball.p_RB.x(), world.ball.p_RB.y(), world.ball.p_FB.z() - world.self.height);
}

constexpr double kClaimAge = 1.0;       // s for which the goalie's word holds
constexpr double kReceiverReady = 0.6;  // m from its place
constexpr double kKickOffLine = 0.6;    // m behind the halfway line that others than the taker stay

}  // namespace

Behavior::Behavior(const TeamParameters& parameters) : parameters_(parameters), goalie_(parameters) {}

Intent Behavior::update(const WorldState& world, const motion::MotionState& motion) {
  kicking_ = motion.askedForKick();
  Intent intent;
  lookAtBall(world, intent.head);
  const Phase phase = world.game.phase;
  if (phase != lastPhase_) {
    beamed_ = false;
    lastPhase_ = phase;
  }
  agree(world);
  if (isBeamPhase(phase)) {
    beforeKickOff(world, intent);
  } else if (phase != Phase::GameOver && phase != Phase::Other && !motion.busy && !motion.rising) {
    play(world, intent);
  }
  intent.say = radio_.update(world, tidings(world));
  return intent;
}

// Who is on the ball and who stands where, also while one lies on the ground or waits for the kick-off.
void Behavior::agree(const WorldState& world) {
  touches_.update(world);
  const Vector2 ball = world.ball.p_FB.head<2>();
  FormationParameters parameters = parameters_.formation;
  if (world::isOpponentSetPiece(world.game.phase)) {
    // The one on the ball waits at the edge of the forbidden circle, the stopper behind it.
    parameters.stopperBehind =
        std::max(parameters.stopperBehind, parameters_.clearOfOpponentKick + parameters.apart);
  }
  formation_ = formationFor(ball, kMaxAssigned, world.field, parameters);
  voting_.update(world, formation_, ballTarget(world), touches_.banned(), parameters_);
  role_ = world.game.unum == 1 ? Role::Goalie : voting_.role();
}

Tidings Behavior::tidings(const WorldState& world) const {
  Tidings tidings;
  tidings.vote = voting_.vote();
  const bool goes = role_ == Role::Goalie ? goalie_.claimsBall() : mayTouch(world);
  if (goes) {
    const Runner self{world.self.X_FR, true, world::isFallen(world.body.posture)};
    tidings.timeToBall = timeToBall(self, BallForecast(world), ballTarget(world), parameters_.pace);
  }
  return tidings;
}

bool Behavior::goalieClaims(const WorldState& world) {
  const world::RadioReport& report = world.radio[1];
  return world.time - report.time < kClaimAge && report.message.timeToBall && !report.message.fallen;
}

bool Behavior::ownKickOffNext(const WorldState& world) const {
  // After a goal the other team kicks off; the left team has the first half's kick-off, the other one the
  // second's.
  if (world.game.phase == Phase::OwnGoal) return false;
  if (world.game.phase == Phase::OpponentGoal) return true;
  const bool left = world.game.side == protocol::TeamSide::Left;
  const bool firstHalf = world.game.time < 1.0;
  return left == firstHalf;
}

void Behavior::beforeKickOff(const WorldState& world, Intent& intent) {
  if (world.game.unum == 0) return;  // the server has not said yet who we are
  const Pose2 place = kickOffPose(world.game.unum, ownKickOffNext(world), world.field);
  // Once at the beginning of the phase; again if we ended up elsewhere (pushed, or the first one came too
  // early).
  const double sinceBeam = world.time - lastBeam_;
  const bool elsewhere = world.self.localized &&
                         (world.self.X_FR.translation - place.translation).norm() > 0.7 && sinceBeam > 2.0;
  if (!beamed_ || elsewhere) {
    intent.beam = place;
    lastBeam_ = world.time;
    beamed_ = true;
  }
}

void Behavior::searchBall(const WorldState& world, Intent& intent) const {
  intent.motion = motion::WalkVelocity{Pose2(0.0, 0.0, world.ball.p_RB.y() >= 0.0 ? 0.8 : -0.8)};
  intent.head.kind = HeadRequest::Kind::Scan;
}

void Behavior::play(const WorldState& world, Intent& intent) {
  const bool isGoalie = role_ == Role::Goalie;
  if (!world.ball.known) {
    // Only once the head has had time to look around does the body turn.
    if (!isGoalie && world.time - world.ball.lastSeen > 2.0 && world.time - world.game.phaseSince > 3.0)
      searchBall(world, intent);
    return;
  }
  if (!world.self.localized) return;
  if (isGoalie) {
    intent.motion = goalie_.update(world, mayTouch(world), kicking_);
  } else {
    fieldPlayer(world, intent);
  }
}

void Behavior::fieldPlayer(const WorldState& world, Intent& intent) const {
  if (world::isOpponentSetPiece(world.game.phase)) {
    intent.motion = opponentSetPiece(world);
  } else if (world::isOwnSetPiece(world.game.phase)) {
    intent.motion = ownSetPiece(world);
  } else if (role_ == Role::OnBall && mayTouch(world) && !goalieClaims(world)) {
    intent.motion = playBall(world, ballTarget(world), parameters_, KickUse::IfFree, kicking_);
  } else if (role_ == Role::OnBall) {
    // Ready beside the one who plays it.
    const Vector2 ball = world.ball.p_FB.head<2>();
    intent.motion = support(world, ball + Vector2(parameters_.onBallRoom, 0.0));
  } else {
    intent.motion = support(world, formation_.positions[static_cast<std::size_t>(role_)]);
  }
}

MotionRequest Behavior::support(const WorldState& world, const Vector2& place) const {
  Caution caution;
  caution.robots = parameters_.avoidDistance;
  caution.ball = parameters_.avoidDistance;
  caution.onBall = goalieClaims(world) ? 1 : voting_.onBall();
  caution.onBallRoom = parameters_.onBallRoom;
  return walkTo(world, Pose2(place, headingTo(world, world.ball.p_FB.head<2>())), caution);
}

// Everybody keeps the distance that the referee enforces; the one on the ball waits on the own goal's side.
MotionRequest Behavior::opponentSetPiece(const WorldState& world) const {
  const Vector2 ball = world.ball.p_FB.head<2>();
  const Vector2 ownGoal(-0.5 * world.field.length, 0.0);
  Vector2 place = formation_.positions[static_cast<std::size_t>(role_)];
  if (role_ == Role::OnBall) place = ball + 0.1 * (ownGoal - ball).normalized();
  const Vector2 away = place - ball;
  const double clear = parameters_.clearOfOpponentKick;
  if (away.norm() < clear) place = ball + clear * (away + Vector2(-1e-3, 0.0)).normalized();
  if (world.game.phase == Phase::OpponentKickOff) place.x() = std::min(place.x(), -kKickOffLine);
  return support(world, place);
}

MotionRequest Behavior::ownSetPiece(const WorldState& world) const {
  const Vector2 ball = world.ball.p_FB.head<2>();
  const Phase phase = world.game.phase;
  const SetPlay plan = setPlayFor(phase, ball, world.field);
  const bool taker = role_ == Role::OnBall && !goalieClaims(world);
  if (taker) {
    const bool ready =
        std::any_of(world.teammates.begin() + 2, world.teammates.end(), [&](const world::PlayerState& mate) {
          const bool self = &mate == &world.teammates[static_cast<std::size_t>(world.game.unum)];
          return mate.known && !self && !mate.fallen &&
                 (mate.X_FP.translation - plan.p_FReceiver).norm() < kReceiverReady;
        });
    const double waited = world.time - world.game.phaseSince;
    if (!ready && waited < parameters_.waitForReceiver) return waitAtBall(world, plan.p_FTarget, parameters_);
    const KickUse use = phase == Phase::OwnKickOff ? KickUse::Never : KickUse::Clear;
    return playBall(world, plan.p_FTarget, parameters_, use, kicking_);
  }
  Vector2 place =
      role_ == Role::Stopper ? plan.p_FReceiver : formation_.positions[static_cast<std::size_t>(role_)];
  if (phase == Phase::OwnKickOff) place.x() = std::min(place.x(), -kKickOffLine);
  return support(world, place);
}

}  // namespace nonet::team
