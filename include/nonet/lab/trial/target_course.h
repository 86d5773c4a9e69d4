// The obstacle course on which walks are learned and judged, after [MacAlpine 2012b] and [MacAlpine 2012a,
// section 4.2]. Long walks in all directions, curves, quick changes, stop and go, left and right, noisy
// targets, weaving, extreme changes, spirals; and, because a game needs them too, sidesteps and backward
// steps with a held heading, turns on the spot, and places to be taken with a heading.
//
// Order, mirror images and sizes are drawn from the seed. Reward of a target: distance x time allowed / time
// taken, or the distance made good when it was not reached in time; a stop costs the distance moved; a fall
// costs 5 and the robot is set upright again.
#pragma once

#include <cstdint>
#include <vector>

#include "nonet/lab/common/progress.h"
#include "nonet/lab/trial/robot_trial.h"

namespace nonet::lab {

struct CourseLeg {
  enum class Kind : std::uint8_t {
    Walk,   // to the target, walking and turning at the same time
    Shift,  // to the target, heading held
    Turn,   // on the spot
    Place,  // to the target, to stand there with a heading, as players do all the time
    Stop,
  } kind = Kind::Walk;
  Vector2 target = Vector2::Zero();  // m, seen from where the leg (or, chained, its item) began
  double turn = 0.0;                 // Turn: how far; Place: final heading, from that at the begin; rad
  double time = 1.0;                 // s, allowed
  bool chained = false;
  double noise = 0.0;  // m, standard deviation of the target as the robot is told
};

struct CourseItem {
  const char* name = "";
  std::vector<CourseLeg> legs;
};

/// About a minute of walking.
std::vector<CourseItem> makeCourse(std::uint64_t seed);

struct CourseResult {
  double reward = 0.0;
  int falls = 0;
  int targets = 0;  // that could be reached
  int reached = 0;
  double distance = 0.0;   // m made good
  double time = 0.0;       // s walked
  double stopDrift = 0.0;  // m moved in stops
  /// Integral of (tilt / 0.3 rad)^4, s: near falls, which tell sooner than the rare falls how safe a walk is.
  double unsteadiness = 0.0;
};

struct CourseSettings {
  enum class Items : std::uint8_t {
    All,
    HeldHeading,  // only those of sidesteps and backward steps
  } items = Items::All;
  int mostItems = 100;  // the first so many, as they are drawn
  motion::WalkSet set = motion::WalkSet::Automatic;
  int mostFalls = 100;  // then the rest of the course is not walked (and earns nothing)
  /// Every target is walked to until it is reached (30 s at most): what counts is CourseResult::time.
  bool untilReached = false;
  double fallCost = 5.0;  // of reward
  /// Now and then all of the robot gets a velocity, m/s, at most this: what bodies in a duel do.
  double push = 0.0;
  /// Every second, on average, the other of the sets goToTarget and positioning is asked for.
  bool changeSets = false;
};

CourseResult runCourse(const TrialSettings& setup, std::uint64_t seed, const CourseSettings& settings);

/// What a parameter set makes of many courses.
struct CourseSummary {
  int courses = 0;
  int falls = 0;           // in all courses, as the task counts them
  int changeFalls = 0;     // the same while the sets change at random
  double reward = 0.0;     // mean of a course
  double distance = 0.0;   // m, mean of a course
  double stopDrift = 0.0;  // m, mean of a course
  double time = 0.0;       // s, mean of a course walked until every target is reached
};

/// The seeds of the courses follow from `seed`; threads 0: all processors.
CourseSummary measureCourses(const TrialSettings& setup, std::uint64_t seed, int courses, int threads,
                             const TrialProgress& progress = {});

}  // namespace nonet::lab
