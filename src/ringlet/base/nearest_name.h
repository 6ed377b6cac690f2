// The known name that a mistyped word was probably meant to be, for "did you mean ...?".
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ringlet {

/// Index of the name nearest to `word` by insertions, deletions and replacements; names.size() if none is
/// near.
std::size_t nearestName(std::string_view word, const std::vector<std::string>& names);

}  // namespace ringlet
