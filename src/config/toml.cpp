#include "nonet/config/toml.h"

#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "nonet/config/toml_letters.h"

namespace nonet::config {

toml::table parseToml(std::string_view text) {
  if (const std::size_t line = lineOfForeignLetter(text))
    throw TomlError(line, "a letter beyond ASCII may stand in comments and in quotes only");
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw TomlError(error.source().begin.line, std::string(error.description()));
  } catch (const detail::TomlAssertion&) {
    throw TomlError(1, "somewhere: a table's or key's name cannot be read");
  }
}

toml::table parseTomlFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  if (!file.is_open() || file.bad())
    throw std::runtime_error(fmt::format("{}: cannot be read: give the path of a TOML file", path));
  try {
    return parseToml(text);
  } catch (const TomlError& error) {
    throw std::runtime_error(fmt::format("{}:{}: not TOML: {}", path, error.line(), error.what()));
  }
}

}  // namespace nonet::config
