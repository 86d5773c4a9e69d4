// Where two messages differ first: one token with the list around it, instead of two long lines.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace nonet::lab {

struct TokenDifference {
  std::size_t token = 0;  // counted from 1: brackets and atoms
  std::string first;      // the innermost list around it, "(he1 0.123)"; "nothing" behind the end
  std::string second;     // the same of the other message
};

/// Nothing if both consist of the same tokens.
std::optional<TokenDifference> firstTokenDifference(std::string_view first, std::string_view second);

}  // namespace nonet::lab
