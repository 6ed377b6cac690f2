// A strand's points as binary groom files hold them: three little-endian floats each, at equal distances.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "ringlet/groom/groom.h"
#include "ringlet/groom/left_out.h"

namespace ringlet {

/// The first at byte `offset`, each `stride` bytes after the one before.
struct PointRecords {
  std::size_t offset, stride;
  std::uint32_t count;
};

/// Adds a strand of points that the caller knows to be there. One with a point that is not finite is left
/// out, with byte, strand and point; `strand` is its number in the file. Says whether it was added.
bool addStrandAt(std::span<const std::byte> bytes, const PointRecords& points, std::size_t strand,
                 Groom& groom, LeftOutStrands& leftOut);

}  // namespace ringlet
