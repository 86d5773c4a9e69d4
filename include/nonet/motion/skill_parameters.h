// The parameters of all skills as a group of declared parameters, so that files in params/ overlay them like
// any other
// ("motion.skills.<skill>.<parameter>") and the optimizer sees their ranges.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nonet/config/parameters.h"

namespace nonet::motion {

/// Empty until declareSkillParameters() has read the skill files.
struct SkillParameters {
  struct Name {
    std::string skill;
    std::string parameter;
    config::Unit unit = config::Unit::None;
    config::Range range;
    std::optional<config::Range> searchRange;
  };
  // Shared between copies: declarations refer to these texts.
  std::shared_ptr<const std::vector<Name>> names = std::make_shared<std::vector<Name>>();
  std::vector<double> values;  // one per name

  std::optional<double> find(std::string_view skill, std::string_view parameter) const;
  /// values.size() if there is none. It is searched for from `first` on, then before that.
  std::size_t indexOf(std::string_view skill, std::string_view parameter, std::size_t first = 0) const;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    for (std::size_t i = 0; i < self.values.size(); ++i) {
      auto group = One<decltype(self.values[i])>{(*self.names)[i], self.values[i]};
      visit.group((*self.names)[i].skill, group);
    }
  }

 private:
  template <class Reference>
  struct One {
    const Name& name;
    Reference value;
    template <class Self, class Visitor>
    static void describe(Self& self, Visitor&& visit) {
      visit({self.name.parameter, self.name.unit, self.name.range, self.name.searchRange,
             ""},  // the skill file says what it is
            self.value);
    }
  };
};

/// Reads skillFolder/*.skl and declares their parameters with the defaults of the files. Throws SkillError.
SkillParameters declareSkillParameters(const std::string& skillFolder);

}  // namespace nonet::motion
