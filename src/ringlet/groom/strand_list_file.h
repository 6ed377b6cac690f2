// Lists of strands as hair research passes them on: .data (USC-HairSalon) and .bin (CT2Hair), each a count of
// strands, then for each a count of points and the points.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "ringlet/base/result.h"
#include "ringlet/groom/loaded_groom.h"

namespace ringlet {

/// Reads the bytes of a .data file, whose points are three floats; `path` is for messages, which name the
/// byte offset, what was found and what was expected. A strand of one point stands for none and, like one of
/// no point, is left out with a warning; so are bytes behind the last. Errors: anything else that breaks the
/// format, no strands. Memory is taken only for what the file has bytes for. Throws nothing but
/// std::bad_alloc. Cost: one pass.
Result<LoadedGroom> readStrandData(std::span<const std::byte> bytes, const std::filesystem::path& path);

/// The same of a .bin file, whose points are seven floats, of which the first three are the place.
Result<LoadedGroom> readStrandBin(std::span<const std::byte> bytes, const std::filesystem::path& path);

}  // namespace ringlet
