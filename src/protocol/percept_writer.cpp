#include "nonet/math/angle.h"
#include "nonet/protocol/percept_text.h"
#include "nonet/protocol/server_axes.h"

#include "text_writer.h"

namespace nonet::protocol {
namespace {

class PerceptWriter {
 public:
  PerceptWriter(const Percept& percept, std::string& text) : percept_(percept), text_(text) {}

  void run() {
    for (const PerceptEntry& entry : percept_.order) {
      predicate(entry);
    }
  }

 private:
  void predicate(const PerceptEntry& entry) {
    switch (entry.kind) {
      case PerceptKind::Time:
        text_ += "(time (now ";
        appendTwoDecimals(text_, percept_.time);
        text_ += "))";
        break;
      case PerceptKind::GameState:
        gameState(percept_.game);
        break;
      case PerceptKind::Hear:
        if (entry.item < percept_.heard.size()) {
          heard(percept_.heard[entry.item]);
        }
        break;
      case PerceptKind::Gyro:
        text_ += "(GYR (n torso) (rt";
        triple(serverFromRobotAxes(percept_.gyro).unaryExpr([](double rate) { return toDegrees(rate); }));
        text_ += "))";
        break;
      case PerceptKind::Accelerometer:
        text_ += "(ACC (n torso) (a";
        triple(serverFromRobotAxes(percept_.accelerometer));
        text_ += "))";
        break;
      case PerceptKind::Joint:
        text_ += "(HJ (n ";
        text_ += model::perceptorName(model::jointAt(entry.item));
        text_ += ") (ax ";
        appendTwoDecimals(text_, toDegrees(percept_.joints[entry.item]));
        text_ += "))";
        break;
      case PerceptKind::See:
        if (percept_.vision) {
          vision(*percept_.vision);
        }
        break;
      case PerceptKind::Force:
        force(static_cast<ForceSensor>(entry.item));
        break;
    }
  }

  // " X Y Z"
  void triple(const Vector3& value) {
    for (const double component : value) {
      text_ += ' ';
      appendTwoDecimals(text_, component);
    }
  }

  // " (NAME VALUE)"
  void integerItem(std::string_view name, std::optional<int> value) {
    if (value) {
      text_ += " (";
      text_ += name;
      text_ += ' ';
      appendInteger(text_, *value);
      text_ += ')';
    }
  }

  void gameState(const GameStatus& game) {
    text_ += "(GS";
    integerItem("unum", game.unum);
    if (game.side) {
      text_ += *game.side == TeamSide::Left ? " (team left)" : " (team right)";
    }
    integerItem("sl", game.scoreLeft);
    integerItem("sr", game.scoreRight);
    text_ += " (t ";
    appendTwoDecimals(text_, game.time);
    text_ += ')';
    const bool known = game.playMode != PlayMode::Unknown;
    if (known || !game.playModeText.empty()) {
      text_ += " (pm ";
      text_ += known ? playModeName(game.playMode) : game.playModeText.view();
      text_ += ')';
    }
    text_ += ')';
  }

  void heard(const Heard& heard) {
    text_ += "(hear ";
    if (!heard.team.empty()) {
      text_ += heard.team.view();
      text_ += ' ';
    }
    appendTwoDecimals(text_, heard.time);
    text_ += ' ';
    if (heard.self) {
      text_ += "self";
    } else {
      appendTwoDecimals(text_, toDegrees(heard.direction));
    }
    text_ += ' ';
    text_ += heard.message.view();
    text_ += ')';
  }

  void force(ForceSensor sensor) {
    const auto& force = percept_.forces[static_cast<std::size_t>(sensor)];
    if (!force) {
      return;
    }
    constexpr std::array<std::string_view, kForceSensorCount> kNames = {"rf", "lf", "rf1", "lf1"};
    text_ += "(FRP (n ";
    text_ += kNames[static_cast<std::size_t>(sensor)];
    text_ += ") (c";
    triple(serverFromRobotAxes(force->center));
    text_ += ") (f";
    triple(serverFromRobotAxes(force->force));
    text_ += "))";
  }

  void polar(const Polar& polar) {
    text_ += "(pol ";
    appendTwoDecimals(text_, polar.distance);
    text_ += ' ';
    appendTwoDecimals(text_, toDegrees(polar.azimuth));
    text_ += ' ';
    appendTwoDecimals(text_, toDegrees(polar.elevation));
    text_ += ')';
  }

  void namedPolar(std::string_view name, const Polar& at) {
    text_ += '(';
    text_ += name;
    text_ += ' ';
    polar(at);
    text_ += ')';
  }

  void vision(const Vision& vision) {
    std::size_t landmark = 0;
    std::size_t player = 0;
    std::size_t line = 0;
    text_ += "(See";
    for (const SeenKind kind : vision.order) {
      text_ += ' ';
      switch (kind) {
        case SeenKind::Landmark: {
          const SeenLandmark& seen = vision.landmarks[landmark++];
          namedPolar(landmarkName(seen.id), seen.at);
          break;
        }
        case SeenKind::Player:
          seenPlayer(vision.players[player++]);
          break;
        case SeenKind::Line: {
          const SeenLine& seen = vision.lines[line++];
          text_ += "(L ";
          polar(seen.begin);
          text_ += ' ';
          polar(seen.end);
          text_ += ')';
          break;
        }
        default:
          single(kind, vision);
      }
    }
    text_ += vision.order.empty() ? " )" : ")";  // an empty view has a blank (server facts 1.6)
  }

  // What a view holds at most once.
  void single(SeenKind kind, const Vision& vision) {
    if (kind == SeenKind::Ball) {
      namedPolar("B", vision.ball.value_or(Polar{}));
    } else if (kind == SeenKind::MyOrientation) {
      text_ += "(myorien ";
      appendTwoDecimals(text_, toDegrees(vision.trueHeading.value_or(0.0)));
      text_ += ')';
    } else {
      const bool mine = kind == SeenKind::MyPosition;
      text_ += mine ? "(mypos" : "(ballpos";
      triple((mine ? vision.truePosition : vision.trueBallPosition).value_or(Vector3::Zero()));
      text_ += ')';
    }
  }

  void seenPlayer(const SeenPlayer& player) {
    text_ += "(P (team ";
    text_ += player.team.view();
    text_ += ") (id ";
    appendInteger(text_, player.unum);
    text_ += ')';
    for (std::size_t i = 0; i < kBodyPartCount; ++i) {
      if (player.parts[i]) {
        text_ += ' ';
        namedPolar(bodyPartName(static_cast<BodyPart>(i)), *player.parts[i]);
      }
    }
    text_ += ')';
  }

  const Percept& percept_;
  std::string& text_;
};

}  // namespace

void writePercept(const Percept& percept, std::string& text) {
  text.clear();
  PerceptWriter(percept, text).run();
}

}  // namespace nonet::protocol
