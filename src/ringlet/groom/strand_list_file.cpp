// Implements groom/strand_list_file.h.
//
//   i32 strand count; for each i32 point count, then f32[points][3] (.data) or f32[points][7] (.bin)
#include "ringlet/groom/strand_list_file.h"

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <string>

#include "ringlet/base/little_endian.h"
#include "ringlet/groom/point_records.h"

namespace ringlet {
namespace {

Result<LoadedGroom> readList(std::span<const std::byte> bytes, std::size_t stride,
                             const std::filesystem::path& path) {
  const std::string name = path.string();
  const auto ended = [&](std::size_t at, const std::string& what) {
    return Error{
        fmt::format("{}: at byte {}: the file ends at byte {}; expected {}", name, at, bytes.size(), what)};
  };
  if (bytes.size() < 4) return ended(0, "a count of strands");
  const std::uint32_t strandCount = readU32(bytes, 0);
  // In 64 bits, where no count overflows; a negative one is larger than any file.
  if (strandCount == 0)
    return Error{fmt::format("{}: at byte 0: found 0 strands; expected at least one", name)};
  if (std::uint64_t{4} * strandCount > bytes.size() - 4)
    return ended(0, fmt::format("{} strands, which its first number says", strandCount));

  LoadedGroom loaded;
  std::size_t at = 4, none = 0;
  LeftOutStrands leftOut;
  for (std::uint32_t s = 0; s < strandCount; ++s) {
    if (bytes.size() - at < 4) return ended(at, fmt::format("the points of strand {} of {}", s, strandCount));
    const std::uint32_t count = readU32(bytes, at);
    at += 4;
    if (count > (bytes.size() - at) / stride)
      return ended(at - 4, fmt::format("the {} points of strand {}", count, s));
    if (count < 2) {
      ++none;
    } else {
      if (count > std::numeric_limits<std::uint32_t>::max() - loaded.groom.points.size())
        return Error{fmt::format("{}: its strands have too many points; at most 2^32 - 1 can be read", name)};
      addStrandAt(bytes, {at, stride, count}, s, loaded.groom, leftOut);
    }
    at += stride * count;
  }
  if (loaded.groom.strandCount() == 0 && leftOut.count > 0)
    return Error{fmt::format("{}: {}", name, leftOut.first)};
  if (loaded.groom.strandCount() == 0) {
    return Error{
        fmt::format("{}: none of the {} strands has two points; a strand needs two", name, strandCount)};
  }
  if (leftOut.count > 0) loaded.warnings.push_back(leftOut.warning(name, strandCount));
  if (none > 0) {
    loaded.warnings.push_back(
        fmt::format("{}: left out {} of {} strands, which have no or one point: they stand for none", name,
                    none, strandCount));
  }
  if (at < bytes.size()) {
    loaded.warnings.push_back(fmt::format("{}: {} bytes after the last strand, from byte {} on; ignored",
                                          name, bytes.size() - at, at));
  }
  return loaded;
}

}  // namespace

Result<LoadedGroom> readStrandData(std::span<const std::byte> bytes, const std::filesystem::path& path) {
  return readList(bytes, 12, path);
}

Result<LoadedGroom> readStrandBin(std::span<const std::byte> bytes, const std::filesystem::path& path) {
  return readList(bytes, 28, path);
}

}  // namespace ringlet
