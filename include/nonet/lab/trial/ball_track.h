// Where ball and robot were, cycle by cycle, and what that is worth: the measures of the ball skills. Plain
// functions of a track, so that they can be tested with tracks made by hand.
//
// World axes, m, s. A track is in order of time; what stands in brackets below is how a measure treats a
// trial that failed.
#pragma once

#include <vector>

#include "nonet/math/pose2.h"

namespace nonet::lab {

struct BallSample {
  double time = 0.0;  // s since the trial began
  Vector2 ball = Vector2::Zero();
  Pose2 X_WR;  // torso on the ground, heading
};
using BallTrack = std::vector<BallSample>;

/// A line of straight legs along which the ball is to go.
struct BallPath {
  std::vector<Vector2> corners;  // at least two: begin and end
  double keep = 0.6;             // m, farther from the torso the ball is lost
  double width = 0.3;            // m, farther from the legs it has left the path

  double length() const;
};

/// Straight ahead from `start`.
BallPath straightPath(const Pose2& start, double length);
/// `turns` turns of this angle, alternately to the left and the right, a leg before, between and after them;
/// the middle line leads from `start` straight ahead.
BallPath slalomPath(const Pose2& start, int turns, double angle, double leg);

struct DribbleResult {
  double progress = 0.0;  // m of the path that the ball made, corner by corner, until the trial's end
  double speed = 0.0;     // m/s from the first touch to the end of the path (to the end of the trial)
  bool arrived = false;   // at the end of the path
  bool lost = false;      // was once too far from the torso, or too far from the path
  bool tooFar = false;    // was once too far from the torso, wherever
  double away = 0.0;      // share of that time in which it was lost
  double apart = 0.0;     // m, farthest from the torso
  double aside = 0.0;     // m, farthest from the path
};
DribbleResult measureDribble(const BallTrack& track, const BallPath& path);

struct ReceiveResult {
  bool held = false;     // for a while it stayed near the torso and slow beside it
  double time = 0.0;     // s when that began [the end of the track]
  double closest = 0.0;  // m, least distance of the ball from the torso
  double rebound = 0.0;  // m, largest distance within a second after the closest one
};
struct ReceiveRule {
  double near = 0.3;      // m from the torso
  double slow = 0.4;      // m/s, mean speed beside the torso
  double lasts = 0.5;     // s
  double patience = 2.0;  // s from the first time near until it is held
};
ReceiveResult measureReceive(const BallTrack& track, const ReceiveRule& rule);

/// The torso's mean speed straight along its own way over `seconds`, from where it has come `after` metres
/// far [0 when the track is too short].
double runSpeed(const BallTrack& track, double after, double seconds);

/// From `begin` until the torso moves slower than `still` for good, s [the rest of the track].
double stopTime(const BallTrack& track, double begin, double still);

}  // namespace nonet::lab
