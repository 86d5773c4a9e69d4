#include <cstdint>
#include <limits>
#include <string_view>

#include "nonet/protocol/percept_text.h"
#include "nonet/protocol/rounding.h"
#include "nonet/protocol/server_axes.h"
#include "nonet/protocol/sexpr_reader.h"

namespace nonet::protocol {
namespace {

constexpr int kLastUnum = 11;  // what follows on the own number indexes tables by it

bool polarItem(SexprReader& reader, Polar& polar) {
  std::array<double, 3> values;
  if (!reader.numberList("pol", values)) {
    return false;
  }
  polar = {values[0], degreesFromWire(values[1]), degreesFromWire(values[2])};
  return true;
}

// "(NAME X Y Z)"
template <std::size_t kSize>
bool vectorItem(SexprReader& reader, const char (&name)[kSize], Vector3& vector) {
  std::array<double, 3> values;
  if (!reader.numberList(name, values)) {
    return false;
  }
  vector = Vector3(values[0], values[1], values[2]);
  return true;
}

bool triple(SexprReader& reader, Vector3& value) {
  return reader.number(value.x()) && reader.number(value.y()) && reader.number(value.z());
}

bool landmarkFromName(std::string_view name, Landmark& landmark) {
  if (name.size() != 3 || (name[0] != 'F' && name[0] != 'G') || (name[1] != '1' && name[1] != '2') ||
      (name[2] != 'L' && name[2] != 'R')) {
    return false;
  }
  landmark = static_cast<Landmark>((name[0] == 'G' ? 4 : 0) + (name[2] == 'R' ? 2 : 0) + (name[1] - '1'));
  return true;
}

bool bodyPartFromName(std::string_view name, std::size_t& part) {
  const auto found = [&](BodyPart which) {
    part = static_cast<std::size_t>(which);
    return true;
  };
  const bool right = !name.empty() && name[0] == 'r';
  if (name == "head") return found(BodyPart::Head);
  if (!right && (name.empty() || name[0] != 'l')) return false;
  name.remove_prefix(1);
  if (name == "lowerarm") return found(right ? BodyPart::RLowerArm : BodyPart::LLowerArm);
  if (name == "foot") return found(right ? BodyPart::RFoot : BodyPart::LFoot);
  return false;
}

bool forceSensorFromName(std::string_view name, ForceSensor& sensor) {
  const bool toe = name.size() == 3 && name[2] == '1';
  if ((name.size() != 2 && !toe) || name[1] != 'f' || (name[0] != 'r' && name[0] != 'l')) {
    return false;
  }
  const bool right = name[0] == 'r';
  if (toe) {
    sensor = right ? ForceSensor::RToe : ForceSensor::LToe;
  } else {
    sensor = right ? ForceSensor::RFoot : ForceSensor::LFoot;
  }
  return true;
}

// Every method below reads the rest of a list whose name has been read, including its closing bracket, and
// returns false at the first thing that it does not understand. Nothing is stored then; the caller counts
// it and goes on behind the list.
class PerceptParser {
 public:
  PerceptParser(std::string_view text, Percept& percept) : reader_(text), percept_(percept) {}

  void run() {
    while (!reader_.atEnd()) {
      if (!reader_.open()) {
        reader_.skipOne();
        ++percept_.unknownTokens;
        continue;
      }
      if (!predicate() || reader_.depth() != 0) {
        ++percept_.unknownTokens;
        reader_.leaveTo(0);
      }
    }
  }

 private:
  // Calls `item` behind each opening bracket until the list that is open now is closed. Items that fail are
  // counted and skipped.
  template <typename Item>
  bool forEachItem(Item item) {
    const int depth = reader_.depth();
    for (;;) {
      if (reader_.open()) {
        if (!item() || reader_.depth() != depth) {
          ++percept_.unknownTokens;
          if (!reader_.leaveTo(depth)) {
            return false;
          }
        }
      } else if (reader_.close()) {
        return true;
      } else if (!reader_.skipOne()) {
        return false;
      } else {
        ++percept_.unknownTokens;
      }
    }
  }

  bool predicate() {
    std::string_view name;
    if (!reader_.atom(name)) {
      return false;
    }
    if (name == "HJ") return hingeJoint();
    if (name == "See") return see();
    if (name == "time") return time();
    if (name == "GS") return gameState();
    if (name == "GYR") return gyro();
    if (name == "ACC") return accelerometer();
    if (name == "FRP") return force();
    if (name == "hear") return hear();
    return false;
  }

  void note(PerceptKind kind, std::size_t item = 0) {
    percept_.order.push_back({kind, static_cast<std::uint8_t>(item)});
  }

  // "(n NAME)"
  bool nodeName(std::string_view& name) {
    return reader_.openNamed("n") && reader_.atom(name) && reader_.close();
  }

  bool time() {
    std::array<double, 1> now;
    if (!reader_.numberList("now", now) || !reader_.close()) {
      return false;
    }
    percept_.time = now[0];
    note(PerceptKind::Time);
    return true;
  }

  bool hingeJoint() {
    std::string_view name;
    std::array<double, 1> angle;
    if (!nodeName(name) || !reader_.numberList("ax", angle) || !reader_.close()) {
      return false;
    }
    const auto joint = model::jointFromPerceptorName(name);
    if (!joint) {
      return false;
    }
    const std::size_t i = model::index(*joint);
    percept_.joints[i] = degreesFromWire(angle[0]);
    percept_.jointsPresent |= 1U << i;
    note(PerceptKind::Joint, i);
    return true;
  }

  bool gyro() {
    std::string_view name;
    Vector3 rate;
    if (!nodeName(name) || name != "torso" || !vectorItem(reader_, "rt", rate) || !reader_.close()) {
      return false;
    }
    for (double& component : rate) {
      component = degreesFromWire(component);
    }
    percept_.gyro = robotFromServerAxes(rate);
    note(PerceptKind::Gyro);
    return true;
  }

  bool accelerometer() {
    std::string_view name;
    Vector3 acceleration;
    if (!nodeName(name) || name != "torso" || !vectorItem(reader_, "a", acceleration) || !reader_.close()) {
      return false;
    }
    percept_.accelerometer = robotFromServerAxes(acceleration);
    note(PerceptKind::Accelerometer);
    return true;
  }

  bool force() {
    std::string_view name;
    ForceSensor sensor{};
    Vector3 center;
    Vector3 force;
    if (!nodeName(name) || !forceSensorFromName(name, sensor) || !vectorItem(reader_, "c", center) ||
        !vectorItem(reader_, "f", force) || !reader_.close()) {
      return false;
    }
    const auto i = static_cast<std::size_t>(sensor);
    percept_.forces[i] = FootForce{robotFromServerAxes(center), robotFromServerAxes(force)};
    note(PerceptKind::Force, i);
    return true;
  }

  bool gameState() {
    GameStatus& game = percept_.game;
    const bool closed = forEachItem([&] {
      std::string_view name;
      std::string_view text;
      int number = 0;
      if (!reader_.atom(name)) return false;
      if (name == "t") return reader_.number(game.time) && reader_.close();
      if (name == "pm") {
        if (!reader_.atom(text) || !reader_.close()) return false;
        const auto mode = playModeFromName(text);
        game.playMode = mode.value_or(PlayMode::Unknown);
        return game.playModeText.assign(text) && mode.has_value();
      }
      if (name == "team") {
        if (!reader_.atom(text) || !reader_.close() || (text != "left" && text != "right")) return false;
        game.side = text == "left" ? TeamSide::Left : TeamSide::Right;
        return true;
      }
      if (!reader_.integer(number) || !reader_.close()) return false;
      if (name == "sl") return game.scoreLeft = number, true;
      if (name == "sr") return game.scoreRight = number, true;
      if (name != "unum" || number < 1 || number > kLastUnum) return false;
      game.unum = number;
      return true;
    });
    note(PerceptKind::GameState);
    return closed;
  }

  // "[TEAM] TIME self|DIRECTION MESSAGE": a labelled message has one value more.
  bool hear() {
    std::array<std::string_view, 4> values;
    std::size_t count = 0;
    while (count < values.size() && reader_.atom(values[count])) {
      ++count;
    }
    if (count < 3 || !reader_.close() || percept_.heard.size() > std::numeric_limits<std::uint8_t>::max()) {
      return false;
    }
    const std::size_t first = count - 3;  // of the values that are always there
    Heard heard;
    double direction = 0.0;
    heard.self = values[first + 1] == "self";
    if (!SexprReader(values[first]).number(heard.time) ||
        (!heard.self && !SexprReader(values[first + 1]).number(direction)) ||
        !heard.message.assign(values[first + 2]) || (count == 4 && !heard.team.assign(values[0]))) {
      return false;
    }
    heard.direction = degreesFromWire(direction);
    percept_.heard.push_back(heard);
    note(PerceptKind::Hear, percept_.heard.size() - 1);
    return true;
  }

  bool see() {
    if (percept_.vision) {
      return false;  // a second robot on the same connection
    }
    Vision& vision = percept_.beginVision();
    note(PerceptKind::See);
    return forEachItem([&] { return seenItem(vision); });
  }

  bool seenItem(Vision& vision) {
    std::string_view name;
    if (!reader_.atom(name)) return false;
    if (name == "L") return line(vision);
    if (name == "P") return player(vision);
    if (name == "B") return ball(vision);
    SeenLandmark landmark;
    if (landmarkFromName(name, landmark.id)) {
      if (!polarItem(reader_, landmark.at) || !reader_.close()) return false;
      vision.landmarks.push_back(landmark);
      vision.order.push_back(SeenKind::Landmark);
      return true;
    }
    return truth(name, vision);
  }

  bool ball(Vision& vision) {
    Polar at;
    if (vision.ball || !polarItem(reader_, at) || !reader_.close()) return false;
    vision.ball = at;
    vision.order.push_back(SeenKind::Ball);
    return true;
  }

  bool line(Vision& vision) {
    SeenLine line;
    if (!polarItem(reader_, line.begin) || !polarItem(reader_, line.end) || !reader_.close()) return false;
    vision.lines.push_back(line);
    vision.order.push_back(SeenKind::Line);
    return true;
  }

  bool player(Vision& vision) {
    std::string_view team;
    int unum = 0;
    if (!reader_.openNamed("team") || !reader_.atom(team) || !reader_.close() || !reader_.openNamed("id") ||
        !reader_.integer(unum) || !reader_.close()) {
      return false;
    }
    SeenPlayer& player = vision.players.emplace_back();
    player.unum = unum;
    const bool wholeName = player.team.assign(team);
    vision.order.push_back(SeenKind::Player);
    return forEachItem([&] {
             std::string_view name;
             Polar at;
             std::size_t part = 0;
             if (!reader_.atom(name) || !bodyPartFromName(name, part) || player.parts[part] ||
                 !polarItem(reader_, at) || !reader_.close()) {
               return false;
             }
             player.parts[part] = at;
             return true;
           }) &&
           wholeName;
  }

  bool truth(std::string_view name, Vision& vision) {
    Vector3 position;
    if (name == "mypos" && !vision.truePosition) {
      if (!triple(reader_, position) || !reader_.close()) return false;
      vision.truePosition = position;
      vision.order.push_back(SeenKind::MyPosition);
      return true;
    }
    if (name == "ballpos" && !vision.trueBallPosition) {
      if (!triple(reader_, position) || !reader_.close()) return false;
      vision.trueBallPosition = position;
      vision.order.push_back(SeenKind::BallPosition);
      return true;
    }
    double heading = 0.0;
    if (name != "myorien" || vision.trueHeading || !reader_.number(heading) || !reader_.close()) return false;
    vision.trueHeading = degreesFromWire(heading);
    vision.order.push_back(SeenKind::MyOrientation);
    return true;
  }

  SexprReader reader_;
  Percept& percept_;
};

}  // namespace

void parsePercept(std::string_view text, Percept& percept) {
  percept.clear();
  PerceptParser(text, percept).run();
}

}  // namespace nonet::protocol
