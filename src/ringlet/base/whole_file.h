// Whole files in and out: read at once, replaced at once.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "ringlet/base/result.h"

namespace ringlet {

/// All bytes of a regular file. Errors: missing, a folder or device, unreadable, more
/// than 64 GiB, changed while it was read.
/// Throws std::bad_alloc when memory does not hold it; readGroom turns that into an Error.
Result<std::vector<std::byte>> readWholeFile(const std::filesystem::path& path);

/// Replaces a file: writes a temporary beside it to the disk and renames that, so neither a crash nor a full
/// disk leaves half a file. Errors: the folder is missing or read-only, the disk is full, the path is a
/// folder.
Status writeWholeFile(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// The file whose replacement `path` was to become, where its name is that of a temporary of writeWholeFile:
/// a process that is killed leaves it.
std::optional<std::filesystem::path> fileOfTemporary(const std::filesystem::path& path);

}  // namespace ringlet
