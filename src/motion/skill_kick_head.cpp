#include "skill_kick_head.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "nonet/model/robot_model.h"

namespace nonet::motion {

namespace {

using config::Unit;

// "0 2 4" as a bit per type.
std::uint32_t readTypes(SkillReader& reader) {
  std::uint32_t mask = 0;
  while (reader.peek().kind == SkillToken::Kind::Number) {
    const double type = reader.peek().value;
    if (type < 0.0 || type >= model::kRobotTypeCount || type != static_cast<int>(type)) {
      reader.fail("a robot type is a number from 0 to 4");
    }
    reader.take();
    mask |= 1U << static_cast<int>(type);
  }
  if (mask == 0) reader.fail("'types' names at least one robot type");
  return mask;
}

// "flies 0m at 0m within 0m" for a ball that rolls: the numbers are parameters, which differ between types.
void readFlight(SkillReader& reader, KickHead& head) {
  head.apex = reader.value(Unit::Metre);
  reader.expect("at");
  head.apexAt = reader.value(Unit::Metre);
  reader.expect("within");
  head.apexSpread = reader.value(Unit::Metre);
  const bool rolls = head.apex == 0.0 && head.apexAt == 0.0;
  if (!rolls && (head.apex <= 0.0 || head.apexAt <= 0.0 || head.apexSpread <= 0.0))
    reader.fail("height, place and deviation of a flight must be more than zero");
}

}  // namespace

double KickHead::fliesBelow(double height, double distance) const {
  if (distance >= 2.0 * apexAt) return 1.0;
  const double off = distance / apexAt - 1.0;
  const double mean = apex * (1.0 - off * off);
  return 0.5 * std::erfc((mean - height) / (std::sqrt(2.0) * apexSpread));
}

KickInputs kickInputs(const KickAim& aim, const KickHead& head, bool mirrored) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  // m, m, rad, m/s, m/s. The distance has its bounds in the head.
  const KickInputs most = (KickInputs() << 0.08, 0.08, 0.5, 1.0, 1.0, kInfinity).finished();
  const double left = mirrored ? -1.0 : 1.0;
  KickInputs inputs;
  inputs << aim.ball.x() - head.p_RBall.x(), left * aim.ball.y() - head.p_RBall.y(), left * aim.turn,
      aim.pace.x(), left * aim.pace.y(), std::clamp(aim.distance, head.shortest, head.longest);
  return inputs.cwiseMax(-most).cwiseMin(most);
}

KickHead readKickHead(SkillReader& reader) {
  KickHead head;
  reader.expect("{");
  while (!reader.accept("}")) {
    if (reader.accept("ball")) {
      head.p_RBall = reader.pair(Unit::Metre);
      if (reader.accept("within")) head.tolerance = reader.pair(Unit::Metre);
      if (reader.accept("for")) head.steady = reader.positive(Unit::Second);
    } else if (reader.accept("direction")) {
      head.direction = reader.value(Unit::Radian);
      if (reader.accept("within")) head.turn = reader.value(Unit::Radian);
    } else if (reader.accept("distance")) {
      head.shortest = reader.positive(Unit::Metre);
      reader.expect("..");
      head.longest = reader.positive(Unit::Metre);
      if (head.longest < head.shortest) reader.fail("the distances are the wrong way round");
    } else if (reader.accept("flies")) {
      readFlight(reader, head);
    } else if (reader.accept("clears")) {
      head.clears = reader.positive(Unit::Metre);
      reader.expect("within");
      head.lands = reader.positive(Unit::Metre);
    } else if (reader.accept("low")) {
      head.low = reader.positive(Unit::Metre);
    } else if (reader.accept("contact")) {
      head.contact = reader.positive(Unit::Second);
    } else if (reader.accept("room")) {
      head.room = reader.value(Unit::Metre);
    } else if (reader.accept("from")) {
      head.fromWalk = reader.accept("walk");
      if (!head.fromWalk) reader.expect("stand");
    } else if (reader.accept("types")) {
      head.types = readTypes(reader);
    } else {
      reader.fail(
          fmt::format("'{}' does not belong into the head of a kick (ball direction distance flies clears "
                      "low contact room from types)",
                      reader.peek().text));
    }
  }
  if (head.p_RBall.isZero() || head.longest == 0.0 || head.contact == 0.0) {
    reader.fail("the head of a kick needs at least 'ball', 'distance' and 'contact'");
  }
  return head;
}

}  // namespace nonet::motion
