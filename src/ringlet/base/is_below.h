// isBelow: whether a path stays in a folder, links followed.
#pragma once

#include <filesystem>

namespace ringlet {

/// Whether what a path leads to, symbolic links followed, is in or below a folder ("": the current one). What
/// is not there yet is where its name says. False where the folder is not there.
bool isBelow(const std::filesystem::path& path, const std::filesystem::path& folder);

}  // namespace ringlet
