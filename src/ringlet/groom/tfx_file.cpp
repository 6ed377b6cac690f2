// Implements groom/tfx_file.h.
//
//   byte   0  f32 version, 4.0
//          4  u32 strand count
//          8  u32 points in every strand
//         12  u32 where the positions begin, from the start of the file
//         16  u32 likewise a strand's texture coordinates, 20 a point's, 24 a strand's thickness, 28 a
//         point's
//             colour, none of which we use; 0 where the file has none
//         32  u32[32] reserved
//        160  the arrays, in any order; positions are f32[strands][points][4], root first: x, y, z, w
#include "ringlet/groom/tfx_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "ringlet/base/little_endian.h"
#include "ringlet/groom/point_records.h"

namespace ringlet {
namespace {

constexpr std::size_t kTfxHeaderSize = 160;
constexpr std::size_t kTfxStrandCountOffset = 4, kPointsPerStrandOffset = 8, kPositionsOffset = 12,
                      kFirstOtherOffset = 16, kReservedOffset = 32;
constexpr std::uint64_t kTfxPointSize = 16;
constexpr float kTfxVersion = 4;
constexpr std::uint32_t kMostPoints = 65536;  // in a strand; also what our generators allow

struct TfxHeader {
  float version;
  std::uint32_t strandCount, pointsPerStrand, positions;
  bool hasOtherArrays;

  // In 64 bits, where no two counts of the header can overflow it: 2^32 strands of 2^16 points of 2^4 bytes.
  std::uint64_t pointCount() const { return std::uint64_t{strandCount} * pointsPerStrand; }
  std::uint64_t positionsEnd() const { return positions + kTfxPointSize * pointCount(); }
};

// What can be said before any position is read: the counts fit the file's real size.
Result<TfxHeader> readTfxHeader(std::span<const std::byte> bytes, const std::string& name) {
  if (bytes.size() < kTfxHeaderSize) {
    return Error{fmt::format("{}: at byte {}: the file ends here; expected a TressFX header of {} bytes",
                             name, bytes.size(), kTfxHeaderSize)};
  }
  TfxHeader header{readF32(bytes, 0), readU32(bytes, kTfxStrandCountOffset),
                   readU32(bytes, kPointsPerStrandOffset), readU32(bytes, kPositionsOffset), false};
  for (std::size_t offset = kFirstOtherOffset; offset < kReservedOffset; offset += 4)
    header.hasOtherArrays |= readU32(bytes, offset) != 0;

  if (!(header.version >= kTfxVersion && header.version < kTfxVersion + 1)) {
    return Error{fmt::format(
        "{}: at byte 0: found version {}; expected {:.1f}: no TressFX 4 file, or one of an older TressFX, to "
        "be exported anew",
        name, header.version, kTfxVersion)};
  }
  if (header.strandCount == 0) {
    return Error{
        fmt::format("{}: at byte {}: found 0 strands; expected at least one", name, kTfxStrandCountOffset)};
  }
  if (header.pointsPerStrand < 2 || header.pointsPerStrand > kMostPoints) {
    return Error{fmt::format("{}: at byte {}: found {} points in every strand; expected 2 to {}", name,
                             kPointsPerStrandOffset, header.pointsPerStrand, kMostPoints)};
  }
  if (header.positions < kTfxHeaderSize) {
    return Error{
        fmt::format("{}: at byte {}: found positions at byte {}; expected {} or later, after the header",
                    name, kPositionsOffset, header.positions, kTfxHeaderSize)};
  }
  if (header.positionsEnd() > bytes.size()) {
    return Error{fmt::format(
        "{}: at byte {}: found {} strands of {} points with positions at byte {}, which end at byte {}; the "
        "file ends at byte {}",
        name, kTfxStrandCountOffset, header.strandCount, header.pointsPerStrand, header.positions,
        header.positionsEnd(), bytes.size())};
  }
  if (header.pointCount() > std::numeric_limits<std::uint32_t>::max()) {
    return Error{fmt::format("{}: its strands have {} particles; at most 2^32 - 1 can be read", name,
                             header.pointCount())};
  }
  return header;
}

bool isInOnePlace(std::span<const Vec3f> strand) {
  return std::ranges::all_of(strand, [&](Vec3f p) { return p == strand.front(); });
}

}  // namespace

Result<LoadedGroom> readTfx(std::span<const std::byte> bytes, const std::filesystem::path& path) {
  const std::string name = path.string();
  const Result<TfxHeader> header = readTfxHeader(bytes, name);
  if (!header) return header.error();

  LoadedGroom loaded;
  Groom& groom = loaded.groom;
  groom.points.reserve(header->pointCount());
  groom.firstPoint.reserve(std::size_t{header->strandCount} + 1);
  std::size_t offset = header->positions;
  LeftOutStrands leftOut;
  for (std::uint32_t s = 0; s < header->strandCount; ++s) {
    addStrandAt(bytes, {offset, kTfxPointSize, header->pointsPerStrand}, s, groom, leftOut);
    offset += kTfxPointSize * std::size_t{header->pointsPerStrand};
  }

  // What fills up the count has no length; a strand like that between others is the artist's affair.
  while (groom.strandCount() > 0 && isInOnePlace(groom.strand(groom.strandCount() - 1))) {
    groom.firstPoint.pop_back();
    groom.points.resize(groom.firstPoint.back());
  }
  if (groom.strandCount() == 0 && leftOut.count > 0) return Error{fmt::format("{}: {}", name, leftOut.first)};
  if (groom.strandCount() == 0) {
    return Error{fmt::format(
        "{}: each of the {} strands has all its points in one place; expected strands with a length", name,
        header->strandCount)};
  }

  if (leftOut.count > 0) loaded.warnings.push_back(leftOut.warning(name, header->strandCount));
  if (const std::size_t left = header->strandCount - leftOut.count - groom.strandCount(); left > 0) {
    loaded.warnings.push_back(fmt::format(
        "{}: left out the last {} of {} strands, whose points are all in one place: they fill up the count",
        name, left, header->strandCount));
  }
  if (header->version != kTfxVersion) {
    loaded.warnings.push_back(
        fmt::format("{}: at byte 0: found version {}; read as {:.1f}", name, header->version, kTfxVersion));
  }
  if (!header->hasOtherArrays && bytes.size() > header->positionsEnd()) {
    loaded.warnings.push_back(fmt::format("{}: {} bytes after the last array, from byte {} on; ignored", name,
                                          bytes.size() - header->positionsEnd(), header->positionsEnd()));
  }
  return loaded;
}

}  // namespace ringlet
