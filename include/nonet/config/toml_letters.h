// A look at TOML text before toml++ sees it.
#pragma once

#include <cstddef>
#include <string_view>

namespace nonet::config {

/// Number of the first line, from 1, in which a letter beyond ASCII stands outside of comments and of texts
/// in quotes; 0 if there is none. TOML has no use for one there, and toml++ 3.3 has none either: where it
/// looks for a space it takes any of U+00A1 to U+0499 and some others to be impossible, which is undefined
/// behaviour. Texts in three quotes may not hold any: their line breaks are followed by spaces, too. Nor may
/// the rest of a line in which a text begins behind something else than a space, a comma, an opening bracket
/// or the = of a line's first key: there, as in 2="x" or 2."x", toml++ may not heed the quotes.
std::size_t lineOfForeignLetter(std::string_view toml);

}  // namespace nonet::config
