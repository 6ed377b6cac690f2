// CacheWriter: an animation of strands as a cache (.rgc), 5 or 9 bytes a point where USD text takes 30,
// written frame by frame. The layout is cache_format.h's. `.rgc` stands for Ringlet cache; nothing else that
// reads hair uses it, and `ringlet convert` makes of it what other programs read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "ringlet/base/result.h"
#include "ringlet/base/vec3.h"
#include "ringlet/groom/groom.h"
#include "ringlet/output/animation_writer.h"
#include "ringlet/output/byte_file.h"
#include "ringlet/output/cache_format.h"
#include "ringlet/output/cache_frame.h"

namespace ringlet {

/// While frames come, the file is `PATH.partial`: a killed program leaves all finished frames in it, which
/// CacheReader finds. finish() adds the index and renames it to PATH, so a PATH that is there is finished. A
/// frame that fails (full disk) leaves the frames before it.
class CacheWriter : public AnimationWriter {
 public:
  /// Creates the file and writes everything but the frames. Only the groom's strand lengths are used; it has
  /// a strand.
  static Result<CacheWriter> create(const std::filesystem::path& path, const Groom& topology,
                                    const CacheHeader& header);

  /// Goes on with PATH.partial after its first `frameCount` frames, dropping what follows, to the bytes of a
  /// file written in one go; with 0 it begins anew. Errors: the file is not that of such an animation, or has
  /// fewer whole frames.
  static Result<CacheWriter> resume(const std::filesystem::path& path, const Groom& topology,
                                    const CacheHeader& header, int frameCount);

  CacheWriter(CacheWriter&&) = default;
  CacheWriter& operator=(CacheWriter&&) = delete;
  /// Without finish(): leaves the partial file if it holds a frame, else removes it.
  ~CacheWriter() override;

  /// Adds a frame; points in the file's unit, in groom order, finite (see finite_points.h). Cost: one write,
  /// and about 1 ms of processor time for 64,000 points.
  Status addFrame(std::span<const Vec3f> points, const UsdTransform& head = {}) override;
  /// What was added is on the disk.
  Status sync() override { return file_.sync(); }
  /// Writes the index, closes the file with the frames so far (at least one) and gives it its name.
  Status finish() override;

  int frameCount() const override { return static_cast<int>(index_.size()); }
  std::uint64_t byteCount() const { return end_; }
  /// The farthest that any point of the file may be from the one that was added [m].
  std::optional<double> errorBound() const override;

 private:
  struct Entry {
    std::uint64_t offset;  // of a frame's chunk [byte]
    double errorBound;     // [m]
  };

  CacheWriter(ByteFile file, const std::filesystem::path& path, const Groom& topology,
              const CacheHeader& header)
      : file_(std::move(file)), path_(path), firstPoint_(topology.firstPoint), header_(header) {}
  Status append(std::span<const std::byte> bytes);

  ByteFile file_;                          // PATH.partial
  std::filesystem::path path_;             // PATH
  std::vector<std::uint32_t> firstPoint_;  // as in Groom
  CacheHeader header_;
  cache::FrameEncoder encoder_;
  cache::ChunkPacker packer_;
  std::vector<Entry> index_;
  std::uint64_t end_ = 0;  // of the file [byte]
};

}  // namespace ringlet
