// Team mates and opponents in the field frame, by team and number, from whichever body parts are seen, from
// what team mates tell about themselves, and from the opponents that they tell of.
//
// Needs: own pose, the vision message, radio reports. Gives: PlayerState per number. Players without a number
// (or of a third team) go to the nearest opponent that could have moved there, else to a free number. An
// opponent that is not seen where it must be seen has been carried away by the referee, and is forgotten.
#pragma once

#include <array>

#include "nonet/protocol/percept.h"
#include "nonet/world/world_state.h"

namespace nonet::world {

class PlayerTracker {
 public:
  /// A team mate's report about itself.
  struct Report {
    int unum = 0;
    Pose2 X_FP;
    double sigma = 1.0;  // m
    bool fallen = false;
    bool headingKnown = true;
  };
  /// A team mate's sighting of an opponent.
  struct OpponentReport {
    int unum = 0;
    Vector2 p_FP = Vector2::Zero();
    double sigma = 1.0;  // m, at the moment of the sighting
    bool fallen = false;
    double seenAt = kNever;  // server time, s
  };

  void predict(double dt, WorldState& state) const;
  void see(const protocol::Vision& vision, const Vector3& offset, WorldState& state);
  void hear(const Report& report, WorldState& state) const;
  /// Counts only for an opponent that one has not seen oneself since shortly before, and less the older it
  /// is.
  void hear(const OpponentReport& report, WorldState& state) const;
  /// The own team changed its side: half a turn for everybody.
  void mirror(WorldState& state) const;

 private:
  struct Sighting {
    Vector2 p_FP = Vector2::Zero();
    double sigma = 1.0;
    double heading = 0.0;
    bool headingKnown = false;
    std::optional<bool> fallen;
  };
  static std::optional<Sighting> evaluate(const protocol::SeenPlayer& seen, const Vector3& offset,
                                          const SelfState& self);
  static PlayerState* nearestOpponent(const Sighting& sighting, WorldState& state);
  static void merge(const Sighting& sighting, double time, PlayerState& player);
  void missOpponents(WorldState& state);

  std::array<int, kTeamSize + 1> absences_{};   // sightings in a row that an opponent should have been in
  std::array<double, kTeamSize + 1> missed_{};  // server time of the last of those, s
};

}  // namespace nonet::world
