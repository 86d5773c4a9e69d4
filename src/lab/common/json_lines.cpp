#include "nonet/lab/common/json_lines.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace nonet::lab {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

std::vector<ordered_json> readWholeLines(const std::string& path) {
  std::vector<ordered_json> lines;
  std::ifstream file(path, std::ios::binary);
  std::uintmax_t whole = 0;
  for (std::string text; std::getline(file, text) && !file.eof();) {
    lines.push_back(ordered_json::parse(text, nullptr, false));
    if (lines.back().is_discarded())
      throw std::runtime_error(fmt::format("{}: line {} is damaged", path, lines.size()));
    whole += text.size() + 1;
  }
  file.close();
  if (fs::exists(path) && fs::file_size(path) != whole) fs::resize_file(path, whole);
  return lines;
}

void appendLine(const std::string& path, const ordered_json& line) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  const std::string text = line.dump() + "\n";
  const bool written = file >= 0 &&
                       ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
                       ::fdatasync(file) == 0;
  if (file >= 0) ::close(file);
  if (!written) throw std::runtime_error(fmt::format("cannot write {}: is the disk full?", path));
}

}  // namespace nonet::lab
