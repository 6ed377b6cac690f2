// Implements output/frame_reader.h.
#include "ringlet/output/frame_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ringlet/base/little_endian.h"

namespace ringlet {
Error FrameReader::wrong(const std::string& what) const {
  return Error{
      fmt::format("{}: {}; only animations that Ringlet wrote can be read", file_.path().string(), what)};
}

Error FrameReader::damaged(int frame, const char* what) const {
  return Error{fmt::format("{}: frame {} is damaged: {}", file_.path().string(), frame, what)};
}

Result<std::vector<std::byte>> FrameReader::read(std::uint64_t at, std::uint64_t count) {
  std::vector<std::byte> bytes;
  if (!file_.has(at, count)) return wrong(fmt::format("has no bytes {} to {}", at, at + count));
  if (Status read = file_.readAt(at, count, bytes); !read) return read.error();
  return bytes;
}

Status FrameReader::takeMeasures(double rate, double unit, UpAxis up, const char* names) {
  framesPerSecond_ = rate;
  metresPerUnit_ = unit;
  up_ = up;
  if (!(rate > 0) || !(unit > 0) || !std::isfinite(rate + unit))
    return wrong(fmt::format("has no {} above 0", names));
  return {};
}

Status FrameReader::addStrand(double particles) {
  if (!(particles >= 1 && particles <= 1e9))
    return wrong(fmt::format("has a strand of {} particles", particles));
  const std::uint64_t total = firstPoint_.back() + static_cast<std::uint64_t>(particles);
  if (total > std::numeric_limits<std::uint32_t>::max()) return wrong("has more than 2^32 - 1 particles");
  firstPoint_.push_back(static_cast<std::uint32_t>(total));
  return {};
}

Status FrameReader::takeDiameter(std::optional<double> diameter) {
  if (firstPoint_.size() == 1) return wrong("has no strands");
  diameter_ = static_cast<float>(diameter.value_or(kUsualWidth / metresPerUnit_));
  if (!(diameter_ > 0) || !std::isfinite(diameter_)) return wrong("has no widths above 0");
  return {};
}

void FrameReader::takeFrameCount(std::size_t count) {
  const int stated = static_cast<int>(std::min<std::size_t>(count, std::numeric_limits<std::int32_t>::max()));
  std::vector<Vec3f> points;
  for (frameCount_ = stated; frameCount_ > 0; --frameCount_) {
    if (readFrame(frameCount_, points)) break;
  }
  if (frameCount_ < stated)
    warnings_.push_back(
        fmt::format("its end is torn and left out, after {} whole frames of {}", frameCount_, stated));
}

Status FrameReader::addPoints(int frame, std::span<const std::byte> bytes,
                              const std::optional<UsdTransform>& head, std::vector<Vec3f>& points) const {
  for (std::size_t at = 0; at + kPointBytes <= bytes.size(); at += kPointBytes) {
    Vec3f p{readF32(bytes, at), readF32(bytes, at + 4), readF32(bytes, at + 8)};
    if (head) p = Vec3f((*head)(Vec3d(p)));
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      return damaged(frame, "a point is not finite");
    points.push_back(p);
  }
  return {};
}

UsdTransform FrameReader::transformOf(std::span<const std::byte> matrix) {
  const auto row = [&](std::size_t i) {
    return Vec3d{readF64(matrix, 32 * i), readF64(matrix, 32 * i + 8), readF64(matrix, 32 * i + 16)};
  };
  return {{row(0), row(1), row(2)}, row(3)};
}

}  // namespace ringlet
