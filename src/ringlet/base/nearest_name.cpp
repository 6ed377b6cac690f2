// Implements base/nearest_name.h.
#include "ringlet/base/nearest_name.h"

#include <algorithm>
#include <numeric>

namespace ringlet {
namespace {

// Levenshtein's distance, a row at a time.
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
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

}  // namespace

std::size_t nearestName(std::string_view word, const std::vector<std::string>& names) {
  std::size_t nearest = names.size(), least = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::size_t distance = editDistance(word, names[i]);
    if (distance < least && distance < names[i].size()) {
      least = distance;
      nearest = i;
    }
  }
  return nearest;
}

}  // namespace ringlet
