// Strands of a file that holds their points and nothing else: all have as many.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "ringlet/base/result.h"
#include "ringlet/groom/loaded_groom.h"

namespace ringlet {

/// What to do with such a file, as the end of a sentence.
inline constexpr const char* kSayPointsPerStrand =
    "where all strands have as many points, say how many: --points-per-strand N (points_per_strand of "
    "[groom])";

/// An error where so many points are no whole number of strands of as many each, two at least.
Status checkWholeStrands(std::size_t pointCount, std::uint32_t pointsPerStrand);

/// Cuts the points, in their order, into strands of `pointsPerStrand`, 2 or more. Errors: a number that does
/// not divide theirs; no points. `name` is the file's.
Result<LoadedGroom> strandsOfPoints(std::span<const Vec3f> points, std::uint32_t pointsPerStrand,
                                    const std::string& name);

}  // namespace ringlet
