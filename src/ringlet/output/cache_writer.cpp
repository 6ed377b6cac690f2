// Implements output/cache_writer.h.
#include "ringlet/output/cache_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "ringlet/base/assert.h"
#include "ringlet/base/little_endian.h"
#include "ringlet/base/text_of.h"
#include "ringlet/output/cache_reader.h"
#include "ringlet/output/partial_frames.h"

namespace ringlet {
namespace {

using cache::ChunkKind;

}  // namespace

Result<CacheWriter> CacheWriter::create(const std::filesystem::path& path, const Groom& topology,
                                        const CacheHeader& header) {
  RINGLET_ASSERT(topology.strandCount() > 0, "a groom without strands is not written");
  auto file = createPartial(path);
  if (!file) return file.error();
  CacheWriter writer(std::move(*file), path, topology, header);

  std::vector<std::byte> counts;
  for (std::size_t s = 0; s < topology.strandCount(); ++s)
    appendU32(counts, topology.firstPoint[s + 1] - topology.firstPoint[s]);
  if (Status written = writer.append(cache::headerBytes(header)); !written) return written.error();
  const auto strandCount = static_cast<std::uint32_t>(topology.strandCount());
  if (Status written = writer.append(writer.packer_.pack(ChunkKind::strands, strandCount, 0, counts));
      !written)
    return written.error();
  return writer;
}

Result<CacheWriter> CacheWriter::resume(const std::filesystem::path& path, const Groom& topology,
                                        const CacheHeader& header, int frameCount) {
  if (frameCount == 0) return create(path, topology, header);
  auto file = openPartial(path);
  if (!file) return file.error();
  const auto before = CacheReader::open(file->path());
  if (!before) return before.error();
  const auto begins = file->readAt(0, cache::kHeaderBytes);
  if (!begins) return begins.error();
  if (*begins != textOf(cache::headerBytes(header)) || before->firstPoint() != topology.firstPoint ||
      before->frameCount() < frameCount) {
    const bool isOfGroom = before->firstPoint() == topology.firstPoint;
    return cannotGoOn(*file, frameCount,
                      isOfGroom ? fmt::format("{} frames, or another header", before->frameCount()).c_str()
                                : "those of another groom");
  }
  CacheWriter writer(std::move(*file), path, topology, header);
  for (int frame = 1; frame <= frameCount; ++frame)
    writer.index_.push_back({before->frameOffset(frame), before->errorBound(frame)});
  writer.end_ = before->endOf(frameCount);
  if (Status renamed = writer.file_.rename(path.string() + ".partial"); !renamed) return renamed.error();
  if (Status cut = writer.file_.truncate(writer.end_); !cut) return cut.error();
  return writer;
}

CacheWriter::~CacheWriter() { removeWithoutFrames(file_, index_.size()); }

Status CacheWriter::append(std::span<const std::byte> bytes) {
  Status written = file_.writeAt(end_, textOf(bytes));
  if (written) {
    end_ += bytes.size();
    return {};
  }
  // What there was before is whole, also where this fails: a reader drops the torn end.
  const Status ignored = file_.truncate(end_);
  return framesKept(written.error(), index_.size(), file_);
}

Status CacheWriter::addFrame(std::span<const Vec3f> points, const UsdTransform&) {
  RINGLET_ASSERT(points.size() == firstPoint_.back(), "one point per particle of the groom");
  const auto content = encoder_.encode(header_.precision, firstPoint_, points);
  const Entry entry{end_, encoder_.errorBound() * header_.metresPerUnit};
  const auto number = static_cast<std::uint32_t>(index_.size() + 1);
  if (Status written = append(packer_.pack(ChunkKind::frame, number, entry.errorBound, content)); !written)
    return written;
  index_.push_back(entry);
  return {};
}

Status CacheWriter::finish() {
  RINGLET_ASSERT(!index_.empty(), "a file without frames is not finished but dropped");
  std::vector<std::byte> content, end;
  for (const Entry& entry : index_) {
    appendU64(content, entry.offset);
    appendF64(content, entry.errorBound);
  }
  appendU64(end, end_);
  for (char c : cache::kEndMagic) end.push_back(static_cast<std::byte>(c));
  const auto frames = static_cast<std::uint32_t>(index_.size());
  if (Status written = append(packer_.pack(ChunkKind::index, frames, 0, content)); !written) return written;
  if (Status written = append(end); !written) return written;

  return file_.closeAs(path_);
}

std::optional<double> CacheWriter::errorBound() const {
  double largest = 0;
  for (const Entry& entry : index_) largest = std::max(largest, entry.errorBound);
  return largest;
}

}  // namespace ringlet
