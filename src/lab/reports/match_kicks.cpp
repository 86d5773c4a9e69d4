#include "nonet/lab/reports/match_kicks.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include <fmt/format.h>

#include "nonet/lab/common/statistics.h"
#include "nonet/lab/trial/kick_trial.h"
#include "nonet/lab/trial/true_pose.h"
#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/world/ball_law.h"

#include "lab/trial/ball_touch.h"

namespace nonet::lab {
namespace {

using protocol::PlayMode;

constexpr double kLiesStill = 0.05;  // m/s
constexpr double kLongest = 10.0;    // s
constexpr double kHalf = 0.5;

world::BallMotion ballOf(const sim::Simulation& simulation) {
  const sim::World& world = simulation.world();
  return {world.ballPosition().cast<double>(), world.ballVelocity().cast<double>()};
}

bool isGoal(PlayMode mode) {
  return mode == PlayMode::GoalLeft || mode == PlayMode::GoalRight;
}

nlohmann::ordered_json json(const KickShares& shares) {
  return {{"kicks", shares.kicks},
          {"missed", shares.missed},
          {"intended_m", shares.intended},
          {"carried_of_intended", shares.carriedShare},
          {"went_of_intended", shares.wentShare},
          {"under_half", shares.underHalf},
          {"direction_error_deg", toDegrees(shares.directionError)},
          {"direction_error_p90_deg", toDegrees(shares.directionErrorTenth)}};
}

using Groups = std::map<std::string, std::map<std::string, std::vector<MatchKick>>>;

// By team, then by name; under the name "all" every kick of the team.
Groups groupsOf(const std::vector<MatchKick>& kicks) {
  Groups groups;
  for (const MatchKick& kick : kicks) {
    groups[kick.team]["all"].push_back(kick);
    groups[kick.team][kick.name].push_back(kick);
  }
  return groups;
}

}  // namespace

KickShares kickShares(const std::vector<MatchKick>& kicks) {
  KickShares shares;
  shares.kicks = static_cast<int>(kicks.size());
  if (kicks.empty()) return shares;
  std::vector<double> intended, carried, went, directions;
  for (const MatchKick& kick : kicks) {
    intended.push_back(kick.intended);
    carried.push_back(kick.carriedShare());
    went.push_back(kick.wentShare());
    if (kick.contact) directions.push_back(std::abs(kick.direction));
    shares.missed += kick.contact ? 0.0 : 1.0 / shares.kicks;
    shares.underHalf += kick.carriedShare() < kHalf ? 1.0 / shares.kicks : 0.0;
  }
  shares.intended = quantile(intended, 0.5);
  shares.carriedShare = quantile(carried, 0.5);
  shares.wentShare = quantile(went, 0.5);
  if (directions.empty()) return shares;
  shares.directionError = quantile(directions, 0.5);
  shares.directionErrorTenth = quantile(directions, 0.9);
  return shares;
}

void MatchKicks::afterThought(const Thought& thought) {
  const std::string_view name = thought.agent.kick();
  const auto found = open_.find(thought.handle);
  if (found != open_.end() && found->second.runs) {
    found->second.runs = !name.empty();
    return;
  }
  const auto* request = std::get_if<motion::KickTo>(&thought.agent.action().motion);
  if (name.empty() || request == nullptr) return;
  if (found != open_.end()) kicks_.push_back(found->second.kick);
  const agent::AgentSettings& settings = thought.agent.settings();
  const motion::KickHead head = kickHead(settings, std::string(name));
  Open open;
  open.kick.team = settings.team;
  open.kick.unum = thought.agent.world().game.unum;
  open.kick.name = name;
  open.kick.intended = std::clamp((request->target - request->ball).norm(), head.shortest, head.longest);
  open.request = *request;
  open_[thought.handle] = std::move(open);
}

bool MatchKicks::isOver(const sim::Simulation& simulation, sim::RobotHandle robot, Open& open) {
  const BallTouches touches = ballTouches(simulation.world(), robot);
  MatchKick& kick = open.kick;
  kick.contact = kick.contact || (touches.robot && open.runs);
  if (!kick.contact) return !open.runs || touches.other;
  const PlayMode mode = simulation.match().playMode;
  if (isGoal(mode)) {
    kick.carried = std::max(kick.carried, kick.intended);
    kick.went = kick.intended;
    return true;
  }
  const bool interrupted = mode != PlayMode::PlayOn && mode != open.mode;
  if (interrupted || touches.other || (touches.robot && !open.runs)) return true;
  const world::BallMotion ball = ballOf(simulation);
  const Pose2 X_AimW = open.X_WAim->inverse();
  const Vector2 rest = X_AimW * world::restPlace(ball);
  kick.carried = rest.x();
  kick.direction = directionOf(rest);
  kick.went = (X_AimW * Vector2(ball.p_FB.head<2>())).x();
  const bool stopped = !open.runs && !touches.robot && ball.v_FB.norm() < kLiesStill;
  return stopped || simulation.match().serverTime > open.began + kLongest;
}

void MatchKicks::afterCycle(const sim::Simulation& simulation) {
  if (open_.empty()) return;
  for (const sim::AgentInfo& agent : simulation.agents()) {
    const auto found = open_.find(agent.handle);
    if (found == open_.end()) continue;
    Open& open = found->second;
    if (!open.X_WAim) {
      const Pose2 X_WR = truePose(simulation.world(), agent.robot);
      const double direction = directionOf(X_WR.rotate(open.request.target - open.request.ball));
      open.X_WAim = Pose2(ballOf(simulation).p_FB.head<2>(), direction);
      open.began = simulation.match().serverTime;
      open.mode = simulation.match().playMode;
      open.kick.time = simulation.match().time;
    }
    if (!isOver(simulation, agent.robot, open)) continue;
    kicks_.push_back(open.kick);
    open_.erase(found);
  }
}

nlohmann::ordered_json MatchKicks::toJson() const {
  nlohmann::ordered_json result;
  for (const auto& [team, byName] : groupsOf(kicks_))
    for (const auto& [name, kicks] : byName) result[team][name] = json(kickShares(kicks));
  return result;
}

std::string MatchKicks::toText() const {
  std::string text = fmt::format(
      "\nkicks, medians; carried and went as shares of what was intended\n"
      "{:<14} {:<16} {:>6} {:>8} {:>11} {:>8} {:>6} {:>12} {:>8} {:>12}\n",
      "", "", "kicks", "missed %", "intended m", "carried", "went", "under half %", "off deg",
      "a tenth over");
  for (const auto& [team, byName] : groupsOf(kicks_)) {
    for (const auto& [name, kicks] : byName) {
      const KickShares s = kickShares(kicks);
      text += fmt::format(
          "{:<14} {:<16} {:>6} {:>8.0f} {:>11.1f} {:>8.2f} {:>6.2f} {:>12.0f} {:>8.1f} {:>12.1f}\n", team,
          name, s.kicks, 100.0 * s.missed, s.intended, s.carriedShare, s.wentShare, 100.0 * s.underHalf,
          toDegrees(s.directionError), toDegrees(s.directionErrorTenth));
    }
  }
  return text;
}

}  // namespace nonet::lab
