// Headless Chromium for tests of pages, where it is installed, and a look at its screenshots.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <zlib.h>

#include "app/program.h"

namespace nonet::app {

/// An RGB picture, read from a PNG of 8 bits without interlacing, as Chromium writes them.
class Picture {
 public:
  explicit Picture(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    const std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(file), {}};
    std::vector<unsigned char> packed;
    for (std::size_t at = 8; at + 12 <= bytes.size();) {
      const std::size_t length = number(bytes, at);
      const std::string kind(bytes.begin() + static_cast<long>(at) + 4,
                             bytes.begin() + static_cast<long>(at) + 8);
      const auto data = bytes.begin() + static_cast<long>(at) + 8;
      if (kind == "IHDR") {
        width_ = number(bytes, at + 8);
        height_ = number(bytes, at + 12);
        channels_ = bytes.at(at + 17) == 6 ? 4 : 3;
      }
      if (kind == "IDAT") packed.insert(packed.end(), data, data + static_cast<long>(length));
      at += 12 + length;
    }
    unpack(packed);
  }

  std::size_t width() const { return width_; }
  std::size_t height() const { return height_; }
  std::array<int, 3> at(std::size_t x, std::size_t y) const {
    const std::size_t i = (y * width_ + x) * channels_;
    return {pixels_.at(i), pixels_.at(i + 1), pixels_.at(i + 2)};
  }
  /// Share of the pixels that the test accepts.
  template <class Test>
  double share(Test accepts) const {
    std::size_t count = 0;
    for (std::size_t y = 0; y < height_; ++y) {
      for (std::size_t x = 0; x < width_; ++x) {
        const auto [r, g, b] = at(x, y);
        count += accepts(r, g, b) ? 1 : 0;
      }
    }
    return static_cast<double>(count) / static_cast<double>(width_ * height_);
  }

 private:
  static std::size_t number(const std::vector<unsigned char>& bytes, std::size_t at) {
    return (static_cast<std::size_t>(bytes.at(at)) << 24U) |
           (static_cast<std::size_t>(bytes.at(at + 1)) << 16U) |
           (static_cast<std::size_t>(bytes.at(at + 2)) << 8U) | bytes.at(at + 3);
  }

  void unpack(const std::vector<unsigned char>& packed) {
    const std::size_t row = width_ * channels_;
    std::vector<unsigned char> raw(height_ * (row + 1));
    uLongf size = raw.size();
    if (width_ == 0 || uncompress(raw.data(), &size, packed.data(), packed.size()) != Z_OK) {
      throw std::runtime_error("not a PNG that can be read");
    }
    pixels_.assign(height_ * row, 0);
    for (std::size_t y = 0; y < height_; ++y) {
      const int filter = raw[y * (row + 1)];
      for (std::size_t x = 0; x < row; ++x) {
        const int left = x >= channels_ ? pixels_[y * row + x - channels_] : 0;
        const int up = y > 0 ? pixels_[(y - 1) * row + x] : 0;
        const int corner = x >= channels_ && y > 0 ? pixels_[(y - 1) * row + x - channels_] : 0;
        const int guess = predict(filter, left, up, corner);
        pixels_[y * row + x] = static_cast<unsigned char>(raw[y * (row + 1) + 1 + x] + guess);
      }
    }
  }

  // The five filters of the PNG specification, section 9.2.
  static int predict(int filter, int left, int up, int corner) {
    switch (filter) {
      case 1:
        return left;
      case 2:
        return up;
      case 3:
        return (left + up) / 2;
      case 4: {
        const int p = left + up - corner;
        const int a = std::abs(p - left);
        const int b = std::abs(p - up);
        const int c = std::abs(p - corner);
        return a <= b && a <= c ? left : b <= c ? up : corner;
      }
      default:
        return 0;
    }
  }

  std::size_t width_ = 0;
  std::size_t height_ = 0;
  std::size_t channels_ = 3;
  std::vector<unsigned char> pixels_;
};

class Browser {
 public:
  /// Nothing where no Chromium is installed.
  static std::optional<Browser> find() {
    for (const char* path : {"/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"}) {
      if (fs::exists(path)) return Browser(path);
    }
    return std::nullopt;
  }

  struct Visit {
    std::string page;  // the document after its scripts have run
    std::string log;   // what the browser said, the page's console included
  };

  /// Opens the page, lets it run for so many seconds of its own clock, and returns what has become of it.
  Visit visit(const std::string& address, const std::string& profile, double seconds = 6.0) const {
    Visit visit;
    visit.page = run({"--dump-dom", address}, profile, visit.log, seconds);
    return visit;
  }

  Picture screenshot(const std::string& address, const std::string& profile, const std::string& path) const {
    std::string log;
    run({"--screenshot=" + path, address}, profile, log);
    return Picture(path);
  }

 private:
  explicit Browser(std::string binary) : binary_(std::move(binary)) {}

  std::string run(const std::vector<std::string>& task, const std::string& profile, std::string& log,
                  double seconds = 6.0) const {
    const std::string errors = profile + ".err";
    const std::string output = profile + ".out";
    // A shell keeps the document apart from what the browser says.
    std::string line = "timeout 120 " + binary_ +
                       " --headless --no-sandbox --disable-gpu --use-angle=swiftshader "
                       "--enable-unsafe-swiftshader --enable-logging=stderr --window-size=1200,800 "
                       "--hide-scrollbars --virtual-time-budget=" +
                       std::to_string(std::lround(1000.0 * seconds)) + " --user-data-dir=" + profile;
    for (const std::string& part : task) line += " '" + part + "'";
    Program program("/bin/sh", {"-c", line + " 2>" + errors}, output);
    program.wait();
    std::ifstream file(errors);
    log.assign(std::istreambuf_iterator<char>(file), {});
    return program.output();
  }

  std::string binary_;
};

}  // namespace nonet::app
