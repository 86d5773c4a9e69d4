// Files that readers may open at any time.
#pragma once

#include <string>

namespace nonet::lab {

/// Writes the whole text to a new file beside `path`, then renames it: readers see the old or the new one.
/// Makes the folder if there is none; keeps the rights of the file that was there. Throws std::runtime_error
/// that names the file if it cannot be written; what was there then stays, and nothing beside it.
void writeAtomically(const std::string& path, const std::string& text);

}  // namespace nonet::lab
