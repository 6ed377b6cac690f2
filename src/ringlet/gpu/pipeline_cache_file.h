// What a driver keeps of compiled kernels, as a file: read with suspicion, written whole or not at all. The
// driver checks that it is its own.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace ringlet::gpu {

inline constexpr std::size_t kLargestPipelineCache = std::size_t{64}
                                                     << 20;  // [bytes]; larger is neither read nor written

/// The file's bytes; none where it is not there, cannot be read, is too large, or begins like no pipeline
/// cache.
std::vector<std::byte> readPipelineCache(const std::filesystem::path& path);

/// Makes the folder, writes beside the file and moves it there. Whether that went well: a cache that cannot
/// be kept is no failure.
bool writePipelineCache(const std::filesystem::path& path, std::span<const std::byte> bytes);

}  // namespace ringlet::gpu
