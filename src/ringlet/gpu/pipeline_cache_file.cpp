// Implements gpu/pipeline_cache_file.h.
#include "ringlet/gpu/pipeline_cache_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <system_error>
#include <utility>

#include "ringlet/base/whole_file.h"

namespace ringlet::gpu {
namespace {

constexpr std::array<char, 8> kMagic{'R', 'G', 'L', 'P', 'I', 'P', 'E', '1'};

struct PipelineFileHeader {
  std::array<char, 8> magic = kMagic;
  std::uint64_t size = 0;  // of the driver's bytes
  std::uint64_t hash = 0;  // of them
  std::uint32_t driverVersion = 0;
  std::uint32_t reserved = 0;
  bool operator==(const PipelineFileHeader&) const = default;
};
static_assert(sizeof(PipelineFileHeader) == 32, "no gaps: it is written as it is");

// VkPipelineCacheHeaderVersionOne, with which the driver's bytes begin.
struct DriverHeader {
  std::uint32_t size, version, vendor, device;
  std::array<std::uint8_t, 16> uuid;
};
static_assert(sizeof(DriverHeader) == 32);

// FNV-1a, byte by byte: every change of one byte changes it.
std::uint64_t hashOf(std::span<const std::byte> bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const std::byte byte : bytes) hash = (hash ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3;
  return hash;
}

PipelineFileHeader headerOf(const PipelineCacheOwner& owner, std::span<const std::byte> bytes) {
  return {.size = bytes.size(), .hash = hashOf(bytes), .driverVersion = owner.driverVersion};
}

bool isOf(const PipelineCacheOwner& owner, std::span<const std::byte> bytes) {
  DriverHeader header;
  if (bytes.size() < sizeof header) return false;
  std::memcpy(&header, bytes.data(), sizeof header);
  return header.size >= sizeof header && header.size <= bytes.size() && header.version == 1 &&
         header.vendor == owner.vendor && header.device == owner.device && header.uuid == owner.uuid;
}

}  // namespace

std::vector<std::byte> readPipelineCache(const std::filesystem::path& path, const PipelineCacheOwner& owner) {
  std::error_code code;
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  if (code || size > kLargestPipelineCache + sizeof(PipelineFileHeader)) return {};
  auto file = readWholeFile(path);
  PipelineFileHeader header;
  if (!file || file->size() < sizeof header) return {};
  std::memcpy(&header, file->data(), sizeof header);
  file->erase(file->begin(), file->begin() + sizeof header);
  return header == headerOf(owner, *file) && isOf(owner, *file) ? std::move(*file) : std::vector<std::byte>{};
}

bool writePipelineCache(const std::filesystem::path& path, const PipelineCacheOwner& owner,
                        std::span<const std::byte> bytes) {
  if (bytes.size() > kLargestPipelineCache) return false;
  const PipelineFileHeader header = headerOf(owner, bytes);
  std::vector<std::byte> file(sizeof header + bytes.size());
  std::memcpy(file.data(), &header, sizeof header);
  std::ranges::copy(bytes, file.begin() + sizeof header);
  std::error_code ignored;  // the write tells
  std::filesystem::create_directories(path.parent_path(), ignored);
  return static_cast<bool>(writeWholeFile(path, file));
}

}  // namespace ringlet::gpu
