#include "nonet/lab/match/frame_sources.h"

namespace nonet::lab {
namespace {

constexpr int kCyclesPerFrame = 5;
constexpr long kKickShows = 15;  // cycles after the end of a kick in which the ball may show it

}  // namespace

void SimulationFrames::setKick(sim::AgentHandle agent, std::string_view kick) {
  if (kick.empty()) return;
  Mind& mind = minds_[agent];
  mind.kick = kick;
  mind.kickedAt = cycles_;
}

const Frame* SimulationFrames::cycle(const sim::Simulation& simulation) {
  ++cycles_;
  const sim::MatchState& match = simulation.match();
  if (!first_ && !match.teamLeft.empty()) first_ = match.teamLeft;
  const bool swapped = first_ && match.teamLeft.view() != first_->view();
  const std::array<int, 2> score =
      swapped ? std::array{match.scoreRight, match.scoreLeft} : std::array{match.scoreLeft, match.scoreRight};
  const auto fouls = simulation.fouls();
  const bool event = match.playMode != frame_.mode || score != frame_.score || fouls.size() != fouls_;
  if (--cyclesToNext_ > 0 && !event) return nullptr;
  if (cyclesToNext_ <= 0) cyclesToNext_ = kCyclesPerFrame;

  frame_.time = match.time;
  frame_.mode = match.playMode;
  frame_.swapped = swapped;
  frame_.score = score;
  frame_.p_WBall = simulation.world().ballPosition().cast<double>();
  frame_.fouls.clear();
  for (; fouls_ < fouls.size(); ++fouls_) {
    const sim::FoulRecord& foul = fouls[fouls_];
    const bool right = foul.side == protocol::TeamSide::Right;
    frame_.fouls.push_back({foul.type, right != swapped ? 1 : 0, foul.unum});
  }
  frame_.robots.clear();
  for (const sim::AgentInfo& agent : simulation.agents()) {
    if (agent.unum == 0 || agent.robot == sim::kNoRobot) continue;
    const sim::ScenePose pose = simulation.world().bodyPose(agent.robot, model::BodyId::Torso);
    FrameRobot robot;
    robot.team = (agent.side == protocol::TeamSide::Right) != swapped ? 1 : 0;
    robot.unum = agent.unum;
    robot.robotType = agent.robotType;
    robot.p_W = pose.position.cast<double>();
    robot.up = static_cast<double>(pose.rotation(2, 2));
    const auto mind = minds_.find(agent.handle);
    if (mind != minds_.end()) {
      robot.role = mind->second.role;
      if (cycles_ - mind->second.kickedAt <= kKickShows) robot.kick = mind->second.kick;
    }
    frame_.robots.push_back(robot);
  }
  return &frame_;
}

}  // namespace nonet::lab
