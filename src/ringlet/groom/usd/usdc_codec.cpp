// Implements groom/usd/usdc_codec.h.
//
//   packed bytes:  u8 n; n = 0: one LZ4 block to the end; else n times i32 size and an LZ4 block of that size
//   integers:      i32 the commonest difference; two bits an integer, lowest first: 0 that difference, 1, 2
//                  and 3 the next one of the i8, i16 and i32 that follow; the first differs from 0
#include "ringlet/groom/usd/usdc_codec.h"

#include <algorithm>

#include "ringlet/base/little_endian.h"
#include "ringlet/groom/lz4_block.h"

namespace ringlet {
namespace {

constexpr std::size_t kMostBlocks = 127;

// The signed number of so many bytes, 1, 2 or 4.
std::uint32_t signedAt(std::span<const std::byte> bytes, std::size_t offset, std::size_t size) {
  if (size == 4) return readU32(bytes, offset);
  std::uint32_t value = std::to_integer<std::uint32_t>(bytes[offset]);
  if (size == 1) return (value ^ 0x80u) - 0x80u;
  value |= std::to_integer<std::uint32_t>(bytes[offset + 1]) << 8;
  return (value ^ 0x8000u) - 0x8000u;
}

}  // namespace

std::optional<std::vector<std::byte>> unpackUsdc(std::span<const std::byte> packed, std::size_t mostBytes) {
  if (packed.empty()) return std::nullopt;
  std::vector<std::byte> bytes;
  const std::size_t count = std::to_integer<std::size_t>(packed.front());
  packed = packed.subspan(1);
  if (count == 0) {
    if (!appendLz4Block(packed, mostBytes, bytes)) return std::nullopt;
    return bytes;
  }
  if (count > kMostBlocks) return std::nullopt;
  for (std::size_t i = 0; i < count; ++i) {
    if (packed.size() < 4) return std::nullopt;
    const std::size_t size = readU32(packed, 0);
    packed = packed.subspan(4);
    if (size > packed.size()) return std::nullopt;
    if (!appendLz4Block(packed.first(size), mostBytes, bytes)) return std::nullopt;
    packed = packed.subspan(size);
  }
  return bytes;
}

std::optional<std::vector<std::int32_t>> unpackUsdcIntegers(std::span<const std::byte> packed,
                                                            std::size_t count) {
  std::vector<std::int32_t> values;
  if (count == 0) return values;
  const std::size_t codesEnd = 4 + count / 4 + (count % 4 > 0);
  const auto bytes = unpackUsdc(packed, codesEnd + 4 * count);
  if (!bytes || bytes->size() < codesEnd) return std::nullopt;

  values.reserve(count);
  const std::uint32_t common = readU32(*bytes, 0);
  std::uint32_t value = 0;
  std::size_t at = codesEnd;
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned code = std::to_integer<unsigned>((*bytes)[4 + i / 4]) >> (2 * (i % 4)) & 3;
    if (code == 0) {
      value += common;
    } else {
      const std::size_t size = std::size_t{1} << (code - 1);
      if (size > bytes->size() - at) return std::nullopt;
      value += signedAt(*bytes, at, size);
      at += size;
    }
    values.push_back(static_cast<std::int32_t>(value));
  }
  return values;
}

std::vector<std::byte> packUsdc(std::span<const std::byte> bytes) {
  std::vector<std::byte> packed{std::byte{0}};
  appendLz4Literals(bytes, packed);
  return packed;
}

std::vector<std::byte> packUsdcIntegers(std::span<const std::int32_t> values) {
  if (values.empty()) return {};
  std::vector<std::byte> bytes;
  appendU32(bytes, 0);  // the commonest difference, which is not used
  std::size_t codes = 2 * values.size();
  for (; codes >= 8; codes -= 8) bytes.push_back(std::byte{0xff});
  if (codes > 0) bytes.push_back(static_cast<std::byte>((1u << codes) - 1));
  std::uint32_t before = 0;
  for (const std::int32_t value : values) {
    appendU32(bytes, static_cast<std::uint32_t>(value) - before);
    before = static_cast<std::uint32_t>(value);
  }
  return packUsdc(bytes);
}

}  // namespace ringlet
