// A kick from the moment it begins, without the approach: fifty times as many in a second as whole kicks
// (kick_trial.h), so a kick's numbers are found here first. Each begins in a world that was stored when a
// robot began to kick in a whole trial: it stands, leans and sways as it does after its last steps, and the
// ball lies where its eyes say, give or take their errors. Only joints move; nothing is sensed.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nonet/agent/agent.h"
#include "nonet/lab/trial/kick_trial.h"
#include "nonet/model/joints.h"
#include "nonet/motion/skill.h"

namespace nonet::lab {

/// The moment at which a kick began.
struct KickStart {
  std::vector<std::uint8_t> world;       // sim::World::save()
  model::Side foot = model::Side::Left;  // that kicks
  motion::KickAim aim;                   // what the kick was told
  Vector2 p_RPlace = Vector2::Zero();    // the kick's place of the ball (its head, for this foot), m
};

/// The start of a whole trial's kick; nothing if it did not come to it.
std::optional<KickStart> kickStart(const agent::AgentSettings& agent, const sim::Settings& settings,
                                   const KickScene& scene, std::uint64_t seed);

struct Swing {
  Kick kick;             // time from the begin of the kick; the target lies in its direction
  double lean = 0.0;     // the torso's largest tilt after contact, rad
  double upright = 0.0;  // how long it was not down after contact, s
};

/// One kick on a world of its own, for many starts.
class SwingTrial {
 public:
  /// `kick` names a skill with the head of a kick. Throws std::runtime_error if there is none.
  SwingTrial(const agent::AgentSettings& agent, const std::string& kick, bool quickSolver);
  ~SwingTrial();

  const motion::KickHead& head() const;  // for the left foot

  /// The ball should go `distance` far, m; without it as far as when the start was stored. When the kick has
  /// another place for the ball now than when the start was stored, the ball is moved by the difference. It
  /// ends soon when the kick is over and has not met the ball, or when the ball goes quite elsewhere: then
  /// nothing is known of a fall.
  Swing run(const KickStart& start, const std::optional<double>& distance = {});

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace nonet::lab
