#include "nonet/lab/trial/siege_trial.h"

#include <functional>
#include <vector>

#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/math/random.h"

#include "lab/trial/ball_drill.h"

namespace nonet::lab {

namespace {

constexpr std::size_t kAttackers = 4;
constexpr std::size_t kBacks = 6;
constexpr int kFirstAttacker = 3;       // number
constexpr double kSiegeTime = 25.0;     // s
constexpr double kSiegeLost = 5.0;      // m
constexpr double kNearestBall = 3.0;    // m, ball's place from the goal line
constexpr double kFarthestBall = 10.0;  // m
constexpr double kBallAside = 5.0;      // m
constexpr double kBallRolls = 1.0;      // m/s, at most
constexpr double kWide = 1.2;           // rad, to either side of the line from the ball to the goal and back
constexpr double kBackAside = 1.5;      // m, off the line to the goal
constexpr double kRobotsApart = 0.5;    // m
constexpr int kDraws = 40;              // until a robot is so far apart from the others

// Places of robots, none of them upon another.
class FreePlaces {
 public:
  Vector2 take(const std::function<Vector2()>& draw) {
    Vector2 place = draw();
    for (int i = 0; i < kDraws && !isFree(place); ++i) place = draw();
    taken_.push_back(place);
    return place;
  }

 private:
  bool isFree(const Vector2& place) const {
    for (const Vector2& other : taken_)
      if ((place - other).norm() < kRobotsApart) return false;
    return true;
  }

  std::vector<Vector2> taken_;
};

// Three of them press the ball, the others stand on the way to the goal, as a wall does.
Vector2 placeOfBack(std::size_t i, const Vector2& ball, const Vector2& goal, Random& random) {
  constexpr std::size_t kPress = 3;
  if (i < kPress) {
    const double from = directionOf(goal - ball) + random.uniform(-kWide, kWide);
    return ball + random.uniform(0.6, 2.6) * unitVector(from);
  }
  const Vector2 aside(0.0, random.uniform(-kBackAside, kBackAside));
  return ball + random.uniform(0.3, 0.85) * (goal - ball) + aside;
}

// One is at the ball, the others come after.
Vector2 placeOfAttacker(std::size_t i, const Vector2& ball, const Vector2& goal, Random& random) {
  const double from = directionOf(ball - goal) + random.uniform(-kWide, kWide);
  const double distance = i == 0 ? random.uniform(0.4, 1.2) : random.uniform(1.2, 4.0);
  return ball + distance * unitVector(from);
}

// The attackers first, so that the first of them is at the ball.
GameSituation drawSiege(const agent::AgentSettings& agent, const Defence& defence, const Vector2& goal,
                        Random& random) {
  GameSituation situation;
  const double aside = random.uniform(-kBallAside, kBallAside);
  situation.ball = goal - Vector2(random.uniform(kNearestBall, kFarthestBall), aside);
  const double direction = random.uniform(-kPi, kPi);
  situation.ballVelocity = random.uniform(0.0, kBallRolls) * unitVector(direction);
  const Vector2& ball = situation.ball;
  FreePlaces places;
  const auto facingBall = [&ball](const Vector2& place) { return Pose2(place, directionOf(ball - place)); };
  for (std::size_t i = 0; i < kAttackers; ++i) {
    const Vector2 place = places.take([&] { return placeOfAttacker(i, ball, goal, random); });
    situation.players.push_back(fieldPlayer(agent, facingBall(place), {}));
    situation.players.back().agent.unum = kFirstAttacker + static_cast<int>(i);
  }
  situation.players.push_back(rightGoalie(defence.goalie, goal));
  places.take([&] { return situation.players.back().X_WR.translation; });
  for (std::size_t i = 0; i < kBacks; ++i) {
    const Vector2 place = places.take([&] { return placeOfBack(i, ball, goal, random); });
    GamePlayer back{defence.back, true, facingBall(place), {}};
    back.agent.unum = 2 + static_cast<int>(i);
    situation.players.push_back(back);
  }
  return situation;
}

int foulsOf(const GameTrial& game, std::size_t from, std::size_t until, sim::FoulType type) {
  int fouls = 0;
  for (std::size_t i = from; i < until; ++i) fouls += game.fouls(i, type);
  return fouls;
}

void judgeEnd(protocol::PlayMode mode, Siege& siege) {
  using protocol::PlayMode;
  siege.goal = mode == PlayMode::GoalLeft;
  siege.corner = mode == PlayMode::CornerKickLeft;
  siege.out = mode != PlayMode::PlayOn && !siege.goal && !siege.corner;
}

}  // namespace

Siege siegeOnce(const agent::AgentSettings& agent, const Defence& defence, const sim::Settings& settings,
                std::uint64_t seed) {
  Random random(seed);
  const Vector2 goal(0.5 * settings.fieldLength, 0.0);
  const GameSituation situation = drawSiege(agent, defence, goal, random);
  RecordedTrial trial(settings, situation, random.next());
  const GameTrial& game = trial.game();
  Siege siege;
  const auto lost = [&] { return game.ball().x() < situation.ball.x() - kSiegeLost; };
  trial.run(kSiegeTime, [&] {
    for (std::size_t i = 0; i < kAttackers; ++i) siege.fell = siege.fell || game.down(i);
    return trial.playsOn() && !lost();
  });
  judgeEnd(game.simulation().match().playMode, siege);
  siege.lost = lost();
  const std::size_t all = situation.players.size();
  siege.charged = foulsOf(game, 0, kAttackers, sim::FoulType::Charging) > 0;
  siege.opponentCharged = foulsOf(game, kAttackers, all, sim::FoulType::Charging) > 0;
  siege.selfCollisions = foulsOf(game, 0, kAttackers, sim::FoulType::SelfCollision);
  siege.simulated = game.time();
  return siege;
}

}  // namespace nonet::lab
