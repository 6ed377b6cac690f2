// Reads and writes grooms, choosing the format by the file's extension: .hair (hair_file.h), .obj
// (obj_file.h) or, to be read only, .tfx (tfx_file.h).
#pragma once

#include <filesystem>

#include "ringlet/base/result.h"
#include "ringlet/groom/groom.h"
#include "ringlet/groom/loaded_groom.h"

namespace ringlet {

/// Reads a groom; upper or lower case of the extension does not matter. The points stay in the file's unit,
/// and metresPerUnit keeps its default, since no format states it. Every strand has at least two particles,
/// all finite. Errors: unknown extension, missing or unreadable file, anything wrong inside it, more than
/// memory holds. Cost: one read of the whole file into memory.
Result<LoadedGroom> readGroom(const std::filesystem::path& path);

/// Writes a groom so that reading it gives the same bits. An existing file is replaced only once all is
/// written. Errors: an extension other than .hair and .obj, a groom without strands, a strand of fewer than
/// two particles or with one that is not finite, what the format cannot hold, a full disk.
Status writeGroom(const std::filesystem::path& path, const Groom& groom);

}  // namespace ringlet
