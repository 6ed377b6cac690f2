// Caches (.rgc). Checksums would stop the fuzzer at the first byte it changes, so most files get right ones.
#include "ringlet/output/cache_reader.h"

#include <zlib.h>

#include <cstdint>
#include <cstring>

#include "tests/fuzz/memory_file.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t mostBytes);

namespace ringlet::fuzz {

// The reader's promise is 1,000 times the file.
const MemoryBound kMemory{.base = 1 << 20, .perByte = 1000};

namespace {

std::uint32_t checksumOf(const std::uint8_t* data, std::size_t size) {
  return static_cast<std::uint32_t>(crc32_z(0, data, size));
}

// The header's stands behind it, a chunk's before it. Goes on as the reader does where the index is missing.
void mendChecksums(std::uint8_t* data, std::size_t size) {
  if (size < cache::kHeaderBytes) return;
  std::uint32_t sum = checksumOf(data, cache::kHeaderBytes - 4);
  std::memcpy(data + cache::kHeaderBytes - 4, &sum, 4);
  for (std::size_t at = cache::kHeaderBytes; size - at >= cache::kChunkHeaderBytes;) {
    const auto chunk = cache::parseChunkHeader(std::as_bytes(std::span(data + at, cache::kChunkHeaderBytes)));
    if (chunk.storedBytes > size - at - cache::kChunkHeaderBytes) return;
    const std::size_t whole = cache::kChunkHeaderBytes + chunk.storedBytes;
    sum = checksumOf(data + at + 4, whole - 4);
    std::memcpy(data + at, &sum, 4);
    at += whole;
  }
}

}  // namespace

void tryBytes(std::span<const std::byte> bytes) {
  const MemoryFile file(bytes);
  auto reader = CacheReader::open(file.path());
  if (!reader) return;
  demand(reader->strandCount() > 0 && reader->particleCount() >= reader->strandCount(),
         "strands have points");
  std::vector<Vec3f> points;
  for (int frame = 1; frame <= reader->frameCount(); ++frame) {
    demand(std::isfinite(reader->errorBound(frame)) && reader->errorBound(frame) >= 0, "a bound is a number");
    if (!reader->readFrame(frame, points)) continue;
    demand(points.size() == reader->particleCount(), "a frame has every particle");
    demandFinite(std::span<const Vec3f>(points));
  }
}

}  // namespace ringlet::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t mostBytes,
                                               unsigned seed) {
  size = LLVMFuzzerMutate(data, size, mostBytes);
  if (seed % 8 != 0) ringlet::fuzz::mendChecksums(data, size);
  return size;
}
