// The files of the viewer's page, part of the program (from src/app/view/web, written by CMake).
#pragma once

#include <span>
#include <string_view>

namespace nonet::app {

struct WebFile {
  std::string_view path;  // "/index.html"
  std::string_view text;
};

std::span<const WebFile> webFiles();

}  // namespace nonet::app
