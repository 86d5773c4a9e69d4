#include "nonet/config/toml.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include <fmt/format.h>

#include "nonet/config/toml_letters.h"

namespace nonet::config {

toml::table parseToml(std::string_view text) {
  if (const std::size_t line = lineOfForeignLetter(text))
    throw TomlError(
        line,
        "a letter beyond ASCII may stand in comments and in texts in quotes only, in no key behind a dot");
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw TomlError(error.source().begin.line, std::string(error.description()));
  } catch (const detail::TomlAssertion&) {
    throw TomlError(1, "somewhere: a table's or key's name cannot be read");
  }
}

std::string readText(const std::string& path, std::string_view kind) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string text;
  std::array<char, 4096> buffer{};
  while (file.read(buffer.data(), buffer.size()) || file.gcount() > 0) {
    text.append(buffer.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (!file.is_open() || file.bad()) {
    throw std::runtime_error(fmt::format("{}: cannot be read ({}): give the path of a {}", path,
                                         errno != 0 ? std::strerror(errno) : "not a file", kind));
  }
  return text;
}

toml::table parseTomlFile(const std::string& path) {
  const std::string text = readText(path, "TOML file");
  try {
    return parseToml(text);
  } catch (const TomlError& error) {
    throw std::runtime_error(fmt::format("{}:{}: not TOML: {}", path, error.line(), error.what()));
  }
}

}  // namespace nonet::config
