#include "nonet/sim/server/monitor.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>

#include "sim/server/monitor_scene.h"

namespace nonet::sim {

namespace {

// Meshes lie on their backs: mesh x = -body x, mesh y = body z, mesh z = body y. The digits are those of the
// server's 32-bit rotation by (-90, 0, 180) degrees.
constexpr std::string_view kMeshRotation =
    "(SLT -1 3.82137e-15 8.74228e-08 -0 8.74228e-08 4.37114e-08 1 0 0 1 -4.37114e-08 0 0 0 0 1)";

std::array<float, 16> matrixOf(const ScenePose& pose) {
  std::array<float, 16> m{};
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) m[4 * column + row] = pose.rotation(row, column);
  }
  for (int row = 0; row < 3; ++row) m[12 + row] = pose.position[row];
  m[15] = 1.0F;
  return m;
}

}  // namespace

MonitorStream::MonitorStream(const Simulation& simulation)
    : simulation_(simulation),
      staticWhole_(staticScene(simulation.settings())),
      staticFirstDifference_(staticDifference(true)),
      staticDifference_(staticDifference(false)) {}

const std::string& MonitorStream::full() {
  const SentGameState before = sent_;
  const std::size_t foulsBefore = sentFouls_;
  text_.clear();
  sentFouls_ = simulation_.fouls().size();  // the stream brings new ones to everybody
  writeEnvironment(true);
  text_ += "(RSG 0 1)(";
  writeScene(Form::Whole, simulation_.agents(), false);
  text_ += ")";
  sent_ = before;
  sentFouls_ = foulsBefore;
  return text_;
}

const std::string& MonitorStream::next(bool wantFull) {
  const std::vector<AgentInfo> agents = simulation_.agents();
  lastWasFull_ = wantFull || !anySent_ || sentScene_ != simulation_.sceneVersion();
  sentFouls_ = std::min(sentFouls_, simulation_.fouls().size());  // fewer after a restore
  text_.clear();
  writeEnvironment(lastWasFull_);
  text_ += lastWasFull_ ? "(RSG 0 1)(" : "(RDS 0 1)(";
  const Form form = lastWasFull_ ? Form::Whole : firstDifference_ ? Form::FirstDifference : Form::Difference;
  writeScene(form, agents, true);
  text_ += ")";
  firstDifference_ = lastWasFull_;
  anySent_ = true;
  sentScene_ = simulation_.sceneVersion();
  return text_;
}

// Server facts 5.1.
void MonitorStream::writeEnvironment(bool all) {
  const Settings& s = simulation_.settings();
  text_ += '(';
  if (all) {
    const auto value = [this](std::string_view name, double number) {
      fmt::format_to(std::back_inserter(text_), "({} {:g})", name, number);
    };
    value("FieldLength", s.fieldLength);
    value("FieldWidth", s.fieldWidth);
    value("FieldHeight", s.fieldHeight);
    value("GoalWidth", s.goalWidth);
    value("GoalDepth", s.goalDepth);
    value("GoalHeight", s.goalHeight);
    value("BorderSize", s.borderSize);
    value("FreeKickDistance", s.freeKickDistance);
    value("WaitBeforeKickOff", s.waitBeforeKickOff);
    value("AgentRadius", s.agentRadius);
    value("BallRadius", s.ballRadius);
    value("BallMass", s.ballMass);
    value("RuleGoalPauseTime", s.ruleGoalPauseTime);
    value("RuleKickInPauseTime", s.ruleKickInPauseTime);
    value("RuleHalfTime", s.ruleHalfTime);
    value("PassModeMinOppBallDist", s.passModeMinOppBallDist);
    value("PassModeDuration", s.passModeDuration);
    text_ += "(play_modes";
    for (int mode = 0; mode < protocol::kPlayModeCount; ++mode) {
      text_ += ' ';
      text_ += protocol::playModeName(static_cast<protocol::PlayMode>(mode));
    }
    text_ += ')';
  }
  writeGameState(all);
  const auto fouls = simulation_.fouls();
  for (; sentFouls_ < fouls.size(); ++sentFouls_) {
    const FoulRecord& foul = fouls[sentFouls_];
    fmt::format_to(std::back_inserter(text_), "(foul {} {} {} {})", foul.index, foul.type,
                   static_cast<int>(foul.side), foul.unum);
  }
  text_ += ')';
}

void MonitorStream::writeGameState(bool all) {
  if (all) sent_ = {};
  const MatchState& match = simulation_.match();
  const auto out = [this] { return std::back_inserter(text_); };
  fmt::format_to(out(), "(time {:g})", match.time);
  const auto name = [&](std::string_view predicate, const protocol::TeamName& team, bool& sent) {
    if (sent || team.empty()) return;
    sent = true;
    fmt::format_to(out(), "({} {})", predicate, std::string_view(team));
  };
  name("team_left", match.teamLeft, sent_.teamLeft);
  name("team_right", match.teamRight, sent_.teamRight);
  const auto changed = [&](std::string_view predicate, int value, int& sent) {
    if (value == sent) return;
    sent = value;
    fmt::format_to(out(), "({} {})", predicate, value);
  };
  changed("half", match.half, sent_.half);
  changed("score_left", match.scoreLeft, sent_.scoreLeft);
  changed("score_right", match.scoreRight, sent_.scoreRight);
  changed("play_mode", static_cast<int>(match.playMode), sent_.playMode);
  if (match.playMode == protocol::PlayMode::PlayOn) {
    if (match.passModeScoreWaitLeft > 0.0F) {
      fmt::format_to(out(), "(pass_mode_score_wait_left {:g})", match.passModeScoreWaitLeft);
    }
    if (match.passModeScoreWaitRight > 0.0F) {
      fmt::format_to(out(), "(pass_mode_score_wait_right {:g})", match.passModeScoreWaitRight);
    }
  }
}

void MonitorStream::writeScene(Form form, const std::vector<AgentInfo>& agents, bool remember) {
  remember_ = remember;
  slot_ = 0;
  if (form == Form::Whole) {
    if (remember) sentMatrices_.clear();
    text_ += staticWhole_;
  } else {
    text_ += form == Form::FirstDifference ? staticFirstDifference_ : staticDifference_;
  }
  openMoving(simulation_.world().ballPose(), form);
  const float radius = static_cast<float>(simulation_.settings().ballRadius);
  mesh(form, "soccerball.obj", {radius, radius, radius}, "soccerball_rcs-soccerball.png");
  text_ += ')';
  sentSelected_.resize(agents.size(), false);
  for (std::size_t i = 0; i < agents.size(); ++i) {
    agentSlot_ = i;
    if (form == Form::Whole) {
      fmt::format_to(std::back_inserter(text_), "(nd TRF {}", kIdentity);
    } else {
      text_ += "(nd";
    }
    if (agents[i].robot != kNoRobot) writeRobot(agents[i], form);
    text_ += ')';
    if (remember) sentSelected_[i] = agents[i].selected;
  }
}

// A transform is in a difference only if an element has changed by more than 0.005 since it was last sent.
void MonitorStream::openMoving(const ScenePose& pose, Form form) {
  constexpr float kPrecision = 0.005F;
  const Matrix now = matrixOf(pose);
  bool send = true;
  if (form != Form::Whole) {
    const Matrix& sent = sentMatrices_[slot_];
    send = !std::equal(now.begin(), now.end(), sent.begin(),
                       [](float a, float b) { return !(std::abs(a - b) > kPrecision); });
  }
  text_ += form == Form::Whole ? "(nd TRF" : "(nd";
  if (send) {
    text_ += " (SLT";
    for (const float value : now) fmt::format_to(std::back_inserter(text_), " {:g}", value);
    text_ += ')';
    if (remember_ && form == Form::Whole) sentMatrices_.push_back(now);
    if (remember_ && form != Form::Whole) sentMatrices_[slot_] = now;
  }
  ++slot_;
}

void MonitorStream::mesh(Form form, std::string_view file, const std::array<float, 3>& scale,
                         std::string_view materials) {
  if (form == Form::Whole) {
    fmt::format_to(std::back_inserter(text_),
                   "(nd StaticMesh (setVisible 1) (load models/{}) (sSc {:g} {:g} {:g})(resetMaterials {}))",
                   file, scale[0], scale[1], scale[2], materials);
  } else {
    text_ += form == Form::FirstDifference ? "(nd StaticMesh (setVisible 1))" : "(nd StaticMesh)";
  }
}

void MonitorStream::standardShape(Form form, std::string_view load, const std::array<float, 3>& scale,
                                  std::string_view material) {
  if (form == Form::Whole) {
    fmt::format_to(std::back_inserter(text_),
                   "(nd SMN (setVisible 1) (load {}) (sSc {:g} {:g} {:g}) (sMat {}))", load, scale[0],
                   scale[1], scale[2], material);
  } else {
    text_ += form == Form::FirstDifference ? "(nd SMN (setVisible 1))" : "(nd SMN)";
  }
}

void MonitorStream::writeRobot(const AgentInfo& agent, Form form) {
  for (const model::BodySpec& body : model::robotModel(agent.robotType).bodies()) {
    openMoving(simulation_.world().bodyPose(agent.robot, body.id), form);
    writeBody(agent, body, form);
    text_ += ')';
  }
}

// What is drawn of each body: server facts 5.2, second table.
void MonitorStream::writeBody(const AgentInfo& agent, const model::BodySpec& body, Form form) {
  using model::BodyId;
  const bool known = agent.side != protocol::TeamSide::None;
  const std::string number = known ? fmt::format("matNum{}", agent.unum) : "matNum";
  const std::string team = !known                                   ? "matTeam"
                           : agent.side == protocol::TeamSide::Left ? "matLeft"
                                                                    : "matRight";
  // The meshes of types 1 to 3 have a material of their own, those of type 4 have none.
  const std::string type = agent.robotType == 4 ? "" : fmt::format("matType{} ", agent.robotType);
  const std::string_view name = model::bodyName(body.id);
  const auto turned = [&](std::string_view file, std::string_view materials) {
    if (form == Form::Whole) {
      fmt::format_to(std::back_inserter(text_), "(nd TRF {}", kMeshRotation);
    } else {
      text_ += "(nd";
    }
    mesh(form, file, {0.1F, 0.1F, 0.1F}, materials);
    text_ += ')';
  };
  const auto even = [](float scale) { return std::array<float, 3>{scale, scale, scale}; };
  const bool toes = model::robotModel(agent.robotType).hasToes();
  switch (body.id) {
    case BodyId::Torso: {
      turned(fmt::format("naobody{}.obj", agent.robotType),
             fmt::format("{} {} {}naowhite", number, team, type));
      const int visible = agent.selected ? 1 : 0;
      const std::string wasVisible = fmt::format(" (setVisible {})", visible);
      if (form == Form::Whole) {
        fmt::format_to(std::back_inserter(text_),
                       "(nd TRF {}(nd SMN{} (setTransparent) (load StdUnitCylinder 1 1) (sSc 0.2 0.2 0.02) "
                       "(sMat matSelect)))",
                       kIdentity, wasVisible);
      } else {
        const bool changed = form == Form::FirstDifference || sentSelected_[agentSlot_] != agent.selected;
        fmt::format_to(std::back_inserter(text_), "(nd(nd SMN{}))", changed ? wasVisible : "");
      }
      return;
    }
    case BodyId::Neck:
      return standardShape(form, "StdCapsule 0.015 0.08", even(1.0F), "matDarkGrey");
    case BodyId::Head:
      return turned("naohead.obj", fmt::format("{} naoblack naogrey naowhite", team));
    case BodyId::RUpperArm:
    case BodyId::LUpperArm:
      return mesh(form, fmt::format("{}{}.obj", name, agent.robotType), even(0.07F),
                  fmt::format("{} {}naowhite", team, type));
    case BodyId::RLowerArm:
    case BodyId::LLowerArm:
      return mesh(form, fmt::format("{}.obj", name), even(0.05F), fmt::format("{} naowhite", team));
    case BodyId::RThigh:
      return mesh(form, "rthigh.obj", even(0.07F), fmt::format("{} {} naowhite", number, team));
    case BodyId::LThigh:
      return mesh(form, "lthigh.obj", even(0.07F), fmt::format("{} naowhite", team));
    case BodyId::RShank:
    case BodyId::LShank:
      return mesh(form, fmt::format("{}{}.obj", name, agent.robotType), even(0.08F),
                  fmt::format("{} {}naowhite", team, type));
    case BodyId::RFoot:
    case BodyId::LFoot:
      return mesh(form, fmt::format("{}.obj", name),
                  toes ? std::array<float, 3>{0.08F, 0.0622412F, 0.08F} : even(0.08F),
                  fmt::format("{} naowhite", team));
    case BodyId::RToe:
    case BodyId::LToe:
      return mesh(form, body.id == BodyId::RToe ? "rfoot.obj" : "lfoot.obj", {0.08F, 0.0228258F, 0.04F},
                  fmt::format("{} naowhite", team));
    case BodyId::RAnkle:
    case BodyId::LAnkle:
      return standardShape(form, "StdUnitSphere", even(0.01F), "matRed");
    default:
      return standardShape(form, "StdUnitSphere", even(0.01F), "matYellow");
  }
}

MonitorLog::MonitorLog(const Simulation& simulation, const std::string& path, int cyclesPerMessage)
    : stream_(simulation), path_(path), cyclesPerMessage_(cyclesPerMessage) {
  if (!path.ends_with(".log")) {
    file_ = std::make_unique<protocol::CompressedFile>(path);
    return;
  }
  auto& plain = file_.emplace<std::ofstream>(path);
  if (!plain) throw std::runtime_error(fmt::format("cannot write the monitor log {}", path));
}

void MonitorLog::cycle() {
  constexpr int kMessagesPerFull = 15;  // 3 s in the server's log
  if (failed() || --cyclesToNext_ > 0) return;
  cyclesToNext_ = cyclesPerMessage_;
  write(stream_.next(messagesSinceFull_ >= kMessagesPerFull));
  write("\n");
  messagesSinceFull_ = stream_.lastWasFull() ? 1 : messagesSinceFull_ + 1;
  // A killed server loses at most what came after the last full message.
  if (stream_.lastWasFull()) flush();
  noticeError();
}

void MonitorLog::close() {
  if (auto* plain = std::get_if<std::ofstream>(&file_)) {
    if (plain->is_open()) plain->close();
  } else {
    std::get<1>(file_)->close();
  }
  noticeError();
}

void MonitorLog::noticeError() {
  if (failed()) return;
  if (const auto* plain = std::get_if<std::ofstream>(&file_)) {
    if (!*plain)
      error_ = fmt::format("{}: recording stops, it cannot be written: {}", path_, std::strerror(errno));
  } else {
    error_ = std::get<1>(file_)->error();
  }
}

void MonitorLog::write(std::string_view text) {
  if (auto* plain = std::get_if<std::ofstream>(&file_)) {
    *plain << text;
  } else {
    std::get<1>(file_)->write(text);
  }
}

void MonitorLog::flush() {
  if (auto* plain = std::get_if<std::ofstream>(&file_)) {
    plain->flush();
  } else {
    std::get<1>(file_)->flush();
  }
}

}  // namespace nonet::sim
