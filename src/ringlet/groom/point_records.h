// A strand's points as binary groom files hold them: three little-endian floats each, at equal distances.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "ringlet/base/result.h"
#include "ringlet/groom/groom.h"

namespace ringlet {

/// Adds a strand of `count` points, the first at byte `offset`, each `stride` bytes after the one before; the
/// caller knows them to be there. Fails, with byte, strand and point, on one that is not finite; `name` is
/// the file's and `strand` its number there.
Status addStrandAt(std::span<const std::byte> bytes, std::size_t offset, std::size_t stride,
                   std::uint32_t count, std::size_t strand, const std::string& name, Groom& groom);

}  // namespace ringlet
