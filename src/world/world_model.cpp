#include "nonet/world/world_model.h"

#include <array>
#include <cmath>
#include <utility>

#include "nonet/math/angle.h"
#include "nonet/math/rotation.h"
#include "nonet/world/ball_tracker.h"
#include "nonet/world/body_tracker.h"
#include "nonet/world/game_tracker.h"
#include "nonet/world/localization.h"
#include "nonet/world/player_tracker.h"
#include "nonet/world/set_piece_spot.h"

namespace nonet::world {

namespace {

constexpr int kBeamDelay = 2;            // messages from a command to its effect (server facts 1.2)
constexpr double kBallRollsOn = 1.05;    // s of a set piece in which it is seen elsewhere (server facts 4.7)
constexpr double kToldSigma = 0.05;      // m, beside what a mate says of its own accuracy: its own place
constexpr double kToldThingSigma = 0.1;  // m, the same of what it sees
constexpr double kLocalizedSigma = 0.3;  // m
constexpr double kLocalizedAngle = 0.2;  // rad
constexpr double kLocalizedAge = 5.0;    // s without a landmark

/// X_FW: the world as seen by a team that plays from the right is turned by 180 degrees.
Pose3 fieldFromWorld(bool fromRight) {
  Pose3 X_FW = Pose3::Identity();
  if (fromRight) X_FW.linear() = Vector3(-1.0, -1.0, 1.0).asDiagonal();
  return X_FW;
}

/// Covariance of (x, y, heading) of a point fixed to the robot, `arm` from the torso in field axes.
Matrix3 planarCovariance(const BeliefMatrix& P, const Vector3& arm, bool turned) {
  // The point moves by dp + dtheta x arm.
  Eigen::Matrix<double, 3, 6> J = Eigen::Matrix<double, 3, 6>::Zero();
  J(0, 0) = J(1, 1) = J(2, 5) = 1.0;
  J(0, 4) = arm.z();
  J(0, 5) = -arm.y();
  J(1, 3) = -arm.z();
  J(1, 5) = arm.x();
  Matrix3 covariance = J * P.topLeftCorner<6, 6>() * J.transpose();
  if (turned) {
    // Half a turn of the axes changes the sign of x and y together.
    covariance.block<2, 1>(0, 2) *= -1.0;
    covariance.block<1, 2>(2, 0) *= -1.0;
  }
  return covariance;
}

}  // namespace

struct WorldModel::Stages {
  Stages(const model::RobotModel& model, const WorldParameters& parameters, const protocol::TeamName& team,
         std::uint64_t seed)
      : body(model, parameters),
        game(team),
        localization(seed, {parameters.useParticleFilter, parameters.usePoseFit, parameters.useLines}) {}

  void fillSelf();
  void followBeam();
  void changeSides();
  void repeat(const protocol::Percept& percept);
  void listen(const protocol::Percept& percept);
  void believe(const protocol::SayMessage& message, double time);
  void followOthers(const protocol::Percept& percept);
  void followBall(const protocol::Percept& percept);

  BodyTracker body;
  GameTracker game;
  Localization localization;
  BallTracker ball;
  PlayerTracker players;
  WorldState state;
  std::array<std::optional<Pose2>, kBeamDelay> beams;  // asked for, newest last
  std::optional<Vector2> spot;  // where the ball will lie for the set piece, own field frame
  double spotSince = kNever;    // begin of the phase that it belongs to
};

void WorldModel::Stages::fillSelf() {
  const PoseBelief& belief = localization.belief();
  const bool fromRight = playsFromRight(state.game);
  const Pose3 X_FW = fieldFromWorld(fromRight);
  const Pose3 X_FR = X_FW * belief.pose();
  const Pose3 X_RC = model::cameraPose(state.body.bodies);
  SelfState& self = state.self;
  self.X_FR = Pose2(X_FR.translation().x(), X_FR.translation().y(), yawOf(X_FR.linear()));
  self.X_FC = X_FR * X_RC;
  self.height = X_FR.translation().z();
  self.covariance = planarCovariance(belief.covariance, Vector3::Zero(), fromRight);
  self.cameraCovariance = planarCovariance(belief.covariance, belief.R_WR * X_RC.translation(), fromRight);
  self.lastCorrection = localization.lastCorrection();
  const double position = std::sqrt(std::max(self.covariance(0, 0), self.covariance(1, 1)));
  const double heading = std::sqrt(self.covariance(2, 2));
  self.localized = localization.initialised() && !isFallen(state.body.posture) &&
                   position < kLocalizedSigma && heading < kLocalizedAngle &&
                   state.time - self.lastCorrection < kLocalizedAge;
}

void WorldModel::Stages::followBeam() {
  // A request counts two messages later, and only in the phases in which the server obeys (server facts 4.6).
  const std::optional<Pose2> due = beams[0];
  for (std::size_t i = 0; i + 1 < beams.size(); ++i) beams[i] = beams[i + 1];
  beams.back().reset();
  const Phase phase = state.game.phase;
  const bool allowed =
      phase == Phase::BeforeKickOff || phase == Phase::OwnGoal || phase == Phase::OpponentGoal;
  if (!due || !allowed) return;
  const Pose2 turned = Pose2(0.0, 0.0, kPi) * *due;
  std::array<Pose2, 2> places{*due, turned};
  if (playsFromRight(state.game)) std::swap(places[0], places[1]);
  localization.expectPlaces({places.data(), game.sideKnown() ? 1U : 2U}, state.time);
  body.putUpright(state.body);
}

void WorldModel::Stages::listen(const protocol::Percept& percept) {
  for (const protocol::Heard& heard : percept.heard) {
    if (heard.self || (!heard.team.empty() && !(heard.team == state.game.team))) continue;
    const auto message = protocol::decodeSay(heard.message, state.game.team);
    if (!message || message->unum == state.game.unum) continue;
    state.radio[static_cast<std::size_t>(message->unum)] = {percept.time, *message};
    believe(*message, percept.time);
  }
}

void WorldModel::Stages::changeSides() {
  ball.mirror();
  players.mirror(state);
  state.pass = {};
  spot.reset();
}

// A message with the time of the last one: who we are may be new in it, and what others said.
void WorldModel::Stages::repeat(const protocol::Percept& percept) {
  const bool fromRight = playsFromRight(state.game);
  game.update(percept, state.game);
  if (playsFromRight(state.game) != fromRight) changeSides();
  listen(percept);
  ball.fill(state.ball, state.self, state.time);
}

// What a team mate says of itself, the ball, opponents and what it is going to do.
void WorldModel::Stages::believe(const protocol::SayMessage& message, double time) {
  const double spokenAt = time - kBeamDelay * kCycleTime;
  const bool headingKnown = message.kind != protocol::SayKind::Sightings;
  players.hear(PlayerTracker::Report{message.unum, message.X_FR, message.sigma + kToldSigma, message.fallen,
                                     headingKnown},
               state);
  if (message.ball) {
    const protocol::SayBall& seen = *message.ball;
    ball.hear(
        {seen.p_FB, seen.v_FB, spokenAt - seen.age, spokenAt, message.sigma + kToldThingSigma, seen.landsIn},
        time);
  }
  if (message.kind == protocol::SayKind::Sightings) {
    for (const protocol::SaySighting& seen : message.sightings) {
      players.hear(PlayerTracker::OpponentReport{seen.unum, seen.p_FP, message.sigma + kToldThingSigma,
                                                 seen.fallen, spokenAt - seen.age},
                   state);
    }
  }
  if (message.kind == protocol::SayKind::Pass) {
    const protocol::SayPass& pass = message.pass;
    state.pass = {time,
                  message.unum,
                  pass.receiver,
                  pass.p_FTarget,
                  spokenAt + pass.untilKick,
                  spokenAt + pass.untilThere};
  }
}

// A ball that has left the field does not matter any more, but where the referee will put it.
void WorldModel::Stages::followBall(const protocol::Percept& percept) {
  const GameState& now = state.game;
  bool putNow = false;
  if (now.phaseSince != spotSince) {
    spotSince = now.phaseSince;
    spot.reset();
    // It has lain in the goal until now, where this message still shows it (server facts 1.2).
    putNow = isKickOff(now.phase);
    if (putNow) ball.put(Vector2::Zero(), state.time);
  }
  ball.predict(state.body.cycleTime);
  const bool justNow = state.time - now.phaseSince < kBallRollsOn;
  if (justNow && !spot && state.ball.known)
    spot = setPieceSpot(now.phase, state.ball.p_FB.head<2>(), state.field);
  const bool rollsOn = spot && justNow;
  if (percept.vision && !rollsOn && !putNow)
    ball.see(*percept.vision, state.self, localization.belief().offset, state.time);
  listen(percept);
  if (rollsOn) ball.put(*spot, state.time);
  if (now.phase == Phase::BeforeKickOff) ball.hold(Vector2::Zero(), state.time);
  ball.fill(state.ball, state.self, state.time);
}

void WorldModel::Stages::followOthers(const protocol::Percept& percept) {
  players.predict(state.body.cycleTime, state);
  if (percept.vision) players.see(*percept.vision, localization.belief().offset, state);
  followBall(percept);
  if (state.game.unum >= 1 && state.game.unum <= kTeamSize) {
    PlayerState& own = state.teammates[static_cast<std::size_t>(state.game.unum)];
    own.X_FP = state.self.X_FR;
    const Vector2 v_GR = state.body.v_GR.head<2>();
    own.v_FP = Eigen::Rotation2Dd(state.self.X_FR.rotation - state.body.yaw) * v_GR;
    own.sigma = std::sqrt(std::max(state.self.covariance(0, 0), state.self.covariance(1, 1)));
    own.lastSeen = state.time;
    own.known = own.headingKnown = localization.initialised();
    own.lies(isFallen(state.body.posture), state.time);
  }
}

WorldModel::WorldModel(const model::RobotModel& model, const WorldParameters& parameters,
                       const protocol::TeamName& team, std::uint64_t seed)
    : stages_(std::make_unique<Stages>(model, parameters, team, seed)) {}

WorldModel::~WorldModel() = default;

const WorldState& WorldModel::update(const protocol::Percept& percept, const std::optional<Pose2>& beam) {
  Stages& stages = *stages_;
  if (beam) stages.beams.back() = beam;
  WorldState& state = stages.state;
  if (!stages.body.update(percept, state.body)) {
    // A server that stands still sends the same time again.
    if (percept.time == state.time) stages.repeat(percept);
    return state;
  }
  state.time = percept.time;
  const bool fromRight = playsFromRight(state.game);
  stages.game.update(percept, state.game);
  stages.followBeam();
  const protocol::Vision* vision = percept.vision ? &*percept.vision : nullptr;
  stages.localization.update(state.body, vision);
  state.field = stages.localization.map().geometry();
  if (stages.localization.lastCorrection() == state.time) {
    stages.body.correctTilt(stages.localization.tiltCorrection(), state.body);
    const PoseBelief& belief = stages.localization.belief();
    const bool sure = std::sqrt(belief.covariance(kPositionState, kPositionState)) < kLocalizedSigma;
    if (sure && stages.localization.lastLandmark() == state.time) {
      stages.game.noticePlace(belief.p_WR.x(), state.time, state.game);
    }
  }
  if (playsFromRight(state.game) != fromRight) stages.changeSides();
  stages.fillSelf();
  stages.followOthers(percept);
  return state;
}

const WorldState& WorldModel::state() const {
  return stages_->state;
}

std::vector<Pose2> WorldModel::particles() const {
  const Pose2 X_FW(0.0, 0.0, playsFromRight(stages_->state.game) ? kPi : 0.0);
  std::vector<Pose2> poses;
  for (const Particle& particle : stages_->localization.particles().particles())
    poses.push_back(X_FW * particle.X_WR);
  return poses;
}

}  // namespace nonet::world
