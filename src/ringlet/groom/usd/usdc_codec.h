// How USD crates compress, both ways: LZ4 blocks behind a byte, and integers as differences of few bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace ringlet {

/// The bytes that compressed ones stand for, `mostBytes` at most; nothing where they are no such.
std::optional<std::vector<std::byte>> unpackUsdc(std::span<const std::byte> packed, std::size_t mostBytes);

/// `count` integers, unsigned ones as their bits. Nothing where the bytes do not hold as many. Memory: 5
/// bytes an integer beside the result, and nothing for a count that so few bytes cannot hold: the caller
/// bounds it.
std::optional<std::vector<std::int32_t>> unpackUsdcIntegers(std::span<const std::byte> packed,
                                                            std::size_t count);

/// What unpacks to these: blocks of bytes by themselves, every difference in 32 bits. Nothing is compressed.
std::vector<std::byte> packUsdc(std::span<const std::byte> bytes);
std::vector<std::byte> packUsdcIntegers(std::span<const std::int32_t> values);

}  // namespace ringlet
