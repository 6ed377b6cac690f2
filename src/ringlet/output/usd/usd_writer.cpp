// Implements output/usd/usd_writer.h.
//
//   #usda 1.0 ( ... endTimeCode = 2_________ ... )   <- patched after every frame
//   def BasisCurves "Hair" {
//     counts, type, widths, wrap                      constant
//     extent.timeSamples = { 1: ... 2: ... ________ } <- a line of fixed width is reserved for each frame
//     points.timeSamples = {
//       1: [...],____
//       2: [...], };}                                 <- a line a frame; the last ends with what closes
//       everything
//   #   3: [...], };}                                 <- the frame that is being written: a comment
//
// USD text allows no attribute to be continued later, hence the reserved lines: both attributes grow at once.
// A new frame stands behind the end, as a comment, until it is whole. Then one write of five bytes replaces
// `};}`, the line break and `#` by three blanks, a line break and a blank: the old end is gone, and the frame
// and its own end hold. Lines are laid out so that these five bytes, and every extent's line, are within a
// page: a kill leaves such a write whole or undone (ByteFile).
#include "ringlet/output/usd/usd_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>

#include "ringlet/base/bounds.h"
#include "ringlet/output/moving_points.h"
#include "ringlet/output/partial_frames.h"
#include "ringlet/output/usd/usd_hair_stage.h"
#include "ringlet/output/usd/usd_text.h"

namespace ringlet {
namespace {

constexpr std::string_view kEnd = "};}\n", kNext = "#";  // of all; of a line that does not hold yet
constexpr std::string_view kEndAndNext = "};}\n#", kOpened = "   \n ";
constexpr std::size_t kTimeCodeWidth = 10;  // digits of the largest int
// Of a reserved line, its end included: key, 6 floats of at most 15 bytes, brackets. A page holds whole ones.
constexpr std::size_t kExtentWidth = 128;
// Likewise: key, 12 doubles of at most 24 bytes, brackets.
constexpr std::size_t kHeadWidth = 512;
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

// What closes all, where the text will stand at `offset` of the file: it and the next line's first byte
// within a page.
void appendEnd(std::string& text, std::uint64_t offset) {
  const std::uint64_t at = (offset + text.size()) % ByteFile::kPage;
  if (at + kEndAndNext.size() > ByteFile::kPage) text.append(ByteFile::kPage - at, ' ');
  text += kEnd;
}

// Where the line that begins there ends, its end included; `begin` where the file ends before.
Result<std::uint64_t> lineEndAfter(const ByteFile& file, std::uint64_t begin) {
  for (std::uint64_t at = begin;;) {
    const auto piece = file.readAt(at, kFlushBytes);
    if (!piece) return piece.error();
    if (piece->empty()) return begin;
    if (const std::size_t end = piece->find('\n'); end != std::string::npos) return at + end + 1;
    at += piece->size();
  }
}

}  // namespace

UsdWriter::UsdWriter(ByteFile file, const std::filesystem::path& path, const Groom& topology,
                     const AnimationOptions& options)
    : file_(std::move(file)), path_(path), firstPoint_(topology.firstPoint), options_(options) {
  RINGLET_ASSERT(options.frameCount >= 1, "at least one frame will come");
  RINGLET_ASSERT(!options.usd.originPrims, "text holds one prim that moves");
}

Result<UsdWriter> UsdWriter::create(const std::filesystem::path& path, const Groom& topology,
                                    const AnimationOptions& options) {
  auto file = createPartial(path);
  if (!file) return file.error();
  UsdWriter writer(std::move(*file), path, topology, options);
  if (Status written = writer.file_.writeAt(0, writer.headerText(topology)); !written) return written.error();
  return writer;
}

// All that stands before the first frame; notes where that is, and what will be patched.
std::string UsdWriter::headerText(const Groom& topology) {
  // What the file is measured in.
  std::string text(kBegin);
  endTimeCodeAt_ = text.size();
  text += padded(fmt::format("{}", timeCodeOf(0)), kTimeCodeWidth);
  text += fmt::format(
      "\n    metersPerUnit = {}\n    startTimeCode = {}\n    timeCodesPerSecond = {}\n    upAxis = "
      "\"{}\"\n)\n\n",
      options_.metresPerUnit, options_.usd.firstTimeCode, options_.framesPerSecond,
      options_.up == UpAxis::y ? 'Y' : 'Z');

  // What holds for all frames.
  const HairStage made = hairStageOf(topology, options_);
  const HairCurves& curves = made.curves.front();
  margin_ = curves.margin;
  const UsdStagePrim& prim = made.stage.prims.front();
  text += fmt::format("def BasisCurves \"Hair\"{}\n{{\n",
                      prim.apiSchemas.empty() ? "" : " (\n" + usdTextOf(prim.apiSchemas, 4) + ")");
  for (const UsdStageAttribute& attribute : prim.attributes)
    if (attribute.elementsOfSample == 0) text += usdTextOf(attribute, 4);

  // Room for the head's transforms and the extents, and the points opened.
  const auto reserve = [&](std::string_view opening, std::size_t width) {
    text += opening;
    text.append(width - 1 - text.size() % width, ' ').append("\n");
    const std::uint64_t at = text.size();
    for (int frame = 0; frame < options_.frameCount; ++frame) text.append(width - 1, ' ').append("\n");
    text += "    }\n";
    return at;
  };
  if (options_.usd.head == UsdHead::transform)
    headsAt_ = reserve("    matrix4d xformOp:transform.timeSamples = {", kHeadWidth);
  extentsAt_ = reserve("    float3[] extent.timeSamples = {", kExtentWidth);
  text += "    point3f[] points.timeSamples = {\n";
  appendEnd(text, 0);
  end_ = text.size();
  return text;
}

Result<UsdWriter> UsdWriter::resume(const std::filesystem::path& path, const Groom& topology,
                                    const AnimationOptions& options, int frameCount) {
  if (frameCount == 0) return create(path, topology, options);
  auto file = openPartial(path);
  if (!file) return file.error();
  UsdWriter writer(std::move(*file), path, topology, options);

  writer.frameCount_ = frameCount;

  // The header as it would be, but for what was patched since.
  const std::string header = writer.headerText(topology);
  const auto found = writer.file_.readAt(0, header.size());
  if (!found) return found.error();
  std::string blank = *found;
  const auto forget = [&](std::uint64_t at, std::size_t count) {
    if (at + count <= blank.size()) blank.replace(at, count, header, at, count);
  };
  forget(writer.endTimeCodeAt_, kTimeCodeWidth);
  for (int frame = 0; frame < options.frameCount; ++frame) {
    forget(writer.extentsAt_ + frame * kExtentWidth, kExtentWidth - 1);
    if (options.usd.head == UsdHead::transform) forget(writer.headsAt_ + frame * kHeadWidth, kHeadWidth - 1);
  }
  forget(header.size() - kEnd.size(), kEnd.size());
  std::uint64_t begin = header.size(), end = header.size();
  bool isWhole = blank == header;
  for (int frame = 1; frame <= frameCount && isWhole; ++frame) {
    const auto next = lineEndAfter(writer.file_, end);
    if (!next) return next.error();
    isWhole = *next > end;
    begin = end;
    end = *next;
  }
  if (!isWhole) return cannotGoOn(writer.file_, frameCount);
  if (Status renamed = writer.file_.rename(path.string() + ".partial"); !renamed) return renamed.error();
  if (Status cut = writer.cutAfter(begin, end); !cut) return cut.error();
  return writer;
}

// The last frame's line is [lineBegin, lineEnd): what follows goes, and it closes all again. From the last
// line on each becomes a comment behind the end of the line before it, so that the file is whole meanwhile.
Status UsdWriter::cutAfter(std::uint64_t lineBegin, std::uint64_t lineEnd) {
  std::vector<std::uint64_t> later;
  for (std::uint64_t begin = lineEnd;;) {
    const auto next = lineEndAfter(file_, begin);
    if (!next) return next.error();
    if (*next == begin) break;
    later.push_back(begin);
    begin = *next;
  }
  for (; !later.empty(); later.pop_back()) {
    if (Status closed = file_.writeAt(later.back() - kEnd.size(), kEndAndNext); !closed) return closed;
  }
  end_ = lineEnd;
  if (Status cut = file_.truncate(end_); !cut) return cut;
  if (Status closed = file_.writeAt(end_ - kEnd.size(), kEnd); !closed) return closed;
  if (Status opened = file_.writeAt(lineBegin - kEnd.size(), kOpened); !opened) return opened;
  for (int frame = frameCount_ + 1; frame <= options_.frameCount; ++frame) {
    if (Status cleared = clearPlaces(frame); !cleared) return cleared;
  }
  return writeEndTimeCode();
}

UsdWriter::~UsdWriter() { removeWithoutFrames(file_, static_cast<std::size_t>(frameCount_)); }

Status UsdWriter::addFrame(std::span<const Vec3f> points, const UsdTransform& head) {
  RINGLET_ASSERT(points.size() == firstPoint_.back(), "one point per particle of the groom");
  RINGLET_ASSERT(frameCount_ < options_.frameCount, "more frames than announced");
  if (Status written = writeFrame(points, head); !written) return keepFinishedFrames(written.error());
  return {};
}

Status UsdWriter::writeFrame(std::span<const Vec3f> points, const UsdTransform& head) {
  if (options_.usd.head != UsdHead::baked) {
    fromHead_.assign(points.begin(), points.end());
    seeFromHead(head, fromHead_);
    points = fromHead_;
  }
  const Bounds bounds = boundsOf(points);
  const Vec3f low(bounds.low), high(bounds.high);
  const std::uint64_t begin = end_;
  if (Status written = writeLine(points); !written) return written;

  // Its extent: a strand is as thick as it is wide, so half a diameter more on every side.
  const int frame = frameCount_ + 1;
  const Vec3f margin{margin_, margin_, margin_};
  if (Status written = writeExtent(frame, fmt::format("        {}: [{}, {}],", timeCodeOf(frame),
                                                      tuple(low - margin), tuple(high + margin)));
      !written)
    return written;
  if (options_.usd.head == UsdHead::transform) {
    if (Status written = writeHead(frame, fmt::format("        {}: {},", timeCodeOf(frame), usdTextOf(head)));
        !written)
      return written;
  }

  // From now on it holds.
  if (Status opened = file_.writeAt(begin - kEnd.size(), kOpened); !opened) return opened;
  end_ = begin + lineBytes_;
  ++frameCount_;
  return writeEndTimeCode();
}

// Behind the end, as a comment.
Status UsdWriter::writeLine(std::span<const Vec3f> points) {
  std::uint64_t offset = end_;
  buffer_.clear();  // and keeps its memory
  fmt::format_to(std::back_inserter(buffer_), "{}       {}: [", kNext, timeCodeOf(frameCount_ + 1));
  for (std::size_t strand = 0; strand + 1 < firstPoint_.size(); ++strand) {
    auto particles = points.subspan(firstPoint_[strand], firstPoint_[strand + 1] - firstPoint_[strand]);
    std::size_t used = buffer_.size();
    buffer_.resize(used + particles.size() * kTupleBytes);
    char* at = buffer_.data() + used;
    for (Vec3f p : particles) {
      at = putTuple(at, p);
      *at++ = ',';
    }
    buffer_.resize(at - buffer_.data());
    if (buffer_.size() >= kFlushBytes) {
      if (Status written = flush(offset); !written) return written;
    }
  }
  buffer_ += "], ";
  appendEnd(buffer_, offset);
  if (Status written = flush(offset); !written) return written;
  lineBytes_ = offset - end_;
  return {};
}

Status UsdWriter::writeExtent(int frame, std::string text) {
  return file_.writeAt(extentsAt_ + (frame - 1) * kExtentWidth, padded(std::move(text), kExtentWidth - 1));
}

Status UsdWriter::writeHead(int frame, std::string text) {
  return file_.writeAt(headsAt_ + (frame - 1) * kHeadWidth, padded(std::move(text), kHeadWidth - 1));
}

Status UsdWriter::writeEndTimeCode() {
  return file_.writeAt(endTimeCodeAt_, padded(fmt::format("{}", timeCodeOf(frameCount_)), kTimeCodeWidth));
}

// Of a frame that is not there.
Status UsdWriter::clearPlaces(int frame) {
  if (Status cleared = writeExtent(frame, ""); !cleared) return cleared;
  return options_.usd.head == UsdHead::transform ? writeHead(frame, "") : Status{};
}

Status UsdWriter::flush(std::uint64_t& offset) {
  Status written = file_.writeAt(offset, buffer_);
  offset += buffer_.size();
  buffer_.clear();
  return written;
}

Error UsdWriter::keepFinishedFrames(const Error& cause) {
  // Behind the end there is only a comment; where it cannot be cut off it does not matter.
  (void)file_.truncate(end_);
  (void)clearPlaces(frameCount_ + 1);
  return framesKept(cause, static_cast<std::size_t>(frameCount_), file_);
}

Status UsdWriter::finish() {
  RINGLET_ASSERT(frameCount_ > 0, "a file without frames is not finished but dropped");
  return file_.closeAs(path_);
}

}  // namespace ringlet
