#include "nonet/lab/common/atomic_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

namespace nonet::lab {

void writeAtomically(const std::string& path, const std::string& text) {
  const std::string fresh = path + ".new";
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::error_code ignored;  // shows when the file is opened
  if (!folder.empty()) std::filesystem::create_directories(folder, ignored);
  if (std::filesystem::is_directory(path, ignored))
    throw std::runtime_error(fmt::format("cannot write {}: it is a folder, give the name of a file", path));
  {
    errno = 0;
    std::ofstream file(fresh, std::ios::binary | std::ios::trunc);
    file << text;
    file.flush();
    if (!file) throw std::runtime_error(fmt::format("cannot write {}: {}", fresh, std::strerror(errno)));
  }
  std::filesystem::rename(fresh, path);
}

}  // namespace nonet::lab
