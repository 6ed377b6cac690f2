// Implements output/usd/usdc_writer.h. Where everything stands is drawn in usdc_head.h.
//
// A frame's bytes come first, behind the last frame's. Then eight bytes of the head for each attribute that
// moves lead to them, where "None" stood; the points' last, which is what makes a frame one. Those eight
// bytes are within a page: a kill leaves such a write whole or undone (ByteFile).
#include "ringlet/output/usd/usdc_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

#include "ringlet/base/assert.h"
#include "ringlet/base/bounds.h"
#include "ringlet/base/little_endian.h"
#include "ringlet/base/text_of.h"
#include "ringlet/output/partial_frames.h"

namespace ringlet {
namespace {

std::span<const std::byte> bytesOf(std::string_view text) { return std::as_bytes(std::span(text)); }

// Numbers of a file over bytes that are there.
void putU64(char* at, std::uint64_t value) {
  for (int i = 0; i < 8; ++i) at[i] = static_cast<char>(value >> (8 * i) & 0xff);
}
void putVectors(char* at, std::span<const Vec3f> values) {
  static_assert(sizeof(Vec3f) == 12, "a point is three floats");
  if constexpr (std::endian::native == std::endian::little) {
    std::memcpy(at, values.data(), values.size_bytes());
  } else {
    for (const Vec3f v : values) {
      for (const float number : {v.x, v.y, v.z}) {
        const auto bits = std::bit_cast<std::uint32_t>(number);
        for (int i = 0; i < 4; ++i) *at++ = static_cast<char>(bits >> (8 * i) & 0xff);
      }
    }
  }
}

// An array of so many vectors, in its place among a frame's bytes.
void putArray(std::span<const Vec3f> values, const UsdcSamples& samples, std::string& frame) {
  putU64(frame.data() + samples.slot, values.size());
  putVectors(frame.data() + samples.slot + 8, values);
}
// Rows, and where the origin goes: points are rows as well.
void putMatrix(const UsdTransform& transform, char* at) {
  const auto put = [&](Vec3d row, double last) {
    for (const double number : {row.x, row.y, row.z, last}) {
      putU64(at, std::bit_cast<std::uint64_t>(number));
      at += 8;
    }
  };
  for (const Vec3d row : transform.rows) put(row, 0);
  put(transform.move, 1);
}

}  // namespace

UsdcWriter::UsdcWriter(ByteFile file, const std::filesystem::path& path, const Groom& topology,
                       const AnimationOptions& options)
    : file_(std::move(file)),
      path_(path),
      firstPoint_(topology.firstPoint),
      options_(options),
      points_(options) {
  RINGLET_ASSERT(options.frameCount >= 1, "at least one frame will come");
  HairStage made = hairStageOf(topology, options);
  curves_ = std::move(made.curves);
  head_ = usdcHeadOf(made.stage);
}

Result<UsdcWriter> UsdcWriter::create(const std::filesystem::path& path, const Groom& topology,
                                      const AnimationOptions& options) {
  auto file = createPartial(path);
  if (!file) return file.error();
  UsdcWriter writer(std::move(*file), path, topology, options);
  if (Status written = writer.file_.writeAt(0, textOf(writer.head_.bytes)); !written) return written.error();
  return writer;
}

Result<UsdcWriter> UsdcWriter::resume(const std::filesystem::path& path, const Groom& topology,
                                      const AnimationOptions& options, int frameCount) {
  if (frameCount == 0) return create(path, topology, options);
  RINGLET_ASSERT(frameCount <= options.frameCount, "more frames than announced");
  auto file = openPartial(path);
  if (!file) return file.error();
  UsdcWriter writer(std::move(*file), path, topology, options);
  writer.frameCount_ = frameCount;  // what is refused stays as it is
  const auto isOurs = writer.isOurs(frameCount);
  if (!isOurs) return isOurs.error();
  if (!*isOurs) return cannotGoOn(writer.file_, frameCount);
  if (options.usd.velocities) {
    std::vector<Vec3f> last, beforeLast;
    if (Status read = writer.readBack(frameCount, last); !read) return read.error();
    if (frameCount > 1) {
      if (Status read = writer.readBack(frameCount - 1, beforeLast); !read) return read.error();
    }
    writer.points_.resume(std::move(beforeLast), std::move(last));
  }
  if (Status renamed = writer.file_.rename(path.string() + ".partial"); !renamed) return renamed.error();
  if (Status cut = writer.cutAfter(frameCount); !cut) return cut.error();
  return writer;
}

UsdcWriter::~UsdcWriter() { removeWithoutFrames(file_, static_cast<std::size_t>(frameCount_)); }

UsdcWriter::Moving UsdcWriter::movingOf(const HairCurves& curves) const {
  Moving moving;
  for (const UsdcSamples& samples : head_.samples) {
    const auto isCalled = [&](const char* name) { return samples.path == curves.path + "." + name; };
    if (isCalled(kUsdPoints)) moving.points = &samples;
    if (isCalled(kUsdExtent)) moving.extent = &samples;
    if (isCalled(kUsdVelocities)) moving.velocities = &samples;
    if (isCalled(kUsdHead)) moving.head = &samples;
  }
  return moving;
}

// What comes later of the last frame is not there yet.
std::uint64_t UsdcWriter::endOf(int frame) const {
  if (frame == 0) return head_.bytes.size();
  return head_.bytes.size() + static_cast<std::uint64_t>(frame - 1) * head_.frameBytes + head_.earlyBytes;
}

Status UsdcWriter::addFrame(std::span<const Vec3f> points, const UsdTransform& head) {
  RINGLET_ASSERT(points.size() == firstPoint_.back(), "one point per particle of the groom");
  RINGLET_ASSERT(frameCount_ < options_.frameCount, "more frames than announced");
  if (Status written = writeFrame(points, head); !written) return keepFinishedFrames(written.error());
  points_.keep();
  return {};
}

Status UsdcWriter::writeFrame(std::span<const Vec3f> points, const UsdTransform& head) {
  const int frame = frameCount_ + 1;
  points_.take(points, head);
  for (const HairCurves& curves : curves_) {
    if (!curves.fromGroom) continue;
    const std::uint32_t first = firstPoint_[curves.firstStrand],
                        end = firstPoint_[curves.firstStrand + curves.strandCount];
    for (Vec3f& point : std::span(points_.now()).subspan(first, end - first))
      point = Vec3f((*curves.fromGroom)(Vec3d(point)));
  }
  buffer_.assign(head_.earlyBytes, '\0');
  for (const HairCurves& curves : curves_) putCurves(curves, head);
  if (Status written = file_.writeAt(head_.placeOf(frame, {}), buffer_); !written) return written;
  if (options_.usd.velocities && frame > 1) {
    if (Status written = writeVelocities(frame - 1, points_.velocitiesOfLast()); !written) return written;
  }

  // From now on it holds.
  if (Status led = leadTo(frame, false); !led) return led;
  if (frame > 1) {
    if (Status led = leadTo(frame - 1, true); !led) return led;
  }
  frameCount_ = frame;
  return writeEndTimeCode();
}

// Into the frame's bytes: what a prim has of it.
void UsdcWriter::putCurves(const HairCurves& curves, const UsdTransform& head) {
  const std::uint32_t first = firstPoint_[curves.firstStrand],
                      end = firstPoint_[curves.firstStrand + curves.strandCount];
  const std::span<const Vec3f> points = std::span(points_.now()).subspan(first, end - first);
  const Bounds bounds = boundsOf(points);
  const Vec3f low(bounds.low), high(bounds.high), margin{curves.margin, curves.margin, curves.margin};
  const std::array<Vec3f, 2> extent{low - margin, high + margin};

  const Moving moving = movingOf(curves);
  putArray(points, *moving.points, buffer_);
  putArray(extent, *moving.extent, buffer_);
  if (moving.head) putMatrix(head, buffer_.data() + moving.head->slot);
}

Status UsdcWriter::writeVelocities(int frame, std::span<const Vec3f> velocities) {
  std::string bytes(head_.frameBytes, '\0');
  for (const HairCurves& curves : curves_) {
    const std::uint32_t first = firstPoint_[curves.firstStrand],
                        end = firstPoint_[curves.firstStrand + curves.strandCount];
    const UsdcSamples* samples = movingOf(curves).velocities;
    if (samples) putArray(velocities.subspan(first, end - first), *samples, bytes);
  }
  return file_.writeAt(endOf(frame), std::string_view(bytes).substr(head_.earlyBytes));
}

// The head leads to what the frame has, that which comes later or all else; points last.
Status UsdcWriter::leadTo(int frame, bool later) {
  const auto lead = [&](const UsdcSamples& samples) {
    return writeU64(samples.repsAt + 8 * static_cast<std::uint64_t>(frame - 1),
                    head_.repOf(frame, samples).bits);
  };
  for (const bool isPoints : {false, true}) {
    for (const UsdcSamples& samples : head_.samples) {
      if (samples.comesLater != later || samples.path.ends_with(std::string(".") + kUsdPoints) != isPoints)
        continue;
      if (Status led = lead(samples); !led) return led;
    }
  }
  return {};
}

// Frames after it have no value, as at the beginning, nor has what comes later of it.
Status UsdcWriter::forgetAfter(int frame) {
  for (const UsdcSamples& samples : head_.samples) {
    const int kept = samples.comesLater ? frame - 1 : frame;
    std::vector<std::byte> blocks;
    for (int i = std::max(kept, 0); i < options_.frameCount; ++i) appendU64(blocks, usdc::kBlock.bits);
    const std::uint64_t at = samples.repsAt + 8 * static_cast<std::uint64_t>(std::max(kept, 0));
    if (Status written = file_.writeAt(at, textOf(blocks)); !written) return written;
  }
  return {};
}

Status UsdcWriter::writeCounts(int frames) {
  for (const UsdcSamples& samples : head_.samples) {
    if (Status written = writeU64(samples.countAt, static_cast<std::uint64_t>(frames)); !written)
      return written;
  }
  return writeU64(head_.timeCountAt, static_cast<std::uint64_t>(frames));
}

Status UsdcWriter::writeEndTimeCode() {
  return writeU64(head_.endTimeCodeAt,
                  std::bit_cast<std::uint64_t>(double(options_.usd.firstTimeCode - 1 + frameCount_)));
}

Status UsdcWriter::writeU64(std::uint64_t at, std::uint64_t value) {
  char bytes[8];
  putU64(bytes, value);
  return file_.writeAt(at, {bytes, sizeof bytes});
}

Status UsdcWriter::cutAfter(int frame) {
  if (Status done = writeCounts(options_.frameCount); !done) return done;
  if (Status done = forgetAfter(frame); !done) return done;
  if (Status done = writeEndTimeCode(); !done) return done;
  return file_.truncate(endOf(frame));
}

// The head as it would be, but for what was written into it since; and so many frames behind it.
Result<bool> UsdcWriter::isOurs(int frames) const {
  const auto found = file_.readAt(0, head_.bytes.size());
  if (!found) return found.error();
  if (found->size() != head_.bytes.size()) return false;
  std::string blank = *found;
  const auto forget = [&](std::uint64_t at, std::uint64_t count) {
    blank.replace(at, count, textOf(head_.bytes), at, count);
  };
  forget(head_.endTimeCodeAt, 8);
  forget(head_.timeCountAt, 8);
  for (const UsdcSamples& samples : head_.samples) {
    forget(samples.countAt, 8);
    forget(samples.repsAt, 8 * static_cast<std::uint64_t>(options_.frameCount));
    for (int frame = 1; frame <= frames - (samples.comesLater ? 1 : 0); ++frame) {
      const std::uint64_t at = samples.repsAt + 8 * static_cast<std::uint64_t>(frame - 1);
      if (readU64(bytesOf(*found), at) != head_.repOf(frame, samples).bits) return false;
    }
  }
  if (blank != textOf(head_.bytes)) return false;
  const auto lastByte = file_.readAt(endOf(frames) - 1, 1);
  if (!lastByte) return lastByte.error();
  return !lastByte->empty();
}

Status UsdcWriter::readBack(int frame, std::vector<Vec3f>& points) const {
  points.clear();
  for (const HairCurves& curves : curves_) {
    const UsdcSamples& samples = *movingOf(curves).points;
    const auto bytes = file_.readAt(head_.placeOf(frame, samples) + 8, 12 * samples.elements);
    if (!bytes) return bytes.error();
    RINGLET_ASSERT(bytes->size() == 12 * samples.elements, "isOurs saw that it is there");
    for (std::size_t i = 0; i < samples.elements; ++i) {
      const auto number = [&](std::size_t axis) { return readF32(bytesOf(*bytes), 12 * i + 4 * axis); };
      points.push_back({number(0), number(1), number(2)});
    }
  }
  return {};
}

Error UsdcWriter::keepFinishedFrames(const Error& cause) {
  // Nothing leads behind the end any more; where it cannot be cut off it does not matter.
  (void)forgetAfter(frameCount_);
  (void)file_.truncate(endOf(frameCount_));
  return framesKept(cause, static_cast<std::size_t>(frameCount_), file_);
}

Status UsdcWriter::finish() {
  RINGLET_ASSERT(frameCount_ > 0, "a file without frames is not finished but dropped");
  if (options_.usd.velocities) {
    if (Status written = writeVelocities(frameCount_, points_.velocitiesAtEnd()); !written) return written;
    if (Status led = leadTo(frameCount_, true); !led) return led;
  }
  if (frameCount_ < options_.frameCount) {
    if (Status written = writeCounts(frameCount_); !written) return written;
  }
  return file_.closeAs(path_);
}

}  // namespace ringlet
