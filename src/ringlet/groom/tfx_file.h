// TressFX 4 files (.tfx, AMD): a 160-byte header, then plain arrays, little-endian; all strands have the same
// number of points.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "ringlet/base/result.h"
#include "ringlet/groom/groom.h"
#include "ringlet/groom/loaded_groom.h"

namespace ringlet {

/// Reads the bytes of a .tfx file; `path` is for messages, which name the byte offset, what was found and
/// what was expected. Only the positions are used: texture coordinates, thickness and colours are left aside,
/// and so is every point's w, which says whether AMD's solver may move it. Any number of points from 2 to
/// 65,536 a strand will do, where AMD's own loader wants 4, 8, 16, 32 or 64. Exporters fill the strands up to
/// a multiple of 64: strands at the end whose points are all in one place are left out with a warning. Other
/// versions from 4 below 5, and bytes that no array owns, warn too. Errors: anything else that breaks the
/// format. Memory is taken only for what the file has bytes for. Throws nothing but std::bad_alloc. Cost: one
/// pass.
Result<LoadedGroom> readTfx(std::span<const std::byte> bytes, const std::filesystem::path& path);

}  // namespace ringlet
