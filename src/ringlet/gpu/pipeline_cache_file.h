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

/// The device and driver that compiled the kernels: Vulkan's header of a pipeline cache, and the driver's
/// version.
struct PipelineCacheOwner {
  std::uint32_t vendor = 0, device = 0, driverVersion = 0;
  std::array<std::uint8_t, 16> uuid{};
};

// The file is a header of our own (PipelineFileHeader in the .cpp: size and hash of the driver's bytes,
// driver version) and after it the driver's bytes as they came. Some drivers crash on bytes that are cut or
// changed, so none are handed over that are not exactly those written, by the same version of the same
// driver.

/// The driver's bytes; none where the file is not there, cannot be read, is too large, is not as it was
/// written, or was written for another owner.
std::vector<std::byte> readPipelineCache(const std::filesystem::path& path, const PipelineCacheOwner& owner);

/// Makes the folder, writes beside the file and moves it there. Whether that went well: a cache that cannot
/// be kept is no failure.
bool writePipelineCache(const std::filesystem::path& path, const PipelineCacheOwner& owner,
                        std::span<const std::byte> bytes);

}  // namespace ringlet::gpu
