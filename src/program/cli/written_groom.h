// Properties of a groom that a file cannot hold and that its reader must therefore be told.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ringlet/groom/loaded_groom.h"
#include "ringlet/output/up_axis.h"

namespace ringlet::program {

/// A sentence each for the unit and the up axis if reading `path` without options would assume others, where
/// its format states neither. `path` may be a folder of such files.
std::vector<std::string> lostIn(const std::filesystem::path& path, double metresPerUnit, bool upIsZ);

/// Which axis of a groom that was read points up: what was typed, or what the file stated; else it is
/// unknown.
std::optional<UpAxis> upOf(const std::optional<std::string>& typed, const LoadedGroom& loaded);

}  // namespace ringlet::program
