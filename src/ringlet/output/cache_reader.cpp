// Implements output/cache_reader.h.
#include "ringlet/output/cache_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <limits>
#include <optional>
#include <system_error>

#include "ringlet/base/assert.h"
#include "ringlet/base/little_endian.h"
#include "ringlet/output/cache_frame.h"

namespace ringlet {
namespace {

using cache::ChunkKind;

bool isBound(double value) { return std::isfinite(value) && value >= 0; }

}  // namespace

Result<CacheReader> CacheReader::open(const std::filesystem::path& path) {
  auto file = ReadFile::open(path);
  if (!file) return file.error();
  CacheReader reader(std::move(*file));
  if (Status read = reader.readHeader(); !read) return read.error();
  if (Status read = reader.readStrands(); !read) return read.error();
  reader.isFinished_ = reader.readIndex();
  if (!reader.isFinished_) reader.scan();
  return reader;
}

Status CacheReader::readHeader() {
  std::vector<std::byte> bytes;
  if (!file_.readAt(0, cache::kHeaderBytes, bytes))
    return Error{fmt::format("{}: has {} bytes; expected a Ringlet cache, whose header alone has {}",
                             file_.path().string(), file_.size(), cache::kHeaderBytes)};
  const cache::ParsedHeader parsed = cache::parseHeader(bytes);
  if (!parsed.header)
    return Error{
        fmt::format("{}: {}; expected a cache that `ringlet simulate --cache` or `ringlet convert` wrote",
                    file_.path().string(), parsed.fault)};
  header_ = *parsed.header;
  return {};
}

Status CacheReader::readStrands() {
  const std::uint64_t at = cache::kHeaderBytes;
  std::vector<std::byte> bytes;
  if (!file_.readAt(at, cache::kChunkHeaderBytes, bytes)) return damaged("ends before its strands");
  const cache::ChunkHeader chunk = cache::parseChunkHeader(bytes);
  const std::uint64_t strandCount = chunk.number;
  if (!readChunk(at, ChunkKind::strands, strandCount, 4 * strandCount, content_))
    return damaged("has damaged strand lengths");
  std::uint64_t total = 0;
  for (std::size_t s = 0; s < strandCount; ++s) {
    const std::uint32_t count = readU32(content_, 4 * s);
    total += count;
    if (count == 0 || total > std::numeric_limits<std::uint32_t>::max())
      return damaged("has strand lengths that no groom has");
    firstPoint_.push_back(static_cast<std::uint32_t>(total));
  }
  if (total == 0) return damaged("has no strands");
  framesAt_ = at + cache::kChunkHeaderBytes + chunk.storedBytes;
  return {};
}

// Where the frames are, from the file's end; false if that is not whole.
bool CacheReader::readIndex() {
  std::vector<std::byte> end;
  if (file_.size() < framesAt_ + cache::kEndBytes ||
      !file_.readAt(file_.size() - cache::kEndBytes, cache::kEndBytes, end))
    return false;
  if (!std::ranges::equal(std::span(end).last(cache::kEndMagic.size()),
                          std::as_bytes(std::span(cache::kEndMagic))))
    return false;
  const std::uint64_t at = readU64(end, 0);
  std::vector<std::byte> bytes;
  if (at < framesAt_ || !file_.readAt(at, cache::kChunkHeaderBytes, bytes)) return false;
  const std::uint64_t count = cache::parseChunkHeader(bytes).number;
  if (count > std::numeric_limits<int>::max() ||
      !readChunk(at, ChunkKind::index, count, cache::kIndexEntryBytes * count, content_))
    return false;
  std::vector<Frame> frames(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t entry = cache::kIndexEntryBytes * k;
    frames[k] = {readU64(content_, entry), readF64(content_, entry + 8)};
    if (!isBound(frames[k].errorBound)) return false;
  }
  frames_ = std::move(frames);
  framesEnd_ = at;
  return !frames_.empty();
}

// From chunk to chunk, as far as they are whole. Only the last frame's bytes are read: a killed program
// leaves no other torn.
void CacheReader::scan() {
  std::uint64_t at = framesAt_;
  std::vector<std::byte> bytes;
  bool meetsIndex = false;
  while (file_.readAt(at, cache::kChunkHeaderBytes, bytes)) {
    const cache::ChunkHeader chunk = cache::parseChunkHeader(bytes);
    meetsIndex = chunk.kind == ChunkKind::index;
    if (chunk.kind != ChunkKind::frame || chunk.number != frames_.size() + 1 || !isBound(chunk.errorBound) ||
        chunk.storedBytes > file_.size() - at - cache::kChunkHeaderBytes ||
        frames_.size() == std::numeric_limits<int>::max())
      break;
    frames_.push_back({at, chunk.errorBound});
    at += cache::kChunkHeaderBytes + chunk.storedBytes;
  }
  std::vector<Vec3f> ignored;
  while (!frames_.empty() && !readFrame(frameCount(), ignored)) {
    at = frames_.back().offset;
    meetsIndex = false;
    frames_.pop_back();
  }
  framesEnd_ = at;
  if (meetsIndex) {
    warnings_.push_back(fmt::format("{}: its index is damaged; its {} frames were found without it",
                                    file_.path().string(), frames_.size()));
  } else if (at < file_.size()) {
    warnings_.push_back(
        fmt::format("{}: frame {} is torn or damaged; dropped the last {} bytes, {} frames are whole",
                    file_.path().string(), frames_.size() + 1, file_.size() - at, frames_.size()));
  }
}

Status CacheReader::readFrame(int frame, std::vector<Vec3f>& points) {
  RINGLET_ASSERT(frame >= 1 && frame <= frameCount(), "a frame that the file has");
  const std::uint64_t contentBytes = cache::frameBytes(header_.precision, strandCount(), particleCount());
  const auto number = static_cast<std::uint64_t>(frame);
  if (!readChunk(frames_[number - 1].offset, ChunkKind::frame, number, contentBytes, content_))
    return damaged(fmt::format("frame {} is damaged: its bytes are not those that were written", frame));
  points.resize(particleCount());
  if (!cache::decodeFrame(header_.precision, firstPoint_, content_, points))
    return damaged(fmt::format("frame {} has a point that is not finite", frame));
  return {};
}

// The content of the chunk at `offset`, which must be of this kind, number and size. No memory is taken for
// what the file is too short for.
bool CacheReader::readChunk(std::uint64_t offset, ChunkKind kind, std::uint64_t number,
                            std::uint64_t contentBytes, std::vector<std::byte>& content) {
  if (!file_.readAt(offset, cache::kChunkHeaderBytes, chunk_)) return false;
  const cache::ChunkHeader chunk = cache::parseChunkHeader(chunk_);
  if (chunk.kind != kind || chunk.number != number || !cache::canHold(chunk.storedBytes, contentBytes) ||
      chunk.storedBytes > file_.size() ||
      !file_.readAt(offset, cache::kChunkHeaderBytes + chunk.storedBytes, chunk_))
    return false;
  content.resize(contentBytes);
  return cache::unpack(chunk_, content);
}

double CacheReader::errorBound() const {
  double largest = 0;
  for (const Frame& frame : frames_) largest = std::max(largest, frame.errorBound);
  return largest;
}

std::uint64_t CacheReader::endOf(int frame) const {
  return frame < frameCount() ? frameOffset(frame + 1) : framesEnd_;
}

Error CacheReader::damaged(std::string_view what) const {
  return Error{fmt::format("{}: {}", file_.path().string(), what)};
}

}  // namespace ringlet
