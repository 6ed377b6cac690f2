// Implements gpu/pipeline_cache_file.h.
#include "ringlet/gpu/pipeline_cache_file.h"

#include <cstdint>
#include <cstring>
#include <system_error>
#include <utility>

#include "ringlet/base/whole_file.h"

namespace ringlet::gpu {
namespace {

// VkPipelineCacheHeaderVersionOne.
struct Header {
  std::uint32_t size, version;
  PipelineCacheOwner owner;
};
static_assert(sizeof(Header) == 32);

bool isOf(const PipelineCacheOwner& owner, std::span<const std::byte> bytes) {
  Header header;
  if (bytes.size() < sizeof header) return false;
  std::memcpy(&header, bytes.data(), sizeof header);
  return header.size >= sizeof header && header.size <= bytes.size() && header.version == 1 &&
         header.owner.vendor == owner.vendor && header.owner.device == owner.device &&
         header.owner.uuid == owner.uuid;
}

}  // namespace

std::vector<std::byte> readPipelineCache(const std::filesystem::path& path, const PipelineCacheOwner& owner) {
  std::error_code code;
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  if (code || size > kLargestPipelineCache) return {};
  auto bytes = readWholeFile(path);
  return bytes && isOf(owner, *bytes) ? std::move(*bytes) : std::vector<std::byte>{};
}

bool writePipelineCache(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  if (bytes.size() > kLargestPipelineCache) return false;
  std::error_code ignored;  // the write tells
  std::filesystem::create_directories(path.parent_path(), ignored);
  return static_cast<bool>(writeWholeFile(path, bytes));
}

}  // namespace ringlet::gpu
