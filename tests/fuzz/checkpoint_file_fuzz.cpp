// Checkpoints (.rgk), most of them with the right checksum: it would stop the fuzzer at the first byte it
// changes.
#include "ringlet/output/checkpoint_file.h"

#include <cstdint>
#include <cstring>
#include <span>

#include "ringlet/base/checksum.h"
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
  constexpr std::size_t kHeader = 32;
  size = LLVMFuzzerMutate(data, size, mostBytes);
  if (size < kHeader || seed % 8 == 0) return size;
  const std::uint64_t sum = ringlet::checksum64(std::as_bytes(std::span(data + kHeader, size - kHeader)));
  const std::uint64_t bytes = size - kHeader;
  std::memcpy(data + 16, &sum, 8);
  std::memcpy(data + 24, &bytes, 8);
  return size;
}
