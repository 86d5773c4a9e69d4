#include "nonet/lab/rise_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "parallel.h"

namespace nonet::lab {

namespace {

using model::JointId;
using motion::MotionRequest;
using world::Posture;

constexpr int kMostThrows = 60;    // until one ends in a fall
constexpr double kLongest = 12.0;  // s: the referee takes a field player away after 15 s on the ground
constexpr double kLasts = 0.6;     // s that a stand must last
constexpr double kTipped = 0.5;    // rad: from here on the robot falls
constexpr std::array<const char*, kFallKindCount> kNames{"front", "back", "side"};

bool matches(Posture posture, FallKind kind) {
  switch (kind) {
    case FallKind::Front:
      return posture == Posture::FallenFront;
    case FallKind::Back:
      return posture == Posture::FallenBack;
    case FallKind::Side:
      return posture == Posture::FallenLeft || posture == Posture::FallenRight;
  }
  return false;
}

// Leans in the given direction (0 = forward) by ankles and hips until the robot tips.
bool tip(RobotTrial& trial, double direction, Random& random) {
  motion::JointTargets targets;
  targets.angles = trial.belief().body.joints;
  targets.stiffness.fill(1.0);
  for (std::size_t i = model::index(JointId::RArm1); i < model::kJointCount; ++i) {
    targets.angles[i] += random.uniform(-0.2, 0.2);
  }
  const double lean = random.uniform(0.5, 0.8);
  const double ahead = lean * std::cos(direction);
  const double aside = lean * std::sin(direction);
  for (const JointId ankle : {JointId::LLeg5, JointId::RLeg5}) targets.angles[model::index(ankle)] += ahead;
  for (const JointId hip : {JointId::LLeg2, JointId::RLeg2}) targets.angles[model::index(hip)] += aside;
  if (ahead < 0.0) {
    for (const JointId hip : {JointId::LLeg3, JointId::RLeg3})
      targets.angles[model::index(hip)] += 0.5 * ahead;
  }
  for (int i = 0; i < 75; ++i) {
    trial.stepJoints(targets);
    if (trial.tilt() > kTipped) return true;
  }
  return false;
}

void dive(RobotTrial& trial, Random& random) {
  MotionRequest request;
  request.kind = MotionRequest::Kind::Skill;
  request.skill = std::string_view("dive");
  request.side = random.below(2) == 0 ? model::Side::Left : model::Side::Right;
  for (int i = 0; i < 200 && !trial.motion().state().skillFinished; ++i) trial.step(request);
}

// Steps until the robot stands and stays up; fills what happened.
void rise(RobotTrial& trial, FallKind kind, Rise& result) {
  double lying = -1.0;
  double standing = -1.0;
  bool wasRising = false;
  const double begin = trial.time();
  while (trial.time() - begin < kLongest) {
    trial.step(MotionRequest{});
    const Posture posture = trial.belief().body.posture;
    if (lying < 0.0 && world::isFallen(posture)) lying = trial.time();
    const bool rising = trial.motion().fall().rising();
    if (rising && !wasRising) {
      if (result.attempts == 0) result.fell = matches(posture, kind);
      ++result.attempts;
    }
    wasRising = rising;
    const bool up = lying >= 0.0 && !trial.down() && trial.tilt() < 0.2 && !trial.motion().state().rising;
    if (!up) standing = -1.0;
    if (up && standing < 0.0) standing = trial.time();
    if (up && trial.time() - standing >= kLasts) {
      result.stands = true;
      result.time = standing - lying;
      return;
    }
  }
}

}  // namespace

Rise fallAndRise(const TrialSetup& setup, FallKind kind, std::uint64_t seed) {
  TrialSetup own = setup;
  own.seed = seed;
  RobotTrial trial(own);
  Random random(seed);
  trial.settle(Pose2(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-kPi, kPi)));
  MotionRequest walk;
  walk.kind = MotionRequest::Kind::WalkVelocity;
  walk.velocity = Pose2(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-2.0, 2.0));
  trial.run(walk, random.uniform(0.0, 1.5));
  Rise result;
  if (kind == FallKind::Side) {
    dive(trial, random);
  } else {
    const double direction = (kind == FallKind::Front ? 0.0 : kPi) + random.uniform(-0.8, 0.8);
    if (!tip(trial, direction, random)) return result;
  }
  rise(trial, kind, result);
  return result;
}

RiseReport measureRising(const RiseReportSettings& settings) {
  const int count = static_cast<int>(kFallKindCount) * settings.falls;
  std::vector<Rise> rises(static_cast<std::size_t>(count));
  const Random seeds(settings.seed);
  inParallel(count, settings.threads, [&](int i) {
    const auto kind = static_cast<FallKind>(i / settings.falls);
    Rise& rise = rises[static_cast<std::size_t>(i)];
    // Some throws are caught or end otherwise than wanted: thrown again.
    Random own = seeds.fork(static_cast<std::uint64_t>(i));
    for (int k = 0; k < kMostThrows && !rise.fell; ++k) rise = fallAndRise(settings.setup, kind, own.next());
  });
  RiseReport report;
  for (std::size_t kind = 0; kind < kFallKindCount; ++kind) {
    RiseStatistics& statistics = report.kinds[kind];
    std::vector<double> times;
    for (int i = 0; i < settings.falls; ++i) {
      const Rise& rise = rises[kind * static_cast<std::size_t>(settings.falls) + static_cast<std::size_t>(i)];
      if (!rise.fell) continue;
      ++statistics.falls;
      if (!rise.stands) continue;
      ++statistics.risen;
      if (rise.attempts == 1) ++statistics.firstTry;
      times.push_back(rise.time);
    }
    std::sort(times.begin(), times.end());
    if (times.empty()) continue;
    statistics.median = 0.5 * (times[(times.size() - 1) / 2] + times[times.size() / 2]);
    statistics.slowest = times.back();
  }
  return report;
}

std::string riseReportTable(const RiseReport& report) {
  std::string out = "fall    falls  first try  risen  median s  slowest s\n";
  for (std::size_t kind = 0; kind < kFallKindCount; ++kind) {
    const RiseStatistics& s = report.kinds[kind];
    out += fmt::format("{:<6} {:6} {:10} {:6} {:9.2f} {:10.2f}\n", kNames[kind], s.falls, s.firstTry, s.risen,
                       s.median, s.slowest);
  }
  return out;
}

std::string riseReportJson(const RiseReport& report) {
  nlohmann::ordered_json json;
  for (std::size_t kind = 0; kind < kFallKindCount; ++kind) {
    const RiseStatistics& s = report.kinds[kind];
    json[kNames[kind]] = {{"falls", s.falls},
                          {"first_try", s.firstTry},
                          {"risen", s.risen},
                          {"median_s", s.median},
                          {"slowest_s", s.slowest}};
  }
  return json.dump(2) + "\n";
}

}  // namespace nonet::lab
