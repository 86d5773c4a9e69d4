#include "nonet/lab/common/atomic_file.h"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

namespace nonet::lab {
namespace {

namespace fs = std::filesystem;

// A limit on the size of files stands in for a full disk.
TEST(AtomicFile, AFailureLeavesTheOldTextAndNothingBeside) {
  const fs::path folder = fs::path(testing::TempDir()) / ("nonet_atomic_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const std::string path = (folder / "a.txt").string();
  writeAtomically(path, "old");
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);

  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{100, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(writeAtomically(path, std::string(5000, 'x')), std::runtime_error);
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);

  std::ifstream file(path);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);

  writeAtomically(path, "new");
  EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace nonet::lab
