// Implements motion/point_cache.h.
#include "ringlet/motion/point_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <new>
#include <string>
#include <string_view>

#include "ringlet/base/file_ending.h"
#include "ringlet/base/little_endian.h"
#include "ringlet/base/pc2_format.h"
#include "ringlet/base/whole_file.h"

namespace ringlet {
namespace {

constexpr std::size_t kMddHeaderBytes = 8;

std::uint32_t readBigU32(std::span<const std::byte> bytes, std::size_t offset) {
  const std::uint32_t little = readU32(bytes, offset);
  return little >> 24 | (little >> 8 & 0xff00) | (little << 8 & 0xff0000) | little << 24;
}
float readBigF32(std::span<const std::byte> bytes, std::size_t offset) {
  return std::bit_cast<float>(readBigU32(bytes, offset));
}

// Counts of a header whose points begin at `header`, one after the other until the file's end.
Status checkCounts(std::span<const std::byte> bytes, std::uint64_t header, std::uint32_t points,
                   std::uint32_t samples) {
  constexpr std::uint32_t kMost = 0x7fffffff;
  if (points < 1 || points > kMost || samples < 1 || samples > kMost)
    return Error{
        fmt::format("found {} samples of {} points; expected 1 to {} of each", samples, points, kMost)};
  const std::uint64_t perSample = std::uint64_t{points} * kPc2PointBytes;
  const bool fits = (bytes.size() - std::min<std::uint64_t>(header, bytes.size())) / perSample >= samples &&
                    bytes.size() >= header;
  if (!fits || bytes.size() != header + perSample * samples)
    return Error{fmt::format("found {} bytes; expected {}, for {} samples of {} points", bytes.size(),
                             static_cast<double>(header) + static_cast<double>(perSample) * samples, samples,
                             points)};
  return {};
}

template <class ReadNumber>
void takePoints(std::span<const std::byte> bytes, std::size_t header, std::size_t count, ReadNumber number,
                std::vector<Vec3f>& points) {
  points.reserve(count);
  for (std::size_t at = header; points.size() < count; at += kPc2PointBytes)
    points.push_back({number(bytes, at), number(bytes, at + 4), number(bytes, at + 8)});
}

Result<PointSamples> readPc2(std::span<const std::byte> bytes, double framesPerSecond) {
  if (bytes.size() < kPc2HeaderBytes || std::memcmp(bytes.data(), kPc2Magic.data(), kPc2Magic.size()) != 0)
    return Error{"found no PC2 header; expected one of 32 bytes that begins with 'POINTCACHE2'"};
  if (const std::uint32_t version = readU32(bytes, 12); version != 1)
    return Error{fmt::format("found version {}; expected 1", version)};
  const std::uint32_t pointCount = readU32(bytes, 16), sampleCount = readU32(bytes, kPc2CountAt);
  const double rate = readF32(bytes, kPc2RateAt);
  if (!(rate > 0 && rate <= 1e6))
    return Error{fmt::format("found {} frames a sample; expected more than 0", rate)};
  if (Status checked = checkCounts(bytes, kPc2HeaderBytes, pointCount, sampleCount); !checked)
    return checked.error();
  PointSamples samples{.pointCount = pointCount};
  for (std::uint32_t k = 0; k < sampleCount; ++k) samples.seconds.push_back(k * rate / framesPerSecond);
  takePoints(bytes, kPc2HeaderBytes, std::size_t{pointCount} * sampleCount, readF32, samples.points);
  return samples;
}

Result<PointSamples> readMdd(std::span<const std::byte> bytes) {
  if (bytes.size() < kMddHeaderBytes)
    return Error{fmt::format("found {} bytes; expected an MDD header of 8", bytes.size())};
  const std::uint32_t sampleCount = readBigU32(bytes, 0), pointCount = readBigU32(bytes, 4);
  const std::uint64_t header = kMddHeaderBytes + std::uint64_t{4} * sampleCount;
  if (Status checked = checkCounts(bytes, header, pointCount, sampleCount); !checked) return checked.error();
  PointSamples samples{.pointCount = pointCount};
  for (std::uint32_t k = 0; k < sampleCount; ++k)
    samples.seconds.push_back(readBigF32(bytes, kMddHeaderBytes + std::size_t{4} * k));
  takePoints(bytes, header, std::size_t{pointCount} * sampleCount, readBigF32, samples.points);
  return samples;
}

}  // namespace

bool isPointCache(const std::filesystem::path& path) {
  const std::string ending = endingOf(path);
  return ending == ".pc2" || ending == ".mdd";
}

Result<PointSamples> readPointCache(std::span<const std::byte> bytes, const std::filesystem::path& path,
                                    double framesPerSecond) {
  auto samples = endingOf(path) == ".mdd" ? readMdd(bytes) : readPc2(bytes, framesPerSecond);
  if (!samples) return Error{fmt::format("{}: {}", path.string(), samples.error().message)};
  return samples;
}

Result<PointSamples> readPointCache(const std::filesystem::path& path, double framesPerSecond) {
  try {
    const auto bytes = readWholeFile(path);
    if (!bytes) return bytes.error();
    return readPointCache(*bytes, path, framesPerSecond);
  } catch (const std::bad_alloc&) {
    return Error{fmt::format("{}: reading it needs more memory than there is", path.string()),
                 Fault::hostMemory};
  }
}

}  // namespace ringlet
