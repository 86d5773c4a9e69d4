#include "nonet/app/soak/false_clock.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

namespace nonet::app {
namespace {

namespace fs = std::filesystem;

/// Debian keeps it in the folder of the machine's kind.
std::string libraryPath() {
  std::error_code ignored;
  for (const auto& folder : fs::directory_iterator("/usr/lib", ignored)) {
    const fs::path path = folder.path() / "faketime/libfaketimeMT.so.1";
    if (fs::exists(path, ignored)) return path.string();
  }
  throw std::runtime_error(
      "the fault 'clock' needs libfaketime: install the Debian package of that name, or name other --kinds");
}

}  // namespace

FalseClock::FalseClock(std::string file) : library_(libraryPath()), file_(std::move(file)) {
  jump(0);
}

std::vector<std::string> FalseClock::variables() const {
  return {"LD_PRELOAD=" + library_, "FAKETIME_TIMESTAMP_FILE=" + file_,
          fmt::format("FAKETIME_CACHE_DURATION={:.0f}", kTillSeen), "FAKETIME_DONT_FAKE_MONOTONIC=1"};
}

void FalseClock::jump(long seconds) const {
  // Read at any moment, so it must never be empty.
  const std::string next = file_ + ".next";
  std::ofstream(next) << fmt::format("{:+d}\n", seconds);
  fs::rename(next, file_);
}

void FalseClock::clean(pid_t pid) {
  std::error_code ignored;
  for (const char* kind : {"faketime_shm_", "sem.faketime_sem_"})
    fs::remove(fmt::format("/dev/shm/{}{}", kind, pid), ignored);
}

}  // namespace nonet::app
