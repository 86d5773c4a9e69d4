#include "nonet/sim/fidelity/fixed_episode.h"

#include <array>
#include <cmath>
#include <cstring>
#include <ctime>
#include <vector>

#include "nonet/sim/sensors/sensors.h"

namespace nonet::sim {

namespace {

using model::JointId;

double processorSeconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void mixWord(std::uint64_t& hash, std::uint64_t word) {
  hash = (hash ^ word) * 1099511628211ULL;
  hash ^= hash >> 29U;
}

void mix(std::uint64_t& hash, double value) {
  std::uint64_t word = 0;
  std::memcpy(&word, &value, sizeof(word));
  mixWord(hash, word);
}

/// Knees and hips up and down, head and arms at random.
void command(World& world, RobotHandle robot, int cycle) {
  const double phase = 0.35 * cycle + robot;
  const auto lift = static_cast<float>(1.5 * std::sin(phase));
  constexpr std::array<std::array<JointId, 3>, 2> kLegs{
      {{JointId::LLeg3, JointId::LLeg4, JointId::LLeg5}, {JointId::RLeg3, JointId::RLeg4, JointId::RLeg5}}};
  for (const auto& [hip, knee, ankle] : kLegs) {
    world.setJointSpeed(robot, hip, lift);
    world.setJointSpeed(robot, knee, -2.0F * lift);
    world.setJointSpeed(robot, ankle, lift);
  }
  if (cycle % 10 != 0) return;
  Random random(static_cast<std::uint64_t>(100 * cycle + robot));
  for (std::size_t i = index(JointId::Head1); i < index(JointId::RLeg1); ++i) {
    world.setJointSpeed(robot, model::jointAt(i), static_cast<float>(random.uniform(-2.0, 2.0)));
  }
}

void place(World& world, int robots, bool rough) {
  for (int i = 0; i < robots; ++i) {
    const RobotHandle robot = world.addRobot(i % model::kRobotTypeCount);
    const int rowIndex = i / 6;
    const auto column = static_cast<float>(i % 6);
    const auto row = static_cast<float>(rowIndex);
    const Vector3f apart(2.0F * column - 6.0F, 2.0F * row - 4.0F, 0.45F);
    const Vector3f together(0.25F * column, 0.3F * row, 0.45F);
    world.placeRobot(robot, rough ? together : apart, rough ? 50.0F * static_cast<float>(i) : -90.0F);
  }
  world.setBallPosition({-1.5F, 0.1F, 0.05F});
  world.setBallVelocity({3.0F, 0.0F, 1.0F});
}

void mixSensed(std::uint64_t& hash, const protocol::Percept& percept) {
  for (int i = 0; i < 3; ++i) mix(hash, percept.gyro[i]);
  for (int i = 0; i < 3; ++i) mix(hash, percept.accelerometer[i]);
  for (const double angle : percept.joints) mix(hash, angle);
  if (!percept.vision) return;
  for (const auto& landmark : percept.vision->landmarks) mix(hash, landmark.at.azimuth);
  for (const auto& player : percept.vision->players) mixWord(hash, static_cast<std::uint64_t>(player.unum));
  for (const auto& line : percept.vision->lines) mix(hash, line.end.distance);
}

}  // namespace

EpisodeResult runFixedEpisode(const WorldSettings& settings, int robots, int cycles, bool rough) {
  World world(settings);
  place(world, robots, rough);
  const VisionField field;
  std::vector<VisiblePlayer> players;
  std::vector<AgentSensors> sensors;
  Random random(7);
  for (const RobotHandle robot : world.robots()) {
    players.push_back(
        VisiblePlayer{robot, protocol::TeamName("Bench"), static_cast<int>(players.size()) + 1});
    sensors.emplace_back(random);
  }
  SensorContext context;
  context.field = &field;
  context.players = players;
  protocol::Percept percept;
  EpisodeResult result;
  result.simulated = kCycleTime * cycles;
  for (int cycle = 0; cycle < cycles; ++cycle) {
    const double begin = processorSeconds();
    for (const RobotHandle robot : world.robots()) command(world, robot, cycle);
    world.prePhysics();
    world.stepPhysics();
    const double stepped = processorSeconds();
    context.vision = cycle % 3 == 0;
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      percept.clear();
      sensors[i].fill(world, players[i].robot, context, random, percept);
      mixSensed(result.signature, percept);
    }
    result.worldSeconds += stepped - begin;
    result.senseSeconds += processorSeconds() - stepped;
  }
  mixWord(result.signature, world.signature());
  return result;
}

}  // namespace nonet::sim
