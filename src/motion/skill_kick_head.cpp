#include "skill_kick_head.h"

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

}  // namespace

KickHead readKickHead(SkillReader& reader) {
  KickHead head;
  reader.expect("{");
  while (!reader.accept("}")) {
    if (reader.accept("ball")) {
      head.p_RBall = reader.pair(Unit::Metre);
      if (reader.accept("within")) head.tolerance = reader.pair(Unit::Metre);
    } else if (reader.accept("direction")) {
      head.direction = reader.value(Unit::Radian);
      if (reader.accept("within")) head.turn = reader.value(Unit::Radian);
    } else if (reader.accept("distance")) {
      head.shortest = reader.positive(Unit::Metre);
      reader.expect("..");
      head.longest = reader.positive(Unit::Metre);
      if (head.longest < head.shortest) reader.fail("the distances are the wrong way round");
    } else if (reader.accept("flies")) {
      head.rises = reader.positive(Unit::Metre);
      reader.expect("..");
      head.falls = reader.positive(Unit::Metre);
      if (head.falls < head.rises) reader.fail("the begin and the end of the flight are the wrong way round");
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
          fmt::format("'{}' does not belong into the head of a kick (ball direction distance flies contact "
                      "room from types)",
                      reader.peek().text));
    }
  }
  if (head.p_RBall.isZero() || head.longest == 0.0 || head.contact == 0.0) {
    reader.fail("the head of a kick needs at least 'ball', 'distance' and 'contact'");
  }
  return head;
}

}  // namespace nonet::motion
