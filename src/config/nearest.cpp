#include "nonet/config/nearest.h"

#include <algorithm>

namespace nonet::config {

std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

std::string nearestOf(const std::vector<std::string>& names, std::string_view name) {
  const auto nearer = [name](const std::string& a, const std::string& b) {
    return editDistance(a, name) < editDistance(b, name);
  };
  const auto best = std::min_element(names.begin(), names.end(), nearer);
  return best == names.end() ? std::string() : *best;
}

}  // namespace nonet::config
