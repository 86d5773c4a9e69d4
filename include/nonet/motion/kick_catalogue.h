// The kicks that this robot can do: every skill with a head (skill.h, KickHead) that serves its type, once
// for each foot. A new kick is a new file in skills/; nobody names one.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "nonet/model/joints.h"
#include "nonet/motion/skill_library.h"

namespace nonet::motion {

/// A kick with one foot. Everything is as that foot does it: for the right foot the head is mirrored.
struct KickOption {
  int skill = -1;         // in the library
  std::string_view name;  // of the skill; lives as long as the catalogue
  model::Side foot = model::Side::Left;
  KickHead head;
};

class KickCatalogue {
 public:
  /// The library must outlive it.
  KickCatalogue(const SkillLibrary& library, int robotType);

  /// The two feet of a kick stand next to each other, the left one first.
  std::span<const KickOption> options() const { return options_; }

 private:
  std::vector<KickOption> options_;
};

/// The head as the other foot does it.
KickHead mirroredHead(const KickHead& head);

}  // namespace nonet::motion
