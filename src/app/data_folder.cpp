#include "nonet/app/data_folder.h"

#include <cstdlib>
#include <filesystem>

namespace nonet::app {

namespace fs = std::filesystem;

std::string executablePath() {
  std::error_code error;
  const fs::path path = fs::read_symlink("/proc/self/exe", error);
  return error ? std::string() : path.string();
}

std::string dataFolder() {
  if (const char* given = std::getenv("NONET_DATA")) return given;  // NOLINT(concurrency-mt-unsafe)
  std::error_code error;
  for (fs::path folder = fs::path(executablePath()).parent_path(); folder.has_relative_path();
       folder = folder.parent_path()) {
    if (fs::is_directory(folder / "skills", error)) {
      return folder.string();
    }
  }
  return NONET_SOURCE_DIR;
}

}  // namespace nonet::app
