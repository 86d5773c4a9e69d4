#include "nonet/lab/common/folder_lock.h"

#include <filesystem>
#include <stdexcept>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

namespace nonet::lab {

void makeFolder(const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code trouble;
  fs::create_directories(folder, trouble);
  if (!trouble) return;
  std::error_code unknown;
  for (fs::path above = folder; !above.empty() && above != above.parent_path(); above = above.parent_path()) {
    if (fs::exists(above, unknown) && !fs::is_directory(above, unknown))
      throw std::runtime_error(
          fmt::format("cannot make the folder {}: {} is a file: name a folder", folder, above.string()));
  }
  throw std::runtime_error(fmt::format("cannot make the folder {}: {}", folder, trouble.message()));
}

std::shared_ptr<void> lockFolder(const std::string& folder) {
  const std::string path = folder + "/lock";
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file < 0) throw std::runtime_error(fmt::format("cannot write {}", path));
  if (::flock(file, LOCK_EX | LOCK_NB) != 0) {
    ::close(file);
    throw std::runtime_error(
        fmt::format("another process works on {}: wait for its end or stop it first", folder));
  }
  return {nullptr, [file](void*) { ::close(file); }};
}

}  // namespace nonet::lab
