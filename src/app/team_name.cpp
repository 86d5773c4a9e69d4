#include "nonet/app/team_name.h"

#include <stdexcept>

#include <fmt/format.h>

#include "nonet/protocol/percept.h"

namespace nonet::app {

void checkTeamName(const std::string& name) {
  protocol::TeamName fits;
  if (name.empty() || !fits.assign(name)) {
    throw std::runtime_error(fmt::format("team '{}': the name must have 1 to 64 letters", name));
  }
  for (const char letter : name) {
    const bool plain = letter > ' ' && letter < '\x7f';  // bytes beyond ASCII are negative or larger
    if (plain && std::string_view("()\";/").find(letter) == std::string_view::npos) continue;
    throw std::runtime_error(
        fmt::format("team '{}': only ASCII letters without blanks, brackets, quotes, semicolons and slashes "
                    "can be in a name",
                    name));
  }
}

}  // namespace nonet::app
