#include "nonet/team/behavior.h"

#include <algorithm>
#include <cmath>

#include "nonet/team/ball_handling.h"
#include "nonet/team/navigation.h"

namespace nonet::team {

namespace {

using motion::HeadRequest;
using motion::MotionRequest;
using world::Phase;
using world::WorldState;

bool isBeamPhase(Phase phase) {
  return phase == Phase::BeforeKickOff || phase == Phase::OwnGoal || phase == Phase::OpponentGoal;
}

bool isOpponentKick(Phase phase) {
  switch (phase) {
    case Phase::OpponentKickOff:
    case Phase::OpponentKickIn:
    case Phase::OpponentCorner:
    case Phase::OpponentGoalKick:
    case Phase::OpponentFreeKick:
    case Phase::OpponentDirectFreeKick:
    case Phase::OpponentPass:
      return true;
    default:
      return false;
  }
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

MotionRequest stand() {
  return {};
}

}  // namespace

Behavior::Behavior(const TeamParameters& parameters) : parameters_(parameters) {}

Intent Behavior::update(const WorldState& world, bool motionBusy) {
  Intent intent;
  intent.motion = stand();
  lookAtBall(world, intent.head);
  intent.say = radio_.update(world);
  const Phase phase = world.game.phase;
  if (phase != lastPhase_) {
    beamed_ = false;
    lastPhase_ = phase;
  }
  if (isBeamPhase(phase)) {
    beforeKickOff(world, intent);
  } else if (phase != Phase::GameOver && phase != Phase::Other && !motionBusy) {
    play(world, intent);
  }
  return intent;
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

void Behavior::updateRole(const WorldState& world) {
  // Players in the order of their numbers: every team mate computes the same from the same view.
  std::array<Vector2, kMaxAssigned> places{};
  std::array<int, kMaxAssigned> unums{};
  int count = 0;
  int me = -1;
  for (int unum = 2; unum <= world::kTeamSize && count < kMaxAssigned; ++unum) {
    const bool self = unum == world.game.unum;
    if (!self && !world.teammates[unum].known) continue;
    if (self) me = count;
    places[count] = self ? world.self.X_FR.translation : world.teammates[unum].X_FP.translation;
    unums[count] = unum;
    ++count;
  }
  if (me < 0) return;
  const Vector2 ball = world.ball.p_FB.head<2>();
  const Formation formation = formationFor(ball, count, world.field, parameters_.formation);

  // The player nearest to the ball takes it (section 6 of the paper); the others share the rest by
  // assignment.
  int onBall = 0;
  for (int i = 1; i < count; ++i)
    if ((places[i] - ball).norm() < (places[onBall] - ball).norm()) onBall = i;
  if (onBall == me) {
    role_ = Role::OnBall;
    roleTarget_ = ball;
    return;
  }
  std::array<Vector2, kMaxAssigned> others{};
  int myPlace = 0;
  int n = 0;
  for (int i = 0; i < count; ++i) {
    if (i == onBall) continue;
    if (i == me) myPlace = n;
    others[n++] = places[i];
  }
  const std::size_t size = static_cast<std::size_t>(n);
  const Assignment assignment =
      assigner_.assign({others.data(), size}, {formation.positions.data() + 1, size});
  role_ = static_cast<Role>(assignment[myPlace] + 1);
  roleTarget_ = formation.positions[assignment[myPlace] + 1];
}

void Behavior::searchBall(const WorldState& world, Intent& intent) const {
  intent.motion.kind = MotionRequest::Kind::WalkVelocity;
  intent.motion.velocity = Pose2(0.0, 0.0, world.ball.p_RB.y() >= 0.0 ? 0.8 : -0.8);
  intent.head.kind = HeadRequest::Kind::Scan;
}

void Behavior::play(const WorldState& world, Intent& intent) {
  const bool isGoalie = world.game.unum == 1;
  if (!world.ball.known) {
    // Only once the head has had time to look around does the body turn.
    if (!isGoalie && world.time - world.ball.lastSeen > 2.0 && world.time - world.game.phaseSince > 3.0)
      searchBall(world, intent);
    return;
  }
  if (!world.self.localized) return;
  if (isGoalie) {
    role_ = Role::Goalie;
    goalie(world, intent);
    return;
  }
  updateRole(world);
  const Vector2 ball = world.ball.p_FB.head<2>();
  if (isOpponentKick(world.game.phase)) {
    // Everybody keeps the distance that the referee enforces, on the own goal's side of the ball.
    const Vector2 ownGoal(-0.5 * world.field.length, 0.0);
    Vector2 place = roleTarget_;
    const double clear = parameters_.clearOfOpponentKick;
    if ((place - ball).norm() < clear) place = ball + clear * (ownGoal - ball).normalized();
    if (world.game.phase == Phase::OpponentKickOff) place.x() = std::min(place.x(), -0.6);
    intent.motion = walkTo(world, Pose2(place, headingTo(world, ball)), parameters_.avoidDistance);
    return;
  }
  if (role_ == Role::OnBall) {
    intent.motion = handleBall(world, ballTarget(world), parameters_.ball);
    return;
  }
  Vector2 place = roleTarget_;
  if (world.game.phase == Phase::OwnKickOff) place.x() = std::min(place.x(), -0.6);
  intent.motion = walkTo(world, Pose2(place, headingTo(world, ball)), parameters_.avoidDistance);
}

void Behavior::goalie(const WorldState& world, Intent& intent) {
  const GoalieParameters& parameters = parameters_.goalie;
  const Vector2 ball = world.ball.p_FB.head<2>();
  const Vector2 speed = world.ball.v_FB.head<2>();
  const Vector2 goal(-0.5 * world.field.length, 0.0);
  const Vector2 self = world.self.X_FR.translation;

  // A ball that will cross the line through the goalie on its way into the goal.
  if (parameters.dive && world.game.phase == Phase::PlayOn && speed.x() < -0.5) {
    const double time = (self.x() - ball.x()) / speed.x();
    const double crossing = ball.y() + speed.y() * time;
    const double aside = crossing - self.y();
    const bool reachesUs = world.ball.p_FRest.x() < self.x();
    const bool atGoal = std::abs(crossing) < 0.5 * world.field.goalWidth + 0.2;
    if (time > 0.0 && time < parameters.diveTime && reachesUs && atGoal &&
        std::abs(aside) > parameters.diveReach) {
      intent.motion.kind = MotionRequest::Kind::Skill;
      intent.motion.skill.assign("dive");
      intent.motion.side = aside > 0.0 ? model::Side::Left : model::Side::Right;
      return;
    }
  }
  const bool ballNear = (ball - goal).norm() < parameters.attackDistance;
  if (ballNear && !isOpponentKick(world.game.phase) && speed.norm() < 0.5) {
    intent.motion = handleBall(world, ballTarget(world), parameters_.ball);
    return;
  }
  const Vector2 toBall = (ball - goal).normalized();
  Vector2 place = goal + parameters.outOfGoal * toBall;
  place.x() = std::max(place.x(), goal.x() + 0.2);
  intent.motion = walkTo(world, Pose2(place, headingTo(world, ball)), parameters_.avoidDistance);
}

}  // namespace nonet::team
