// Folders of results: made where they are missing, and held by one process at a time.
#pragma once

#include <memory>
#include <string>

namespace nonet::lab {

/// Makes the folder and those above it that are missing. Throws std::runtime_error that names it: a file is
/// in the way, or it cannot be written there.
void makeFolder(const std::string& folder);

/// Held until the last copy goes or the process ends, however it ends. Throws std::runtime_error: the folder
/// cannot be written, or another process holds it.
std::shared_ptr<void> lockFolder(const std::string& folder);

}  // namespace nonet::lab
