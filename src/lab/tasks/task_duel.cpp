// duel: the course of goToTarget among others who bump into the robot, and staying upright before all. It
// teaches the set for the neighbourhood of others.
#include "nonet/lab/trial/target_course.h"

#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

class DuelTask final : public CourseTask {
 public:
  using CourseTask::CourseTask;

  // The search begins at the walk set, unless a positioning set was learned before.
  void prepare(agent::AgentParameters& parameters) const override {
    parameters.motion.selection.usePositioning = true;
    startAt(parameters.motion.sets.goToTarget, parameters.motion.sets.positioning);
  }
};

}  // namespace

CourseSettings duelCourse() {
  return {.set = motion::WalkSet::Positioning, .fallCost = kDearFall, .push = kDuelPush};
}

const Task& duelTask() {
  static const DuelTask task(
      "duel", "the course of goToTarget with pushes as in a crowd; a fall costs 20 instead of 5",
      "motion.positioning.", duelCourse());
  return task;
}

}  // namespace nonet::lab
