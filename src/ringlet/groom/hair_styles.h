// Hair styles: named sets of numbers for makeHead.
#pragma once

#include <optional>
#include <string_view>

#include "ringlet/groom/generate.h"

namespace ringlet {

inline constexpr const char* kHairStyles = "ringlets, long, bob, fringe, layered, short, coils";

/// Nothing for a name that is not of kHairStyles. How many strands, particles and which unit stay the
/// defaults.
std::optional<HeadParameters> headOfStyle(std::string_view name);

}  // namespace ringlet
