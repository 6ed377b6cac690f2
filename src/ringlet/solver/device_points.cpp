// Implements solver/device_points.h.
#include "ringlet/solver/device_points.h"

#include <fmt/format.h>

#include <cstring>

#include "ringlet/gpu/buffer.h"
#include "ringlet/gpu/recorder.h"

namespace ringlet {
namespace {

constexpr std::uint32_t kPointBytes = 3 * sizeof(float), kMostStride = 1024;

Status check(const DevicePoints& points, std::size_t which) {
  if (!points.buffer) return Error{fmt::format("buffer {} of points is none", which)};
  if (points.offset % 4 != 0 || points.stride % 4 != 0 || points.stride < kPointBytes ||
      points.stride > kMostStride)
    return Error{fmt::format(
        "buffer {} of points begins at byte {}, with {} bytes from a point to the next; expected multiples of 4, and "
        "{} to {} bytes a point",
        which, points.offset, points.stride, kPointBytes, kMostStride)};
  return {};
}

std::uint64_t bytesOf(const DevicePoints& points) {
  return points.count == 0 ? 0 : std::uint64_t{points.stride} * (points.count - 1) + kPointBytes;
}

std::vector<Vec3d> pointsIn(std::span<const std::byte> bytes, const DevicePoints& points) {
  std::vector<Vec3d> found;
  found.reserve(points.count);
  for (std::size_t i = 0; i < points.count; ++i) {
    float xyz[3];
    std::memcpy(xyz, bytes.data() + i * points.stride, sizeof(xyz));
    found.push_back({xyz[0], xyz[1], xyz[2]});
  }
  return found;
}

}  // namespace

Result<std::vector<std::vector<Vec3d>>> readPoints(const ComputeDevice& device,
                                                   std::span<const DevicePoints> buffers) {
  if (Status here = device.checkProcess(); !here) return here.error();
  std::uint64_t bytes = 0;
  for (std::size_t b = 0; b < buffers.size(); ++b) {
    if (Status fine = check(buffers[b], b); !fine) return fine.error();
    bytes += bytesOf(buffers[b]);
  }
  auto copy = gpu::Buffer::create(device.gpu(), bytes, gpu::BufferKind::stream, "points of bodies that bend");
  if (!copy) return copy.error();
  auto recorder = gpu::Recorder::create(device.gpu(), "points of a host");
  if (!recorder) return recorder.error();
  if (Status begun = recorder->begin(); !begun) return begun.error();
  recorder->barrier();
  std::uint64_t at = 0;
  for (const DevicePoints& points : buffers) {
    recorder->copyFromHost(points.buffer, points.offset, *copy, bytesOf(points), at);
    at += bytesOf(points);
  }
  if (Status done = recorder->submitAndWait(); !done) return done.error();
  std::vector<std::vector<Vec3d>> all;
  at = 0;
  for (const DevicePoints& points : buffers) {
    all.push_back(pointsIn(copy->mapped().subspan(at, bytesOf(points)), points));
    at += bytesOf(points);
  }
  return all;
}

}  // namespace ringlet
