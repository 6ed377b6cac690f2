// Files of compiled kernels: a driver is handed the bytes that were written for it, and no others. Most files
// get a size and a hash that are right, as those would stop the fuzzer at the first byte it changes.
#include "ringlet/gpu/pipeline_cache_file.h"

#include <cstdint>
#include <cstring>

#include "tests/fuzz/memory_file.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t mostBytes);

namespace ringlet::fuzz {

const MemoryBound kMemory{.base = 1 << 20, .perByte = 16};

void tryBytes(std::span<const std::byte> bytes) {
  const MemoryFile file(bytes);
  gpu::PipelineCacheOwner owner{.vendor = 0x10005, .device = 0, .driverVersion = 1};
  const std::vector<std::byte> found = gpu::readPipelineCache(file.path(), owner);
  demand(found.empty() || found.size() + 32 == bytes.size(), "all of the driver's bytes, or none");
  owner.driverVersion = 2;
  demand(gpu::readPipelineCache(file.path(), owner).empty() || found.empty(), "bytes are one owner's");
}

}  // namespace ringlet::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t mostBytes,
                                               unsigned seed) {
  size = LLVMFuzzerMutate(data, size, mostBytes);
  constexpr std::size_t kHeader = 32;  // magic 8 | size 8 | FNV-1a hash 8 | driver version 4 | 0 4
  if (seed % 8 == 0 || size < kHeader) return size;
  const std::uint64_t bytes = size - kHeader;
  std::uint64_t hash = 0xcbf29ce484222325;
  for (std::size_t i = kHeader; i < size; ++i) hash = (hash ^ data[i]) * 0x100000001b3;
  std::memcpy(data + 8, &bytes, 8);
  std::memcpy(data + 16, &hash, 8);
  return size;
}
