#include <algorithm>
#include <cmath>

#include "nonet/math/direction.h"
#include "nonet/team/behaviors.h"

#include "team/behaviors/push.h"

namespace nonet::team {

namespace {

constexpr double kKeep = 0.5;  // m, of the ball from the torso, for which the parameters stand

// The ball and the way that it should go, as they will be seen in a moment: the ball rolls, the robot walks.
struct Line {
  double behind = 0.0;   // m, how far the robot is behind the ball
  double besides = 0.0;  // m, the ball to the left of the line through the robot
};

Line lineAhead(const Situation& s) {
  const BallPlay& play = *s.play;
  const world::BodyState& body = s.world.body;
  const Vector2 rolls = s.ballVelocity();
  const Vector2 walks = body.odometryStep.translation / std::max(body.cycleTime, 1e-3);
  const Vector2 ball = play.ball + s.parameters.dribble.lead * (rolls - walks);
  return {ball.dot(play.along), ball.dot(play.aside)};
}

// After the ball, as fast as leaves time to come into its line before the contact, and slow at the contact,
// or the ball is gone.
std::optional<Action> steer(const Situation& s) {
  const BallPlay& play = *s.play;
  const DribbleParameters& p = s.parameters.dribble;
  const Line line = lineAhead(s);
  const bool inLine = line.behind > p.behind && std::abs(play.direction) < p.angle &&
                      std::abs(line.besides) < p.aside + p.cone * std::max(line.behind, 0.0);
  if (!inLine) return std::nullopt;
  // Met by the foot on whose side it is.
  const double foot = std::clamp(line.besides, -p.footAside, p.footAside);
  const double off = line.besides - foot;
  const double gap = line.behind - p.contact;
  const double missing = std::max(std::abs(off) - p.tolerance, 1e-3);
  const double inTime = std::max(p.leastSpeed, p.asideSpeed * gap / missing);
  const double looser = 1.0 + p.loose * (play.keep.value_or(kKeep) / kKeep - 1.0);
  const double ahead = std::min({p.speed, looser * (p.touch + p.haste * std::max(gap, 0.0)), inTime});
  const double aside = std::clamp(p.asideGain * off, -p.asideSpeed, p.asideSpeed);
  const double inwards = p.footAside > 0.0 ? p.toe * foot / p.footAside : 0.0;
  motion::WalkVelocity walk;
  walk.set = motion::WalkSet::Dribble;
  walk.velocity = Pose2(ahead * play.along + aside * play.aside, p.turnGain * (play.direction - inwards));
  return Action(walk, "steered");
}

// Right before the own goal: as the robot stands, if the ball then goes neither into the goal nor before it.
std::optional<Action> pushAway(const Situation& s) {
  constexpr double kAhead = 0.5;  // rad, of the ball from where the robot faces
  constexpr double kClear = 0.5;  // m beside a post
  const Vector2& ball = s.play->ball;
  if (!atOwnGoal(s.world) || s.setPlay || std::abs(directionOf(ball)) > kAhead) return std::nullopt;
  const world::FieldGeometry& field = s.world.field;
  const Vector2 away = (s.ball() - s.world.self.X_FR.translation).normalized();
  const double toSide = (field.post() + kClear - std::abs(s.ball().y())) / std::max(std::abs(away.y()), 1e-6);
  const bool crosses = away.x() < 0.0 && s.ball().x() + toSide * away.x() < -field.goalLine();
  const bool inwards = away.y() * s.ball().y() < 0.0 && away.x() < 0.3;
  if (crosses || inwards) return std::nullopt;
  const Pose2 through(ball + s.parameters.ball.dribbleThrough * ball.normalized(), directionOf(ball));
  return Action(motion::WalkTo{through, false}, "away from the goal");
}

std::optional<Action> runThrough(const Situation& s) {
  if (auto away = pushAway(s)) return away;
  const BallPlay& play = *s.play;
  const BallHandlingParameters& p = s.parameters.ball;
  const bool aligned = play.behind > p.alignedBehind && std::abs(play.direction) < p.alignedAngle &&
                       std::abs(play.besides) < p.alignedAside;
  if (!aligned || pushRollsOut(s)) return std::nullopt;
  const Pose2 through(play.ball + p.dribbleThrough * play.along, play.direction);
  return Action(motion::WalkTo{through, false}, "through the ball");
}

// A set piece: whoever walks into the ball often touches it twice. Before the server drops the ball,
// anything.
bool isToBeKicked(const Situation& s) {
  constexpr double kKickBy = 10.0;  // s
  const bool canKick = s.parameters.ball.kick && !s.motion.kicks.empty();
  return s.setPlay && canKick && s.play->use == KickUse::Clear &&
         s.world.time - s.world.game.phaseSince < kKickBy;
}

}  // namespace

std::optional<Action> dribble(const Situation& s) {
  if (!s.play) return std::nullopt;
  if (isToBeKicked(s)) return std::nullopt;
  const bool keep = s.play->keep.has_value() || s.parameters.dribble.steer;
  std::optional<Action> action = keep ? steer(s) : runThrough(s);
  if (action) action->reason.candidates = s.play->candidates;
  return action;
}

}  // namespace nonet::team
