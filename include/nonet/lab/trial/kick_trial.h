// One seeded kick with the whole approach: a robot that sees, with all noise, goes to a ball and kicks it as
// in play, with the team's behaviours and the real motion code, on the complete simulation.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nonet/agent/agent.h"
#include "nonet/lab/trial/server_address.h"
#include "nonet/motion/skill.h"
#include "nonet/sim/settings/settings.h"

namespace nonet::lab {

struct KickScene {
  std::string kick;        // name of its skill; empty: motion chooses
  double start = 0.5;      // m from the ball, facing it
  double bearing = 0.0;    // rad, from which side the robot comes: 0 = the ball goes straight on
  double rolling = 0.0;    // m/s, the fastest that the ball rolls at the begin, in any direction
  double pushed = 0.0;     // m/s, and how fast towards where it should go, as after a push of the dribbler
  double passed = 0.0;     // m/s, how fast a pass comes from that side, to roll out before the waiting robot
  double distance = 10.0;  // m, how far it should go
  bool stops = false;      // and no farther: a pass
  double longest = 10.0;   // s until the contact
};

/// What a kick was told when it began.
struct KickBegin {
  motion::KickAim aim;
  model::Side foot = model::Side::Left;
};

struct Kick {
  std::optional<KickBegin> begin;  // nothing: no kick began
  bool contact = false;            // the foot met the ball in a kick
  double forward = 0.0;            // m that the ball went towards the target, until it rolled out
  double aside = 0.0;              // m to the left of it
  double height = 0.0;             // m, of the ball's centre a metre from where it lay
  double highest = 0.0;            // m, of its centre, until it first came down
  double landing = 0.0;            // m from where it lay to where it first came down; 0: it did not fly
  double time = 0.0;               // s until contact
  double ballSpeed = 0.0;          // m/s, the fastest
  bool fell = false;               // within two seconds after contact, or before
  bool selfCollided = false;       // until then its own limbs collided, for which the referee freezes them
  std::vector<Vector3> path;       // of the ball: x towards the target, y left, from where it lay, m

  bool missed() const;
  bool tooShort() const;                            // under 2 m
  bool clears(const motion::KickHead& head) const;  // as high as a chip is to be, and down soon enough
  double direction() const;                         // rad, positive to the left
};

/// The same arguments always give the same kick.
Kick kickOnce(const agent::AgentSettings& agent, const sim::Settings& settings, const KickScene& scene,
              std::uint64_t seed);

/// The same on a server that is otherwise empty, in lock-step or by the clock: the robot enters, is put at
/// its place, and leaves. The truth comes from the monitor stream; the server's own noise makes each kick
/// another. Throws std::runtime_error that names the address when it cannot be reached or refuses.
Kick kickOnServer(const agent::AgentSettings& agent, const ServerAddress& address, const KickScene& scene,
                  std::uint64_t seed);

/// Head of the kick of that name, for the left foot. Throws std::runtime_error if this robot has no such
/// kick, naming those that it has.
motion::KickHead kickHead(const agent::AgentSettings& agent, const std::string& kick);

/// Ten bearings on a half circle, one after the other.
double kickBearing(int trial);

}  // namespace nonet::lab
