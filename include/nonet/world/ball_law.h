// How the ball moves when nobody touches it: the server's drag, bounce and rolling (server facts 3.2, 3.3;
// the constants are fitted to recorded rolls, drops and kicks).
#pragma once

#include <array>
#include <optional>

#include "nonet/math/types.h"

namespace nonet::world {

struct BallMotion {
  Vector3 p_FB = Vector3::Zero();  // m
  Vector3 v_FB = Vector3::Zero();  // m/s
};

inline constexpr double kBallRestHeight = 0.0403;  // m, centre at rest: the ground is soft
inline constexpr double kRollDecay = 1.062;        // 1/s: rolling, v' = -kRollDecay v
inline constexpr double kAirDecay = 0.385;         // 1/s: drag 0.01 N s/m over 0.026 kg
inline constexpr double kBounce = 0.66;            // vertical speed kept in a bounce
inline constexpr double kBounceGrip = 0.8;         // horizontal speed kept in a bounce (it starts to roll)

bool isFlying(const BallMotion& ball);

/// Moves the ball by `dt` s (at most one cycle for a good bounce).
void stepBall(BallMotion& ball, double dt);
/// The same for any time, s.
void moveBall(BallMotion& ball, double seconds);

/// How long it is still in the air until its first bounce, s; 0 if it rolls. The drag on the way up and down
/// is left out: at most 6 % of the time.
double landingTime(const BallMotion& ball);

/// Where a ball goes that nobody touches, in the plane: reckoned once, asked often. Legs from bounce to
/// bounce, each with its drag, and the roll at the end; the way is straight. Times are seconds from now.
class FreeBall {
 public:
  explicit FreeBall(const BallMotion& ball);
  Vector2 at(double seconds) const;  // m
  /// When it rolls; 0: it does already.
  double rollsAfter() const { return legs_[count_ - 1].begin; }
  /// When it rolls no faster than `speed` (m/s).
  double slowAfter(double speed) const;
  /// When it has gone so far (m) along its way; infinite: it never does.
  double goneAfter(double distance) const;

 private:
  struct Leg {
    double begin = 0.0;              // s
    Vector2 p_FB = Vector2::Zero();  // m, at its begin
    Vector2 v_FB = Vector2::Zero();  // m/s, at its begin
    double decay = kRollDecay;       // 1/s
  };
  static constexpr std::size_t kMostLegs = 12;  // the bounce after 11 others is lower than the ball's radius
  void add(double begin, const BallMotion& ball);

  std::array<Leg, kMostLegs> legs_{};
  std::size_t count_ = 0;
};

/// Where it comes to rest, m.
Vector2 restPlace(const BallMotion& ball);

/// When and where the centre crosses the line x = `x` (field frame), or nothing if it stops before.
struct LineCrossing {
  double time = 0.0;    // s from now
  double y = 0.0;       // m
  double height = 0.0;  // m
};
std::optional<LineCrossing> crossingOfLine(const BallMotion& ball, double x);

}  // namespace nonet::world
