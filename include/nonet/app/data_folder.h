// Where the program finds params/ and skills/, and what its pages need.
#pragma once

#include <string>

namespace nonet::app {

/// The folder with params/ and skills/: `given` (--data) if not empty, otherwise NONET_DATA if set, otherwise
/// found from the executable (findData()). Throws std::runtime_error that says what is missing and where it
/// was looked for: without its data an agent would play on, crippled.
std::string dataFolder(const std::string& given = {});

/// The nearest folder above `executable` that holds params/ and skills/ itself (a source tree, an unpacked
/// archive) or in share/nonet (an installation); otherwise `sourceFolder` if it does. Throws
/// std::runtime_error.
std::string findData(const std::string& executable, const std::string& sourceFolder);

/// The folder of three.js, which the viewer's page needs: that of an installation, share/nonet/three beside
/// the folder of `executable`, otherwise `systemFolder`.
std::string findThree(const std::string& executable, const std::string& systemFolder);

/// Path of the running executable.
std::string executablePath();

}  // namespace nonet::app
