#include "nonet/lab/common/atomic_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

namespace nonet::lab {

void writeAtomically(const std::string& path, const std::string& text) {
  namespace fs = std::filesystem;
  std::error_code unknown;
  const fs::path real = fs::is_symlink(path, unknown) ? fs::weakly_canonical(path, unknown) : fs::path(path);
  // A pipe or a device cannot be exchanged for another file.
  const bool special =
      fs::exists(real, unknown) && !fs::is_regular_file(real, unknown) && !fs::is_directory(real, unknown);
  const std::string fresh = special ? real.string() : real.string() + ".new";
  const fs::path folder = real.parent_path();
  if (!folder.empty()) fs::create_directories(folder, unknown);  // an error shows when the file is opened
  if (fs::is_directory(path, unknown))
    throw std::runtime_error(fmt::format("cannot write {}: it is a folder, give the name of a file", path));
  {
    errno = 0;
    std::ofstream file(fresh, std::ios::binary | std::ios::trunc);
    file << text;
    file.flush();
    if (!file) throw std::runtime_error(fmt::format("cannot write {}: {}", fresh, std::strerror(errno)));
  }
  if (!special) fs::rename(fresh, real);
}

}  // namespace nonet::lab
