// toml++ as it is used here. Nothing else may include it: its functions are inline, and the linker takes any
// one of several that were compiled with other macros.
#pragma once

#define TOML_ENABLE_FORMATTERS 0  // reading only

// toml++ 3.3 takes some malformed texts ("[[!a]]") for a fault of its own. Its assertions are errors of the
// text here, in every build: with NDEBUG they would be promises to the optimiser.
namespace nonet::config::detail {
struct TomlAssertion {};
[[noreturn]] inline void failToml() {
  throw TomlAssertion{};
}
}  // namespace nonet::config::detail
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(expr) ((expr) ? void() : nonet::config::detail::failToml())
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace nonet::config {

/// What is wrong with a text that is not TOML, and in which line, from 1.
class TomlError : public std::runtime_error {
 public:
  TomlError(std::size_t line, const std::string& message) : std::runtime_error(message), line_(line) {}
  std::size_t line() const { return line_; }

 private:
  std::size_t line_;
};

/// Throws TomlError, also where letters beyond ASCII must not stand (toml_letters.h).
toml::table parseToml(std::string_view text);

/// A whole file; throws std::runtime_error that says why it cannot be read, and what `kind` of file to give.
std::string readText(const std::string& path, std::string_view kind);

/// parseToml() of a whole file; throws std::runtime_error, whose message begins with PATH: or PATH:LINE:.
toml::table parseTomlFile(const std::string& path);

}  // namespace nonet::config
