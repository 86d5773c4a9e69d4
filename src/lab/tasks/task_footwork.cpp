// footwork: what feet do around a contested ball, for the positioning set. What learns one of its three parts
// alone is the worse at the others: approaches among pushes as of others (lab/trial/ball_trial.h), duels with
// the robot of the data folder, and some items of the course of `duel`, in all directions. The fitness is, in
// seconds: minus the mean time of an approach, more for duels that are won, less for falls in each part.
#include "nonet/lab/trial/ball_trial.h"
#include "nonet/math/random.h"

#include "lab/tasks/duel_tally.h"
#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

constexpr std::uint64_t kFootworkDraws = 9;  // stream of what this task draws

constexpr int kApproaches = 2;
constexpr double kApproachFall = 5.0;  // s
constexpr int kDuels = 4;
constexpr double kWon = 2.0;       // s
constexpr double kDuelFall = 2.0;  // s
constexpr int kCourseItems = 4;
constexpr double kPerReward = 0.06;    // s, worth of the course's reward,
constexpr double kUnsteadiness = 2.0;  // less so much for every second of near falls

class FootworkTask final : public Task {
 public:
  std::string_view name() const override { return "footwork"; }
  std::string_view description() const override {
    return "approaches among pushes, duels and a course in all directions, without falls";
  }
  std::vector<std::string> searchedKeys() const override { return {"motion.positioning."}; }

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override {
    const agent::AgentSettings agent = agentOf(parameters, settings);
    const sim::Settings server = serverOf(settings);
    Random random = Random(seed).fork(kFootworkDraws);
    TaskResult result;
    double time = 0.0, falls = 0.0;
    for (int i = 0; i < kApproaches; ++i) {
      const Approach approach = approachOnce(agent, server, random.next(), kDuelPush);
      time += approach.time / kApproaches;
      falls += approach.fell ? 1.0 : 0.0;
    }
    result.fitness = -time - kApproachFall * falls / kApproaches;
    result.measures = {{"approach_s", time}, {"falls_approach", falls / kApproaches}};
    addDuels(result, agent, dataAgent(settings, settings.robotType), server, random);
    addCourse(result, trialSettings(parameters, seed, settings), random.next());
    return result;
  }

 private:
  static void addDuels(TaskResult& result, const agent::AgentSettings& agent,
                       const agent::AgentSettings& opponent, const sim::Settings& server, Random& random) {
    const DuelTally duels = fightDuels(kDuels, agent, opponent, server, random);
    const double falls = static_cast<double>(duels.falls) / kDuels;
    result.fitness += kWon * duels.won - kDuelFall * falls;
    result.measures.insert(result.measures.end(), {{"won", duels.won}, {"falls_duel", falls}});
  }

  static void addCourse(TaskResult& result, const TrialSettings& setup, std::uint64_t seed) {
    CourseSettings course = duelCourse();
    course.mostItems = kCourseItems;
    course.mostFalls = kMostFalls;
    const CourseResult walked = runCourse(setup, seed, course);
    result.fitness += kPerReward * (walked.reward - kUnsteadiness * walked.unsteadiness);
    result.measures.insert(
        result.measures.end(),
        {{"reward", walked.reward}, {"falls_course", walked.falls}, {"unsteadiness_s", walked.unsteadiness}});
  }
};

}  // namespace

const Task& footworkTask() {
  static const FootworkTask task;
  return task;
}

}  // namespace nonet::lab
