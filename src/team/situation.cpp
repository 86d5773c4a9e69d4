#include "nonet/team/situation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nonet/math/direction.h"
#include "nonet/team/ball_choice.h"
#include "nonet/team/goalie.h"
#include "nonet/team/pass_mode.h"
#include "nonet/team/touch_watch.h"

namespace nonet::team {

namespace {

constexpr double kGoalKick = 10.0;  // m, of the goalie's longest kick, as it usually comes to rest
// Where theirs comes down: at their area nobody of ours would have it.
constexpr double kTheirGoalKick = 9.5;  // m
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Formation placesFor(const Situation& s) {
  const world::WorldState& world = s.world;
  if (s.phase() == world::Phase::OwnKickOff)
    return kickOffFormation(s.ball(), world.field, s.parameters.setPlay);
  // Where the one on the ball is: at the edge of the forbidden circle, on the own goal's side.
  Vector2 from = s.ball();
  if (world::isOpponentSetPiece(s.phase())) {
    const Vector2 home = world.field.ownGoal() - from;
    const bool goalKick = s.phase() == world::Phase::OpponentGoalKick;
    const double clear = goalKick ? kTheirGoalKick : s.clearOfOpponentKick();
    from += std::min(clear, 0.5 * home.norm()) * home.stableNormalized();
  }
  // Where the goalie's kick comes down: for all the same place, whatever they see and can kick themselves.
  if (s.phase() == world::Phase::OwnGoalKick && s.parameters.ball.kick)
    from += kGoalKick * (clearanceTarget(s) - from).normalized();
  // The stopper is the receiver of the own set piece, so whoever is next to that place is the stopper.
  const std::optional<Vector2> receiver = s.setPlay ? std::optional(s.setPlay->p_FReceiver) : std::nullopt;
  return formationFor(from, kFieldRoles, world.field, s.parameters.formation, s.parameters.variant,
                      world.opponents, receiver);
}

// Straight away from the own goal.
Vector2 awayTarget(const Situation& s) {
  return s.ball() + s.parameters.variant.clearLength * (s.ball() - s.world.field.ownGoal()).normalized();
}

// One of the others in the field.
template <class Which>
bool anyMate(const Situation& s, const Which& which) {
  const auto& mates = s.world.teammates;
  return std::any_of(mates.begin() + 2, mates.end(), [&](const world::PlayerState& mate) {
    const auto unum = static_cast<int>(&mate - mates.data());
    return mate.known && unum != s.world.game.unum && !s.hasGone(unum) && which(mate);
  });
}

bool receiverReady(const Situation& s) {
  return anyMate(s, [&](const world::PlayerState& mate) {
    const double away = (mate.X_FP.translation - s.setPlay->p_FReceiver).norm();
    return !mate.fallen && away < s.parameters.setPlay.receiverReady;
  });
}

// Goes as far as it is asked to, or nearly, and not farther; nothing without such a kick.
const motion::KickOption* kickThatGoes(const Situation& s, double distance) {
  const auto serves = [&](const motion::KickOption& kick) {
    const motion::KickHead& head = kick.head;
    return kick.foot == model::Side::Left && head.isStraight() && head.scales && !head.isChip() &&
           distance >= head.shortest;
  };
  if (!s.parameters.ball.kick) return nullptr;
  const auto found = std::find_if(s.motion.kicks.begin(), s.motion.kicks.end(), serves);
  return found == s.motion.kicks.end() ? nullptr : &*found;
}

// A kick to where one of us is first, if that is worth more than the pass to the one who stands next to it.
BallPlay setPiece(const Situation& s, Candidates* record) {
  if (s.phase() != world::Phase::OwnKickOff && s.parameters.ball.kick) {
    const BallChoice choice = chooseSetPiece(s, record);
    if (choice.kick) {
      BallPlay play = playTowards(s, choice.p_FTarget, KickUse::Clear, ballNotPut(s.world));
      play.kick = choice.with;
      if (record != nullptr) play.candidates = record->all();
      return play;
    }
  }
  const bool alone = !anyMate(s, [](const world::PlayerState&) { return true; });
  if (alone) return playTowards(s, s.p_FTarget, KickUse::Clear, ballNotPut(s.world));
  const double waited = s.world.time - s.world.game.phaseSince;
  const bool wait = ballNotPut(s.world) || (waited < s.parameters.waitForReceiver && !receiverReady(s));
  BallPlay play = playTowards(s, s.setPlay->p_FTarget, KickUse::Never, wait);
  // Whoever walks into the ball often touches it twice.
  if (const auto* kick = kickThatGoes(s, (play.p_FTarget - s.ball()).norm())) {
    play.use = KickUse::Clear;
    play.kick = kick->name;
  }
  return play;
}

}  // namespace

bool Situation::waitsForKickOff() const {
  return phase() == world::Phase::BeforeKickOff || phase() == world::Phase::OwnGoal ||
         phase() == world::Phase::OpponentGoal;
}

bool Situation::hasGone(int unum) const {
  const double heard = world.radio[static_cast<std::size_t>(unum)].time;
  const double since = world.time - heard;
  return heard > world::kNever && unum != world.game.unum && since > parameters.agreement.goneAfter;
}

double Situation::clearOfOpponentKick() const {
  return phase() == world::Phase::OpponentPass ? parameters.passMode.clear : parameters.clearOfOpponentKick;
}

bool Situation::free() const {
  const bool clockRuns =
      !waitsForKickOff() && phase() != world::Phase::GameOver && phase() != world::Phase::Other;
  return clockRuns && !motion.busy && !motion.rising;
}

Pose2 BallPlay::placeBehind(double distance) const {
  const Vector2 way = p_FTarget - p_FMeeting;
  return {p_FMeeting - distance * way.normalized(), directionOf(way)};
}

void BallPlay::face(double heading) {
  direction = heading;
  along = unitVector(heading);
  aside = Vector2(-along.y(), along.x());
  behind = ball.dot(along);
  besides = ball.dot(aside);
}

BallPlay playTowards(const Situation& s, const Vector2& p_FTarget, KickUse use, bool wait) {
  BallPlay play;
  play.p_FTarget = p_FTarget;
  play.use = use;
  play.wait = wait;
  const Pose2& X_FR = s.world.self.X_FR;
  play.p_FMeeting = s.forecast.at(timeToBall({X_FR, true}, s.forecast, p_FTarget, s.parameters.pace));
  play.ball = s.world.ball.p_RB;
  play.target = X_FR.inverse() * p_FTarget;
  play.face(directionOf(play.target - play.ball));
  return play;
}

Situation assess(const world::WorldState& world, const TeamParameters& parameters,
                 const motion::MotionState& motion, const std::optional<double>& present,
                 Candidates* record) {
  Situation s{world, parameters, motion, BallForecast(world, parameters.pace)};
  if (record != nullptr) record->clear();
  s.p_FTarget = ballTarget(world, parameters.target, present, record);
  if (record != nullptr) s.targets = record->all();
  s.nearestOpponent = nearestOf(world.opponents, s.ball());
  s.timeToBall.fill(kInfinity);
  for (std::size_t unum = 1; unum < s.timeToBall.size(); ++unum) {
    const world::PlayerState& mate = world.teammates[unum];
    if (!mate.known) continue;
    s.timeToBall[unum] =
        timeToBall(runnerOf(mate, world.time, parameters.pace), s.forecast, s.p_FTarget, parameters.pace);
  }
  const world::RadioReport& goalie = world.radio[1];
  s.goalieClaims = world.time - goalie.time < parameters.agreement.claimAge && goalie.message.timeToBall &&
                   !goalie.message.fallen;
  if (s.phase() == world::Phase::OwnPass) {
    s.mayScore = false;
    s.undisturbed = std::max(0.0, world.game.phaseSince + kPassModeTime - world.time);
  }
  if (world::isOwnSetPiece(s.phase()))
    s.setPlay = setPlayFor(s.phase(), s.ball(), world.field, parameters.setPlay);
  s.formation = placesFor(s);
  return s;
}

std::optional<BallPlay> ownTurn(const Situation& s, Candidates* record) {
  if (!s.acts()) return std::nullopt;
  if (s.role == Role::Goalie) {
    if (!s.claims) return std::nullopt;
    return playTowards(s, clearanceTarget(s), KickUse::Clear, ballNotPut(s.world));
  }
  const bool opponents = world::isOpponentSetPiece(s.phase());
  if (s.role != Role::OnBall || s.goalieClaims || opponents) return std::nullopt;
  const bool alone = s.phase() == world::Phase::OwnKickOff && atMostTwoPlay(s.world);
  if (s.setPlay && !alone) return setPiece(s, record);
  if (!s.mayTouch) return std::nullopt;
  if (s.parameters.variant.clearFirst && s.ball().x() < 0.0)
    return playTowards(s, awayTarget(s), KickUse::Clear);
  if (!s.parameters.choice.use || !world::isOpenPlay(s.phase())) {
    BallPlay play = playTowards(s, s.p_FTarget, KickUse::IfFree);
    play.candidates = s.targets;
    return play;
  }
  const BallChoice choice = chooseAction(s, record);
  BallPlay play = playTowards(s, choice.p_FTarget, choice.kick ? KickUse::Clear : KickUse::Never);
  play.kick = choice.with;
  if (record != nullptr) play.candidates = record->all();
  return play;
}

}  // namespace nonet::team
