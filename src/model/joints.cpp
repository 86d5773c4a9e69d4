#include "nonet/model/joints.h"

namespace nonet::model {
namespace {

constexpr std::array<std::string_view, kJointCount> kPerceptorNames = {
    "hj1",  "hj2",  "raj1", "raj2", "raj3", "raj4", "laj1", "laj2", "laj3", "laj4", "rlj1", "rlj2",
    "rlj3", "rlj4", "rlj5", "rlj6", "rlj7", "llj1", "llj2", "llj3", "llj4", "llj5", "llj6", "llj7"};
constexpr std::array<std::string_view, kJointCount> kEffectorNames = {
    "he1",  "he2",  "rae1", "rae2", "rae3", "rae4", "lae1", "lae2", "lae3", "lae4", "rle1", "rle2",
    "rle3", "rle4", "rle5", "rle6", "rle7", "lle1", "lle2", "lle3", "lle4", "lle5", "lle6", "lle7"};
constexpr std::array<std::string_view, kBodyCount> kBodyNames = {
    "torso",     "neck",      "head",   "rshoulder", "rupperarm", "relbow", "rlowerarm",
    "lshoulder", "lupperarm", "lelbow", "llowerarm", "rhip1",     "rhip2",  "rthigh",
    "rshank",    "rankle",    "rfoot",  "rtoe",      "lhip1",     "lhip2",  "lthigh",
    "lshank",    "lankle",    "lfoot",  "ltoe"};

// The reader needs no hash table and no comparison with 24 strings: a name is "<limb><j|e><digit>", its limb
// tells where the joints of that limb begin in message order, and its digit which of them it is.
std::optional<JointId> jointFromName(std::string_view name, char kind) {
  if (name.size() == 3) {  // head
    if (name[0] != 'h' || name[1] != kind || name[2] < '1' || name[2] > '2') {
      return std::nullopt;
    }
    return jointAt(static_cast<std::size_t>(name[2] - '1'));
  }
  if (name.size() != 4 || name[2] != kind) {
    return std::nullopt;
  }
  const bool right = name[0] == 'r';
  if (!right && name[0] != 'l') {
    return std::nullopt;
  }
  const int number = name[3] - '1';
  if (name[1] == 'a' && number >= 0 && number < 4) {
    return jointAt(index(right ? JointId::RArm1 : JointId::LArm1) + static_cast<std::size_t>(number));
  }
  if (name[1] == 'l' && number >= 0 && number < 7) {
    return jointAt(index(right ? JointId::RLeg1 : JointId::LLeg1) + static_cast<std::size_t>(number));
  }
  return std::nullopt;
}

}  // namespace

std::string_view perceptorName(JointId id) {
  return kPerceptorNames[index(id)];
}

std::string_view effectorName(JointId id) {
  return kEffectorNames[index(id)];
}

std::optional<JointId> jointFromPerceptorName(std::string_view name) {
  return jointFromName(name, 'j');
}

std::optional<JointId> jointFromEffectorName(std::string_view name) {
  return jointFromName(name, 'e');
}

JointId mirrored(JointId id) {
  constexpr std::size_t kArmJoints = 4;
  constexpr std::size_t kLegJoints = 7;
  if (id >= JointId::LLeg1) {
    return jointAt(index(id) - kLegJoints);
  }
  if (id >= JointId::RLeg1) {
    return jointAt(index(id) + kLegJoints);
  }
  if (id >= JointId::LArm1) {
    return jointAt(index(id) - kArmJoints);
  }
  if (id >= JointId::RArm1) {
    return jointAt(index(id) + kArmJoints);
  }
  return id;
}

std::string_view bodyName(BodyId id) {
  return kBodyNames[index(id)];
}

}  // namespace nonet::model
