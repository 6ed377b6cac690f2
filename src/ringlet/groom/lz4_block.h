// LZ4 blocks, as USD crates hold them: bytes and repeats of bytes before them, without a frame or checksum.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace ringlet {

/// The most bytes that a block of `size` bytes can become.
inline std::size_t mostLz4Bytes(std::size_t size) { return 255 * size + 64; }

/// Appends what the block stands for; false where it is no LZ4 block, or would make `out` larger than
/// `mostBytes`. Memory is taken for what the block really has.
bool appendLz4Block(std::span<const std::byte> block, std::size_t mostBytes, std::vector<std::byte>& out);

/// Appends a block that stands for these bytes, by themselves: nothing is compressed.
void appendLz4Literals(std::span<const std::byte> bytes, std::vector<std::byte>& out);

}  // namespace ringlet
