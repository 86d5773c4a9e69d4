#include "nonet/app/turn.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

namespace nonet::app {

namespace {

// The addresses that mean this machine itself: 127.x.x.x, ::1, ::ffff:127.x.x.x and the empty ones.
bool isOwnLoop(const asio::ip::address& address) {
  if (address.is_v6() && address.to_v6().is_v4_mapped())
    return isOwnLoop(asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6()));
  return address.is_loopback() || address.is_unspecified();
}

}  // namespace

void Turn::queueFor(const asio::ip::tcp::endpoint& server) {
  const std::string host = isOwnLoop(server.address()) ? "localhost" : server.address().to_string();
  std::string name = fmt::format("nonet-{}-{}-{}.lock", ::getuid(), host, server.port());
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '.'; },
      '_');
  if (name == name_) return;
  name_ = name;
  if (file_ >= 0) ::close(file_);
  file_ = -1;
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
