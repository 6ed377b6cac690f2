// The layout of a cache (.rgc): an animation of strands in few bytes, for what USD text is too large and too
// slow for. All numbers are little-endian.
//
//   header | chunk of strands | chunk of frame 1 | chunk of frame 2 | ... | chunk of the index | end
//
//   header  magic 8 | version u32 | precision u32 | up axis u32 | diameter f32 | frames per second f64 |
//           metres per unit f64 | 0 u32 | CRC-32 of the bytes before it u32
//   chunk   CRC-32 of all its other bytes u32 | kind u32 | number u32 | 0 u32 | stored bytes u64 |
//           error bound f64 [m] | the stored bytes
//   end     where the chunk of the index begins u64 | magic 8
//
//   kind      number            content
//   strands   how many          the particle count of each, u32
//   frame     which, from 1     points, see cache_frame.h
//   index     how many frames   of each: where its chunk begins u64, its error bound f64 [m]
//
// How large a content is follows from the number and the strands. Stored is either the content itself, where
// that is as large, or one zstd frame of it, never smaller than 1/256: what a reader allocates is then
// bounded by the size of the file, whatever the file says. A chunk is written at once and stands for itself,
// so a file that ends in the middle of one has lost that one; without index and end the chunks are found one
// by one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "ringlet/output/up_axis.h"

struct ZSTD_CCtx_s;  // zstd's, whose own header stays inside

namespace ringlet {

enum class CachePrecision : std::uint32_t {
  float32 = 0,  // every bit of every point
  bits16 = 1,   // 16 bits a coordinate, off by at most the error bound of the frame
};

/// What holds for all frames.
struct CacheHeader {
  CachePrecision precision = CachePrecision::float32;
  UpAxis up = UpAxis::y;
  float diameter = 0.05f;  // of every strand [file unit]
  double framesPerSecond = 24;
  double metresPerUnit = 0.01;  // unit of points and diameter
};

namespace cache {

// No text: the first byte is no letter, and whoever changes line ends changes this too (as PNG's).
inline constexpr std::string_view kMagic = "\x89RGC\r\n\x1a\n";
inline constexpr std::string_view kEndMagic = "RGCindex";
inline constexpr std::uint32_t kVersion = 1;
inline constexpr std::size_t kHeaderBytes = 48, kChunkHeaderBytes = 32, kEndBytes = 16;
inline constexpr std::size_t kIndexEntryBytes = 16;
inline constexpr std::uint64_t kMostExpansion = 256;  // content over stored bytes

enum class ChunkKind : std::uint32_t { strands = 1, frame = 2, index = 3 };

struct ChunkHeader {
  std::uint32_t checksum = 0;
  ChunkKind kind = ChunkKind::frame;
  std::uint32_t number = 0;
  std::uint64_t storedBytes = 0;
  double errorBound = 0;  // of a frame, else 0 [m]
};

std::vector<std::byte> headerBytes(const CacheHeader& header);

/// The header, from its kHeaderBytes bytes, or what is wrong with them, as "has version 7; ...".
struct ParsedHeader {
  std::optional<CacheHeader> header;
  std::string_view fault;
};
ParsedHeader parseHeader(std::span<const std::byte> bytes);

/// From the first kChunkHeaderBytes of a chunk; the checksum is not looked at.
ChunkHeader parseChunkHeader(std::span<const std::byte> bytes);

/// Makes chunks; keeps its memory from one to the next.
class ChunkPacker {
 public:
  ChunkPacker();

  /// The whole chunk, good until the next call. Cost: half a millisecond for the frame of 64,000 points.
  std::span<const std::byte> pack(ChunkKind kind, std::uint32_t number, double errorBound,
                                  std::span<const std::byte> content);

 private:
  struct Free {
    void operator()(ZSTD_CCtx_s* context) const;
  };
  std::unique_ptr<ZSTD_CCtx_s, Free> context_;
  std::vector<std::byte> chunk_;
};

/// Whether so many stored bytes can hold such a content: ask before memory for it is taken.
inline bool canHold(std::uint64_t storedBytes, std::uint64_t contentBytes) {
  return storedBytes <= contentBytes && contentBytes / kMostExpansion <= storedBytes;
}

/// The content of a whole chunk, whose header is `bytes`' own, into all of `content`; false if a byte is not
/// what was written.
bool unpack(std::span<const std::byte> bytes, std::span<std::byte> content);

}  // namespace cache
}  // namespace ringlet
