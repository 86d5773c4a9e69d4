// Words of a shell's command line.
#pragma once

#include <string>

namespace nonet::app {

/// One word for a POSIX shell, whatever is in the text.
std::string quoted(const std::string& text);
/// The same as a user would type it: in quotes only where it must be.
std::string shellWord(const std::string& text);

}  // namespace nonet::app
