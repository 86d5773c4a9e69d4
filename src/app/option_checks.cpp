#include "nonet/app/option_checks.h"

#include <charconv>

#include <fmt/format.h>

namespace nonet::app {

CLI::Validator threadCount() {
  return CLI::Range(0, 256);
}

CLI::Validator ownPort() {
  return CLI::Range(0, 65535);
}

CLI::Validator otherPort() {
  return CLI::Range(1, 65535);
}

CLI::Validator moreThanZero() {
  const auto check = [](const std::string& text) -> std::string {
    double value = 0.0;
    // What is no finite number is told by the check that all numbers have.
    if (CLI::detail::lexical_cast(text, value) && !(value <= 0.0)) return "";
    return fmt::format("must be more than 0, not {}", text);
  };
  return {check, "POSITIVE"};
}

std::optional<std::uint16_t> portFrom(std::string_view text) {
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && port > 0 ? std::optional(port) : std::nullopt;
}

}  // namespace nonet::app
