// Implements frame_sink.h.
#include "ringlet/run/frame_sink.h"

#include <utility>

#include "ringlet/base/stopwatch.h"
#include "ringlet/output/finite_points.h"

namespace ringlet {
namespace {

// Frames that may wait to be written: enough that a slow one delays nobody, few enough to save memory.
constexpr std::size_t kRoom = 4;

// Converts from the solver's coordinates (metres, relative to the head's origin) to the file's.
std::vector<Vec3f> toFile(std::span<const Vec3f> positions, const HeadPose& head, double metresPerUnit) {
  std::vector<Vec3f> points(positions.begin(), positions.end());  // converted in place, since memory is the
                                                                  // main cost
  for (Vec3f& point : points) point = Vec3f((head.position + Vec3d(point)) / metresPerUnit);
  return points;
}

}  // namespace

FrameSink::FrameSink(const Groom& groom, FrameReaders readers)
    : groom_(groom), readers_(std::move(readers)), thread_(kRoom) {}

Status FrameSink::hand(ComputedFrame frame) {
  return thread_.hand([this, frame = std::move(frame)]() mutable { return take(std::move(frame)); });
}

std::vector<Vec3f> FrameSink::takeRoom() {
  const std::lock_guard lock(roomMutex_);
  return std::exchange(room_, {});
}

Status FrameSink::finish() {
  if (Status shown = thread_.hand([this] { return isShown_ ? Status{} : show(); }); !shown) return shown;
  return thread_.finish();
}

void FrameSink::archive(Archive& archive) {
  int frameCount = frameCount_;
  archive.value(frameCount);
  frameCount_ = frameCount;
  archive.value(mostReplaced_);
  if (readers_.bodies) readers_.bodies->archive(archive);
}

Status FrameSink::take(ComputedFrame frame) {
  if (readers_.bodies) {
    Stopwatch watch(watching_);
    const std::vector<std::span<const Vec3d>> points(frame.points.begin(), frame.points.end());
    readers_.bodies->look(frame.positions, frame.head, frame.bodies, points);
  }
  std::swap(last_, frame);
  isShown_ = false;
  {
    const std::lock_guard lock(roomMutex_);
    room_ = std::move(frame.positions);
  }
  const bool canWait = readers_.needLastOnly && areFinite(last_.positions);
  if (Status shown = canWait ? Status{} : show(); !shown) return shown;
  ++frameCount_;
  return {};
}

Status FrameSink::show() {
  Stopwatch watch(writing_);
  std::vector<Vec3f> points = toFile(last_.positions, last_.head, groom_.metresPerUnit);
  mostReplaced_ = std::max(mostReplaced_, replaceNonfinite(groom_, points));
  if (readers_.observe) {
    if (Status seen = readers_.observe(last_, points); !seen) return seen;
  }
  if (readers_.write) {
    if (Status written = readers_.write(last_.number, std::move(points), last_); !written) return written;
  }
  isShown_ = true;
  return {};
}

}  // namespace ringlet
