#include "nonet/lab/reports/replay.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <time.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/agent/data_folder.h"
#include "nonet/config/assignment.h"
#include "nonet/config/parameters.h"
#include "nonet/lab/common/statistics.h"
#include "nonet/lab/reports/token_difference.h"
#include "nonet/motion/skill_language.h"
#include "nonet/protocol/log_file.h"
#include "nonet/protocol/percept_text.h"

namespace nonet::lab {
namespace {

using protocol::LogLine;
using protocol::PerceptKind;

/// Processor time of this thread, us: other programs on the machine do not count.
double processorTime() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e6 + static_cast<double>(time.tv_nsec) * 1e-3;
}

constexpr int kMessagesToLookAt = 300;    // of a foreign log, to find out who recorded it
constexpr double kOwnArmDistance = 0.35;  // m: no other robot's lower arm comes that near to the camera

/// What a foreign log tells of its robot: the handshake if it was recorded, otherwise the number on the arms
/// that the camera sees at a hand's breadth, and toes.
class Identity {
 public:
  void look(const LogLine& line) {
    if (line.kind == LogLine::Kind::Sent) {
      protocol::parseEffectors(line.text, effectors_);
      if (effectors_.scene) robotType = effectors_.scene->robotType;
      if (effectors_.init) {
        unum = effectors_.init->unum;
        team = std::string(effectors_.init->team.view());
      }
    } else if (line.kind == LogLine::Kind::Received) {
      protocol::parsePercept(line.text, percept_);
      if (percept_.game.unum) unum = *percept_.game.unum;
      if ((percept_.jointsPresent >> model::index(model::JointId::RLeg7)) & 1U) robotType = 4;
      if (percept_.vision && !team) lookAtArms();
    }
  }

  std::optional<int> unum;
  std::optional<std::string> team;
  std::optional<int> robotType;

 private:
  void lookAtArms() {
    for (const protocol::SeenPlayer& player : percept_.vision->players) {
      for (const auto part : {protocol::BodyPart::RLowerArm, protocol::BodyPart::LLowerArm}) {
        const auto& arm = player.parts[static_cast<std::size_t>(part)];
        if (arm && arm->distance < kOwnArmDistance) {
          unum = player.unum;
          team = std::string(player.team.view());
        }
      }
    }
  }

  protocol::Effectors effectors_;
  protocol::Percept percept_;
};

std::string_view perceptorName(PerceptKind kind) {
  switch (kind) {
    case PerceptKind::Time:
      return "time";
    case PerceptKind::GameState:
      return "GS";
    case PerceptKind::Hear:
      return "hear";
    case PerceptKind::Gyro:
      return "GYR";
    case PerceptKind::Accelerometer:
      return "ACC";
    case PerceptKind::Joint:
      return "HJ";
    case PerceptKind::See:
      return "See";
    case PerceptKind::Force:
      return "FRP";
  }
  return "?";
}

std::optional<Quantiles> quantiles(const std::vector<double>& sample) {
  if (sample.empty()) return std::nullopt;
  return Quantiles{sample.size(), quantile(sample, 0.5), quantile(sample, 0.95)};
}

class Replay {
 public:
  Replay(const std::string& path, const ReplaySettings& settings, const agent::AgentSettings& agentSettings)
      : settings_(settings),
        reader_(path),
        session_({agentSettings, !reader_.header() || agent::syncFromLog(*reader_.header())}) {
    report_.file = path;
    report_.own = reader_.header().has_value();
  }

  ReplayReport run() {
    LogLine line;
    while (reader_.next(line)) {
      linesRead_ = line.number;
      if (line.kind == LogLine::Kind::Received) {
        received(line);
      } else if (line.kind == LogLine::Kind::Sent && report_.own) {
        compare(line);
      } else if (line.kind == LogLine::Kind::Truth && settings_.truthObserver) {
        settings_.truthObserver(line.text);
      } else if (line.kind == LogLine::Kind::Other) {
        if (strangers_++ == 0) judgeStranger(line.number, line.text);
      }
    }
    finish();
    return std::move(report_);
  }

 private:
  void received(const LogLine& line) {
    const std::string_view text = line.text;
    const double start = processorTime();
    session_.receive(text);
    // In foreign logs every message gets its answer. In our own the recorded answers say which ones did.
    if (!report_.own) (void)session_.answer();
    cycles_.push_back(processorTime() - start);

    const protocol::Percept& percept = session_.percept();
    protocol::writePercept(percept, written_);
    if (written_ != text) ++report_.roundtripDifferences;
    if (percept.unknownTokens > 0) nameUnknown(line);
    count(percept);
    if (percept.vision) compareWithTruth(*percept.vision);
    if (settings_.observer) settings_.observer(session_);
  }

  // The parser drops what it does not know, so it is missing where the percept is written back.
  void nameUnknown(const LogLine& line) {
    constexpr std::size_t kEnough = 10;
    if (report_.unknown.size() >= kEnough) return;
    const auto difference = firstTokenDifference(line.text, written_);
    report_.unknown.push_back(
        {line.number, session_.percept().time, difference ? difference->first : std::string(line.text)});
  }

  void count(const protocol::Percept& percept) {
    for (const protocol::PerceptEntry& entry : percept.order) {
      ++kindCounts_[static_cast<std::size_t>(entry.kind)];
    }
    if (!percept.vision) return;
    landmarks_ += static_cast<long>(percept.vision->landmarks.size());
    balls_ += percept.vision->ball ? 1 : 0;
    players_ += static_cast<long>(percept.vision->players.size());
    lines_ += static_cast<long>(percept.vision->lines.size());
  }

  void compareWithTruth(const protocol::Vision& vision) {
    const world::WorldState& world = session_.agent().world();
    if (vision.truePosition) {
      positionErrors_.push_back((world.self.X_FC.translation() - *vision.truePosition).head<2>().norm());
    }
    if (vision.trueHeading) {
      const Vector3 forward = world.self.X_FC.linear().col(0);
      headingErrors_.push_back(
          std::abs(angleDifference(std::atan2(forward.y(), forward.x()), *vision.trueHeading)));
    }
    if (vision.trueBallPosition && world.ball.known) {
      ballErrors_.push_back((world.ball.p_FB - *vision.trueBallPosition).head<2>().norm());
    }
  }

  void compare(const LogLine& line) {
    const bool beforeFirstMessage = session_.counts().messages == 0;
    // Before the first message comes the greeting, and a lone (syn) for a server that hangs: the transport's
    // clock decided on that, not the agent.
    if (beforeFirstMessage && line.text == "(syn)") return;
    const double start = processorTime();
    const std::string_view answer = beforeFirstMessage ? session_.begin() : session_.answer();
    if (!beforeFirstMessage) cycles_.back() += processorTime() - start;
    if (answer == line.text) return;
    ++report_.effectorDifferences;
    if (report_.firstDifference) return;
    // The same tokens with other blanks differ as well, though nobody reads them differently.
    const TokenDifference difference =
        firstTokenDifference(line.text, answer).value_or(TokenDifference{0, "other blanks", "other blanks"});
    report_.firstDifference =
        EffectorDifference{line.number,      session_.percept().time, session_.counts().messages,
                           difference.token, difference.first,        difference.second};
  }

  /// Keeps what can be said about the first line that no log of an agent has.
  void judgeStranger(std::size_t number, std::string_view text) {
    const bool binary = std::any_of(text.begin(), text.end(), [](char c) {
      return static_cast<unsigned char>(c) < ' ' && c != '\t' && c != '\r';
    });
    const bool monitor = text.starts_with("((") || text.starts_with("(RSG") || text.starts_with("RSG");
    stranger_ = fmt::format("line {} is {}", number,
                            binary    ? "binary data"
                            : monitor ? "of a monitor's stream"
                                      : fmt::format("'{}'", text.substr(0, 40)));
  }

  /// Torn before a first message, and what there is may be of a log, whose lines begin with a mark.
  bool tornEarly() const {
    constexpr std::string_view kMarks = "<>=#";
    const std::string_view rest = reader_.tornLine();
    return reader_.end() == protocol::LogReader::End::Torn && strangers_ == 0 &&
           (rest.empty() || kMarks.find(rest.front()) != std::string_view::npos);
  }

  void judge() {
    report_.problem = reader_.problem();
    const bool messages = session_.counts().messages > 0;
    if (reader_.end() == protocol::LogReader::End::Damaged) {
      report_.sound = false;
    } else if (!report_.own && !messages && !tornEarly()) {
      const std::string_view rest = reader_.tornLine();
      if (strangers_ == 0 && !rest.empty()) judgeStranger(linesRead_ + 1, rest);
      report_.sound = false;
      report_.problem = fmt::format("{}: no log of an agent, which has lines that begin with '<' and '>': {}",
                                    report_.file, stranger_);
    } else if (report_.own && strangers_ > 0) {
      report_.sound = false;
      report_.problem = fmt::format("{}: damaged, {} lines are neither message nor answer: {}", report_.file,
                                    strangers_, stranger_);
    }
  }

  void finish() {
    judge();
    report_.counts = session_.counts();
    for (std::size_t i = 0; i < kindCounts_.size(); ++i) {
      report_.perceptors[std::string(perceptorName(static_cast<PerceptKind>(i)))] = kindCounts_[i];
    }
    report_.perceptors["See: landmarks"] = landmarks_;
    report_.perceptors["See: ball"] = balls_;
    report_.perceptors["See: players"] = players_;
    report_.perceptors["See: lines"] = lines_;
    report_.cycleMedian = quantile(cycles_, 0.5);
    report_.cycleP999 = quantile(cycles_, 0.999);
    report_.positionError = quantiles(positionErrors_);
    report_.headingError = quantiles(headingErrors_);
    report_.ballError = quantiles(ballErrors_);
  }

  const ReplaySettings& settings_;
  protocol::LogReader reader_;
  agent::Session session_;
  ReplayReport report_;
  std::string written_;
  std::size_t linesRead_ = 0;
  long strangers_ = 0;                    // lines of no known kind
  std::string stranger_ = "it is empty";  // or what the first of them is
  std::array<long, 8> kindCounts_{};
  long landmarks_ = 0;
  long balls_ = 0;
  long players_ = 0;
  long lines_ = 0;
  std::vector<double> cycles_;
  std::vector<double> positionErrors_;
  std::vector<double> headingErrors_;
  std::vector<double> ballErrors_;
};

nlohmann::ordered_json toJson(const std::optional<Quantiles>& error, double scale) {
  if (!error) return nullptr;
  return {{"count", error->count}, {"median", error->median * scale}, {"p95", error->p95 * scale}};
}

// What stands in a file is the file's fault, whatever it is.
agent::AgentSettings fromHeader(const protocol::LogHeader& header, const std::string& dataFolder,
                                const std::string& path) {
  try {
    return agent::agentFromLog(header, dataFolder, path);
  } catch (const agent::DataError&) {
    throw;
  } catch (const config::ParameterError& error) {
    throw protocol::LogError(error.what());
  } catch (const motion::SkillError& error) {
    throw protocol::LogError(fmt::format("{}: {}", path, error.what()));
  }
}

agent::AgentSettings recordedAgent(const std::string& path, const ReplaySettings& settings) {
  protocol::LogReader reader(path);
  LogLine line;
  if (reader.header()) {
    if (settings.unum || settings.team || settings.robotType) {
      throw std::runtime_error(
          path + ": --unum, --team and --type are for foreign logs; our own say who recorded them");
    }
    agent::AgentSettings agentSettings = fromHeader(*reader.header(), settings.dataFolder, path);
    while (reader.next(line) && line.kind == LogLine::Kind::Comment) {
      if (const auto start = agent::startFromComment(line.text)) agentSettings.startPose = start;
    }
    for (const std::string& file : settings.parameterFiles)
      config::overlayFile(agentSettings.parameters, file);
    return agentSettings;
  }
  Identity identity;
  for (int messages = 0; messages < kMessagesToLookAt && reader.next(line);) {
    if (line.kind == LogLine::Kind::Received) ++messages;
    identity.look(line);
  }
  agent::AgentChoice choice;
  choice.unum = settings.unum.value_or(identity.unum.value_or(0));
  choice.team = settings.team.value_or(identity.team.value_or("Nonet"));
  choice.robotType = settings.robotType.value_or(identity.robotType.value_or(0));
  choice.parameterFiles = settings.parameterFiles;
  return agent::makeAgentSettings(choice, settings.dataFolder);
}

}  // namespace

agent::AgentSettings agentOfLog(const std::string& path, const ReplaySettings& settings) {
  agent::AgentSettings agentSettings = recordedAgent(path, settings);
  for (const std::string& text : settings.assignments)
    config::assignParameter(agentSettings.parameters, text);
  return agentSettings;
}

ReplayReport replay(const std::string& path, const ReplaySettings& settings) {
  try {
    return Replay(path, settings, agentOfLog(path, settings)).run();
  } catch (const protocol::DamagedLog& error) {
    ReplayReport report;
    report.file = path;
    report.own = true;
    report.problem = error.what();
    report.sound = false;
    return report;
  }
}

nlohmann::ordered_json ReplayReport::toJson() const {
  nlohmann::ordered_json json = {
      {"file", file},
      {"messages", counts.messages},
      {"unknown", counts.unknownTokens},
      {"roundtrip_differences", roundtripDifferences},
      {"lost_cycles", counts.lostCycles},
      {"effector_differences", nullptr},
      {"cycle_us", {{"median", cycleMedian}, {"p999", cycleP999}}},
      {"own", own},
      {"passed_over", counts.passedOver},
      {"problem", problem},
      {"perceptors", perceptors},
      {"position_error_m", lab::toJson(positionError, 1.0)},
      {"heading_error_deg", lab::toJson(headingError, toDegrees(1.0))},
      {"ball_error_m", lab::toJson(ballError, 1.0)},
  };
  if (own) json["effector_differences"] = effectorDifferences;
  if (firstDifference) {
    json["first_difference"] = {
        {"line", firstDifference->line},         {"time", firstDifference->time},
        {"cycle", firstDifference->cycle},       {"token", firstDifference->token},
        {"recorded", firstDifference->recorded}, {"replayed", firstDifference->replayed}};
  }
  for (const UnknownToken& token : unknown) {
    json["unknown_tokens"].push_back({{"line", token.line}, {"time", token.time}, {"text", token.text}});
  }
  return json;
}

std::string ReplayReport::toText() const {
  std::string text = fmt::format(
      "{}: {} messages, {} unknown tokens, {} round-trip differences, {} lost cycles, {} passed over\n", file,
      counts.messages, counts.unknownTokens, roundtripDifferences, counts.lostCycles, counts.passedOver);
  text += fmt::format("  cycle: median {:.1f} us, 99.9th percentile {:.1f} us\n", cycleMedian, cycleP999);
  if (!perceptors.empty()) {
    text += "  perceptors:";
    for (const auto& [name, number] : perceptors) text += fmt::format(" {} {},", name, number);
    text.back() = '\n';
  }
  if (own)
    text += fmt::format("  effectors: {} answers differ from the recorded ones\n", effectorDifferences);
  if (firstDifference) {
    text += fmt::format(
        "  first difference in line {}, cycle {}, server time {:.2f}: recorded {}, replayed {} (token {})\n",
        firstDifference->line, firstDifference->cycle, firstDifference->time, firstDifference->recorded,
        firstDifference->replayed, firstDifference->token);
  }
  for (const UnknownToken& token : unknown) {
    text += fmt::format("  unknown in line {}, server time {:.2f}: {}\n", token.line, token.time, token.text);
  }
  const auto error = [&](const char* name, const std::optional<Quantiles>& value, double scale,
                         const char* unit) {
    if (!value) return;
    text += fmt::format("  {} error: median {:.3f} {}, 95th percentile {:.3f} {} ({} frames)\n", name,
                        value->median * scale, unit, value->p95 * scale, unit, value->count);
  };
  error("position", positionError, 1.0, "m");
  error("heading", headingError, toDegrees(1.0), "deg");
  error("ball", ballError, 1.0, "m");
  if (!problem.empty()) text += "  " + problem + "\n";
  return text;
}

}  // namespace nonet::lab
