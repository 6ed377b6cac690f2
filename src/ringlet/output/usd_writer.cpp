// Implements output/usd_writer.h.
//
//   #usda 1.0 ( ... endTimeCode = 48______ ... )      <- patched after every frame
//   def BasisCurves "Hair" {
//     counts, type, widths, wrap                      constant
//     extent.timeSamples = { 1: ... 2: ... ________ } <- a line of fixed width is reserved for each frame
//     points.timeSamples = { 1: [...], 2: [...],      <- grows
//     }                                               <- the closing braces: the next frame overwrites them
//   }
//
// USD text allows no attribute to be continued later, hence the reserved lines: both attributes grow at once.
#include "ringlet/output/usd_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <limits>

namespace ringlet {
namespace {

constexpr std::string_view kClosing = "    }\n}\n";
constexpr std::size_t kTimeCodeWidth = 10;  // digits of the largest int
constexpr std::size_t kExtentWidth =
    128;  // bytes a reserved line: key, 6 floats of at most 15 bytes, brackets
constexpr std::size_t kFlushBytes = 4 << 20;  // text collected before a write: few calls, little memory
constexpr std::size_t kFloatBytes = 15;       // most bytes of a float: -1.17549435e-38
constexpr std::size_t kTupleBytes = 3 * kFloatBytes + 5;  // of "(x,y,z),"

// The shortest text that reads back as the same float, whatever the locale.
char* putFloat(char* at, float value) { return std::to_chars(at, at + kFloatBytes, value).ptr; }

char* putTuple(char* at, Vec3f v) {
  *at++ = '(';
  at = putFloat(at, v.x);
  *at++ = ',';
  at = putFloat(at, v.y);
  *at++ = ',';
  at = putFloat(at, v.z);
  *at++ = ')';
  return at;
}

std::string tuple(Vec3f v) {
  char text[kTupleBytes];
  return {text, putTuple(text, v)};
}

// The text, with spaces up to the width reserved for it.
std::string padded(std::string text, std::size_t width) {
  RINGLET_ASSERT(text.size() <= width, "text is wider than its place in the file");
  text.resize(width, ' ');
  return text;
}

}  // namespace

Result<UsdWriter> UsdWriter::create(const std::filesystem::path& path, const Groom& topology,
                                    const UsdOptions& options) {
  RINGLET_ASSERT(options.frameCount >= 1, "at least one frame will come");
  auto file = ByteFile::create(path.string() + ".partial");
  if (!file) return file.error();
  UsdWriter writer(std::move(*file));
  writer.path_ = path;
  writer.firstPoint_ = topology.firstPoint;
  writer.options_ = options;

  // What the file is measured in.
  std::string& text = writer.buffer_;
  text = "#usda 1.0\n(\n    defaultPrim = \"Hair\"\n    endTimeCode = ";
  writer.endTimeCodeAt_ = text.size();
  text += padded("0", kTimeCodeWidth);
  text += fmt::format(
      "\n    metersPerUnit = {}\n    startTimeCode = 1\n    timeCodesPerSecond = {}\n    upAxis = "
      "\"{}\"\n)\n\n",
      options.metresPerUnit, options.framesPerSecond, options.up == UpAxis::y ? 'Y' : 'Z');

  // What holds for all frames. "linear" must be said: the default is cubic.
  text += "def BasisCurves \"Hair\"\n{\n    int[] curveVertexCounts = [";
  for (std::size_t strand = 0; strand < topology.strandCount(); ++strand) {
    if (strand != 0) text += strand % 25 == 0 ? ",\n        " : ", ";
    fmt::format_to(std::back_inserter(text), "{}",
                   topology.firstPoint[strand + 1] - topology.firstPoint[strand]);
  }
  text += "]\n    uniform token type = \"linear\"\n";
  text += fmt::format("    float[] widths = [{}] (\n        interpolation = \"constant\"\n    )\n",
                      options.diameter);
  text += "    uniform token wrap = \"nonperiodic\"\n";

  // Room for the extents, and the points opened.
  text += "    float3[] extent.timeSamples = {\n";
  writer.extentsAt_ = text.size();
  for (int frame = 0; frame < options.frameCount; ++frame) text.append(kExtentWidth, ' ').append("\n");
  text += "    }\n    point3f[] points.timeSamples = {\n";
  writer.end_ = text.size();
  text += kClosing;
  if (Status written = writer.file_.writeAt(0, text); !written) return written.error();
  return writer;
}

UsdWriter::~UsdWriter() {
  if (!file_.isOpen() || frameCount_ > 0) return;
  std::error_code ignored;
  std::filesystem::remove(file_.path(), ignored);
}

Status UsdWriter::addFrame(std::span<const Vec3f> points) {
  RINGLET_ASSERT(points.size() == firstPoint_.back(), "one point per particle of the groom");
  RINGLET_ASSERT(frameCount_ < options_.frameCount, "more frames than announced");
  if (Status written = writeFrame(points); !written) return keepFinishedFrames(written.error());
  return {};
}

Status UsdWriter::writeFrame(std::span<const Vec3f> points) {
  const int timeCode = frameCount_ + 1;
  const float infinity = std::numeric_limits<float>::infinity();
  Vec3f low{infinity, infinity, infinity}, high = -low;

  // The points, a line a strand, over the closing braces.
  std::uint64_t offset = end_;
  buffer_.clear();  // and keeps its memory
  fmt::format_to(std::back_inserter(buffer_), "        {}: [\n", timeCode);
  for (std::size_t strand = 0; strand + 1 < firstPoint_.size(); ++strand) {
    auto particles = points.subspan(firstPoint_[strand], firstPoint_[strand + 1] - firstPoint_[strand]);
    std::size_t used = buffer_.size();
    buffer_.resize(used + particles.size() * kTupleBytes + 1);
    char* at = buffer_.data() + used;
    for (Vec3f p : particles) {
      at = putTuple(at, p);
      *at++ = ',';
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    *at++ = '\n';
    buffer_.resize(at - buffer_.data());
    if (buffer_.size() >= kFlushBytes) {
      if (Status written = flush(offset); !written) return written;
    }
  }
  buffer_ += "        ],\n";
  const std::uint64_t end = offset + buffer_.size();
  buffer_ += kClosing;
  if (Status written = flush(offset); !written) return written;

  // Its extent: a strand is as thick as it is wide, so half a diameter more on every side.
  const float radius = options_.diameter / 2;
  const Vec3f margin{radius, radius, radius};
  std::string extent =
      fmt::format("        {}: [{}, {}],", timeCode, tuple(low - margin), tuple(high + margin));
  if (Status written =
          file_.writeAt(extentsAt_ + frameCount_ * (kExtentWidth + 1), padded(extent, kExtentWidth));
      !written) {
    return written;
  }
  if (Status written = file_.writeAt(endTimeCodeAt_, padded(fmt::format("{}", timeCode), kTimeCodeWidth));
      !written) {
    return written;
  }
  end_ = end;
  ++frameCount_;
  return {};
}

Status UsdWriter::flush(std::uint64_t& offset) {
  Status written = file_.writeAt(offset, buffer_);
  offset += buffer_.size();
  buffer_.clear();
  return written;
}

Error UsdWriter::keepFinishedFrames(const Error& cause) {
  if (frameCount_ == 0) return cause;
  // The braces go where they were before this frame; that part of the file exists, so a full disk does not
  // matter.
  Status restored = file_.writeAt(end_, kClosing);
  if (restored) restored = file_.truncate(end_ + kClosing.size());
  if (!restored) return cause;
  return Error{fmt::format("{} (the first {} frames are kept in {})", cause.message, frameCount_,
                           file_.path().string())};
}

Status UsdWriter::finish() {
  RINGLET_ASSERT(frameCount_ > 0, "a file without frames is not finished but dropped");
  return file_.closeAs(path_);
}

}  // namespace ringlet
