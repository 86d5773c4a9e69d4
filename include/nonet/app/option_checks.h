// What the values of options may be, where more than one command asks the same.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include <CLI/CLI.hpp>

namespace nonet::app {

/// For CLI::Option::check(). Threads: 0 (one per core) to 256.
CLI::Validator threadCount();
/// A port to listen on: 0 (any free one) to 65535.
CLI::Validator ownPort();
/// A port that somebody else listens on: 1 to 65535.
CLI::Validator otherPort();
/// A number above 0, without the bound of CLI::PositiveNumber, which takes 309 digits to tell.
CLI::Validator moreThanZero();

/// A port that somebody else listens on; nothing if the text is none.
std::optional<std::uint16_t> portFrom(std::string_view text);

}  // namespace nonet::app
