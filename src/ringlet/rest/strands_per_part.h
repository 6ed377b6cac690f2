// How many strands a thread takes at a time where work is shared (base/in_parallel.h).
#pragma once

#include <cstddef>

namespace ringlet {

inline constexpr std::size_t kStrandsPerPart = 64;

}  // namespace ringlet
