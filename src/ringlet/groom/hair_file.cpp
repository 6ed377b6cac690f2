// Implements groom/hair_file.h.
//
//   byte   0  "HAIR"; some programs write "hair"
//          4  u32 strand count
//          8  u32 point count
//         12  u32 flags
//         16  u32 default segments
//         20  f32 default thickness, transparency and colour, which we do not use
//         40  text
//        128  u16 segments[strands], f32 points[points][3], f32 thickness[points],
//             f32 transparency[points], f32 colours[points][3], each only if its flag is set
//
// A strand of s segments owns the next s + 1 points, root first.
#include "ringlet/groom/hair_file.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ringlet/base/little_endian.h"
#include "ringlet/base/quoted.h"
#include "ringlet/base/whole_file.h"
#include "ringlet/groom/groom_check.h"
#include "ringlet/groom/point_records.h"

namespace ringlet {
namespace {

constexpr std::string_view kMagic = "HAIR", kLowerMagic = "hair";
constexpr std::size_t kHeaderSize = 128;
constexpr std::size_t kStrandCountOffset = 4, kPointCountOffset = 8, kFlagsOffset = 12,
                      kDefaultSegmentsOffset = 16;
constexpr std::uint32_t kHasSegments = 1, kHasPoints = 2, kHasThickness = 4, kHasTransparency = 8,
                        kHasColours = 16;
constexpr std::uint32_t kKnownFlags = 31;
constexpr std::size_t kMostSegments = 65535;  // they are u16
constexpr std::uint64_t kPointSize = 12;

struct Header {
  std::uint32_t strandCount, pointCount, flags, defaultSegments;

  bool has(std::uint32_t flag) const { return (flags & flag) != 0; }
  // In 64 bits, where no count of the header can overflow it.
  std::uint64_t pointsOffset() const { return kHeaderSize + (has(kHasSegments) ? 2ull * strandCount : 0); }
  std::uint64_t coloursOffset() const {
    const std::uint64_t before = kPointSize + (has(kHasThickness) ? 4 : 0) + (has(kHasTransparency) ? 4 : 0);
    return pointsOffset() + before * pointCount;
  }
  std::uint64_t fileSize() const {
    return coloursOffset() + (has(kHasColours) ? kPointSize * pointCount : 0);
  }
};

std::string_view magicOf(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), kMagic.size()};
}

// What can be said before any array is read: the counts fit the flags and the file's real size.
Result<Header> readHeader(std::span<const std::byte> bytes, const std::string& name) {
  if (bytes.size() < kHeaderSize) {
    return Error{fmt::format("{}: at byte {}: the file ends here; expected a HAIR header of {} bytes", name,
                             bytes.size(), kHeaderSize)};
  }
  const std::string_view found = magicOf(bytes);
  if (found != kMagic && found != kLowerMagic) {
    return Error{fmt::format("{}: at byte 0: found {}; expected '{}'", name, quoted(found), kMagic)};
  }
  const Header header{readU32(bytes, kStrandCountOffset), readU32(bytes, kPointCountOffset),
                      readU32(bytes, kFlagsOffset), readU32(bytes, kDefaultSegmentsOffset)};
  if (!header.has(kHasPoints)) {
    return Error{fmt::format("{}: at byte {}: found flags {:#x}; expected bit 1, that the file has points",
                             name, kFlagsOffset, header.flags)};
  }
  if (header.strandCount == 0) {
    return Error{
        fmt::format("{}: at byte {}: found 0 strands; expected at least one", name, kStrandCountOffset)};
  }
  if (header.fileSize() > bytes.size()) {
    return Error{fmt::format(
        "{}: at byte {}: found {} strands, {} points and flags {:#x}, which need {} bytes; the file ends at "
        "byte {}",
        name, kStrandCountOffset, header.strandCount, header.pointCount, header.flags, header.fileSize(),
        bytes.size())};
  }

  // A product of two 32-bit counts, the second plus one, is below 2^64.
  const std::uint64_t uniform = header.strandCount * (std::uint64_t{header.defaultSegments} + 1);
  if (!header.has(kHasSegments) && uniform != header.pointCount) {
    return Error{fmt::format(
        "{}: at byte {}: found {} points; expected {}: {} strands of {} default segments", name,
        kPointCountOffset, header.pointCount, uniform, header.strandCount, header.defaultSegments)};
  }
  return header;
}

// How many points each strand owns. Their sum is the header's point count.
Result<std::vector<std::uint32_t>> readPointCounts(std::span<const std::byte> bytes, const Header& header,
                                                   const std::string& name) {
  if (!header.has(kHasSegments))
    return std::vector<std::uint32_t>(header.strandCount, header.defaultSegments + 1);
  std::vector<std::uint32_t> counts(header.strandCount);
  std::uint64_t sum = 0;
  for (std::size_t s = 0; s < counts.size(); ++s) {
    const std::size_t offset = kHeaderSize + 2 * s;
    counts[s] = readU16(bytes, offset) + 1;
    sum += counts[s];
    if (sum > header.pointCount) {
      return Error{fmt::format(
          "{}: at byte {}: found {} segments for strand {}, which makes {} points so far; expected {} in "
          "all, from byte {}",
          name, offset, counts[s] - 1, s, sum, header.pointCount, kPointCountOffset)};
    }
  }
  if (sum != header.pointCount) {
    return Error{
        fmt::format("{}: at byte {}: found {} points; expected {}, the sum of all strands' segments + 1",
                    name, kPointCountOffset, header.pointCount, sum)};
  }
  return counts;
}

// The points' colours as USD's displayColor, of the strands that the groom has.
void addColours(std::span<const std::byte> bytes, const Header& header, std::span<const std::uint32_t> counts,
                const std::vector<bool>& isKept, const std::string& name, LoadedGroom& loaded) {
  GroomValue colours{"primvars:displayColor", "color3f[]", "vertex", {}, {}};
  std::size_t offset = static_cast<std::size_t>(header.coloursOffset());
  for (std::size_t s = 0; s < counts.size(); ++s) {
    const std::uint32_t count = counts[s];
    for (std::size_t k = 0; isKept[s] && k < 3 * std::size_t{count}; ++k) {
      colours.numbers.push_back(readF32(bytes, offset + 4 * k));
      if (std::isfinite(colours.numbers.back())) continue;
      loaded.warnings.push_back(fmt::format(
          "{}: at byte {}: found a colour that is not finite; colours are left aside", name, offset + 4 * k));
      return;
    }
    offset += kPointSize * std::size_t{count};
  }
  GroomPrim prim;
  prim.strandCount = static_cast<std::uint32_t>(loaded.groom.strandCount());
  prim.values.push_back(std::move(colours));
  loaded.prims.push_back(std::move(prim));
}

}  // namespace

Result<LoadedGroom> readHair(std::span<const std::byte> bytes, const std::filesystem::path& path,
                             const GroomReading& reading) {
  const std::string name = path.string();
  const Result<Header> header = readHeader(bytes, name);
  if (!header) return header.error();
  const Result<std::vector<std::uint32_t>> counts = readPointCounts(bytes, *header, name);
  if (!counts) return counts.error();

  LoadedGroom loaded;
  Groom& groom = loaded.groom;
  groom.points.reserve(header->pointCount);
  groom.firstPoint.reserve(counts->size() + 1);
  std::size_t offset = static_cast<std::size_t>(header->pointsOffset());
  std::size_t tooShort = 0;
  LeftOutStrands leftOut;
  std::vector<bool> isKept(counts->size(), false);
  for (std::size_t s = 0; s < counts->size(); ++s) {
    // A strand of one point has no direction: nothing to simulate.
    const std::uint32_t count = (*counts)[s];
    if (count < 2) {
      offset += kPointSize;
      ++tooShort;
      continue;
    }
    isKept[s] = addStrandAt(bytes, {offset, kPointSize, count}, s, groom, leftOut);
    offset += kPointSize * std::size_t{count};
  }
  if (groom.strandCount() == 0 && leftOut.count > 0) return Error{fmt::format("{}: {}", name, leftOut.first)};
  if (groom.strandCount() == 0) {
    return Error{
        fmt::format("{}: none of the {} strands has two points; a strand needs two", name, counts->size())};
  }

  if (leftOut.count > 0) loaded.warnings.push_back(leftOut.warning(name, counts->size()));
  if (tooShort > 0) {
    loaded.warnings.push_back(
        fmt::format("{}: left out {} of {} strands, which have one point; a strand needs two", name, tooShort,
                    counts->size()));
  }
  if (reading.keepsPrims && header->has(kHasColours))
    addColours(bytes, *header, *counts, isKept, name, loaded);
  if (magicOf(bytes) == kLowerMagic) {
    loaded.warnings.push_back(
        fmt::format("{}: at byte 0: found '{}' for '{}'; read as the same", name, kLowerMagic, kMagic));
  }
  if (header->flags & ~kKnownFlags) {
    loaded.warnings.push_back(fmt::format("{}: at byte {}: flags {:#x} have unknown bits {:#x}; ignored",
                                          name, kFlagsOffset, header->flags, header->flags & ~kKnownFlags));
  }
  if (bytes.size() > header->fileSize()) {
    loaded.warnings.push_back(fmt::format("{}: {} bytes after the last array, from byte {} on; ignored", name,
                                          bytes.size() - header->fileSize(), header->fileSize()));
  }
  return loaded;
}

Status writeHair(const std::filesystem::path& path, const Groom& groom) {
  if (Status status = checkGroom(groom, groom.points, path); !status) return status;
  const std::size_t strandCount = groom.strandCount();
  std::vector<std::byte> bytes;
  bytes.reserve(kHeaderSize + 2 * strandCount + kPointSize * groom.points.size());

  // The header; default segments, thickness, transparency and colour as in the format's own code.
  for (char c : kMagic) bytes.push_back(static_cast<std::byte>(c));
  appendU32(bytes, static_cast<std::uint32_t>(strandCount));
  appendU32(bytes, static_cast<std::uint32_t>(groom.points.size()));
  appendU32(bytes, kHasSegments | kHasPoints);
  appendU32(bytes, 0);
  for (float value : {1.f, 0.f, 1.f, 1.f, 1.f}) appendF32(bytes, value);
  for (char c : std::string_view("Written by Ringlet")) bytes.push_back(static_cast<std::byte>(c));
  bytes.resize(kHeaderSize);

  for (std::size_t s = 0; s < strandCount; ++s) {
    const std::size_t segments = groom.strand(s).size() - 1;
    if (segments > kMostSegments) {
      return Error{fmt::format("{}: strand {} has {} segments; .hair holds {} at most, .obj any number",
                               path.string(), s, segments, kMostSegments)};
    }
    bytes.push_back(static_cast<std::byte>(segments & 0xff));
    bytes.push_back(static_cast<std::byte>(segments >> 8));
  }
  for (Vec3f p : groom.points) {
    for (float value : {p.x, p.y, p.z}) appendF32(bytes, value);
  }
  return writeWholeFile(path, bytes);
}

}  // namespace ringlet
