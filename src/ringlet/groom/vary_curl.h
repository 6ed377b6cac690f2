// varyCurl: the curl of one strand among many (generate.h).
#pragma once

#include <cstddef>

#include "ringlet/groom/generate.h"

namespace ringlet {

/// The curl as strand number `strand` wears it. The same seed and number always give the same.
CurlParameters varyCurl(const CurlParameters& curl, const Variation& variation, std::size_t strand);

}  // namespace ringlet
