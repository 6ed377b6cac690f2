// Properties of a groom that a file cannot hold and that its reader must therefore be told.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ringlet/groom/loaded_groom.h"

namespace ringlet::program {

/// A sentence each for the unit and the up axis if reading `path` without options would assume others, since
/// its format states neither. `path` may be a folder of such files.
std::vector<std::string> lostIn(const std::filesystem::path& path, double metresPerUnit, bool upIsZ);

}  // namespace ringlet::program
