#include "nonet/app/data_folder.h"

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

namespace nonet::app {

namespace fs = std::filesystem;

namespace {

bool holdsData(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder / "params", ignored) && fs::is_directory(folder / "skills", ignored);
}

std::string checked(const std::string& folder, const std::string& origin) {
  if (holdsData(folder)) return folder;
  throw std::runtime_error(
      fmt::format("{} {}: there is no params/ and skills/: give the folder that holds both", origin, folder));
}

}  // namespace

std::string executablePath() {
  std::error_code error;
  const fs::path path = fs::read_symlink("/proc/self/exe", error);
  return error ? std::string() : path.string();
}

std::string findData(const std::string& executable, const std::string& sourceFolder) {
  for (fs::path folder = fs::path(executable).parent_path(); !folder.empty(); folder = folder.parent_path()) {
    if (holdsData(folder)) return folder.string();
    if (holdsData(folder / "share" / "nonet")) return (folder / "share" / "nonet").string();
    if (!folder.has_relative_path()) break;
  }
  if (holdsData(sourceFolder)) return sourceFolder;
  throw std::runtime_error(fmt::format(
      "params/ and skills/ are missing: they are not above {}, nor in share/nonet there; set NONET_DATA "
      "or --data to the folder that holds both",
      executable));
}

std::string findThree(const std::string& executable, const std::string& systemFolder) {
  const fs::path installed = fs::path(executable).parent_path().parent_path() / "share/nonet/three";
  std::error_code ignored;
  return fs::is_directory(installed, ignored) ? installed.string() : systemFolder;
}

std::string dataFolder(const std::string& given) {
  if (!given.empty()) return checked(given, "--data");
  const char* set = std::getenv("NONET_DATA");  // NOLINT(concurrency-mt-unsafe)
  if (set != nullptr && *set != '\0') return checked(set, "NONET_DATA");
  return findData(executablePath(), NONET_SOURCE_DIR);
}

}  // namespace nonet::app
