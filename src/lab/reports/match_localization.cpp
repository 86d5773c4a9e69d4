#include "nonet/lab/reports/match_localization.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "nonet/lab/common/statistics.h"
#include "nonet/math/angle.h"

namespace nonet::lab {
namespace {

constexpr std::size_t kMomentsKept = 3;  // a message shows the state one cycle before it is read
constexpr std::size_t kTrackLength = 25;
constexpr double kWalkingSpeed = 0.05;  // m/s
const double kFallenBelow = std::cos(toRadians(60.0));
const double kStandingAbove = std::cos(toRadians(25.0));
constexpr double kTimeToRecover = 0.5;  // s
constexpr double kGoodError = 0.1;      // m
constexpr double kKnownWell = 0.5;      // m, of an opponent
constexpr double kNearBy = 5.0;         // m, range of sightings whose errors are counted

constexpr std::array<std::string_view, 3> kActivityNames = {"standing", "walking", "fallen"};

/// World axes <-> axes of a team that plays from the right.
Vector3 turned(const Vector3& p, bool fromRight) {
  return fromRight ? Vector3(-p.x(), -p.y(), p.z()) : p;
}

double yawOfForward(const sim::ScenePose& pose) {
  const auto forward = pose.rotation.col(1).cast<double>();  // the server's bodies look along y
  return std::atan2(forward.y(), forward.x());
}

std::string row(std::string_view name, const LocalizationReport& report) {
  const LocalizationReport::Summary s = report.summary();
  return fmt::format(
      "{:<14} {:>7} {:>8.4f} {:>8.4f} {:>8.4f} {:>9.4f} {:>8.4f} {:>8.4f} {:>8.3f} {:>8.3f} {:>7.1f} "
      "{:>7.1f}\n",
      name, s.frames, s.position.median, s.position.p95, s.position.mean, s.position.largest, s.height.median,
      s.height.p95, toDegrees(s.heading.median), toDegrees(s.heading.p95), 100.0 * s.coverage95,
      100.0 * s.localizedShare);
}

nlohmann::ordered_json errorsToJson(const std::vector<double>& errors) {
  return {{"count", errors.size()}, {"median", quantile(errors, 0.5)}, {"p95", quantile(errors, 0.95)}};
}

double share(long part, long whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

}  // namespace

void MatchLocalization::afterCycle(const sim::Simulation& simulation) {
  if (moments_.size() == kMomentsKept) moments_.pop_front();
  Moment& moment = moments_.emplace_back();
  const sim::MatchState& match = simulation.match();
  moment.time = static_cast<double>(match.serverTime);
  moment.p_WB = simulation.world().ballPose().position.cast<double>();
  for (const sim::AgentInfo& agent : simulation.agents()) {
    if (agent.unum == 0 || agent.robot == sim::kNoRobot) continue;
    if (firstTeam_.empty()) firstTeam_ = std::string(match.teamLeft.view());
    const sim::ScenePose& torso = simulation.world().bodyPose(agent.robot, model::BodyId::Torso);
    const sim::ScenePose& head = simulation.world().bodyPose(agent.robot, model::BodyId::Head);
    RobotTruth& truth = moment.robots[agent.handle];
    const Vector3 p_WR = torso.position.cast<double>();
    truth.X_WR = Pose2(p_WR.x(), p_WR.y(), yawOfForward(torso));
    truth.p_WC = head.position.cast<double>();
    truth.cameraHeading = yawOfForward(head);
    truth.up = static_cast<double>(torso.rotation(2, 2));
    truth.fromRight = agent.side == protocol::TeamSide::Right;
    truth.rightTeam = agent.team.view() != firstTeam_;
    truth.unum = agent.unum;
  }
}

const MatchLocalization::Moment* MatchLocalization::momentOf(double time) const {
  for (const Moment& moment : moments_) {
    if (std::abs(moment.time - time) < 0.5 * kCycleTime) return &moment;
  }
  return nullptr;
}

MatchLocalization::Activity MatchLocalization::follow(const RobotTruth& truth, double time,
                                                      Follow& robot) const {
  if (robot.track.size() > kTrackLength) robot.track.pop_front();
  robot.track.push_back(truth.X_WR.translation);
  if (truth.up < kFallenBelow) robot.fallen = true;
  if (truth.up < kStandingAbove) robot.uprightSince = time;
  if (robot.fallen && time - robot.uprightSince > kTimeToRecover) {
    robot.fallen = false;
    robot.mustProve = true;
  }
  if (robot.fallen) return Activity::Fallen;
  const double seconds = kCycleTime * static_cast<double>(robot.track.size() - 1);
  const double way = (robot.track.back() - robot.track.front()).norm();
  return way > kWalkingSpeed * std::max(seconds, kCycleTime) ? Activity::Walking : Activity::Standing;
}

void MatchLocalization::afterThought(const Thought& thought) {
  const Moment* moment = momentOf(thought.percept.time);
  if (moment == nullptr) return;
  const auto found = moment->robots.find(thought.handle);
  if (found == moment->robots.end()) return;
  const RobotTruth& truth = found->second;
  Follow& robot = robots_[thought.handle];
  const Activity activity = follow(truth, moment->time, robot);
  if (!thought.percept.vision) return;

  const world::WorldState& world = thought.agent.world();
  const Vector3 p_FC = turned(truth.p_WC, truth.fromRight);
  const double heading = wrapAngle(truth.cameraHeading + (truth.fromRight ? kPi : 0.0));
  for (LocalizationReport* report :
       {&all_, &byActivity_[static_cast<std::size_t>(activity)], &byPlayer_[{truth.rightTeam, truth.unum}]}) {
    report->add(world, p_FC, heading);
  }
  if (robot.mustProve) {
    robot.mustProve = false;
    ++rises_.count;
    const double error = (world.self.X_FC.translation() - p_FC).head<2>().norm();
    if (world.self.localized && error < kGoodError) ++rises_.good;
  }
  compareOthers(*moment, thought);
}

void MatchLocalization::compareOthers(const Moment& moment, const Thought& thought) {
  const world::WorldState& world = thought.agent.world();
  const RobotTruth& self = moment.robots.at(thought.handle);
  const auto near = [&](const Vector2& p_W) { return (p_W - self.X_WR.translation).norm() < kNearBy; };
  if (thought.percept.vision->ball && near(moment.p_WB.head<2>())) {
    ballErrors_.push_back((world.ball.p_FB - turned(moment.p_WB, self.fromRight)).head<2>().norm());
  }
  for (const auto& [handle, other] : moment.robots) {
    if (handle == thought.handle) continue;
    const bool mate = other.rightTeam == self.rightTeam;
    const auto& players = mate ? world.teammates : world.opponents;
    const world::PlayerState& player = players[static_cast<std::size_t>(other.unum)];
    const Vector2 p_WP = other.X_WR.translation;
    const Vector2 p_FP = self.fromRight ? Vector2(-p_WP) : p_WP;
    if (!mate) askOfOpponent(player, p_FP);
    if (!near(p_WP) || !player.known || player.lastSeen != world.time) continue;
    playerErrors_.push_back((player.X_FP.translation - p_FP).norm());
  }
}

void MatchLocalization::askOfOpponent(const world::PlayerState& opponent, const Vector2& p_FP) {
  ++opponents_.asked;
  if (!opponent.known) return;
  ++opponents_.known;
  const double error = (opponent.X_FP.translation - p_FP).norm();
  opponents_.errors.push_back(error);
  if (error < kKnownWell) ++opponents_.good;
}

nlohmann::ordered_json MatchLocalization::toJson() const {
  nlohmann::ordered_json json = {{"all", all_.toJson()}};
  for (std::size_t i = 0; i < byActivity_.size(); ++i) json[kActivityNames[i]] = byActivity_[i].toJson();
  json["rises"] = {{"count", rises_.count}, {"good", rises_.good}};
  json["ball_error_m"] = errorsToJson(ballErrors_);
  json["player_error_m"] = errorsToJson(playerErrors_);
  json["opponents"] = {{"known", share(opponents_.known, opponents_.asked)},
                       {"within_half_metre", share(opponents_.good, opponents_.asked)},
                       {"error_m", errorsToJson(opponents_.errors)}};
  json["players"] = nlohmann::ordered_json::array();
  for (const auto& [player, report] : byPlayer_) {
    nlohmann::ordered_json entry = {{"side", player.first ? "right" : "left"}, {"unum", player.second}};
    entry.update(report.toJson());
    json["players"].push_back(std::move(entry));
  }
  return json;
}

std::string MatchLocalization::toText() const {
  std::string text = fmt::format(
      "\nlocalization, every vision message of every player against the simulation's truth\n"
      "{:<14} {:>7} {:>35} {:>17} {:>17} {:>15}\n"
      "{:<14} {:>7} {:>8} {:>8} {:>8} {:>9} {:>8} {:>8} {:>8} {:>8} {:>7} {:>7}\n",
      "", "", "position m", "height m", "heading deg", "% in 95 region", "", "frames", "median", "95%",
      "mean", "max", "median", "95%", "median", "95%", "truth", "sure");
  for (const auto& [player, report] : byPlayer_) {
    text += row(fmt::format("{} {}", player.first ? "right" : "left", player.second), report);
  }
  for (std::size_t i = 0; i < byActivity_.size(); ++i) text += row(kActivityNames[i], byActivity_[i]);
  text += row("all", all_);
  text += fmt::format("rises: {} of {} robots knew their place 0.5 s after they stood again\n", rises_.good,
                      rises_.count);
  text += fmt::format("ball in sight within 5 m: median {:.3f} m, 95% {:.3f} m ({} frames)\n",
                      quantile(ballErrors_, 0.5), quantile(ballErrors_, 0.95), ballErrors_.size());
  text += fmt::format("players in sight within 5 m: median {:.3f} m, 95% {:.3f} m ({} sightings)\n",
                      quantile(playerErrors_, 0.5), quantile(playerErrors_, 0.95), playerErrors_.size());
  text +=
      fmt::format("opponents anywhere: {:.1f} % known, {:.1f} % within 0.5 m, those known median {:.3f} m\n",
                  100.0 * share(opponents_.known, opponents_.asked),
                  100.0 * share(opponents_.good, opponents_.asked), quantile(opponents_.errors, 0.5));
  return text;
}

}  // namespace nonet::lab
