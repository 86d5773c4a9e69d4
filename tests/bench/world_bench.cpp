// Time of the world update: in vision cycles and in others, on a recording; and of its parts by number of
// particles and landmarks.
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "nonet/protocol/log_file.h"
#include "nonet/protocol/percept_text.h"
#include "nonet/world/localization.h"
#include "nonet/world/world_model.h"

namespace nonet::world {
namespace {

std::vector<protocol::Percept> recording(const std::string& name) {
  std::vector<protocol::Percept> percepts;
  protocol::LogReader reader(std::string(NONET_TEST_DATA) + "/world/" + name);
  protocol::LogLine line;
  while (reader.next(line)) {
    if (line.kind != protocol::LogLine::Kind::Received) continue;
    percepts.emplace_back();
    protocol::parsePercept(line.text, percepts.back());
  }
  return percepts;
}

/// One whole update per iteration; `vision` chooses which cycles are timed.
void updateCycle(benchmark::State& state, const char* name, bool vision) {
  const auto percepts = recording(name);
  auto world =
      std::make_unique<WorldModel>(model::robotModel(0), WorldParameters{}, protocol::TeamName("Probe"), 1);
  std::size_t next = 0;
  for (auto _ : state) {
    state.PauseTiming();
    while (percepts[next].vision.has_value() != vision) {
      world->update(percepts[next]);
      if (++next == percepts.size()) {
        next = 0;
        world = std::make_unique<WorldModel>(model::robotModel(0), WorldParameters{},
                                             protocol::TeamName("Probe"), 1);
      }
    }
    state.ResumeTiming();
    benchmark::DoNotOptimize(world->update(percepts[next]));
    state.PauseTiming();
    if (++next == percepts.size()) {
      next = 0;
      world = std::make_unique<WorldModel>(model::robotModel(0), WorldParameters{},
                                           protocol::TeamName("Probe"), 1);
    }
    state.ResumeTiming();
  }
}
BENCHMARK_CAPTURE(updateCycle, wanderVision, "wander.log.gz", true);
BENCHMARK_CAPTURE(updateCycle, wanderOther, "wander.log.gz", false);
BENCHMARK_CAPTURE(updateCycle, gameVision, "game_fall.log.gz", true);
BENCHMARK_CAPTURE(updateCycle, gameOther, "game_fall.log.gz", false);

/// Frames with at least so many landmarks, cut to that number.
std::vector<protocol::Vision> framesWith(std::size_t landmarks) {
  std::vector<protocol::Vision> frames;
  for (const protocol::Percept& percept : recording("wander.log.gz")) {
    if (!percept.vision || percept.vision->landmarks.size() < landmarks) continue;
    frames.push_back(*percept.vision);
    frames.back().landmarks.resize(landmarks);
  }
  return frames;
}

void fitByLandmarks(benchmark::State& state) {
  const auto frames = framesWith(static_cast<std::size_t>(state.range(0)));
  const FieldMap map(largeField());
  const Pose3 X_RC = Pose3::Identity();
  PoseFit fit;
  VisionFrame frame;
  std::size_t next = 0;
  for (auto _ : state) {
    // Started where the truth puts the camera, as a tracking filter would be.
    const protocol::Vision& vision = frames[next++ % frames.size()];
    PoseBelief belief;
    belief.p_WR = *vision.truePosition;
    belief.R_WR = Eigen::AngleAxisd(*vision.trueHeading, Vector3::UnitZ()).toRotationMatrix();
    belief.covariance *= 0.01;
    frame.assign(vision);
    benchmark::DoNotOptimize(fit.update(belief, X_RC, frame, map));
  }
}
BENCHMARK(fitByLandmarks)->DenseRange(1, 4);

void filterByParticles(benchmark::State& state) {
  const auto frames = framesWith(2);
  const FieldMap map(largeField());
  ParticleFilter filter(1);
  filter.scatter(map);
  VisionFrame frame;
  GroundObservations seen;
  std::size_t next = 0;
  const bool few = state.range(0) == static_cast<long>(ParticleFilter::kFew);
  for (auto _ : state) {
    frame.assign(frames[next++ % frames.size()]);
    seen.assign(frame, Pose3::Identity(), Vector3::Zero(), map, true);
    filter.predict({}, 0.01, 0.005);
    filter.correct(seen, map, few);
  }
}
BENCHMARK(filterByParticles)
    ->Arg(static_cast<long>(ParticleFilter::kFew))
    ->Arg(static_cast<long>(ParticleFilter::kMany));

}  // namespace
}  // namespace nonet::world
