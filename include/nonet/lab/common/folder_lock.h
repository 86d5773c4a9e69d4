// One process at a time in a folder of results.
#pragma once

#include <memory>
#include <string>

namespace nonet::lab {

/// Held until the last copy goes or the process ends, however it ends. Throws std::runtime_error: the folder
/// cannot be written, or another process holds it.
std::shared_ptr<void> lockFolder(const std::string& folder);

}  // namespace nonet::lab
