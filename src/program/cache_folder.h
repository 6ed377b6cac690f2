// Where the program keeps what only saves time.
#pragma once

#include <filesystem>

namespace ringlet::program {

/// $RINGLET_CACHE_DIR, else ringlet in $XDG_CACHE_HOME, else in ~/.cache; empty where none of them is known.
std::filesystem::path cacheFolder();

}  // namespace ringlet::program
