// Choosing a kick: among those of the data folder, and at worst, with the cheapest kicks all along curves
// that the leg follows almost to their end.
#include <stdexcept>
#include <string>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "nonet/model/inverse_kinematics.h"
#include "nonet/motion/kick_control.h"
#include "nonet/motion/parameters.h"
#include "nonet/motion/skill_language.h"

namespace nonet::motion {
namespace {

model::JointArray bentLegs() {
  model::JointArray angles{};
  for (const model::Side side : {model::Side::Left, model::Side::Right})
    model::setLegAngles(side, {0.0, 0.0, 0.6, -1.2, 0.6, 0.0}, angles);
  return angles;
}

KickTo request() {
  KickTo kick;
  kick.ball = {0.17, 0.05};
  kick.target = {5.0, 0.05};
  return kick;
}

// The first two thirds of a curve within reach, the end far beyond it.
std::string kickThatFailsLate(int number) {
  return fmt::format(
      "skill kick_{} {{ kick {{ ball (0.17m, 5cm) within (9cm, 9cm) distance 1m..6m contact 0.3s from stand "
      "}}\n"
      "move over 0.3s {{ foot left at (0, 0.11m, -0.30m) foot right at (0, 0, -0.32m) }}\n"
      "curve left foot over 0.3s from ball {{ point (-0.2m, 20mm, 0) point (-0.12m, 10mm, 0) "
      "point (-0.1m, 10mm, 0) point (-0.1m, 10mm, 5mm) point (-0.1m, 10mm, 10mm) point (0.5m, 0, 10mm) }} "
      "}}\n",
      number);
}

void chooseKickAtWorst(benchmark::State& state) {
  const model::RobotModel& model = model::robotModel(0);
  std::string text;
  for (int i = 0; i < 12; ++i) text += kickThatFailsLate(i);
  const SkillLibrary library(parseSkills(text, "bench.skl"));
  const KickCatalogue catalogue(library, 0);
  const CurveCheck check(model, library, bentLegs());
  KickControl control(catalogue, KickParameters{}, &check);
  const WalkEngine walk(model);
  if (control.update(request(), walk, 1.0).begin) throw std::logic_error("these kicks must not begin");
  for (auto _ : state) {
    control.reset();
    benchmark::DoNotOptimize(control.update(request(), walk, 1.0));
  }
}
BENCHMARK(chooseKickAtWorst);

void chooseKickOfTheDataFolder(benchmark::State& state) {
  const std::string folder = NONET_SOURCE_DIR "/skills";
  const model::RobotModel& model = model::robotModel(0);
  const SkillLibrary library(folder, declareSkillParameters(folder));
  const KickCatalogue catalogue(library, 0);
  const CurveCheck check(model, library, bentLegs());
  KickControl control(catalogue, KickParameters{}, &check);
  const WalkEngine walk(model);
  for (auto _ : state) {
    control.reset();
    benchmark::DoNotOptimize(control.update(request(), walk, 1.0));
  }
}
BENCHMARK(chooseKickOfTheDataFolder);

}  // namespace
}  // namespace nonet::motion
