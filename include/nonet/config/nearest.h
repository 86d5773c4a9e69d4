// Which known name somebody meant who misspelled one.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace nonet::config {

/// Levenshtein's distance: letters to insert, to delete or to replace until `a` is `b`.
std::size_t editDistance(std::string_view a, std::string_view b);

/// The name with the smallest distance, the first of equals; "" if there are no names.
std::string nearestOf(const std::vector<std::string>& names, std::string_view name);

}  // namespace nonet::config
