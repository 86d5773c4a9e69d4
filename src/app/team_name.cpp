#include "nonet/app/team_name.h"

#include <stdexcept>

#include <fmt/format.h>

#include "nonet/protocol/effectors.h"
#include "nonet/protocol/percept.h"

namespace nonet::app {

void checkTeamName(const std::string& name) {
  protocol::TeamName fits;
  if (name.empty() || !fits.assign(name)) {
    throw std::runtime_error(fmt::format("team '{}': the name must have 1 to 64 letters", name));
  }
  if (!protocol::isTeamName(name) || name.find_first_of(";/") != std::string::npos) {
    throw std::runtime_error(
        fmt::format("team '{}': only ASCII letters without blanks, brackets, quotes, semicolons and slashes "
                    "can be in a name",
                    name));
  }
}

}  // namespace nonet::app
