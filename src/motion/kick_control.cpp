#include "nonet/motion/kick_control.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/motion/walk/balance.h"

namespace nonet::motion {

using model::Side;

namespace {

constexpr double kAbout = 2.0;  // tolerances: the ball lies about where a kick wants it
constexpr double kNear = 0.01;  // m; from here on the least speed fades, so that it does not jump
// A kick with its ball behind the robot: as long as it must still turn by more than this, rad, it keeps so
// far from the ball, m.
constexpr double kTurned = 0.5;
constexpr double kTurnsAt = 0.27;
// And it comes up to the ball so slowly that it stops before it, m/s.
constexpr double kBackwards = 0.25;

// Out of the walk a kick begins where the step has ended that stands on the kicking foot: the other one
// becomes the stance. Only out of slow steps: fast ones leave too much to balance. Who has been hit is slow,
// too, and sees the ball elsewhere under its torso than its feet have it. `away`: speed at which the ball
// rolls away ahead, m/s; the foot passes one that comes.
bool mayBeginAtStep(const WalkEngine& walk, Side foot, double away, const KickParameters& p) {
  const GaitState& gait = walk.gait();
  if (gait.standing || gait.stance != foot || gait.phase < 1.0 - 1e-6) return false;
  if (leansTooFar(walk.measurement().tilt) || away < -p.comes) return false;
  if (gait.step.translation.x() < p.leastPace * gait.stepDuration) return false;
  return gait.step.translation.x() < (p.closing + std::max(away, 0.0)) * gait.stepDuration &&
         std::abs(gait.step.translation.y()) < p.asidePace * gait.stepDuration &&
         gait.step.translation.norm() < p.strideSpeed * gait.stepDuration &&
         std::abs(gait.step.rotation) < p.strideTurn * gait.stepDuration;
}

// Where to go first when the ball is to lie behind: there the robot turns without touching it.
Vector2 turningPlace(const Vector2& place, const Vector2& ball) {
  return ball + kTurnsAt * (place - ball).normalized();
}

Vector2 shortened(const Vector2& way, double most) {
  return way * std::min(1.0, most / std::max(way.norm(), 1e-9));
}

// How far the kick takes a ball for which so much is wanted. One that does not scale goes too far for a pass,
// which no other kick minds.
double carries(const KickHead& head, double wanted, bool stops) {
  if (stops && !head.scales) return head.longest;
  return std::clamp(wanted, head.shortest, head.longest);
}

}  // namespace

KickControl::Way KickControl::wayTo(const KickOption& option, const KickTo& request) const {
  const Vector2 way = request.target - request.ball;
  Way result;
  result.turn = wrapAngle(directionOf(way) - option.head.direction);
  result.place = request.ball - Pose2(Vector2::Zero(), result.turn).rotate(option.head.p_RBall);
  result.missing = request.ball - option.head.p_RBall;
  return result;
}

double KickControl::cost(const KickOption& option, const KickTo& request) const {
  const KickParameters& p = parameters_;
  const Way way = wayTo(option, request);
  const double wanted = (request.target - request.ball).norm();
  const double carried = carries(option.head, wanted, request.stops);
  const double off = std::abs(wanted - carried);
  // The place lies beyond the ball as seen from here.
  const bool around = way.place.dot(request.ball) > request.ball.squaredNorm();
  return way.place.norm() + p.turnCost * std::abs(way.turn) + (around ? p.aroundCost : 0.0) +
         p.timeCost * (option.head.steady + option.head.contact) + p.shortCost * off +
         (option.head.fromWalk ? 0.0 : p.standCost);
}

bool KickControl::serves(const KickOption& option, const KickTo& request) const {
  if (!option.head.hasRoom(request.room, &option == chosen_)) return false;
  const bool named = request.kick.view() == option.name;
  if (!request.kick.view().empty() && !named) return false;
  // What a ball may go beyond is not for soft kicks, chips are for those who want to go over somebody, and
  // exact kicks for those who have the time.
  const bool special = (option.head.scales && !request.stops) || option.head.onlyByName();
  if (special && !named) return false;
  return std::find(refused_.begin(), refused_.end(), &option) == refused_.end();
}

const KickOption* KickControl::choose(const KickTo& request) const {
  const KickOption* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const KickOption& option : catalogue_->options()) {
    if (!serves(option, request)) continue;
    const double value = cost(option, request) - (&option == chosen_ ? parameters_.keep : 0.0);
    if (value >= least) continue;
    least = value;
    best = &option;
  }
  return best;
}

// Small steps may lead nowhere: the least speed keeps a robot from stopping short of its place for ever. The
// place itself moves with the ball, `along`.
WalkVelocity KickControl::lastSteps(const Way& way, const Vector2& along) const {
  const KickParameters& p = parameters_;
  const Vector2 speed = along + (p.gain + p.leastSpeed / std::max(way.place.norm(), kNear)) * way.place;
  WalkVelocity walk;
  walk.velocity.translation = speed * std::min(1.0, p.mostSpeed / std::max(speed.norm(), 1e-9));
  walk.velocity.rotation = p.gain * way.turn;
  return walk;
}

// Where ball and target will be seen when the present steps have gone on for so long, at so much less speed
// ahead than they say.
KickTo KickControl::after(double seconds, double drift, const KickTo& request, const WalkEngine& walk) const {
  const Pose2 speed = walk.speed();
  const Vector2 way = seconds * (speed.translation - Vector2(drift, 0.0));
  const Pose2 back = Pose2(way, seconds * speed.rotation).inverse();
  KickTo then = request;
  if (!chosen_->head.fromWalk && !walk.standing()) then.ball.x() += parameters_.stopDrift;
  then.ball = back * Vector2(then.ball);
  then.target = back * request.target;
  return then;
}

bool KickControl::within(double share, const Way& way) const {
  const KickHead& head = chosen_->head;
  return std::abs(way.missing.x()) < share * head.tolerance.x() &&
         std::abs(way.missing.y()) < share * head.tolerance.y() &&
         std::abs(way.turn) < share * (head.turn > 0.0 ? head.turn : parameters_.angle);
}

// The cheapest first, and no further once one may begin or must still come to its place.
KickStep KickControl::update(const KickTo& request, const WalkEngine& walk, double quiet) {
  const KickOption* before = chosen_;
  refused_.fill(nullptr);
  KickStep step;
  for (const KickOption*& refused : refused_) {
    chosen_ = choose(request);
    if (chosen_ == nullptr) return step;
    if (chosen_ != before) comesToStand_ = false;
    step = stepFor(request, walk, quiet);
    if (!step.begin || check_ == nullptr || check_->check(*chosen_, step.aim.ball).allows()) return step;
    step.begin = step.inPlace = step.stand = comesToStand_ = false;
    refused = chosen_;
  }
  return step;
}

KickStep KickControl::stepFor(const KickTo& request, const WalkEngine& walk, double quiet) {
  const KickParameters& p = parameters_;
  KickStep step;
  step.option = chosen_;
  const KickHead& head = chosen_->head;
  const double delay = CommandHistory::kDelay * kCycleTime;
  // The steps follow a ball that still rolls. In full they would run into it.
  KickTo ahead = after(p.coast, head.isExact() ? p.drift : 0.0, request, walk);
  ahead.ball += p.follow * (p.coast + delay + head.contact) * request.ballVelocity;
  Way toPlace = wayTo(*chosen_, ahead);
  const bool backwards = head.isBackward();
  const bool turns = backwards && std::abs(toPlace.turn) >= kTurned;
  if (turns) toPlace.place = turningPlace(toPlace.place, ahead.ball);
  step.walk = lastSteps(toPlace, p.follow * request.ballVelocity);
  if (backwards && !turns)
    step.walk.velocity.translation = shortened(step.walk.velocity.translation, kBackwards);
  // Where the ball will be when the kick begins, and by how much it still rolls until contact.
  KickTo then = after(head.fromWalk ? delay : 0.0, 0.0, request, walk);
  then.ball += (delay + head.contact) * request.ballVelocity;
  const Way way = wayTo(*chosen_, then);
  const bool quietly = walk.standing() && quiet >= p.quietTime;
  step.inPlace = within(head.fromWalk ? 1.0 : comesToStand_ ? p.stay : walk.standing() ? 1.0 : p.aim, way);
  comesToStand_ = step.inPlace;
  step.aim = {then.ball, way.turn, walk.speed().translation, (request.target - request.ball).norm()};
  step.begin = step.inPlace &&
               (head.fromWalk ? mayBeginAtStep(walk, chosen_->foot, request.ballVelocity.x(), p) : quietly);
  step.stand = step.inPlace && !head.fromWalk;
  if (head.isExact()) {
    const bool lies = within(kAbout, way) && (steady_ == 0.0 || steadyFor_ == chosen_);
    steadyFor_ = chosen_;
    steady_ = lies ? steady_ + kCycleTime : 0.0;
    step.begin = step.begin && steady_ >= head.steady;
  }
  return step;
}

}  // namespace nonet::motion
