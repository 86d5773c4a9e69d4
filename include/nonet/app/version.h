// Which program this is.
#pragma once

#include <string>

namespace nonet::app {

/// "nonet 0.1.0, commit 8cdcba0e1"; "+changes" behind it if the sources had changes since.
std::string versionText();

}  // namespace nonet::app
