// Implements gpu/pipeline_cache_file.h.
#include "ringlet/gpu/pipeline_cache_file.h"

#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>

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
  if (code || size < kHeaderBytes || size > kLargestPipelineCache) return {};
  std::vector<std::byte> bytes(size);
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))) return {};
  return hasHeader(bytes) ? bytes : std::vector<std::byte>{};
}

bool writePipelineCache(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  if (bytes.size() > kLargestPipelineCache) return false;
  std::error_code code;
  std::filesystem::create_directories(path.parent_path(), code);
  std::filesystem::path beside = path;
  beside += "." + std::to_string(getpid());  // two programs may end at once
  {
    std::ofstream file(beside, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file) {
      std::filesystem::remove(beside, code);
      return false;
    }
  }
  std::filesystem::rename(beside, path, code);
  if (!code) return true;
  std::error_code ignored;
  std::filesystem::remove(beside, ignored);
  return false;
}

}  // namespace ringlet::gpu
