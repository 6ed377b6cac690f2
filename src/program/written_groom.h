// What the file of a groom does not hold although the groom had it: whoever reads it must say it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ringlet/groom/loaded_groom.h"

namespace ringlet::program {

/// A sentence each for the unit and the up axis of `groom`, where whoever reads `path` without options would
/// take others: all formats that are written state neither. `upIsZ`: the axis it was read to.
std::vector<std::string> lostIn(const std::filesystem::path& path, const LoadedGroom& groom, bool upIsZ);

}  // namespace ringlet::program
