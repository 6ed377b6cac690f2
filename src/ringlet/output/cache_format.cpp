// Implements output/cache_format.h.
#include "ringlet/output/cache_format.h"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "ringlet/base/assert.h"
#include "ringlet/base/little_endian.h"

namespace ringlet::cache {
namespace {

// What zstd gains here are short codes for frequent bytes; repeats are rare, so it looks for long ones only,
// with the smallest table. Level 1 needs 1.3 to 1.6 times as long and gains up to 8 %; the levels below it
// leave the codes out.
constexpr std::pair<ZSTD_cParameter, int> kParameters[] = {
    {ZSTD_c_compressionLevel, 1}, {ZSTD_c_strategy, ZSTD_fast}, {ZSTD_c_hashLog, 6}, {ZSTD_c_minMatch, 7}};

std::uint32_t checksumOf(std::span<const std::byte> bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

// `value` over the four bytes at `at`.
void putU32(std::span<std::byte> bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::byte>(value >> (8 * i) & 0xff);
}

bool isPositive(double value) { return std::isfinite(value) && value > 0; }

}  // namespace

std::vector<std::byte> headerBytes(const CacheHeader& header) {
  std::vector<std::byte> bytes;
  for (char c : kMagic) bytes.push_back(static_cast<std::byte>(c));
  appendU32(bytes, kVersion);
  appendU32(bytes, static_cast<std::uint32_t>(header.precision));
  appendU32(bytes, header.up == UpAxis::z ? 1 : 0);
  appendF32(bytes, header.diameter);
  appendF64(bytes, header.framesPerSecond);
  appendF64(bytes, header.metresPerUnit);
  appendU32(bytes, 0);
  appendU32(bytes, checksumOf(bytes));
  RINGLET_ASSERT(bytes.size() == kHeaderBytes, "the header has its size");
  return bytes;
}

ParsedHeader parseHeader(std::span<const std::byte> bytes) {
  const auto isOf = [&](std::string_view magic) {
    return std::ranges::equal(bytes.first(magic.size()), std::as_bytes(std::span(magic)));
  };
  if (!isOf(kMagic)) return {{}, "does not begin as a Ringlet cache does"};
  if (readU32(bytes, 8) != kVersion)
    return {{}, "has a version that this program does not know; a newer one may"};
  if (readU32(bytes, kHeaderBytes - 4) != checksumOf(bytes.first(kHeaderBytes - 4)))
    return {{}, "has a damaged header: its checksum is another"};
  const std::uint32_t precision = readU32(bytes, 12), up = readU32(bytes, 16);
  const CacheHeader header{static_cast<CachePrecision>(precision), up == 1 ? UpAxis::z : UpAxis::y,
                           readF32(bytes, 20), readF64(bytes, 24), readF64(bytes, 32)};
  if (precision > 1 || up > 1 || !isPositive(header.diameter) || !isPositive(header.framesPerSecond) ||
      !isPositive(header.metresPerUnit))
    return {{}, "has numbers in its header that no cache has"};
  return {header, {}};
}

ChunkHeader parseChunkHeader(std::span<const std::byte> bytes) {
  return {readU32(bytes, 0), static_cast<ChunkKind>(readU32(bytes, 4)), readU32(bytes, 8), readU64(bytes, 16),
          readF64(bytes, 24)};
}

ChunkPacker::ChunkPacker() : context_(ZSTD_createCCtx()) {
  if (!context_) throw std::bad_alloc();
  for (const auto& [parameter, value] : kParameters) ZSTD_CCtx_setParameter(context_.get(), parameter, value);
}
void ChunkPacker::Free::operator()(ZSTD_CCtx_s* context) const { ZSTD_freeCCtx(context); }

std::span<const std::byte> ChunkPacker::pack(ChunkKind kind, std::uint32_t number, double errorBound,
                                             std::span<const std::byte> content) {
  chunk_.resize(std::max(chunk_.size(), kChunkHeaderBytes + ZSTD_compressBound(content.size())));
  const auto stored = std::span(chunk_).subspan(kChunkHeaderBytes);
  std::size_t size =
      ZSTD_compress2(context_.get(), stored.data(), stored.size(), content.data(), content.size());
  if (ZSTD_isError(size) || size >= content.size() || !canHold(size, content.size())) {
    std::ranges::copy(content, stored.begin());
    size = content.size();
  }

  std::vector<std::byte> header;
  for (std::uint32_t value : {std::uint32_t{0}, static_cast<std::uint32_t>(kind), number, std::uint32_t{0}})
    appendU32(header, value);
  appendU64(header, size);
  appendF64(header, errorBound);
  std::ranges::copy(header, chunk_.begin());
  const auto whole = std::span(chunk_).first(kChunkHeaderBytes + size);
  putU32(whole, 0, checksumOf(whole.subspan(4)));
  return whole;
}

bool unpack(std::span<const std::byte> bytes, std::span<std::byte> content) {
  const auto stored = bytes.subspan(kChunkHeaderBytes);
  if (readU32(bytes, 0) != checksumOf(bytes.subspan(4))) return false;
  if (stored.size() == content.size()) {
    std::ranges::copy(stored, content.begin());
    return true;
  }
  return ZSTD_decompress(content.data(), content.size(), stored.data(), stored.size()) == content.size();
}

}  // namespace ringlet::cache
