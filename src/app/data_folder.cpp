#include "nonet/app/data_folder.h"

#include <filesystem>

#include "nonet/agent/data_folder.h"

namespace nonet::app {

namespace fs = std::filesystem;

std::string executablePath() {
  std::error_code error;
  const fs::path path = fs::read_symlink("/proc/self/exe", error);
  return error ? std::string() : path.string();
}

std::string findThree(const std::string& executable, const std::string& systemFolder) {
  const fs::path installed = fs::path(executable).parent_path().parent_path() / "share/nonet/three";
  std::error_code ignored;
  return fs::is_directory(installed, ignored) ? installed.string() : systemFolder;
}

std::string dataFolder(const std::string& given, const std::string& option) {
  return agent::dataFolder(given, option, executablePath(), NONET_SOURCE_DIR);
}

}  // namespace nonet::app
