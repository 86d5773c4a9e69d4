#include "nonet/lab/trial/scrum_trial.h"

#include <array>

#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/math/random.h"

#include "lab/trial/ball_drill.h"

namespace nonet::lab {

namespace {

constexpr std::size_t kPerSide = 3;
constexpr int kFirstNumber = 3;
constexpr double kTime = 12.0;       // s
constexpr double kAlong = 8.0;       // m, ball's place from the middle
constexpr double kAcross = 7.0;      // m
constexpr double kLineTurned = 0.4;  // rad, the line between the sides
constexpr double kFacing = 0.6;      // rad, robots off the direction of the ball
constexpr double kApart = 0.45;      // m
constexpr int kPlaceTries = 20;      // until they are so far apart

struct Ring {          // where a robot stands from the ball
  double least, most;  // m
  double wide;         // rad to either side of its own goal's direction
};
using Rings = std::array<Ring, kPerSide>;
constexpr Rings kAroundContested = {{{0.4, 1.5, 1.3}, {0.9, 2.6, 2.0}, {0.9, 2.6, 2.0}}};
constexpr Rings kAroundLoose = {{{0.8, 2.5, kPi}, {1.2, 4.0, kPi}, {1.2, 4.0, kPi}}};
constexpr double kLeastSpeed = 0.5;  // m/s, of a loose ball
constexpr double kMostSpeed = 3.0;   // m/s

using Places = std::array<Pose2, 2 * kPerSide>;  // the left side's first

void moveApart(Places& places) {
  for (int move = 0; move < kPlaceTries; ++move) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Vector2 way = places[i].translation - places[j].translation;
        const double apart = way.norm();
        if (apart >= kApart) continue;
        const Vector2 half =
            0.5 * (kApart - apart) * (apart > 1e-6 ? Vector2(way / apart) : Vector2::UnitX());
        places[i].translation += half;
        places[j].translation -= half;
      }
    }
  }
}

Places drawPlaces(const Vector2& ball, const Rings& rings, Random& random) {
  Places places;
  const double turned = random.uniform(-kLineTurned, kLineTurned);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Ring& ring = rings[i % kPerSide];
    const double side = i < kPerSide ? -1.0 : 1.0;
    const double distance = random.uniform(ring.least, ring.most);
    const double from = turned + random.uniform(-ring.wide, ring.wide);
    const Vector2 place = ball + side * distance * unitVector(from);
    places[i] = Pose2(place, wrapAngle(directionOf(ball - place) + random.uniform(-kFacing, kFacing)));
  }
  moveApart(places);
  return places;
}

// Each robot's falls, as they begin.
class FallCount {
 public:
  void look(const GameTrial& game) {
    for (std::size_t i = 0; i < lay_.size(); ++i) {
      const bool lies = game.down(i);
      if (lies && !lay_[i]) ++falls_[i / kPerSide];
      lay_[i] = lies;
    }
  }
  int of(std::size_t side) const { return falls_[side]; }

 private:
  std::array<bool, 2 * kPerSide> lay_{};
  std::array<int, 2> falls_{};
};

// Robots that have made one. A foul is written anew in each cycle until it is punished.
int foulers(const GameTrial& game, std::size_t side, sim::FoulType type) {
  int count = 0;
  for (std::size_t i = 0; i < kPerSide; ++i) count += game.fouls(side * kPerSide + i, type) > 0 ? 1 : 0;
  return count;
}

struct Begin {
  Vector2 ball = Vector2::Zero();      // m
  Vector2 velocity = Vector2::Zero();  // m/s
  Places places;
  std::uint64_t noise = 0;
};

// Once, with `agent` on the side `own`: 0 the left one.
void play(const agent::AgentSettings& agent, const agent::AgentSettings& opponent, std::size_t own,
          const Begin& begin, const sim::Settings& settings, Scrum& scrum) {
  const Vector2& ball = begin.ball;
  GameSituation situation;
  situation.ball = ball;
  situation.ballVelocity = begin.velocity;
  for (std::size_t i = 0; i < begin.places.size(); ++i) {
    const std::size_t side = i / kPerSide;
    GamePlayer player{side == own ? agent : opponent, side == 1, begin.places[i], {}};
    player.agent.unum = kFirstNumber + static_cast<int>(i % kPerSide);
    situation.players.push_back(player);
  }
  RecordedTrial trial(settings, situation, begin.noise);
  FallCount falls;
  trial.run(kTime, [&] {
    falls.look(trial.game());
    return trial.playsOn();
  });
  const double forward = own == 0 ? 1.0 : -1.0;
  double sum = 0.0;
  for (const BallSample& sample : trial.track()) sum += sample.ball.x() - ball.x();
  scrum.gained += 0.5 * forward * (trial.track().back().ball.x() - ball.x());
  scrum.territory += 0.5 * forward * sum / static_cast<double>(trial.track().size());
  scrum.falls += 0.5 * falls.of(own);
  scrum.opponentFalls += 0.5 * falls.of(1 - own);
  scrum.charges += 0.5 * foulers(trial.game(), own, sim::FoulType::Charging);
  scrum.opponentCharges += 0.5 * foulers(trial.game(), 1 - own, sim::FoulType::Charging);
  scrum.fell = scrum.fell || falls.of(own) > 0;
  scrum.selfCollisions += foulers(trial.game(), own, sim::FoulType::SelfCollision);
  scrum.simulated += trial.game().time();
}

}  // namespace

Scrum scrumOnce(ScrumBall ball, const agent::AgentSettings& agent, const agent::AgentSettings& opponent,
                const sim::Settings& settings, std::uint64_t seed) {
  Random random(seed);
  const double along = random.uniform(-kAlong, kAlong);
  Begin begin;
  begin.ball = Vector2(along, random.uniform(-kAcross, kAcross));
  const bool loose = ball == ScrumBall::Loose;
  begin.places = drawPlaces(begin.ball, loose ? kAroundLoose : kAroundContested, random);
  if (loose) {
    const double speed = random.uniform(kLeastSpeed, kMostSpeed);
    begin.velocity = speed * unitVector(random.uniform(-kPi, kPi));
  }
  begin.noise = random.next();
  Scrum scrum;
  for (const std::size_t own : {0U, 1U}) play(agent, opponent, own, begin, settings, scrum);
  return scrum;
}

}  // namespace nonet::lab
