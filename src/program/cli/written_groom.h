// What the file of a groom does not hold although the groom had it: whoever reads it must say it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ringlet/groom/loaded_groom.h"

namespace ringlet::program {

/// A sentence each for the unit and the up axis of strands, where whoever reads `path` without options would
/// take others: its format states neither. `path` may be a folder of such files.
std::vector<std::string> lostIn(const std::filesystem::path& path, double metresPerUnit, bool upIsZ);

}  // namespace ringlet::program
