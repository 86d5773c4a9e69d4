#include "nonet/lab/common/atomic_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>
#include <unistd.h>

namespace nonet::lab {
namespace {

namespace fs = std::filesystem;

std::runtime_error cannotWrite(const std::string& path, int reason) {
  return std::runtime_error(fmt::format("cannot write {}: {}", path, std::strerror(reason)));
}

void writeText(const std::string& path, const std::string& text) {
  errno = 0;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << text;
  file.flush();
  if (!file) throw cannotWrite(path, errno);
}

// Writes `fresh` and puts it in the place of `real`. Throws.
void exchange(const fs::path& fresh, const fs::path& real, const std::string& text) {
  writeText(fresh.string(), text);
  std::error_code unknown;
  const fs::file_status before = fs::status(real, unknown);
  if (fs::exists(before)) fs::permissions(fresh, before.permissions(), unknown);
  fs::rename(fresh, real);
}

}  // namespace

void writeAtomically(const std::string& path, const std::string& text) {
  std::error_code unknown;
  const fs::path real = fs::is_symlink(path, unknown) ? fs::weakly_canonical(path, unknown) : fs::path(path);
  const fs::path folder = real.parent_path();
  if (!folder.empty()) fs::create_directories(folder, unknown);  // an error shows when the file is opened
  if (fs::is_directory(path, unknown))
    throw std::runtime_error(fmt::format("cannot write {}: it is a folder, give the name of a file", path));
  // A pipe or a device cannot be exchanged for another file.
  const bool there = fs::exists(real, unknown);
  if (there && !fs::is_regular_file(real, unknown)) return writeText(real.string(), text);
  // Whoever protected the file did not mean that another takes its place.
  if (there && ::access(real.c_str(), W_OK) != 0) throw cannotWrite(path, errno);
  const fs::path fresh = real.string() + ".new";
  try {
    exchange(fresh, real, text);
  } catch (...) {
    fs::remove(fresh, unknown);
    throw;
  }
}

}  // namespace nonet::lab
