// Where the program finds params/ and skills/, and what its pages need.
#pragma once

#include <string>

namespace nonet::app {

/// The folder with params/ and skills/: `given` (of `option`) if not empty, otherwise NONET_DATA if set,
/// otherwise found from the executable (agent::dataFolder()). Throws agent::DataError that says what is
/// missing and where it was looked for.
std::string dataFolder(const std::string& given = {}, const std::string& option = "--data");

/// The folder of three.js, which the viewer's page needs: that of an installation, share/nonet/three beside
/// the folder of `executable`, otherwise `systemFolder`.
std::string findThree(const std::string& executable, const std::string& systemFolder);

/// Path of the running executable.
std::string executablePath();

}  // namespace nonet::app
