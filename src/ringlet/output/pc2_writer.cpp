// Implements output/pc2_writer.h.
#include "ringlet/output/pc2_writer.h"

#include <fmt/format.h>

#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "ringlet/base/assert.h"
#include "ringlet/base/little_endian.h"
#include "ringlet/base/pc2_format.h"
#include "ringlet/base/text_of.h"
#include "ringlet/groom/obj_file.h"
#include "ringlet/output/partial_frames.h"

namespace ringlet {
namespace {

std::vector<std::byte> headerOf(const Groom& topology, int frames) {
  std::vector<std::byte> bytes;
  for (const char c : kPc2Magic) bytes.push_back(static_cast<std::byte>(c));
  appendU32(bytes, 1);
  appendU32(bytes, topology.firstPoint.back());
  appendF32(bytes, 1);
  appendF32(bytes, 1);
  appendU32(bytes, static_cast<std::uint32_t>(frames));
  return bytes;
}

}  // namespace

Result<Pc2Writer> Pc2Writer::resume(const std::filesystem::path& path, const Groom& topology,
                                    const AnimationOptions&, int frameCount) {
  if (topology.firstPoint.back() > std::uint32_t{std::numeric_limits<std::int32_t>::max()})
    return Error{fmt::format("cannot write {}: it can hold 2^31 - 1 points, and there are {}", path.string(),
                             topology.firstPoint.back())};
  auto file = frameCount == 0 ? createPartial(path) : openPartial(path);
  if (!file) return file.error();
  Pc2Writer writer(std::move(*file), path, topology);
  const std::vector<std::byte> expected = headerOf(topology, 0);
  if (frameCount == 0) {
    if (Status written = writer.file_.writeAt(0, textOf(expected)); !written) return written.error();
    return writer;
  }
  writer.frameCount_ = frameCount;  // what is refused stays as it is
  const auto header = writer.file_.readAt(0, kPc2HeaderBytes);
  if (!header) return header.error();
  const auto last = writer.file_.readAt(writer.endOf(frameCount) - 1, 1);
  if (!last) return last.error();
  const bool isOurs = header->size() == kPc2HeaderBytes &&
                      header->substr(0, kPc2CountAt) == textOf(expected).substr(0, kPc2CountAt);
  if (!isOurs || last->empty()) return cannotGoOn(writer.file_, frameCount);
  if (Status renamed = writer.file_.rename(path.string() + ".partial"); !renamed) return renamed.error();
  if (Status counted = writer.writeCount(); !counted) return counted.error();
  if (Status cut = writer.file_.truncate(writer.endOf(frameCount)); !cut) return cut.error();
  return writer;
}

Pc2Writer::~Pc2Writer() { removeWithoutFrames(file_, static_cast<std::size_t>(frameCount_)); }

std::uint64_t Pc2Writer::endOf(int frame) const {
  return kPc2HeaderBytes + static_cast<std::uint64_t>(frame) * kPc2PointBytes * topology_.firstPoint.back();
}

Status Pc2Writer::addFrame(std::span<const Vec3f> points, const UsdTransform&) {
  RINGLET_ASSERT(points.size() == topology_.firstPoint.back(), "one point per particle of the groom");
  std::vector<std::byte> bytes;
  bytes.reserve(kPc2PointBytes * points.size());
  for (const Vec3f p : points) {
    for (const float number : {p.x, p.y, p.z}) appendF32(bytes, number);
  }
  Status written = file_.writeAt(endOf(frameCount_), textOf(bytes));
  if (written && frameCount_ == 0) {
    std::filesystem::path strands = path_;
    topology_.points.assign(points.begin(), points.end());
    written = writeObj(strands.replace_extension(".obj"), topology_, points, ObjLines::edges);
    topology_.points = {};
  }
  if (!written) {
    (void)file_.truncate(endOf(frameCount_));
    return framesKept(written.error(), static_cast<std::size_t>(frameCount_), file_);
  }
  ++frameCount_;
  return writeCount();
}

Status Pc2Writer::writeCount() {
  const std::vector<std::byte> header = headerOf(topology_, frameCount_);
  return file_.writeAt(kPc2CountAt, textOf(header).substr(kPc2CountAt));
}

Status Pc2Writer::finish() {
  RINGLET_ASSERT(frameCount_ > 0, "a file without frames is not finished but dropped");
  return file_.closeAs(path_);
}

}  // namespace ringlet
