#include "skill_condition.h"

#include <array>
#include <string_view>

#include <fmt/format.h>

namespace nonet::motion {

namespace {

using config::Unit;
using model::Side;

class ConditionReader {
 public:
  ConditionReader(SkillReader& reader, std::vector<ConditionNode>& nodes) : reader_(reader), nodes_(nodes) {}

  int condition() {
    int left = conjunction();
    while (reader_.accept("or")) {
      const int right = conjunction();
      left = add({ConditionNode::Kind::Or, left, right});
    }
    return left;
  }

 private:
  int add(const ConditionNode& node) {
    nodes_.push_back(node);
    return static_cast<int>(nodes_.size()) - 1;
  }
  int conjunction() {
    int left = term();
    while (reader_.accept("and")) {
      const int right = term();
      left = add({ConditionNode::Kind::And, left, right});
    }
    return left;
  }
  int term() {
    using Node = ConditionNode::Kind;
    if (reader_.accept("not")) {
      reader_.enter();
      const int inner = term();
      reader_.leave();
      return add({Node::Not, inner});
    }
    if (reader_.accept("upright")) return add({Node::Upright});
    if (reader_.accept("contact"))
      return add({reader_.side() == Side::Left ? Node::ContactLeft : Node::ContactRight});
    if (reader_.accept("fallen")) {
      if (reader_.accept("front")) return add({Node::FallenFront});
      if (reader_.accept("back")) return add({Node::FallenBack});
      if (reader_.accept("left")) return add({Node::FallenLeft});
      if (reader_.accept("right")) return add({Node::FallenRight});
      return add({Node::Fallen});
    }
    return comparison();
  }
  int comparison() {
    struct QuantityWord {
      std::string_view name;
      Quantity quantity;
      Unit unit;
    };
    static constexpr std::array<QuantityWord, 8> kQuantities{
        {{"time", Quantity::Time, Unit::Second},
         {"pitch", Quantity::Pitch, Unit::Radian},
         {"roll", Quantity::Roll, Unit::Radian},
         {"rate", Quantity::Rate, Unit::RadianPerSecond},
         {"height", Quantity::Height, Unit::Metre},
         {"ballDistance", Quantity::BallDistance, Unit::Metre},
         {"ballX", Quantity::BallX, Unit::Metre},
         {"ballY", Quantity::BallY, Unit::Metre}}};
    for (const QuantityWord& quantity : kQuantities) {
      if (!reader_.accept(quantity.name)) continue;
      ConditionNode node;
      node.quantity = quantity.quantity;
      if (reader_.accept("<")) {
        node.kind = ConditionNode::Kind::Less;
      } else {
        reader_.expect(">");
        node.kind = ConditionNode::Kind::Greater;
      }
      node.value = reader_.value(quantity.unit);
      return add(node);
    }
    reader_.fail(
        fmt::format("'{}' is no condition (upright fallen contact time pitch roll rate height ballDistance "
                    "ballX ballY, or one behind not)",
                    reader_.peek().text));
  }

  SkillReader& reader_;
  std::vector<ConditionNode>& nodes_;
};

}  // namespace

int readCondition(SkillReader& reader, std::vector<ConditionNode>& nodes) {
  return ConditionReader(reader, nodes).condition();
}

}  // namespace nonet::motion
