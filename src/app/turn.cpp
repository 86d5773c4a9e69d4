#include "nonet/app/turn.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

namespace nonet::app {

Turn::Turn(const std::string& host, int port) {
  std::string name = fmt::format("nonet-{}-{}-{}.lock", ::getuid(), host, port);
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '.'; },
      '_');
  std::error_code error;
  const auto folder = std::filesystem::temp_directory_path(error);
  if (error) return;
  file_ = ::open((folder / name).c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
}

Turn::~Turn() {
  if (file_ >= 0) ::close(file_);
}

bool Turn::take() {
  return file_ < 0 || ::flock(file_, LOCK_EX | LOCK_NB) == 0;
}

void Turn::release() {
  if (file_ >= 0) ::flock(file_, LOCK_UN);
}

}  // namespace nonet::app
