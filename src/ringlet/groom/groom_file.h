// Reads grooms, choosing the format by the file's extension: .hair (hair_file.h), .obj (obj_file.h), .usda,
// .usdc, .usd and .usdz (usd_file.h), .abc (alembic/abc_groom.h), .tfx (tfx_file.h), .ply (ply_file.h), .data
// and .bin (strand_list_file.h). They are written by output/groom_writer.h.
#pragma once

#include <filesystem>

#include "ringlet/base/result.h"
#include "ringlet/groom/groom.h"
#include "ringlet/groom/loaded_groom.h"

namespace ringlet {

/// Reads a groom; upper or lower case of the extension does not matter. The points stay in the file's unit.
/// USD and Ringlet's Alembic archives alone state their unit and their up axis: metresPerUnit is then the
/// file's, and the points are turned to the axis that is asked for; of others metresPerUnit keeps its
/// default. Every strand has at least two particles, all finite. Errors: unknown extension, missing or
/// unreadable file, anything wrong inside it, more than memory holds. Cost: one read of the whole file into
/// memory.
Result<LoadedGroom> readGroom(const std::filesystem::path& path, const GroomReading& reading = {});

/// Whether the name of a file ends as that of a groom that can be read.
bool isGroomFile(const std::filesystem::path& path);

/// All such endings, as a sentence has them: ".hair, .obj ... and .bin".
inline constexpr const char* kGroomEndings =
    ".hair, .obj, .usda, .usdc, .usd, .usdz, .abc, .tfx, .ply, .data and .bin";

}  // namespace ringlet
