#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/team/ball_choice.h"
#include "nonet/team/behaviors.h"

#include "team/behaviors/go_behind.h"
#include "team/behaviors/kick_action.h"
#include "team/behaviors/play_aside.h"

namespace nonet::team {

namespace {

constexpr double kMateAtBall = 0.2;  // m

// Where the ball's way to its target meets the goal line, own field frame.
Vector2 goalCrossing(const Situation& s, const BallPlay& play) {
  const Vector2 way = play.p_FTarget - s.ball();
  const double toLine = s.world.field.goalLine() - s.ball().x();
  return s.ball() + toLine / std::max(way.x(), 1e-6) * way;
}

bool betweenPosts(const Situation& s, const Vector2& crossing) {
  return std::abs(crossing.y()) < s.world.field.post();
}

// Where the play's kick comes to rest, the longest if it names none; own field frame.
Vector2 kickEnd(const Situation& s, const BallPlay& play) {
  const Vector2 way = play.p_FTarget - s.ball();
  return s.ball() + kickLength(s, play.kick) * way.normalized();
}

bool beyondGoalLine(const Situation& s, const Vector2& end) {
  return end.x() > s.world.field.goalLine();
}

bool endsInGoal(const Situation& s, const BallPlay& play, const Vector2& end) {
  if (!s.mayScore || !beyondGoalLine(s, end) || !betweenPosts(s, goalCrossing(s, play))) return false;
  const ShotParameters& p = s.parameters.shot;
  return hitsGoal(s.world, directionOf(play.p_FTarget - s.ball()), p.spread) >= p.hits;
}

bool endsInField(const Situation& s, const BallPlay& play, const Vector2& end) {
  if (std::abs(end.y()) > s.world.field.touchLine()) return false;
  return !beyondGoalLine(s, end) || endsInGoal(s, play, end);
}

// One of us is first where the longest kick towards the target comes to rest. A ball that crosses the line
// between the posts need not be caught.
bool staysOurs(const Situation& s, const BallPlay& play, const Vector2& end) {
  if (endsInGoal(s, play, end)) return true;
  return teammatesTime(s, end) + s.parameters.ball.kickLead < opponentsTime(s, end);
}

// One of ours lies or stands right at the ball.
bool mateAtBall(const Situation& s) {
  const auto& mates = s.world.teammates;
  const auto at = [&](const world::PlayerState& mate) {
    const bool self = &mate == &mates[static_cast<std::size_t>(s.world.game.unum)];
    return mate.known && !self && (mate.X_FP.translation - s.ball()).norm() < kMateAtBall;
  };
  return std::any_of(mates.begin(), mates.end(), at);
}

// Any kick at all: it is wanted, the ball lies, no mate is at it and nobody nearer to it than `room`, or a
// share of that once the robot is in its place.
bool canKick(const Situation& s, bool there, double room) {
  const BallHandlingParameters& p = s.parameters.ball;
  return p.kick && s.play->use != KickUse::Never && s.world.ball.v_FB.head<2>().norm() <= p.kickRolling &&
         s.nearestOpponent >= (there ? p.kickPress : 1.0) * room && !mateAtBall(s);
}

// How far a kick has come: the farther, the less is asked of who is where.
struct Stage {
  bool there = false;  // the robot is in its place
  bool held = false;   // it is on its last steps there
};

bool mayKick(const Situation& s, const BallPlay& play, const Stage& stage) {
  const BallHandlingParameters& p = s.parameters.ball;
  const KickUse use = s.play->use;
  const bool there = stage.there;
  const double contact = contactTime(s, play);
  const double wait = stage.held ? 0.0 : p.kickRoomPace * contact;
  const double soon = there ? p.kickOpponentDistance : p.kickRoom + wait;
  const double room = s.undisturbed > contact ? 0.0 : std::min(p.kickOpponentDistance, soon);
  if (!canKick(s, there, room)) return false;
  if (use == KickUse::Clear) return true;
  const Vector2 restsAt = kickEnd(s, play);
  if (!endsInField(s, play, restsAt) || mateBars(s.world, s.ball(), restsAt)) return false;
  if (there || stage.held) return true;
  if (!staysOurs(s, play, restsAt)) return false;
  const Vector2 from = s.ball();
  const Vector2 way = play.p_FTarget - from;
  const Vector2 end = from + std::min(1.0, p.kickLaneLength / std::max(way.norm(), 1e-6)) * way;
  return laneWidth(s.world, from, end, std::numeric_limits<double>::infinity()) > p.kickLane;
}

// Near enough, and behind the ball, for motion to take the last steps.
bool isBehind(const Situation& s, const BallPlay& play) {
  const BallHandlingParameters& p = s.parameters.ball;
  return play.behind > p.kickBehind && std::abs(play.direction) < p.kickApproach &&
         std::abs(play.besides) < play.behind + p.kickBesides;
}

bool goesAside(const Situation& s, std::string_view kick) {
  return std::any_of(s.motion.kicks.begin(), s.motion.kicks.end(), [&](const motion::KickOption& option) {
    return option.name == kick && !option.head.isStraight();
  });
}

// The robot is on its last steps to a kick, and about that direction is still wanted.
bool isHeld(const Situation& s) {
  const BallHandlingParameters& p = s.parameters.ball;
  if (!kickUnderWay(s, p.kickHold)) return false;
  const double wanted = directionOf(s.play->p_FTarget - s.ball());
  return std::abs(angleDifference(wanted, *presentKick(s))) < p.kickHoldAngle;
}

// In the place for a kick, which is not one to the side.
bool isThere(const Situation& s) {
  return s.motion.kickInPlace() && !goesAside(s, s.motion.kick.name);
}

// Where the ball at the feet is about to be kicked, to be stopped by nobody: rad, own field frame.
std::optional<double> shotUnderWay(const Situation& s) {
  return kickUnderWay(s, s.parameters.shot.keepWithin) ? presentKick(s) : std::nullopt;
}

}  // namespace

std::optional<Action> shoot(const Situation& s) {
  const ShotParameters& p = s.parameters.shot;
  if (!s.play || !s.mayScore || s.phase() != world::Phase::PlayOn) return std::nullopt;
  const bool there = isThere(s);
  if (!canKick(s, there, p.room)) return std::nullopt;
  const std::optional<Shot> shot = bestShot(s.world, s.motion.kicks, p, shotUnderWay(s));
  if (!shot) return std::nullopt;
  BallPlay play = playTowards(s, shot->p_FTarget, s.play->use);
  play.kick = shot->kick;
  if (!there && !isBehind(s, play)) return std::nullopt;
  return kickAction(s, play, there ? "in place" : "line up");
}

std::optional<Action> kick(const Situation& s) {
  if (!s.play || s.motion.kicks.empty()) return std::nullopt;
  const bool there = isThere(s);
  const bool held = isHeld(s);
  const bool asideHeld = held && goesAside(s, std::get<motion::KickTo>(s.motion.request).kick.view());
  const bool straight = mayKick(s, *s.play, {there, held && !asideHeld});
  if (straight && there) return kickAction(s, *s.play, "in place");
  const std::optional<BallPlay> aside = atOwnGoal(s.world) ? std::nullopt : playAside(s, *s.play, straight);
  const bool thereAside = aside && s.motion.kickInPlace() && s.motion.kick.name == aside->kick;
  if (aside && mayKick(s, *aside, {thereAside, asideHeld})) {
    if (thereAside) return kickAction(s, *aside, "in place");
    return isBehind(s, *aside) ? kickAction(s, *aside, "line up aside") : goBehind(s, *aside);
  }
  if (!straight || !isBehind(s, *s.play)) return std::nullopt;
  return kickAction(s, *s.play, "line up");
}

}  // namespace nonet::team
