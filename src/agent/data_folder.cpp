#include "nonet/agent/data_folder.h"

#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

namespace nonet::agent {

namespace fs = std::filesystem;

namespace {

bool holdsData(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder / "params", ignored) && fs::is_directory(folder / "skills", ignored);
}

std::string checked(const std::string& folder, const std::string& origin) {
  if (holdsData(folder)) return folder;
  throw DataError(
      fmt::format("{} {}: there is no params/ and skills/: give the folder that holds both", origin, folder));
}

}  // namespace

std::string findData(const std::string& programFile, const std::string& givenBy,
                     const std::string& sourceFolder) {
  for (fs::path folder = fs::path(programFile).parent_path(); !folder.empty();
       folder = folder.parent_path()) {
    if (holdsData(folder)) return folder.string();
    if (holdsData(folder / "share" / "nonet")) return (folder / "share" / "nonet").string();
    if (!folder.has_relative_path()) break;
  }
  if (!sourceFolder.empty() && holdsData(sourceFolder)) return sourceFolder;
  throw DataError(fmt::format(
      "params/ and skills/ are missing: they are not above {}, nor in share/nonet there; set NONET_DATA "
      "or {} to the folder that holds both",
      programFile, givenBy));
}

std::string dataFolder(const std::string& given, const std::string& givenBy, const std::string& programFile,
                       const std::string& sourceFolder) {
  if (!given.empty()) return checked(given, givenBy);
  const char* set = std::getenv("NONET_DATA");  // NOLINT(concurrency-mt-unsafe)
  if (set != nullptr && *set != '\0') return checked(set, "NONET_DATA");
  return findData(programFile, givenBy, sourceFolder);
}

}  // namespace nonet::agent
