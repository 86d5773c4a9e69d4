// Where the program finds params/ and skills/.
#pragma once

#include <string>

namespace nonet::app {

/// NONET_DATA if set, otherwise the folder above the executable that holds skills/, otherwise the source tree
/// the program was built from.
std::string dataFolder();

/// Path of the running executable.
std::string executablePath();

}  // namespace nonet::app
