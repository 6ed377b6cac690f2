// HAIR files (.hair, Cem Yuksel): a 128-byte header, then plain arrays, little-endian.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "ringlet/base/result.h"
#include "ringlet/groom/groom.h"
#include "ringlet/groom/loaded_groom.h"

namespace ringlet {

/// Reads the bytes of a .hair file; `path` is for messages, which name the byte offset, what was found and
/// what was expected. Colours become a primvar, where prims are kept; thickness and transparency are left
/// aside. Strands of one point are left out with a warning; a first word "hair", unknown flags and trailing
/// bytes warn too. Errors: anything else that breaks the format. Memory is taken only for what the file has
/// bytes for. Throws nothing but std::bad_alloc. Cost: one pass.
Result<LoadedGroom> readHair(std::span<const std::byte> bytes, const std::filesystem::path& path,
                             const GroomReading& reading = {});

/// Writes a groom as .hair, points and segments only; reading it gives the same bits. Errors: see writeGroom;
/// also a strand of more than 65,536 particles, since the format counts 65,535 segments at most.
Status writeHair(const std::filesystem::path& path, const Groom& groom);

}  // namespace ringlet
