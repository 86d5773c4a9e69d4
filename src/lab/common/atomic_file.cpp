#include "nonet/lab/common/atomic_file.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

namespace nonet::lab {

void writeAtomically(const std::string& path, const std::string& text) {
  const std::string fresh = path + ".new";
  {
    std::ofstream file(fresh, std::ios::binary | std::ios::trunc);
    file << text;
    file.flush();
    if (!file) throw std::runtime_error(fmt::format("cannot write {}: is the disk full?", fresh));
  }
  std::filesystem::rename(fresh, path);
}

}  // namespace nonet::lab
