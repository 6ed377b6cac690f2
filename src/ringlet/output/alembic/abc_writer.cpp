// Implements output/alembic/abc_writer.h.
#include "ringlet/output/alembic/abc_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "ringlet/base/assert.h"
#include "ringlet/base/bounds.h"
#include "ringlet/base/little_endian.h"
#include "ringlet/output/partial_frames.h"

namespace ringlet {
namespace {

constexpr std::uint64_t kRootPlaceAt = 8;
constexpr std::uint64_t kAbcSampleHead = 8 + kAbcDigestBytes;  // before its values: their size, a digest

std::span<const std::byte> abcBytesOf(std::string_view text) { return std::as_bytes(std::span(text)); }

std::string abcWordBytes(std::uint64_t value) {
  std::string bytes;
  putAbcU64(bytes, value);
  return bytes;
}

std::string abcMatrixBytesOf(const UsdTransform& transform) {
  std::string bytes;
  const auto putRow = [&](Vec3d row, double end) {
    for (const double number : {row.x, row.y, row.z, end}) putAbcF64(bytes, number);
  };
  for (const Vec3d& row : transform.rows) putRow(row, 0);
  putRow(transform.move, 1);
  return bytes;
}

std::uint64_t abcSampleSize(const AbcOutProperty& property) {
  return (kAbcSampleHead + property.sampleBytes + 7) / 8 * 8;
}

}  // namespace

AbcWriter::AbcWriter(ByteFile file, const std::filesystem::path& path, const Groom& topology,
                     const AnimationOptions& options)
    : file_(std::move(file)),
      path_(path),
      pointCount_(topology.firstPoint.back()),
      options_(options),
      stage_(abcStageOf(topology, options)),
      points_(options) {
  options_.usd.origin = nullptr;  // it may end before the writer
  findMoving(abcTransformOf(stage_.archive));
  findMoving(abcGeometryOf(stage_.archive));
  RINGLET_ASSERT(std::ranges::is_sorted(moving_, {}, [](const Moving& m) { return m.property->comesLater; }),
                 "what comes later is the last of a frame");
  for (Moving& moving : moving_) {
    moving.slot = frameBytes_;
    frameBytes_ += abcSampleSize(*moving.property);
    if (!moving.property->comesLater) earlyBytes_ = frameBytes_;
  }
  makeFront();
}

void AbcWriter::findMoving(std::vector<AbcOutProperty>& properties) {
  for (AbcOutProperty& property : properties) {
    if (property.isMoving()) moving_.push_back({&property, 0});
  }
}

void AbcWriter::makeFront() {
  front_ = abcFileHeader(0);
  putAbcU64(front_, kAbcMark.size() + 8 + kAbcDigestBytes);
  front_ += kAbcMark;
  const std::uint64_t treeDigestAt = front_.size() + 8;
  front_.resize(treeDigestAt + kAbcDigestBytes, '\0');
  for (auto* properties : {&abcTransformOf(stage_.archive), &abcGeometryOf(stage_.archive)}) {
    for (AbcOutProperty& property : *properties)
      putAbcSamples(property, static_cast<std::uint32_t>(options_.frameCount), front_);
  }
  contents_ = abcDigest(front_);
  rooms_[0] = front_.size();
  roomBytes_ = treeOf(0, 0, 0).bytes.size();
  rooms_[1] = rooms_[0] + roomBytes_;
  const AbcTree tree = treeOf(0, 0, 0);
  front_ += tree.bytes;
  front_.resize(rooms_[1] + roomBytes_, '\0');
  front_.replace(kRootPlaceAt, 8, abcWordBytes(tree.rootPlace));
  front_.replace(kAbcFrontSizeAt, 8, abcWordBytes(front_.size()));
  front_.replace(treeDigestAt, kAbcDigestBytes, abcDigest(tree.bytes));
}

// The header's 16 bytes come last: before that the file is no archive.
Result<AbcWriter> AbcWriter::create(const std::filesystem::path& path, const Groom& topology,
                                    const AnimationOptions& options) {
  auto file = createPartial(path);
  if (!file) return file.error();
  AbcWriter writer(std::move(*file), path, topology, options);
  const std::string_view front = writer.front_;
  const std::size_t header = kRootPlaceAt + 8;
  if (Status written = writer.file_.writeAt(header, front.substr(header)); !written) return written.error();
  if (Status written = writer.file_.writeAt(0, front.substr(0, header)); !written) return written.error();
  return writer;
}

Result<AbcWriter> AbcWriter::resume(const std::filesystem::path& path, const Groom& topology,
                                    const AnimationOptions& options, int frameCount) {
  if (frameCount == 0) return create(path, topology, options);
  RINGLET_ASSERT(frameCount <= options.frameCount, "more frames than announced");
  auto file = openPartial(path);
  if (!file) return file.error();
  AbcWriter writer(std::move(*file), path, topology, options);
  writer.frameCount_ = frameCount;  // what is refused stays as it is
  const auto isOurs = writer.isOurs(frameCount);
  if (!isOurs) return isOurs.error();
  if (!*isOurs) return cannotGoOn(writer.file_, frameCount);
  if (Status read = writer.readContents(frameCount); !read) return read.error();
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

AbcWriter::~AbcWriter() { removeWithoutFrames(file_, static_cast<std::size_t>(frameCount_)); }

std::uint64_t AbcWriter::placeOf(int frame, const Moving& moving) const {
  return front_.size() + static_cast<std::uint64_t>(frame - 1) * frameBytes_ + moving.slot;
}

std::uint64_t AbcWriter::wordAt(int frame, const Moving& moving) const {
  const std::uint64_t before = moving.property->childrenPerSample() * static_cast<std::uint64_t>(frame - 1);
  return moving.property->samples + 8 + 8 * before;
}

// What comes later of the last frame is not there yet.
std::uint64_t AbcWriter::endOf(int frame) const {
  if (frame == 0) return front_.size();
  return front_.size() + static_cast<std::uint64_t>(frame - 1) * frameBytes_ + earlyBytes_;
}

AbcTree AbcWriter::treeOf(int room, int frames, int laterFrames) {
  const auto count = static_cast<std::uint32_t>(frames),
             later = static_cast<std::uint32_t>(std::max(laterFrames, 0));
  for (auto* properties : {&abcTransformOf(stage_.archive), &abcGeometryOf(stage_.archive)}) {
    for (AbcOutProperty& property : *properties) {
      if (property.isCounted) property.sampleCount = property.comesLater ? later : count;
    }
  }
  stage_.archive.samplings.back().mostSamples = count;
  std::string content = contents_.substr(kAbcDigestBytes * count, kAbcDigestBytes);
  putAbcU32(content, later);
  return abcTreeAt(rooms_[static_cast<std::size_t>(room)], stage_.archive, content);
}

Status AbcWriter::addFrame(std::span<const Vec3f> points, const UsdTransform& head) {
  RINGLET_ASSERT(points.size() == pointCount_, "one point per particle of the groom");
  RINGLET_ASSERT(frameCount_ < options_.frameCount, "more frames than announced");
  if (Status written = writeFrame(points, head); !written) return keepFinishedFrames(written.error());
  points_.keep();
  return {};
}

Status AbcWriter::writeFrame(std::span<const Vec3f> points, const UsdTransform& head) {
  const int frame = frameCount_ + 1;
  points_.take(points, head);
  const Bounds bounds = boundsOf(points_.now());
  const Vec3f low(bounds.low), high(bounds.high);
  const Vec3f margin{stage_.margin, stage_.margin, stage_.margin};
  buffer_.resize(frameBytes_, '\0');
  for (const Moving& moving : moving_) {
    const std::string& name = moving.property->name;
    if (moving.property->comesLater) continue;
    if (name == kAbcPoints) {
      putPoints(moving, points_.now());
    } else {
      putSample(moving,
                name == ".vals" ? abcMatrixBytesOf(head) : abcBoxBytes({low - margin, high + margin}));
    }
  }
  const std::string_view early = std::string_view(buffer_).substr(0, earlyBytes_);
  if (Status written = file_.writeAt(placeOf(frame, {}), early); !written) return written;
  if (options_.usd.velocities && frame > 1) {
    if (Status written = writeVelocities(frame - 1, points_.velocitiesOfLast()); !written) return written;
  }
  if (Status led = leadTo(frame, false); !led) return led;
  if (frame > 1) {
    if (Status led = leadTo(frame - 1, true); !led) return led;
  }

  // From now on it counts.
  std::string digests = contents_.substr(contents_.size() - kAbcDigestBytes);
  for (const Moving& moving : moving_) {
    if (!moving.property->comesLater) digests += buffer_.substr(moving.slot + 8, kAbcDigestBytes);
  }
  contents_ += abcDigest(digests);
  if (Status switched = switchTo(frame % 2, frame, frame - 1); !switched) return switched;
  frameCount_ = frame;
  return {};
}

void AbcWriter::putSample(const Moving& moving, std::string_view values) {
  RINGLET_ASSERT(values.size() == moving.property->sampleBytes, "a sample of the size that was announced");
  buffer_.replace(moving.slot + kAbcSampleHead, values.size(), values);
  signSample(moving);
}

void AbcWriter::putPoints(const Moving& moving, std::span<const Vec3f> points) {
  putAbcPoints(points, buffer_, moving.slot + kAbcSampleHead);
  signSample(moving);
}

// Before the values that are there: how many bytes these are, and their digest.
void AbcWriter::signSample(const Moving& moving) {
  const std::size_t size = moving.property->sampleBytes;
  buffer_.replace(moving.slot, 8, abcWordBytes(kAbcDigestBytes + size));
  buffer_.replace(moving.slot + 8, kAbcDigestBytes,
                  abcDigest(std::string_view(buffer_).substr(moving.slot + kAbcSampleHead, size)));
}

Status AbcWriter::writeVelocities(int frame, std::span<const Vec3f> velocities) {
  buffer_.resize(frameBytes_, '\0');
  putPoints(moving_.back(), velocities);
  return file_.writeAt(endOf(frame), std::string_view(buffer_).substr(earlyBytes_));
}

// The words of the frame, of what comes later or all else.
Status AbcWriter::leadTo(int frame, bool later) {
  for (const Moving& moving : moving_) {
    if (moving.property->comesLater != later) continue;
    if (Status led = writeU64(wordAt(frame, moving), abcDataWord(placeOf(frame, moving))); !led) return led;
  }
  return {};
}

// That room has the tree from now on; the header does not lead there yet.
Status AbcWriter::switchTo(int room, int frames, int laterFrames) {
  RINGLET_ASSERT(room != room_, "a tree is not written where the header leads");
  const AbcTree tree = treeOf(room, frames, laterFrames);
  RINGLET_ASSERT(tree.bytes.size() == roomBytes_, "trees of any counts have one size");
  if (Status written = file_.writeAt(rooms_[static_cast<std::size_t>(room)], tree.bytes); !written)
    return written;
  if (Status switched = writeU64(kRootPlaceAt, tree.rootPlace); !switched) return switched;
  room_ = room;
  return {};
}

// How many words the groups have; those that no tree counts say nothing.
Status AbcWriter::writeCounts(int frames) {
  for (const Moving& moving : moving_) {
    const std::uint64_t count = moving.property->childrenPerSample() * static_cast<std::uint64_t>(frames);
    if (Status written = writeU64(moving.property->samples, count); !written) return written;
  }
  return {};
}

Status AbcWriter::writeU64(std::uint64_t at, std::uint64_t value) {
  return file_.writeAt(at, abcWordBytes(value));
}

// To what the file of the first frames was when the last of them was added. The header goes from room to
// room, so that no tree is written over that it leads to.
Status AbcWriter::cutAfter(int frame) {
  const int room = frame % 2, other = 1 - room;
  contents_.resize(kAbcDigestBytes * (static_cast<std::size_t>(frame) + 1));
  if (Status done = writeCounts(options_.frameCount); !done) return done;
  if (room_ == room) {
    if (Status done = switchTo(other, frame, frame - 1); !done) return done;
  }
  if (Status done = switchTo(room, frame, frame - 1); !done) return done;
  const std::string before =
      frame > 0 ? treeOf(other, frame - 1, frame - 2).bytes : std::string(roomBytes_, '\0');
  if (Status done = file_.writeAt(rooms_[static_cast<std::size_t>(other)], before); !done) return done;
  for (const Moving& moving : moving_) {
    const int kept = std::max(moving.property->comesLater ? frame - 1 : frame, 0);
    const std::uint64_t first = wordAt(kept + 1, moving), end = wordAt(options_.frameCount + 1, moving);
    if (Status done = file_.writeAt(first, std::string_view(front_).substr(first, end - first)); !done)
      return done;
  }
  return file_.truncate(endOf(frame));
}

// What is in front as it would be, but for what was written into it since; and so many frames behind it.
Result<bool> AbcWriter::isOurs(int frames) {
  const auto found = file_.readAt(0, front_.size());
  if (!found) return found.error();
  if (found->size() != front_.size()) return false;
  std::string blank = *found;
  const auto forget = [&](std::uint64_t at, std::uint64_t count) {
    blank.replace(at, count, front_, at, count);
  };
  forget(kRootPlaceAt, 8);
  forget(rooms_[0], 2 * roomBytes_);
  for (const Moving& moving : moving_) {
    forget(moving.property->samples, wordAt(options_.frameCount + 1, moving) - moving.property->samples);
    for (int frame = 1; frame <= frames - (moving.property->comesLater ? 1 : 0); ++frame) {
      if (readU64(abcBytesOf(*found), wordAt(frame, moving)) != abcDataWord(placeOf(frame, moving)))
        return false;
    }
  }
  if (blank != front_) return false;
  const std::uint64_t root = readU64(abcBytesOf(*found), kRootPlaceAt);
  room_ = root >= rooms_[1] ? 1 : 0;
  if (root < rooms_[0] || root >= rooms_[1] + roomBytes_) return false;
  const auto lastByte = file_.readAt(endOf(frames) - 1, 1);
  if (!lastByte) return lastByte.error();
  return !lastByte->empty();
}

// The digests that frames left in the file.
Status AbcWriter::readContents(int frames) {
  for (int frame = 1; frame <= frames; ++frame) {
    std::string digests = contents_.substr(contents_.size() - kAbcDigestBytes);
    for (const Moving& moving : moving_) {
      if (moving.property->comesLater) continue;
      const auto digest = file_.readAt(placeOf(frame, moving) + 8, kAbcDigestBytes);
      if (!digest) return digest.error();
      digests += *digest;
    }
    contents_ += abcDigest(digests);
  }
  return {};
}

Status AbcWriter::readBack(int frame, std::vector<Vec3f>& points) const {
  const auto moving =
      std::ranges::find_if(moving_, [](const Moving& each) { return each.property->name == kAbcPoints; });
  const auto bytes = file_.readAt(placeOf(frame, *moving) + kAbcSampleHead, moving->property->sampleBytes);
  if (!bytes) return bytes.error();
  RINGLET_ASSERT(bytes->size() == moving->property->sampleBytes, "isOurs saw that it is there");
  points.clear();
  for (std::size_t at = 0; at < bytes->size(); at += 12) {
    const auto number = [&](std::size_t axis) { return readF32(abcBytesOf(*bytes), at + 4 * axis); };
    points.push_back({number(0), number(1), number(2)});
  }
  return {};
}

Error AbcWriter::keepFinishedFrames(const Error& cause) {
  // Where it cannot be done it does not matter: nothing counts what follows.
  (void)cutAfter(frameCount_);
  (void)file_.truncate(endOf(frameCount_));
  return framesKept(cause, static_cast<std::size_t>(frameCount_), file_);
}

Status AbcWriter::finish() {
  RINGLET_ASSERT(frameCount_ > 0, "a file without frames is not finished but dropped");
  if (options_.usd.velocities) {
    if (Status written = writeVelocities(frameCount_, points_.velocitiesAtEnd()); !written) return written;
    if (Status led = leadTo(frameCount_, true); !led) return led;
    if (Status switched = switchTo(1 - room_, frameCount_, frameCount_); !switched) return switched;
  }
  if (frameCount_ < options_.frameCount) {
    if (Status written = writeCounts(frameCount_); !written) return written;
  }
  return file_.closeAs(path_);
}

}  // namespace ringlet
