// The folder of cached data, which only saves time.
#pragma once

#include <filesystem>

namespace ringlet::program {

/// $RINGLET_CACHE_DIR, else ringlet in $XDG_CACHE_HOME, else in ~/.cache; empty if none of these is set.
std::filesystem::path cacheFolder();

}  // namespace ringlet::program
