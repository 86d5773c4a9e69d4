#include "nonet/team/challenge.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include "nonet/team/behaviors.h"

namespace nonet::team {

namespace {

struct Name {
  std::string_view word;
  Challenge challenge;
};
constexpr std::array<Name, 5> kNames = {{{"run", Challenge::Run},
                                         {"kick", Challenge::Kick},
                                         {"goalie", Challenge::Goalie},
                                         {"pass", Challenge::Passing},
                                         {"keepaway", Challenge::KeepAway}}};

}  // namespace

std::optional<Challenge> challengeFromName(std::string_view name) {
  std::string letters;
  for (const char c : name) {
    if (std::isalpha(static_cast<unsigned char>(c)) != 0)
      letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  for (const Name& known : kNames) {
    if (letters.find(known.word) != std::string::npos) return known.challenge;
  }
  return std::nullopt;
}

std::string_view challengeName(Challenge challenge) {
  for (const Name& known : kNames) {
    if (known.challenge == challenge) return known.word;
  }
  return "";
}

std::optional<Action> ChallengePlayer::update(const Situation& situation) {
  if (situation.waitsForKickOff()) *this = ChallengePlayer(challenge_);
  if (!situation.free()) return std::nullopt;
  std::optional<Action> action;
  if (challenge_ == Challenge::Run) action = run(situation);
  if (challenge_ == Challenge::Kick) action = kickToCentre(situation);
  if (action) action->reason.behavior = "challenge";
  return action;
}

// Along a line parallel to the field's axis, up to the end of the field: where that runs on, nothing is
// gained.
Action ChallengePlayer::run(const Situation& s) {
  const ChallengeParameters& p = s.parameters.challenge;
  const Pose2& X_FR = s.world.self.X_FR;
  if (!s.world.self.localized)
    return {motion::WalkVelocity{Pose2(p.blindSpeed, 0.0, 0.0), motion::WalkSet::Sprint}, "blind"};
  if (!start_) start_ = X_FR.translation;
  if (X_FR.translation.x() > s.world.field.goalLine() - p.runOut) return {motion::Stand{}, "arrived"};
  const Pose2 ahead(X_FR.translation.x() + p.runAhead, start_->y(), 0.0);
  motion::WalkTo walk;
  walk.target = X_FR.inverse() * ahead;
  walk.stopAtTarget = false;
  return {walk, "run"};
}

std::optional<Action> ChallengePlayer::kickToCentre(const Situation& s) {
  if (!s.acts()) return std::nullopt;
  const ChallengeParameters& p = s.parameters.challenge;
  near_ = near_ || s.world.ball.p_RB.norm() < p.near;
  if (!start_ || !near_) start_ = s.ball();
  kicked_ = kicked_ || (s.ball() - *start_).norm() > p.kicked;
  if (kicked_) return Action(motion::Stand{}, "kicked");
  Situation own = s;
  own.play = playTowards(s, Vector2::Zero(), KickUse::Clear);
  for (const auto& behavior : {goToBall, kick, goBehindBall}) {
    if (auto action = behavior(own)) return action;
  }
  return std::nullopt;
}

}  // namespace nonet::team
