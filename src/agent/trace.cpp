#include "nonet/agent/trace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "nonet/world/ball_law.h"
#include "nonet/world/game_tracker.h"

namespace nonet::agent {
namespace {

using nlohmann::ordered_json;

constexpr std::array<const char*, 20> kPhaseNames = {"before kick-off",
                                                     "own kick-off",
                                                     "their kick-off",
                                                     "play on",
                                                     "own kick-in",
                                                     "their kick-in",
                                                     "own corner kick",
                                                     "their corner kick",
                                                     "own goal kick",
                                                     "their goal kick",
                                                     "own free kick",
                                                     "their free kick",
                                                     "own direct free kick",
                                                     "their direct free kick",
                                                     "own pass mode",
                                                     "their pass mode",
                                                     "own goal",
                                                     "their goal",
                                                     "game over",
                                                     "other"};
constexpr std::array<const char*, 3> kHeadNames = {"look", "point", "scan"};

// Enough digits for a reader: millimetres, thousandths of a second, hundredths of a degree. Divided by a
// whole number, so that no digits of rounding follow.
double rounded(double value, double perUnit = 1e3) {
  return std::round(value * perUnit) / perUnit + 0.0;
}
ordered_json place(const Vector2& p) {
  return {rounded(p.x()), rounded(p.y())};
}
ordered_json pose(const Pose2& X) {
  return {rounded(X.translation.x()), rounded(X.translation.y()), rounded(toDegrees(X.rotation), 1e2)};
}

// Says what motion is asked to do, all in the field frame, so that a reader need not turn it.
class RequestWriter {
 public:
  explicit RequestWriter(const Pose2& X_FR) : X_FR_(X_FR) {}

  ordered_json operator()(const motion::Stand&) const { return {{"kind", "stand"}}; }
  ordered_json operator()(const motion::WalkVelocity& walk) const {
    return {{"kind", "walk with"}, {"velocity", pose(walk.velocity)}};
  }
  ordered_json operator()(const motion::WalkTo& walk) const {
    return {{"kind", "walk to"}, {"target", pose(X_FR_ * walk.target)}};
  }
  ordered_json operator()(const motion::PlaySkill& skill) const {
    return {{"kind", "skill"}, {"skill", std::string(skill.name.view())}, {"side", sideName(skill.side)}};
  }
  ordered_json operator()(const motion::KickTo& kick) const {
    return {{"kind", "kick"}, {"ball", place(X_FR_ * kick.ball)}, {"target", place(X_FR_ * kick.target)}};
  }

 private:
  static const char* sideName(model::Side side) { return side == model::Side::Left ? "left" : "right"; }

  Pose2 X_FR_;
};

const char* headName(const team::Action& action) {
  return action.head ? kHeadNames.at(static_cast<std::size_t>(action.head->kind)) : "";
}

ordered_json candidatesOf(const team::Reason& reason) {
  ordered_json list = ordered_json::array();
  for (const team::Candidate& candidate : reason.candidates) {
    const Vector2& p = candidate.p_F;
    list.push_back({{"name", fmt::format("to ({:.1f}, {:.1f})", p.x(), p.y())},
                    {"at", place(p)},
                    {"value", rounded(candidate.value)}});
  }
  return list;
}

std::string reasonText(const team::Reason& reason) {
  if (reason.detail.empty()) return std::string(reason.behavior);
  return fmt::format("{}: {}", reason.behavior, reason.detail);
}

// Seconds since then; null: never. The ball is known before it was seen where the rules say where it lies.
ordered_json ageOf(const world::WorldState& world, double time) {
  if (time <= world::kNever) return nullptr;
  return rounded(world.time - time);
}

ordered_json ballOf(const world::WorldState& world) {
  const world::BallState& ball = world.ball;
  if (!ball.known) return nullptr;
  return {{"at", {rounded(ball.p_FB.x()), rounded(ball.p_FB.y()), rounded(ball.p_FB.z())}},
          {"velocity", {rounded(ball.v_FB.x()), rounded(ball.v_FB.y())}},
          {"covariance",
           {rounded(ball.covariance(0, 0), 1e6), rounded(ball.covariance(0, 1), 1e6),
            rounded(ball.covariance(1, 1), 1e6)}},
          {"rests", place(world::restPlace({ball.p_FB, ball.v_FB}))},
          {"seen", ageOf(world, ball.lastSeen)}};
}

// Centimetres do for a cloud.
ordered_json particlesOf(const Agent& agent) {
  ordered_json list = ordered_json::array();
  for (const Pose2& X_FR : agent.particles())
    list.push_back({rounded(X_FR.translation.x(), 1e2), rounded(X_FR.translation.y(), 1e2)});
  return list;
}

ordered_json playersOf(const world::WorldState& world,
                       const std::array<world::PlayerState, world::kTeamSize + 1>& players, int except) {
  ordered_json list = ordered_json::array();
  for (int unum = 1; unum <= world::kTeamSize; ++unum) {
    const world::PlayerState& player = players[static_cast<std::size_t>(unum)];
    if (!player.known || unum == except) continue;
    list.push_back({{"unum", unum},
                    {"at", place(player.X_FP.translation)},
                    {"sigma", rounded(player.sigma)},
                    {"seen", ageOf(world, player.lastSeen)},
                    {"fallen", player.fallen}});
  }
  return list;
}

std::string number(const ordered_json& value) {
  return value.is_null() ? "" : value.dump();
}

std::string sigma(const ordered_json& variance) {
  return fmt::format("{:.3f}", std::sqrt(std::max(0.0, variance.get<double>())));
}

std::string at(const ordered_json& place) {
  return fmt::format("({:.2f}, {:.2f})", place[0].get<double>(), place[1].get<double>());
}

std::string seenText(const ordered_json& age) {
  return age.is_null() ? "never seen" : fmt::format("seen {:.2f} s ago", age.get<double>());
}

// How many there are, and within which distance of its pose the robot has nine tenths of them.
std::string particlesText(const ordered_json& trace) {
  const Vector2 pose(trace["pose"][0].get<double>(), trace["pose"][1].get<double>());
  std::vector<double> distances;
  for (const ordered_json& place : trace["particles"])
    distances.push_back((Vector2(place[0].get<double>(), place[1].get<double>()) - pose).norm());
  if (distances.empty()) return "none";
  std::sort(distances.begin(), distances.end());
  return fmt::format("{}, nine tenths within {:.2f} m", distances.size(),
                     distances[distances.size() * 9 / 10]);
}

std::string requestText(const ordered_json& request) {
  std::string text = request["kind"];
  if (request.contains("skill"))
    text += fmt::format(" {}, {}", std::string(request["skill"]), std::string(request["side"]));
  if (request.contains("ball")) text += fmt::format(" the ball at {}", at(request["ball"]));
  if (request.contains("target"))
    text += fmt::format("{} {} m", text.ends_with(" to") ? "" : " to", at(request["target"]));
  if (request.contains("velocity")) text += fmt::format(" {} m/s", at(request["velocity"]));
  return text;
}

}  // namespace

ordered_json traceOf(const Agent& agent) {
  const world::WorldState& world = agent.world();
  const world::SelfState& self = world.self;
  const bool ownGoalLeft = !world::playsFromRight(world.game);
  const Matrix3& covariance = self.covariance;
  ordered_json json = {
      {"time", rounded(world.time)},
      {"game_time", rounded(world.game.time)},
      {"team", agent.settings().team},
      {"unum", world.game.unum},
      {"left", world.game.side != protocol::TeamSide::Right},
      {"side", ownGoalLeft ? 1 : -1},
      {"phase", kPhaseNames.at(static_cast<std::size_t>(world.game.phase))},
      {"role", team::roleName(agent.role())},
      {"request", std::visit(RequestWriter(self.X_FR), agent.action().motion)},
      {"head", headName(agent.action())},
      {"pose", pose(self.X_FR)},
      // Of x and y in m^2 (xx, xy, yy), of the heading in deg^2.
      {"covariance",
       {rounded(covariance(0, 0), 1e6), rounded(covariance(0, 1), 1e6), rounded(covariance(1, 1), 1e6),
        rounded(toDegrees(toDegrees(covariance(2, 2))), 1e3)}},
      {"localized", self.localized},
      {"particles", particlesOf(agent)},
      {"ball", ballOf(world)},
      {"mates", playersOf(world, world.teammates, world.game.unum)},
      {"opponents", playersOf(world, world.opponents, 0)},
  };
  const team::Action& action = agent.action();
  if (!action.reason.behavior.empty()) json["reason"] = reasonText(action.reason);
  if (!action.reason.candidates.empty()) json["candidates"] = candidatesOf(action.reason);
  if (action.passMode) json["asks_pass_mode"] = true;
  if (action.say) json["say"] = std::string(action.say->view());
  return json;
}

std::string_view traceCsvHeader() {
  return "time_s,game_time_s,unum,phase,role,request,skill,target_x_m,target_y_m,x_m,y_m,heading_deg,sigma_x_"
         "m,"
         "sigma_y_m,sigma_heading_deg,ball_x_m,ball_y_m,ball_seen_s";
}

std::string traceCsv(const ordered_json& trace) {
  const ordered_json& request = trace["request"];
  const ordered_json target = request.value("target", ordered_json{nullptr, nullptr});
  const ordered_json& covariance = trace["covariance"];
  std::string line = fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", trace["time"].dump(),
                                 trace["game_time"].dump(), trace["unum"].dump(), std::string(trace["phase"]),
                                 std::string(trace["role"]), std::string(request["kind"]),
                                 request.value("skill", std::string()), number(target[0]), number(target[1]),
                                 trace["pose"][0].dump(), trace["pose"][1].dump(), trace["pose"][2].dump(),
                                 sigma(covariance[0]), sigma(covariance[2]), sigma(covariance[3]));
  const ordered_json& ball = trace["ball"];
  if (ball.is_null()) return line + ",,,";
  return line + fmt::format(",{},{},{}", ball["at"][0].dump(), ball["at"][1].dump(), number(ball["seen"]));
}

std::string traceText(const ordered_json& trace) {
  const ordered_json& covariance = trace["covariance"];
  std::string text =
      fmt::format("{} {} at {:.2f} s of the game (server time {:.2f} s): {}\n", std::string(trace["team"]),
                  trace["unum"].get<int>(), trace["game_time"].get<double>(), trace["time"].get<double>(),
                  std::string(trace["phase"]));
  text += fmt::format("  role      {}\n", std::string(trace["role"]));
  if (trace.contains("reason")) text += fmt::format("  reason    {}\n", std::string(trace["reason"]));
  text +=
      fmt::format("  wants     {}, head: {}\n", requestText(trace["request"]), std::string(trace["head"]));
  text +=
      fmt::format("  is at     {} m, heading {:.1f} deg; one sigma {} m, {} m, {} deg{}\n", at(trace["pose"]),
                  trace["pose"][2].get<double>(), sigma(covariance[0]), sigma(covariance[2]),
                  sigma(covariance[3]), trace["localized"].get<bool>() ? "" : "; NOT localized");
  text += fmt::format("  particles {}\n", particlesText(trace));
  const ordered_json& ball = trace["ball"];
  if (ball.is_null()) {
    text += "  ball      not known\n";
  } else {
    text += fmt::format("  ball      {} m, moves with {} m/s, will rest at {}; {}\n", at(ball["at"]),
                        at(ball["velocity"]), at(ball["rests"]), seenText(ball["seen"]));
  }
  for (const char* team : {"mates", "opponents"}) {
    text += fmt::format("  {:10}", team);
    for (const ordered_json& player : trace[team]) {
      text += fmt::format("{}: {}{}  ", player["unum"].get<int>(), at(player["at"]),
                          player["fallen"].get<bool>() ? " down" : "");
    }
    text += trace[team].empty() ? "nobody known\n" : "\n";
  }
  if (trace.contains("asks_pass_mode")) text += "  asks      the referee for pass mode\n";
  if (trace.contains("say")) text += fmt::format("  says      {}\n", std::string(trace["say"]));
  return text;
}

}  // namespace nonet::agent
