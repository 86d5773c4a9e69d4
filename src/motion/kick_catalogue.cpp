#include "nonet/motion/kick_catalogue.h"

namespace nonet::motion {

using model::Side;

KickHead mirroredHead(const KickHead& head) {
  KickHead mirror = head;
  mirror.p_RBall.y() = -head.p_RBall.y();
  mirror.direction = -head.direction;
  return mirror;
}

KickCatalogue::KickCatalogue(const SkillLibrary& library, int robotType) {
  for (std::size_t i = 0; i < library.size(); ++i) {
    const Skill& skill = library.skill(static_cast<int>(i));
    if (!skill.kick || !skill.kick->serves(robotType)) continue;
    const int index = static_cast<int>(i);
    options_.push_back({index, skill.name, Side::Left, *skill.kick});
    options_.push_back({index, skill.name, Side::Right, mirroredHead(*skill.kick)});
  }
}

}  // namespace nonet::motion
