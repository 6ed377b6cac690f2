// Checkpoints (.rgk), most of them with the right checksum: it would stop the fuzzer at the first byte it
// changes.
#include "ringlet/output/checkpoint_file.h"

#include <zlib.h>

#include <cstdint>
#include <cstring>

#include "tests/fuzz/memory_file.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t mostBytes);

namespace ringlet::fuzz {

// A fact takes at least 16 bytes of the file, and two strings of memory.
const MemoryBound kMemory{.base = 1 << 20, .perByte = 64};

void tryBytes(std::span<const std::byte> bytes) {
  const MemoryFile file(bytes);
  const auto checkpoint = readCheckpoint(file.path());
  if (!checkpoint) return;
  demand(checkpoint->frame >= 0, "a checkpoint is of a frame");
  demand(checkpoint->computed.size() + checkpoint->written.size() <= bytes.size(), "a state is in the file");
  demand(differencesOf(checkpoint->facts, checkpoint->facts).empty() || !checkpoint->facts.empty(),
         "nothing differs from nothing");
}

}  // namespace ringlet::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t mostBytes,
                                               unsigned seed) {
  constexpr std::size_t kHeader = 24;
  size = LLVMFuzzerMutate(data, size, mostBytes);
  if (size < kHeader || seed % 8 == 0) return size;
  const auto sum = static_cast<std::uint32_t>(crc32_z(0, data + kHeader, size - kHeader));
  const std::uint64_t bytes = size - kHeader;
  std::memcpy(data + 12, &sum, 4);
  std::memcpy(data + 16, &bytes, 8);
  return size;
}
