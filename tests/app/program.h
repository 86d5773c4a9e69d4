// Runs the program itself, or a script, in a process of its own.
#pragma once

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <string>
#include <thread>
#include <vector>

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

namespace nonet::app {

namespace fs = std::filesystem;

/// Runs the program itself; its output goes to a file.
class Program {
 public:
  Program(const std::vector<std::string>& arguments, const fs::path& output)
      : Program(NONET_BINARY, arguments, output) {}
  Program(const std::string& binary, const std::vector<std::string>& arguments, const fs::path& output)
      : output_(output) {
    std::vector<std::string> command = {binary};
    command.insert(command.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& argument : command) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ == 0) {
      if (std::freopen(output_.c_str(), "w", stdout) == nullptr || ::dup2(1, 2) < 0) ::_exit(126);
      ::execv(pointers[0], pointers.data());
      ::_exit(127);
    }
  }
  ~Program() {
    if (!ended_) {
      ::kill(pid_, SIGKILL);
      wait();
    }
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  int wait() {
    int status = 0;
    ::waitpid(pid_, &status, 0);
    ended_ = true;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string output() const { return textOf(output_); }
  /// The first number that stands behind these words in its output, a port say.
  int numberAfter(const std::string& words) const {
    const std::string text = output();
    return std::stoi(text.substr(text.find(words) + words.size()));
  }
  /// Waits until a line of its output matches.
  bool says(const std::string& pattern, double seconds = 20.0) const {
    return fileSays(output_, pattern, seconds);
  }
  /// Waits until a line of the file matches: what a program in the background has said is not there at once.
  static bool fileSays(const fs::path& path, const std::string& pattern, double seconds = 20.0) {
    for (int i = 0; i < seconds * 20; ++i) {
      if (std::regex_search(textOf(path), std::regex(pattern))) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }
  pid_t pid() const { return pid_; }
  bool running() {
    int status = 0;
    if (!ended_ && ::waitpid(pid_, &status, WNOHANG) == pid_) ended_ = true;
    return !ended_;
  }
  /// Process ids of its agents by uniform number, of one team.
  std::map<int, pid_t> agents(const std::string& team) const {
    std::map<int, pid_t> found;
    for (const auto& task : fs::directory_iterator("/proc/" + std::to_string(pid_) + "/task")) {
      std::ifstream children(task.path() / "children");
      for (pid_t child = 0; children >> child;) {
        std::ifstream file("/proc/" + std::to_string(child) + "/cmdline");
        std::string part;
        std::string before;
        int unum = 0;
        bool ours = false;
        while (std::getline(file, part, '\0')) {
          if (before == "--unum") unum = std::stoi(part);
          if (before == "--team") ours = part == team;
          before = part;
        }
        if (ours) found[unum] = child;
      }
    }
    return found;
  }

 private:
  static std::string textOf(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  fs::path output_;
  pid_t pid_ = -1;
  bool ended_ = false;
};

/// A folder for the files of one test.
class TestFolder {
 public:
  explicit TestFolder(const std::string& name)
      : folder_(fs::temp_directory_path() / (name + "_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~TestFolder() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

 private:
  fs::path folder_;
};

}  // namespace nonet::app
