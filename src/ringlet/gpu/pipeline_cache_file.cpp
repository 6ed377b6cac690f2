// Implements gpu/pipeline_cache_file.h.
#include "ringlet/gpu/pipeline_cache_file.h"

#include <cstdint>
#include <cstring>
#include <system_error>
#include <utility>

#include "ringlet/base/whole_file.h"

namespace ringlet::gpu {
namespace {

// VkPipelineCacheHeaderVersionOne: its size and version stand first.
constexpr std::size_t kHeaderBytes = 32;

bool hasHeader(std::span<const std::byte> bytes) {
  std::uint32_t words[2];
  if (bytes.size() < kHeaderBytes) return false;
  std::memcpy(words, bytes.data(), sizeof words);
  return words[0] >= kHeaderBytes && words[0] <= bytes.size() && words[1] == 1;
}

}  // namespace

std::vector<std::byte> readPipelineCache(const std::filesystem::path& path) {
  std::error_code code;
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  if (code || size > kLargestPipelineCache) return {};
  auto bytes = readWholeFile(path);
  return bytes && hasHeader(*bytes) ? std::move(*bytes) : std::vector<std::byte>{};
}

bool writePipelineCache(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  if (bytes.size() > kLargestPipelineCache) return false;
  std::error_code ignored;  // the write tells
  std::filesystem::create_directories(path.parent_path(), ignored);
  return static_cast<bool>(writeWholeFile(path, bytes));
}

}  // namespace ringlet::gpu
