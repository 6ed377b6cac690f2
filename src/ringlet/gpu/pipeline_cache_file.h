// What a driver keeps of compiled kernels, as a file: read with suspicion, written whole or not at all.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace ringlet::gpu {

inline constexpr std::size_t kLargestPipelineCache = std::size_t{64}
                                                     << 20;  // [bytes]; larger is neither read nor written

/// Whose compiled kernels, as Vulkan's header of a pipeline cache has it.
struct PipelineCacheOwner {
  std::uint32_t vendor = 0, device = 0;
  std::array<std::uint8_t, 16> uuid{};
};

/// The file's bytes; none where it is not there, cannot be read, is too large, or begins like no pipeline
/// cache of this owner.
std::vector<std::byte> readPipelineCache(const std::filesystem::path& path, const PipelineCacheOwner& owner);

/// Makes the folder, writes beside the file and moves it there. Whether that went well: a cache that cannot
/// be kept is no failure.
bool writePipelineCache(const std::filesystem::path& path, std::span<const std::byte> bytes);

}  // namespace ringlet::gpu
